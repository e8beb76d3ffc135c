//! One of the two models, and the error of its computed points.

use crate::bvh::Aabb;
use crate::closest::Target;
use crate::model::RigidTransform;
use crate::rounding::{VANISHING_LENGTH, gamma};

/// The roundings of a bound of a pair, relative to the largest length of a control point of
/// both models: lemma C2 of docs/clearance.md.
const BOUND_ROUNDINGS: f64 = 64.0;

/// A model as the search sees it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Body<'a> {
    /// Its patches and their tree.
    pub(crate) target: &'a Target,
    /// A box around the control points of its surfaces and patches.
    pub(crate) control_box: Aabb,
    /// An upper bound on the distance between a computed point and the exact one.
    pub(crate) point_error: f64,
}

impl Body<'_> {
    /// Returns the error that halving a patch so often adds to its control points (lemma R4
    /// of docs/rounding.md).
    fn halving_error(&self, halvings: u32) -> f64 {
        gamma(2.0 * f64::from(halvings) * self.target.max_degree as f64) * self.control_box.diagonal()
    }
}

/// Returns an upper bound on the error of both bounds of a pair of pieces, the one of A moved,
/// after at most `halvings` halvings of each: E of lemma C2.
pub(super) fn pair_error([a, b]: [&Body<'_>; 2], transform: &RigidTransform, halvings: u32) -> f64 {
    let of_a = a.control_box.farthest_from_origin();
    let length = (of_a + transform.offset().length()).max(b.control_box.farthest_from_origin());
    a.point_error
        + b.point_error
        + transform.rounding(of_a)
        + a.halving_error(halvings)
        + b.halving_error(halvings)
        + gamma(BOUND_ROUNDINGS) * length
        + VANISHING_LENGTH
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::rounding::UNIT_ROUNDOFF;
    use crate::shapes::sphere;
    use glam::{DQuat, DVec3};

    /// The terms of lemma C2, each alone where the others vanish or are subtracted.
    #[test]
    fn the_error_of_a_pair_has_the_terms_of_the_lemma() {
        // Of degree 2.
        let target = Target::new(extract(&sphere(DVec3::ZERO, 1.0).unwrap()).patches);
        let body = |half: DVec3, point_error: f64| Body {
            target: &target,
            control_box: Aabb { min: -half, max: half },
            point_error,
        };
        let [small, large] = [DVec3::ZERO, DVec3::new(3.0, 0.0, 4.0)];
        let moved = |length: f64| RigidTransform::new(DQuat::IDENTITY, length * DVec3::Y).unwrap();
        let error = |a: [f64; 2], b: [f64; 2], length: f64, halvings: u32| {
            let [a, b] = [a, b].map(|[size, point_error]| body(small.lerp(large, size), point_error));
            pair_error([&a, &b], &moved(length), halvings)
        };
        let is_near = |found: f64, expected: f64| {
            assert!(expected <= found && found <= 1.02 * expected, "{found:e} for {expected:e}");
        };
        is_near(error([0.0, 0.25], [0.0, 0.0], 0.0, 0), 0.25);
        is_near(error([0.0, 0.0], [0.0, 0.25], 0.0, 0), 0.25);
        // The lengths of B alone, of A with its motion, and of the motion alone.
        is_near(error([0.0, 0.0], [1.0, 0.0], 0.0, 0), UNIT_ROUNDOFF * 64.0 * 5.0);
        is_near(error([1.0, 0.0], [0.0, 0.0], 2.0, 0), UNIT_ROUNDOFF * (65.0 + 64.0) * 7.0);
        is_near(error([0.0, 0.0], [0.0, 0.0], 2.0, 0), UNIT_ROUNDOFF * (65.0 + 64.0) * 2.0);
        // Ten halvings of a box with a diagonal of 10, of either model.
        for [a, b] in [[1.0, 0.0], [0.0, 1.0]] {
            let halved = error([a, 0.0], [b, 0.0], 0.0, 10) - error([a, 0.0], [b, 0.0], 0.0, 0);
            is_near(halved, UNIT_ROUNDOFF * 2.0 * 10.0 * 2.0 * 10.0);
        }
    }
}
