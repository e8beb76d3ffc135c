//! The bound beside a sphere of B, in closed form.

use super::super::Cell;
use super::{CellContext, UpperBound};
use crate::bezier::Patch;
use crate::model::RigidTransform;
use crate::symmetry::Sphere;

/// The distance to a sphere is that of the radii.
pub(super) struct InSphere;

impl UpperBound for InSphere {
    fn evaluate(&self, context: &mut CellContext<'_>, _threshold: f64) -> Option<f64> {
        let CellContext { pair, cell, patch, .. } = context;
        let surface = pair.b.patch(context.feet.nearest().patch).surface;
        let sphere = pair.b.revolution(surface)?.sphere?;
        Some(upper_bound(cell, patch, &pair.transform, &sphere))
    }
}

/// An upper bound on the distance from every point of the cell to the sphere's
/// surface, all of which belongs to B. O(p^2 q^2).
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
    sphere.distance_bound(&Patch { controls: &controls, ..*patch })
}
