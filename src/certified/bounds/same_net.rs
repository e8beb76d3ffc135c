//! The bound by equal control nets: moved and edited copies.

use super::super::Pair;
use crate::bezier::Patch;
use crate::certified::audit::Lemma;
use crate::certified::cell_context::{CellContext, UpperBound};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// The differences of corresponding control points bound those of the patches.
pub(super) struct SameNet;

impl UpperBound for SameNet {
    fn lemma(&self) -> Lemma {
        Lemma::SameNet
    }

    fn evaluate(&self, context: &mut CellContext<'_>, _threshold: f64) -> Option<f64> {
        context.cell.is_whole().then(|| upper_bound(context.pair, context.cell.patch))
    }
}

/// An upper bound on the distance to B of every point of A's patch of this
/// index from B's patch of the same index; +∞ unless both are of the same part
/// of their surfaces, of the same degrees and weights.
///
/// Then `A - B` has those weights too and the differences of the control
/// points for its own, whose convex hull contains it. O(p q).
pub(super) fn upper_bound(pair: &Pair<'_>, index: u32) -> f64 {
    if index as usize >= pair.b.uncut_patches.len() {
        return f64::INFINITY;
    }
    let (of_a, of_b) = (pair.a.patch(index), pair.b.uncut_patches.patch(index as usize));
    let identity = |patch: &Patch<'_>| (patch.degree, patch.domain);
    if identity(&of_a) != identity(&of_b) {
        return f64::INFINITY;
    }
    let mut largest = 0.0_f64;
    for (from, to) in of_a.controls.iter().zip(of_b.controls) {
        if from.w != to.w {
            return f64::INFINITY;
        }
        let point = |center: DVec3, control: &DVec4| center + control.xyz() / control.w;
        let (from, to) = (pair.transform.apply(point(of_a.center, from)), point(of_b.center, to));
        largest = largest.max(from.distance_squared(to));
    }
    largest.sqrt()
}
