//! The distance from a point to a patch behind a plane.

use crate::bezier::Patch;
use crate::rounding::upper_max;
use glam::{DVec3, Vec4Swizzles};

/// Returns a lower bound on the distance from `target` to a patch, but for rounding (lemma R12
/// of docs/rounding.md): the least component of `target - c` along a unit vector for control
/// points c.
///
/// The patch lies in the convex hull of its control points, so every point of it is as far along
/// the vector, and no distance is less than its component. The bound is attained where the control
/// point with that component lies in the direction. A NaN component gives NaN or -∞. O(p q).
pub(super) fn distance_along(patch: &Patch<'_>, target: DVec3, direction: DVec3) -> f64 {
    let heights = patch.controls.iter().map(|control| control.xyz().dot(direction) / control.w);
    (target - patch.center).dot(direction) - heights.fold(f64::NEG_INFINITY, upper_max)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use glam::DVec4;

    /// A bilinear patch with these corners and weights, whose controls are relative to `center`.
    fn bound(corners: [DVec3; 4], weights: [f64; 4], center: DVec3, target: DVec3, direction: DVec3) -> f64 {
        let controls: Vec<DVec4> =
            corners.iter().zip(weights).map(|(&corner, w)| (w * (corner - center)).extend(w)).collect();
        distance_along(&Patch::whole([1, 1], center, &controls), target, direction)
    }

    /// Of a square in the plane z = 1 whose one corner is raised to z = 1.5, the raised corner
    /// decides from above, any other from below, with any weights.
    #[test]
    fn the_nearest_control_along_the_direction_decides() {
        let corners = [[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.5]].map(DVec3::from);
        for weights in [[1.0; 4], [1.0, 4.0, 0.5, 2.0]] {
            for center in [DVec3::ZERO, DVec3::new(8.0, -4.0, 2.0)] {
                let from = |z: f64, direction: DVec3| {
                    bound(corners, weights, center, DVec3::new(0.25, 0.5, z), direction)
                };
                assert_eq!(from(4.0, DVec3::Z), 2.5);
                assert_eq!(from(-1.0, DVec3::NEG_Z), 2.0);
                assert_eq!(from(-1.0, DVec3::Z), -2.5, "on the other side it bounds nothing");
            }
        }
    }

    /// A direction of NaN, as from a target that is its own closest point, bounds nothing.
    #[test]
    fn a_direction_of_nan_bounds_nothing() {
        let lower_bound = bound([DVec3::X; 4], [1.0; 4], DVec3::ZERO, DVec3::X, DVec3::NAN);
        assert!(lower_bound.is_nan() || lower_bound == f64::NEG_INFINITY, "{lower_bound}");
    }
}
