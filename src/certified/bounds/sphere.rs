//! The bound beside a sphere of B, in closed form.

use super::super::Cell;
use super::super::rounding::gamma;
use super::{CellContext, UpperBound};
use crate::bezier::Patch;
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
    let radius = patch.local_points().map(|point| point.length()).fold(0.0, upper_max);
    let degrees = (patch.degree[0] + patch.degree[1]) as f64;
    let shift = patch.center.distance(sphere.center);
    let rounding = gamma((RESTRICTION_ROUNDINGS * degrees + 8.0) * radius + SHIFT_ROUNDINGS * shift);
    sphere.distance_bound(&Patch { controls: &controls, ..*patch }) + rounding
}
