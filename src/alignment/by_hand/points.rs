//! Motions from pairs of points, and from three, two and one of them.

use crate::alignment::moments::eigen;
use crate::error::{Error, Result};
use crate::limits::is_in_range;
use crate::model::RigidTransform;
use glam::{DQuat, DVec3};
use serde::Deserialize;

/// The part of a length below which a direction is not determined, as of points in a line.
const NO_DIRECTION: f64 = 1e-9;

/// A point of A and the point of B on which it belongs.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointPair {
    /// The point of A.
    pub a: [f64; 3],
    /// The point of B.
    pub b: [f64; 3],
    /// Its weight, positive; 1 if not given.
    #[serde(default = "one")]
    pub weight: f64,
}

fn one() -> f64 {
    1.0
}

impl RigidTransform {
    /// Returns the motion that lays the points of A on those of B with the least weighted sum of
    /// squared distances (B. K. P. Horn, *Closed-form solution of absolute orientation using unit
    /// quaternions*, JOSA A 4, 1987). Exact up to rounding where a motion lays all on each other.
    ///
    /// # Errors
    /// [`Error::OptionInvalid`] for fewer than three pairs, points of A or B on one line, and
    /// coordinates or weights that are not finite and within 1e100, or weights that are not positive.
    pub fn from_point_pairs(pairs: &[PointPair]) -> Result<Self> {
        if pairs.len() < 3 {
            return Err(invalid(format!("{} pairs of points, expected at least 3", pairs.len())));
        }
        for (index, PointPair { a, b, weight }) in pairs.iter().enumerate() {
            if !a.iter().chain(b).all(|&value| is_in_range(value)) {
                return Err(invalid(format!(
                    "pair {index} has a coordinate that is not finite or above 1e100"
                )));
            }
            if !(is_in_range(*weight) && *weight > 0.0) {
                return Err(invalid(format!(
                    "pair {index} has the weight {weight:?}, expected a positive one"
                )));
            }
        }
        let total: f64 = pairs.iter().map(|pair| pair.weight).sum();
        let mean = |of: fn(&PointPair) -> [f64; 3]| -> DVec3 {
            pairs.iter().map(|pair| pair.weight / total * DVec3::from_array(of(pair))).sum()
        };
        let (center_a, center_b) = (mean(|pair| pair.a), mean(|pair| pair.b));
        let arms = pairs.iter().map(|pair| {
            let arms = [DVec3::from_array(pair.a) - center_a, DVec3::from_array(pair.b) - center_b];
            (arms, pair.weight / total)
        });
        let arms: Vec<([DVec3; 2], f64)> = arms.collect();
        require_no_line("A", arms.iter().map(|(arms, _)| arms[0]))?;
        require_no_line("B", arms.iter().map(|(arms, _)| arms[1]))?;
        Ok(Self::about(horn(&arms), center_a, center_b))
    }

    /// Returns the motion of A by three points of a plane, two of an edge of it and one of another (3-2-1):
    /// the plane through the first three is laid on that of B, then the line of the next two, seen
    /// along its normal, then the last one along that line.
    ///
    /// # Errors
    /// [`Error::OptionInvalid`] for points on one line, an edge across the plane, and coordinates
    /// that are not finite or above 1e100.
    pub fn from_three_two_one(a: &[[f64; 3]; 6], b: &[[f64; 3]; 6]) -> Result<Self> {
        let ((frame_a, origin_a), (frame_b, origin_b)) = (frame("A", a)?, frame("B", b)?);
        Ok(Self::about((frame_b * frame_a.inverse()).normalize(), origin_a, origin_b))
    }
}

/// Returns the rotation with the largest sum of w a · R b: the eigenvector of Horn's matrix.
fn horn(arms: &[([DVec3; 2], f64)]) -> DQuat {
    let mut s = [[0.0; 3]; 3];
    // In units of their size, so that no product overflows.
    let size = arms.iter().fold(0.0, |size: f64, ([a, b], _)| size.max(a.abs().max(b.abs()).max_element()));
    for ([a, b], weight) in arms {
        for (row, x) in s.iter_mut().zip((*a / size).to_array()) {
            for (entry, y) in row.iter_mut().zip((*b / size).to_array()) {
                *entry += weight * x * y;
            }
        }
    }
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = s;
    let matrix = [
        [xx + yy + zz, yz - zy, zx - xz, xy - yx],
        [yz - zy, xx - yy - zz, xy + yx, zx + xz],
        [zx - xz, xy + yx, yy - xx - zz, yz + zy],
        [xy - yx, zx + xz, yz + zy, zz - xx - yy],
    ];
    let (values, vectors) = eigen(matrix);
    let largest = (0..4).fold(0, |best, k| if values[k] > values[best] { k } else { best });
    let [w, x, y, z] = [0, 1, 2, 3].map(|row| vectors[row][largest]);
    DQuat::from_xyzw(x, y, z, w).normalize()
}

/// # Errors
/// [`Error::OptionInvalid`] for points on one line through their mean.
fn require_no_line(model: &str, arms: impl Iterator<Item = DVec3> + Clone) -> Result<()> {
    let longest =
        arms.clone().fold(DVec3::ZERO, |long, arm| if arm.length() > long.length() { arm } else { long });
    let along = longest.normalize_or_zero();
    let off = arms.fold(0.0, |off: f64, arm| off.max(arm.cross(along).length()));
    if off > NO_DIRECTION * longest.length() {
        return Ok(());
    }
    Err(invalid(format!("the points of {model} lie on one line, which leaves a rotation free")))
}

/// The frame of six points: z is the normal of the first three, x along the next two, and the origin
/// lies in the plane, on the line and beside the last point.
fn frame(model: &str, points: &[[f64; 3]; 6]) -> Result<(DQuat, DVec3)> {
    if !points.iter().flatten().all(|&value| is_in_range(value)) {
        return Err(invalid(format!("{model} has a coordinate that is not finite or above 1e100")));
    }
    let [p, q, r, s, t, u] = points.map(DVec3::from_array);
    let (one, two) = ((q - p).normalize_or_zero(), (r - p).normalize_or_zero());
    let z = one.cross(two);
    if !(z.length() > NO_DIRECTION) {
        return Err(invalid(format!("the first three points of {model} lie on one line")));
    }
    let z = z.normalize();
    let edge = (t - s).normalize_or_zero();
    let x = edge - z * edge.dot(z);
    if !(x.length() > NO_DIRECTION) {
        return Err(invalid(format!("the edge of {model} is across its plane")));
    }
    let x = x.normalize();
    let y = z.cross(x);
    let origin = u.dot(x) * x + s.dot(y) * y + p.dot(z) * z;
    Ok((DQuat::from_mat3(&glam::DMat3::from_cols(x, y, z)).normalize(), origin))
}

fn invalid(found: String) -> Error {
    Error::OptionInvalid { found }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    fn motion(angle: f64) -> RigidTransform {
        let axis = DVec3::new(2.0, -1.0, 2.0) / 3.0;
        RigidTransform::new(DQuat::from_axis_angle(axis, angle), DVec3::new(7.0, -3.0, 0.5)).unwrap()
    }

    const POINTS: [[f64; 3]; 6] = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 3.0, 0.0],
        [1.0, 0.0, 1.0],
        [3.0, 0.0, 2.0],
        [0.0, 1.0, 1.0],
    ];

    fn images(motion: &RigidTransform) -> [[f64; 3]; 6] {
        POINTS.map(|point| motion.apply(DVec3::from_array(point)).to_array())
    }

    fn assert_near(found: &RigidTransform, expected: &RigidTransform) {
        for point in POINTS.map(DVec3::from_array) {
            let off = found.apply(point).distance(expected.apply(point));
            assert!(off < 1e-13 * 10.0, "{off}: {found:?} {expected:?}");
        }
    }

    #[test]
    fn pairs_of_points_give_the_motion_that_moved_them() {
        for angle in [0.0, 0.3, 1.5, 3.0, std::f64::consts::PI] {
            let moved = images(&motion(angle));
            let pairs: Vec<PointPair> =
                (0..6).map(|k| PointPair { a: POINTS[k], b: moved[k], weight: 1.0 + k as f64 }).collect();
            assert_near(&RigidTransform::from_point_pairs(&pairs).unwrap(), &motion(angle));
        }
    }

    /// Of a triangle whose third corner is off by a height the weighted centres meet, and the sum of
    /// squares is least: no small motion lowers it.
    #[test]
    fn no_small_motion_lowers_the_weighted_sum() {
        let mut moved = images(&motion(0.7));
        moved[2] = (DVec3::from_array(moved[2]) + DVec3::new(0.1, 0.2, -0.3)).to_array();
        let pairs: Vec<PointPair> = (0..6)
            .map(|k| PointPair { a: POINTS[k], b: moved[k], weight: if k == 2 { 5.0 } else { 1.0 } })
            .collect();
        let sum = |motion: &RigidTransform| -> f64 {
            let of = |pair: &PointPair| {
                let image = motion.apply(DVec3::from_array(pair.a));
                pair.weight * image.distance_squared(DVec3::from_array(pair.b))
            };
            pairs.iter().map(of).sum()
        };
        let best = RigidTransform::from_point_pairs(&pairs).unwrap();
        let least = sum(&best);
        // No motion lays all of them on each other.
        assert!(least > 1e-3);
        for axis in DVec3::AXES {
            for sign in [-1e-4, 1e-4] {
                assert!(sum(&best.followed(sign * axis, DVec3::ZERO, DVec3::ZERO)) > least);
                assert!(sum(&best.followed(DVec3::ZERO, DVec3::ZERO, sign * axis)) > least);
            }
        }
    }

    #[test]
    fn three_two_one_gives_the_motion_and_later_points_count_only_along_what_is_free() {
        let mut moved = images(&motion(2.0));
        let expected = motion(2.0);
        assert_near(&RigidTransform::from_three_two_one(&POINTS, &moved).unwrap(), &expected);
        // The edge's height, the last point's height and place across the edge do not count.
        let [up, across] = [DVec3::Z, DVec3::Y].map(|axis| expected.rotate(axis));
        let shift = |point: &mut [f64; 3], by: DVec3| *point = (DVec3::from_array(*point) + by).to_array();
        shift(&mut moved[3], 0.4 * up);
        shift(&mut moved[4], -0.2 * up);
        shift(&mut moved[5], 0.3 * up + 0.7 * across);
        assert_near(&RigidTransform::from_three_two_one(&POINTS, &moved).unwrap(), &expected);
    }

    #[test]
    fn what_determines_no_motion_is_refused() {
        let pair = |x: f64, y: f64| PointPair { a: [x, y, 0.0], b: [x, y, 0.0], weight: 1.0 };
        let line = [pair(0.0, 0.0), pair(1.0, 0.0), pair(2.0, 0.0)];
        let code =
            |pairs: &[PointPair]| RigidTransform::from_point_pairs(pairs).map_err(|error| error.code());
        assert_eq!(code(&line), Err("OPTION_INVALID"));
        assert_eq!(code(&line[..2]), Err("OPTION_INVALID"));
        let mut weightless = [pair(0.0, 0.0), pair(1.0, 0.0), pair(0.0, 1.0)];
        assert!(code(&weightless).is_ok());
        weightless[1].weight = 0.0;
        assert_eq!(code(&weightless), Err("OPTION_INVALID"));
        weightless[1] = pair(f64::NAN, 0.0);
        assert_eq!(code(&weightless), Err("OPTION_INVALID"));
        let mut flat = POINTS;
        flat[2] = [2.0, 0.0, 0.0];
        assert!(RigidTransform::from_three_two_one(&flat, &POINTS).is_err());
        let mut across = POINTS;
        (across[3], across[4]) = ([0.0; 3], [0.0, 0.0, 1.0]);
        assert!(RigidTransform::from_three_two_one(&across, &POINTS).is_err());
    }
}
