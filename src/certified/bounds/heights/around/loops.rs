//! Closed curves around a convex set of the plane.

use super::shadow::Shadow;
use std::f64::consts::TAU;

/// Returns true only if a closed curve has a winding number other than 0 about all points of the target.
///
/// The curve is given by its pieces in order; each begins where the one before ends, up to the gap, from which the
/// curve itself may be off by as much. A piece that a line separates from the target is homotopic to the segment
/// between its ends in what the line leaves of the plane.
pub(super) fn runs_around(curve: &[Shadow], target: &Shadow, gap: f64) -> bool {
    if !curve.iter().all(|piece| piece.is_apart(target, gap)) {
        return false;
    }
    let center = target.middle();
    let ends = curve.iter().map(|piece| piece.points[piece.points.len() - 1] - center);
    let next = ends.clone().cycle().skip(1);
    let angle: f64 = ends.zip(next).map(|(end, next)| end.perp_dot(next).atan2(end.dot(next))).sum();
    // A whole number up to rounding.
    (angle / TAU).abs() > 0.5
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use glam::DVec2;

    /// A curve of the sides of a polygon.
    fn polygon(corners: &[[f64; 2]]) -> Vec<Shadow> {
        let corner = |index: usize| DVec2::from(corners[index % corners.len()]);
        (0..corners.len()).map(|side| Shadow::new(vec![corner(side), corner(side + 1)], 0.0)).collect()
    }

    fn square(center: [f64; 2], half: f64) -> Vec<[f64; 2]> {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]| [center[0] + half * x, center[1] + half * y])
            .to_vec()
    }

    /// A square runs around a smaller one, in either direction, and not around one beside it.
    #[test]
    fn a_square_runs_around_what_is_inside() {
        let target =
            |center: [f64; 2]| Shadow::new(square(center, 0.5).into_iter().map(DVec2::from).collect(), 0.0);
        let mut corners = square([0.0; 2], 1.0);
        for _ in 0..2 {
            let curve = polygon(&corners);
            assert!(runs_around(&curve, &target([0.0, 0.0]), 0.1));
            assert!(!runs_around(&curve, &target([3.0, 0.0]), 0.1));
            // The gap, and what is met.
            assert!(runs_around(&curve, &target([0.3, 0.0]), 0.19));
            assert!(!runs_around(&curve, &target([0.3, 0.0]), 0.21));
            assert!(!runs_around(&curve, &target([0.6, 0.0]), 0.0));
            corners.reverse();
        }
    }

    /// A curve that runs around a target once in each direction has the winding number 0; twice in one has 2.
    #[test]
    fn directions_count() {
        let corners = square([0.0; 2], 1.0);
        let target = Shadow::new(square([0.0; 2], 0.5).into_iter().map(DVec2::from).collect(), 0.0);
        let there: Vec<_> = corners.iter().copied().chain([corners[0]]).collect();
        let back: Vec<_> = there.iter().rev().copied().collect();
        assert!(!runs_around(&polygon(&[there.clone(), back].concat()), &target, 0.0));
        assert!(runs_around(&polygon(&[there.clone(), there].concat()), &target, 0.0));
    }

    /// A curved piece counts with all its control points, and errors with both sides.
    #[test]
    fn the_hull_of_a_piece_stays_off_the_target() {
        let point = |x: f64, y: f64| DVec2::new(x, y);
        let target = Shadow::new(vec![point(-0.5, -0.5), point(0.5, -0.5), point(0.5, 0.5)], 0.0);
        let arc = |middle: f64, error: f64| {
            Shadow::new(vec![point(1.0, -2.0), point(middle, 0.0), point(1.0, 2.0)], error)
        };
        assert!(arc(0.6, 0.0).is_apart(&target, 0.0) && !arc(0.4, 0.0).is_apart(&target, 0.0));
        assert!(arc(0.6, 0.09).is_apart(&target, 0.0) && !arc(0.6, 0.11).is_apart(&target, 0.0));
        let inexact = Shadow { error: 0.11, ..target.clone() };
        assert!(!arc(0.6, 0.0).is_apart(&inexact, 0.0) && !arc(0.6, 0.0).is_apart(&target, 0.11));
    }
}
