//! A bound for cells beside a sphere.

use super::region::Cell;
use crate::bezier::Patch;
use crate::model::RigidTransform;
use crate::symmetry::Sphere;

/// At least the distance to the sphere's surface of every point of the cell.
/// O(p^2 q^2).
pub(super) fn on_sphere(cell: &Cell, patch: &Patch<'_>, transform: &RigidTransform, sphere: &Sphere) -> f64 {
    let range = [0, 1].map(|axis| [cell.center[axis] - cell.half[axis], cell.center[axis] + cell.half[axis]]);
    let controls = patch.restricted(range[0], range[1]);
    // The sphere is moved against the patch, as its centre is one point.
    let sphere = Sphere { center: transform.apply_inverse(sphere.center), ..*sphere };
    sphere.distance_bound(&Patch { controls: &controls, ..*patch })
}
