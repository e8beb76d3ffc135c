//! Bounds that are known before anything is searched.

use super::Operand;
use super::correspond::correspond;
use super::on_sphere::on_sphere;
use super::region::Cell;
use crate::model::RigidTransform;
use glam::DVec3;

/// At least the distance to B of every point of a patch of A, if its like on B
/// or a sphere tells it.
pub(super) fn at_once(a: &Operand<'_>, b: &Operand<'_>, transform: &RigidTransform, index: u32) -> f64 {
    let beside = |sphere| on_sphere(&Cell::whole(index), &a.patch(index), transform, &sphere);
    correspond(a, b, transform, index).min(b.sphere.map_or(f64::INFINITY, beside))
}

/// The largest of all A's patches, infinite once one has none.
pub(super) fn farthest_at_once(a: &Operand<'_>, b: &Operand<'_>, transform: &RigidTransform) -> f64 {
    let mut largest = 0.0_f64;
    for index in 0..a.target.patches.len() {
        if largest == f64::INFINITY {
            break;
        }
        largest = largest.max(at_once(a, b, transform, index as u32));
    }
    largest
}

/// The largest distance between points of the two models' boxes: a convex
/// function's largest value over A's box is at a corner.
pub(super) fn farthest_corners(a: &Operand<'_>, b: &Operand<'_>, transform: &RigidTransform) -> f64 {
    let (Some(a), Some(b)) = (a.target.tree.nodes().first(), b.target.tree.nodes().first()) else {
        return 0.0;
    };
    let pick = |bit: usize, low: f64, high: f64| if bit == 0 { low } else { high };
    let corner = |index: usize| {
        let (min, max) = (a.aabb.min, a.aabb.max);
        DVec3::new(
            pick(index & 1, min.x, max.x),
            pick(index & 2, min.y, max.y),
            pick(index & 4, min.z, max.z),
        )
    };
    let distance_squared = |index| b.aabb.max_distance_squared(transform.apply(corner(index)));
    (0..8).map(distance_squared).fold(0.0, f64::max).sqrt()
}
