//! The distance of the convex hulls of two sets of points.

use super::simplex::nearest_of_simplex;
use glam::DVec3;

/// The largest number of steps for one pair: more gain less than halving a piece.
const MAX_STEPS: usize = 16;

/// The excess of a hull point's distance over the bound, as a part of the bound, at which the
/// bound counts as that of the hulls.
const RELATIVE_GAP: f64 = 1e-7;

/// A lower bound on the distance of two hulls, with the two points that the search ended at.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HullDistance {
    /// The lower bound, 0 where the hulls may meet.
    pub(crate) lower: f64,
    /// The direction that gives the bound, from B to A, of any length.
    pub(crate) direction: DVec3,
    /// A pair of points near each other: indices into both sets, with weights of sum 1.
    pub(super) pairs: [([usize; 2], f64); 4],
}

/// Returns a lower bound on the distance of the hulls of A's points and B's, from a direction to
/// start with; ends as soon as the bound is at least `enough` or within `gap` of the distance.
///
/// Guarantee (lemma C1 of docs/clearance.md): along every direction n of length 1, the hulls are
/// at least `min n·a - max n·b` apart; the largest found is returned. The directions are those of
/// E. G. Gilbert, D. W. Johnson and S. S. Keerthi, *A fast procedure for computing the distance
/// between complex objects in three-dimensional space*, 1988. O(points) a step.
pub(crate) fn hull_distance(a: &[DVec3], b: &[DVec3], start: DVec3, enough: f64, gap: f64) -> HullDistance {
    let mut found = HullDistance { lower: 0.0, direction: start, pairs: [([0, 0], 0.0); 4] };
    // The corners of the simplex, the first `count` of these.
    let (mut corners, mut count) = ([([0_usize; 2], DVec3::ZERO); 4], 0);
    let mut toward = start;
    for _ in 0..MAX_STEPS {
        let [i, j] = [lowest(a, toward), lowest(b, -toward)];
        let corner = a[i] - b[j];
        let length = toward.length();
        let lower = if length > 0.0 { (toward.dot(a[i]) - toward.dot(b[j])) / length } else { 0.0 };
        if lower > found.lower {
            (found.lower, found.direction) = (lower, toward);
        }
        let is_known = corners[..count].iter().any(|&(known, _)| known == [i, j]);
        let reached = count > 0 && length - found.lower <= gap.max(RELATIVE_GAP * length);
        if count == 0 {
            found.pairs[0] = ([i, j], 1.0);
        }
        if found.lower >= enough || is_known || reached {
            break;
        }
        corners[count] = ([i, j], corner);
        count += 1;
        let nearest = nearest_of_simplex(&corners.map(|(_, at)| at)[..count]);
        let all = count;
        (count, found.pairs) = (0, [([0, 0], 0.0); 4]);
        for (k, &weight) in nearest.weights.iter().enumerate().take(all) {
            if weight > 0.0 {
                corners[count] = corners[k];
                found.pairs[count] = (corners[k].0, weight);
                count += 1;
            }
        }
        if count == 4 {
            // The origin lies in the simplex, so the hulls meet.
            break;
        }
        toward = nearest.point;
    }
    found
}

/// Returns the index of the point that lies lowest along a direction; of one whose height is NaN, if
/// there is any, as nothing bounds it.
fn lowest(points: &[DVec3], direction: DVec3) -> usize {
    let mut best = (0, f64::INFINITY);
    for (index, point) in points.iter().enumerate() {
        let height = direction.dot(*point);
        if height.is_nan() {
            return index;
        }
        if height < best.1 {
            best = (index, height);
        }
    }
    best.0
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn cube(center: DVec3, turn: f64) -> Vec<DVec3> {
        let rotation = glam::DQuat::from_axis_angle(DVec3::Z, turn);
        (0..8)
            .map(|k| {
                let corner = DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) - 0.5;
                center + rotation * corner
            })
            .collect()
    }

    fn bound(a: &[DVec3], b: &[DVec3], start: DVec3) -> f64 {
        hull_distance(a, b, start, f64::INFINITY, 0.0).lower
    }

    /// Face to face, edge to edge and corner to corner, from any direction.
    #[test]
    fn the_distance_of_cubes_is_exact() {
        let half = 0.5_f64;
        for start in [DVec3::X, DVec3::new(0.3, -1.0, 0.2), DVec3::ZERO] {
            let side = bound(&cube(DVec3::X * 3.0, 0.0), &cube(DVec3::ZERO, 0.0), start);
            assert!((side - 2.0).abs() < 1e-12, "{side}");
            let turned =
                bound(&cube(DVec3::X * 3.0, std::f64::consts::FRAC_PI_4), &cube(DVec3::ZERO, 0.0), start);
            assert!((turned - (2.5 - half.sqrt())).abs() < 1e-7, "{turned}");
            let corner = bound(&cube(DVec3::splat(2.0), 0.0), &cube(DVec3::ZERO, 0.0), start);
            assert!((corner - 3.0_f64.sqrt()).abs() < 1e-7, "{corner}");
        }
    }

    /// A point that overflowed may be anywhere.
    #[test]
    fn hulls_with_a_point_that_is_not_finite_have_no_bound() {
        for coordinate in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for index in 0..8 {
                let mut far = cube(DVec3::X * 3.0, 0.0);
                far[index].y = coordinate;
                assert_eq!(bound(&far, &cube(DVec3::ZERO, 0.0), DVec3::X), 0.0, "{coordinate} at {index}");
                assert_eq!(bound(&cube(DVec3::ZERO, 0.0), &far, -DVec3::X), 0.0, "{coordinate} at {index}");
            }
        }
    }

    #[test]
    fn the_bound_of_hulls_that_meet_is_0() {
        assert_eq!(bound(&cube(DVec3::splat(0.3), 0.4), &cube(DVec3::ZERO, 0.0), DVec3::X), 0.0);
    }
}
