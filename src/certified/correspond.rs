//! A bound for patches of the same parameters and weights: moved and edited
//! copies.

use super::Operand;
use crate::bezier::Patch;
use crate::model::RigidTransform;
use glam::{DVec3, DVec4, Vec4Swizzles};

/// At least the distance to B of every point of A's patch of this index, given
/// B's patch of the same index: infinite unless they are of the same part of
/// the same surface, the same degrees and the same weights.
///
/// Then `A - B` has those weights too and the differences of the control
/// points for its own, whose hull contains it. O(p q).
pub(super) fn correspond(a: &Operand<'_>, b: &Operand<'_>, transform: &RigidTransform, index: u32) -> f64 {
    if index as usize >= b.alike.len() {
        return f64::INFINITY;
    }
    let (of_a, of_b) = (a.patch(index), b.alike.patch(index as usize));
    let place = |patch: &Patch<'_>| (patch.surface, patch.degree, patch.domain);
    if place(&of_a) != place(&of_b) {
        return f64::INFINITY;
    }
    let mut largest = 0.0_f64;
    for (from, to) in of_a.controls.iter().zip(of_b.controls) {
        if from.w != to.w {
            return f64::INFINITY;
        }
        let point = |center: DVec3, control: &DVec4| center + control.xyz() / control.w;
        let (from, to) = (transform.apply(point(of_a.center, from)), point(of_b.center, to));
        largest = largest.max(from.distance_squared(to));
    }
    largest.sqrt()
}
