//! A bound for cells beside a sphere.

use super::region::Cell;
use crate::bezier::{Patch, lengths};
use crate::both::both;
use crate::model::RigidTransform;
use crate::symmetry::Sphere;
use glam::Vec4Swizzles;

/// At least the distance to the sphere's surface of every point of the cell:
/// `| |a - c| - r |`, with `|a - c|` between the lengths that
/// the cell's controls, relative to the sphere's centre, allow. O(p^2 q^2).
pub(super) fn on_sphere(cell: &Cell, patch: &Patch<'_>, transform: &RigidTransform, sphere: &Sphere) -> f64 {
    let range = both(|axis| [cell.center[axis] - cell.half[axis], cell.center[axis] + cell.half[axis]]);
    let mut controls = patch.restricted(range[0], range[1]);
    let shift = patch.center - transform.apply_inverse(sphere.center);
    for control in &mut controls {
        *control = (control.xyz() + control.w * shift).extend(control.w);
    }
    let [least, largest] = lengths(&controls, patch.degree);
    (largest - sphere.radius).max(sphere.radius - least) + sphere.off
}
