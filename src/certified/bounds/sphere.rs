//! The bound beside a sphere of B, in closed form.

use super::super::Cell;
use super::super::rounding::gamma;
use crate::bezier::Patch;
use crate::certified::audit::Lemma;
use crate::certified::cell_context::{CellContext, UpperBound};
use crate::model::RigidTransform;
use crate::rounding::upper_max;
use crate::symmetry::Sphere;

/// Roundings of a restricted control point for each degree (lemma R6), and of the
/// shift to the sphere's centre.
const RESTRICTION_ROUNDINGS: f64 = 16.0;
const SHIFT_ROUNDINGS: f64 = 8.0;

/// The distance to a sphere is that of the radii.
pub(super) struct InSphere;

impl UpperBound for InSphere {
    fn lemma(&self) -> Lemma {
        Lemma::Sphere
    }

    fn evaluate(&self, context: &mut CellContext<'_>, _threshold: f64) -> Option<f64> {
        let CellContext { pair, cell, patch, .. } = context;
        let surface = pair.b.patch(context.feet.nearest().patch).surface;
        let sphere = pair.b.revolution(surface)?.sphere?;
        Some(upper_bound(cell, patch, &pair.transform, &sphere))
    }
}

/// An upper bound on the distance from every point of the cell to the sphere's
/// surface that belongs to B as a whole. O(p^2 q^2).
pub(super) fn upper_bound(
    cell: &Cell,
    patch: &Patch<'_>,
    transform: &RigidTransform,
    sphere: &Sphere,
) -> f64 {
    let [s, t] = cell.ranges();
    let controls = patch.restricted(s, t);
    // The sphere is moved against the patch: its centre is one point.
    let sphere = Sphere { center: transform.apply_inverse(sphere.center), ..*sphere };
    let radius = patch.local_points().map(|point| point.length()).fold(0.0, upper_max);
    let shift = patch.center.distance(sphere.center);
    sphere.distance_bound(&Patch { controls: &controls, ..*patch })
        + restriction_error(patch.degree, radius, shift)
}

/// An upper bound on the error of control points at most `radius` from their centre, restricted
/// to a cell and moved to the sphere's centre, which is `shift` away (lemma R6).
fn restriction_error([p, q]: [usize; 2], radius: f64, shift: f64) -> f64 {
    gamma((RESTRICTION_ROUNDINGS * (p + q) as f64 + 8.0) * radius + SHIFT_ROUNDINGS * shift)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::rounding::UNIT_ROUNDOFF;
    use glam::{DVec3, DVec4};

    #[test]
    fn the_error_of_a_restriction_is_that_of_the_lemma() {
        for (radius, shift, lemma) in [(1.0, 0.0, 16.0 * 5.0 + 8.0), (0.0, 1.0, 8.0), (2.0, 3.0, 200.0)] {
            let part = restriction_error([3, 2], radius, shift) / (UNIT_ROUNDOFF * lemma);
            assert!((1.0..=1.02).contains(&part), "{part} of the lemma, radius {radius}, shift {shift}");
        }
    }

    /// A point at distance 5 from the centre of a sphere of radius 2: the distance is 3, and the
    /// error of a shift by 5 is added.
    #[test]
    fn the_error_of_a_restriction_is_added() {
        let (degree, center) = ([1, 1], 5.0 * DVec3::X);
        let controls = [DVec4::W; 4];
        let patch = Patch::whole(degree, center, &controls);
        let sphere = Sphere { center: DVec3::ZERO, radius: 2.0, deviation: 0.0 };
        let bound = upper_bound(&Cell::whole(0), &patch, &RigidTransform::IDENTITY, &sphere);
        let excess = (bound - sphere.distance_bound(&patch)) / (UNIT_ROUNDOFF * 8.0 * 5.0);
        assert!((0.9..=1.1).contains(&excess), "{excess} of the lemma");
    }
}
