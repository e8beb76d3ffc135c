//! The 2012 paper's criterion: the angle spanned by sampled normals.

use super::SAMPLES;
use crate::bezier::{GridBasis, Patch, normal};
use glam::DVec3;

/// A tangent this much shorter than the patch's longest is that of a
/// degenerate edge, a pole: its direction, and so the normal's, is rounding.
const DEGENERATE_RATIO: f64 = 1e-6;

/// The largest angle between normals of the same s-line and t-line, if some
/// two normals of the patch are more than `tolerance` radians apart.
///
/// Points without a normal are left out; `basis` is of the patch's degrees at
/// the sample parameters.
pub(super) fn excess(patch: &Patch<'_>, basis: &GridBasis<SAMPLES>, tolerance: f64) -> Option<[f64; 2]> {
    let tangents = patch.tangents(basis);
    let longest = [0, 1].map(|axis| {
        let lengths = tangents.iter().map(|tangents| tangents[axis].length_squared());
        DEGENERATE_RATIO * DEGENERATE_RATIO * lengths.fold(0.0, f64::max)
    });
    let normals: Vec<_> = tangents
        .iter()
        .map(|&[s, t]| {
            let regular = s.length_squared() > longest[0] && t.length_squared() > longest[1];
            if regular { normal(s, t) } else { None }
        })
        .collect();
    if least_cosine(&normals, 1) >= tolerance.cos() {
        return None;
    }
    let (mut along_s, mut along_t) = (1.0_f64, 1.0_f64);
    for line in 0..SAMPLES {
        along_s = along_s.min(least_cosine(&normals[line..], SAMPLES));
        along_t = along_t.min(least_cosine(&normals[line * SAMPLES..][..SAMPLES], 1));
    }
    Some([along_s.acos(), along_t.acos()])
}

/// The least cosine between two of the normals that there are, of every `step`th.
fn least_cosine(normals: &[Option<DVec3>], step: usize) -> f64 {
    let mut least = 1.0_f64;
    for (index, first) in normals.iter().enumerate().step_by(step) {
        let Some(first) = first else { continue };
        for second in normals[index..].iter().step_by(step).flatten() {
            least = least.min(first.dot(*second));
        }
    }
    least.max(-1.0)
}
