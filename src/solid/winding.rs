//! The number of times that a ray crosses a patch, less the times that it crosses it the other way.

use super::curve::split;
use super::ray::{Range, Ray};
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::param_box::ParamBox;
use crate::rounding::upper_max;
use glam::{DVec3, DVec4, Vec4Swizzles};

/// The largest number of parts of one patch that are divided: all of them are near an end of the ray, and
/// slivers whose parameter lines both run along them have thousands there.
const MAX_PARTS: usize = 4096;

/// The largest number of halvings of a patch or of an edge; the margin of rays allows for them.
pub(super) const MAX_DEPTH: u32 = 64;

/// Why a ray does not decide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Obstacle {
    /// The ray may meet an edge or a strip, which another ray may avoid.
    OnTheWay,
    /// An end of the ray is so near to a patch that its side is not found, whichever way the ray goes.
    AtTheEnd,
}

/// Returns how often the ray crosses the patch along its normal u × v, less the crossings against it, in the sense of
/// lemma S2 of docs/solids.md, if it certainly meets no edge of the patch and does not start on it.
///
/// The patch is halved until each part lies beside the ray, or a plane separates it from the ray's start.
/// The number of a part that is ahead is that of its boundary's windings about the ray.
pub(super) fn patch_winding(patch: &Patch<'_>, ray: &Ray) -> Result<i32, Obstacle> {
    let controls = ray.controls(patch.center, patch.controls);
    let mut parts = vec![(controls, 0_u32)];
    let (mut winding, mut count) = (0, 0);
    let mut points = Vec::with_capacity(patch.controls.len());
    while let Some((controls, depth)) = parts.pop() {
        points.clear();
        points.extend(controls.iter().map(local));
        let range = Range::of(points.iter().copied());
        if ray.is_beside(&range) {
            continue;
        }
        let of_plane = || ray.beyond_plane(normal(patch.degree, &points), points.iter().copied());
        match if ray.is_ahead(&range) { Some(true) } else { of_plane() } {
            Some(true) => {
                let of_part = boundary_winding(patch.degree, &controls, ray.margin);
                winding += of_part.ok_or(Obstacle::OnTheWay)?;
                continue;
            }
            Some(false) => continue,
            None => {}
        }
        count += 1;
        // Parts smaller than the margin stay as near, and there are ever more of them.
        let is_small = (range.high - range.low).max_element() <= ray.margin;
        if is_small || depth == MAX_DEPTH || count > MAX_PARTS {
            return Err(Obstacle::AtTheEnd);
        }
        let part = Patch { controls: &controls, center: DVec3::ZERO, domain: ParamBox::UNIT, ..*patch };
        let halves = part.halves(longer_axis(patch.degree, |index| points[index]));
        parts.extend(halves.map(|half| (half, depth + 1)));
    }
    Ok(winding)
}

/// The largest number of parts of one patch that are divided to see that a segment does not meet it: one that does is
/// given up soon.
const MAX_CLEAR_PARTS: usize = 96;

/// Returns true only if the ray certainly has no point of the patch.
///
/// The patch is halved until each part lies beside the ray, or a plane through an end of it is between both.
pub(super) fn is_clear(patch: &Patch<'_>, ray: &Ray) -> bool {
    let mut parts = vec![ray.controls(patch.center, patch.controls)];
    let mut points = Vec::with_capacity(patch.controls.len());
    let mut count = 0;
    while let Some(controls) = parts.pop() {
        points.clear();
        points.extend(controls.iter().map(local));
        let of_plane = || ray.beyond_plane(normal(patch.degree, &points), points.iter().copied());
        if ray.is_beside(&Range::of(points.iter().copied())) || of_plane() == Some(false) {
            continue;
        }
        count += 1;
        if count > MAX_CLEAR_PARTS {
            return false;
        }
        let part = Patch { controls: &controls, center: DVec3::ZERO, domain: ParamBox::UNIT, ..*patch };
        parts.extend(part.halves(longer_axis(patch.degree, |index| points[index])));
    }
    true
}

/// Returns the point of a control.
fn local(control: &DVec4) -> DVec3 {
    control.xyz() / control.w
}

/// Returns the unit normal of the plane that is parallel to both diagonals; it is 0 where they are parallel.
fn normal([_, q]: [usize; 2], points: &[DVec3]) -> DVec3 {
    let last = points.len() - 1;
    (points[last] - points[0]).cross(points[last - q] - points[q]).normalize_or_zero()
}

/// Returns the axis along which the longest polygon of control points, by their indices, is longer. Corners alone
/// would not tell: those of a patch that closes in u coincide along u.
fn longer_axis([p, q]: [usize; 2], point: impl Fn(usize) -> DVec3) -> Axis {
    let columns = q + 1;
    let step = |from: usize, to: usize| point(from).distance(point(to));
    let along_u = |j: usize| (0..p).map(|i| step(i * columns + j, (i + 1) * columns + j)).sum::<f64>();
    let along_v = |i: usize| (0..q).map(|j| step(i * columns + j, i * columns + j + 1)).sum::<f64>();
    let [u, v] = [(0..=q).map(along_u).fold(0.0, upper_max), (0..=p).map(along_v).fold(0.0, upper_max)];
    if u >= v { Axis::U } else { Axis::V }
}

/// As [`longer_axis`], of homogeneous control points.
pub(crate) fn longer_axis_of_controls(degree: [usize; 2], controls: &[DVec4]) -> Axis {
    longer_axis(degree, |index| local(&controls[index]))
}

/// Returns how often a patch's boundary, anticlockwise in its parameters, winds about the axis, from x to y.
fn boundary_winding([p, q]: [usize; 2], controls: &[DVec4], margin: f64) -> Option<i32> {
    let columns = q + 1;
    let column = |j: usize| controls.iter().skip(j).step_by(columns).copied().collect::<Vec<_>>();
    let along = [column(0), controls[p * columns..].to_vec()];
    let against = [column(q), controls[..columns].to_vec()];
    let mut winding = 0;
    for (edges, sign) in [(along, 1), (against, -1)] {
        for edge in edges {
            winding += sign * curve_winding(edge, margin)?;
        }
    }
    Some(winding)
}

/// Returns how often a curve crosses the half plane y = 0, x > 0 towards y > 0, less the crossings the other way;
/// `None` if it may meet the axis, or end in the half plane.
///
/// A part on the side x > 0 crosses it once more towards the sign of y at its end where the ends have different signs,
/// by the intermediate value theorem.
fn curve_winding(curve: Vec<DVec4>, margin: f64) -> Option<i32> {
    let mut parts = vec![(curve, 0_u32)];
    let mut winding = 0;
    while let Some((controls, depth)) = parts.pop() {
        let Range { low, high, .. } = Range::of(controls.iter().map(local));
        if low.y > margin || high.y < -margin || high.x < -margin {
            continue;
        }
        if low.x > margin {
            let [start, end] = [controls.first()?, controls.last()?].map(|control| local(control).y);
            if start.abs() <= margin || end.abs() <= margin {
                return None;
            }
            winding += i32::from(end > 0.0) - i32::from(start > 0.0);
            continue;
        }
        if depth == MAX_DEPTH {
            return None;
        }
        let halves = split(&controls, 0.5);
        parts.extend(halves.map(|half| (half, depth + 1)));
    }
    Some(winding)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// The unit square at height z = x + 2 y + 1, seen along -z and z.
    #[test]
    fn a_plane_patch_is_crossed_once_inside_and_never_beside() {
        let corner = |x: f64, y: f64| DVec4::new(x, y, x + 2.0 * y + 1.0, 1.0);
        let controls = [corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 0.0), corner(1.0, 1.0)];
        let patch = Patch::whole([1, 1], DVec3::ZERO, &controls);
        let winding = |start: [f64; 3], direction: [f64; 3]| {
            let direction = DVec3::from_array(direction).normalize();
            patch_winding(&patch, &Ray::new(DVec3::from_array(start), direction, 1e-12))
        };
        assert_eq!(winding([0.3, 0.6, 0.0], [0.0, 0.0, 1.0]), Ok(1));
        assert_eq!(winding([0.3, 0.6, 9.0], [0.0, 0.0, -1.0]), Ok(-1), "against the normal");
        assert_eq!(winding([0.3, 0.6, 0.0], [0.0, 0.0, -1.0]), Ok(0));
        assert_eq!(winding([0.3, 0.6, 2.5 - 1e-9], [0.1, 0.0, 1.0]), Ok(1));
        assert_eq!(winding([0.3, 0.6, 2.5 + 1e-9], [0.1, 0.0, 1.0]), Ok(0));
        assert_eq!(winding([1.2, 0.6, 0.0], [0.0, 0.0, 1.0]), Ok(0));
        assert_eq!(
            winding([0.3, 1.0, 0.0], [0.0, 0.0, 1.0]),
            Err(Obstacle::OnTheWay),
            "the ray meets an edge"
        );
        assert!(winding([0.3, 0.6, 2.5], [0.1, 0.0, 1.0]).is_err(), "the ray starts on the patch");
    }

    /// A segment above a bowl is clear of it, down to its margin, and one into it is not, at whichever end.
    #[test]
    fn a_segment_is_clear_of_a_patch_only_if_it_does_not_meet_it() {
        let at = |x: f64, y: f64, z: f64| DVec4::new(x, y, z, 1.0);
        // z = x² + y² over [-1, 1]².
        let heights = [[2.0, 0.0, 2.0], [0.0, -2.0, 0.0], [2.0, 0.0, 2.0]];
        let controls: Vec<DVec4> =
            (0..9).map(|k| at((k / 3) as f64 - 1.0, (k % 3) as f64 - 1.0, heights[k / 3][k % 3])).collect();
        let patch = Patch::whole([2, 2], DVec3::ZERO, &controls);
        let clear = |start: [f64; 3], end: [f64; 3]| {
            is_clear(&patch, &Ray::segment(DVec3::from_array(start), DVec3::from_array(end), 1e-9))
        };
        for low in [1e-3, 1e-7] {
            assert!(clear([0.3, 0.4, 0.25 + low], [0.3, 0.4, 2.0]), "{low}");
            assert!(clear([0.3, 0.4, 0.25 - low], [0.3, 0.4, -2.0]), "{low}");
            assert!(!clear([0.3, 0.4, 0.25 - low], [0.3, 0.4, 2.0]), "{low}");
            assert!(!clear([0.3, 0.4, 2.0], [0.3, 0.4, 0.25 - low]), "{low}");
        }
        assert!(!clear([0.3, 0.4, 0.25 + 1e-10], [0.3, 0.4, 2.0]), "within the margin");
        assert!(!clear([-2.0, 0.1, 0.5], [2.0, 0.1, 0.5]), "twice, from outside to outside");
        assert!(!clear([0.3, 0.4, 1.0], [0.3, 0.4, 1.0]), "no segment");
    }

    /// A thin tube about the z axis: one patch that closes in u, whose corners coincide along u. A ray
    /// along its wall's tangent plane from near it, and one along the axis, need halves along u.
    #[test]
    fn a_patch_that_closes_is_halved_along_its_longer_axis() {
        let ring = [[1.0, 0.0], [3.0, 2.0], [-1.0, 4.0], [-5.0, 0.0], [-1.0, -4.0], [3.0, -2.0], [1.0, 0.0]];
        let point = |[x, y]: [f64; 2], z: f64| DVec4::new(x, y, z, 1.0);
        let controls: Vec<DVec4> =
            ring.into_iter().flat_map(|place| [point(place, 0.0), point(place, 0.5)]).collect();
        assert_eq!(longer_axis([6, 1], |index| local(&controls[index])), Axis::U);
        let patch = Patch::whole([6, 1], DVec3::ZERO, &controls);
        for turn in 0..32 {
            let (sin, cos) = (0.1 + 0.19 * f64::from(turn)).sin_cos();
            let across = DVec3::new(cos, sin, 0.01);
            let from = |x: f64| Ray::new(DVec3::new(x, 0.0, 0.25), across.normalize(), 1e-12);
            // The tube has (0, 0) inside and (-9, 0) outside: a ray near z = 0.25 meets its wall an odd
            // number of times from there, and an even one from here.
            assert_eq!(patch_winding(&patch, &from(0.0)), Ok(1), "{turn}");
            assert_eq!(patch_winding(&patch, &from(-9.0)), Ok(0), "{turn}");
        }
    }

    /// Heights above a plane through the ray's ends count beyond twice the margin.
    #[test]
    fn planes_that_separate_a_patch_from_the_ends_decide() {
        let ray = Ray::new(DVec3::ZERO, DVec3::Z, 1e-3);
        let tilted = DVec3::new(0.0, -0.6, 0.8);
        let between = |ray: &Ray, heights: [f64; 2]| {
            // Points at these heights above the tilted plane, far to either side of the ray.
            let points = [(-9.0, heights[0]), (9.0, heights[1])].map(|(aside, height)| {
                let point = aside * DVec3::Y;
                point + (height - tilted.dot(point)) * tilted
            });
            [tilted, -tilted].map(|normal| ray.beyond_plane(normal, points.into_iter()))
        };
        assert_eq!(between(&ray, [0.0021, 3.0]), [Some(true); 2]);
        assert_eq!(between(&ray, [-0.0021, -3.0]), [Some(false); 2]);
        // Heights within twice the margin are on either side, and so are those of different signs.
        for heights in [[0.0019, 3.0], [-0.0019, -3.0], [-0.1, 0.1]] {
            assert_eq!(between(&ray, heights), [None; 2], "{heights:?}");
        }
        // The segment ends at a height of 0.8 × 5 above the plane.
        let segment = Ray::segment(DVec3::ZERO, 5.0 * DVec3::Z, 1e-3);
        assert_eq!(between(&segment, [0.0021, 3.9979]), [Some(true); 2]);
        assert_eq!(between(&segment, [4.0021, 9.0]), [Some(false); 2]);
        for heights in [[0.0021, 3.9981], [3.9981, 9.0], [2.0, 9.0]] {
            assert_eq!(between(&segment, heights), [None; 2], "{heights:?}");
        }
        assert_eq!(ray.beyond_plane(DVec3::ZERO, [DVec3::ONE].into_iter()), None);
        assert_eq!(ray.beyond_plane(tilted, [DVec3::ONE, DVec3::NAN].into_iter()), None);
    }
}
