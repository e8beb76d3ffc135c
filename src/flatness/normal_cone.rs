//! Flatness by the angle between sampled normals, the 2012 paper's criterion.

use super::SAMPLES;
use crate::bezier::{GridBasis, Patch, normal};
use glam::DVec3;

/// A tangent shorter than the patch's longest by this factor belongs to a
/// degenerate edge, such as a pole: its direction, and so the normal's, is rounding.
const DEGENERATE_RATIO: f64 = 1e-6;

/// Returns the largest angles between two normals of one s-line and of one
/// t-line, if any two normals of the patch are more than `tolerance` radians apart.
///
/// Points without a normal are left out. `basis` is of the patch's degrees at
/// the sample parameters.
pub(super) fn excess(patch: &Patch<'_>, basis: &GridBasis<SAMPLES>, tolerance: f64) -> Option<[f64; 2]> {
    let tangents = patch.tangents(basis);
    let thresholds = [0, 1].map(|axis| {
        let lengths = tangents.iter().map(|tangents| tangents[axis].length_squared());
        DEGENERATE_RATIO * DEGENERATE_RATIO * lengths.fold(0.0, f64::max)
    });
    let normals: Vec<_> = tangents
        .iter()
        .map(|&[s, t]| {
            let regular = s.length_squared() > thresholds[0] && t.length_squared() > thresholds[1];
            if regular { normal(s, t) } else { None }
        })
        .collect();
    if is_within_half(&normals, tolerance) || min_cosine(&normals, 1) >= tolerance.cos() {
        return None;
    }
    let (mut along_s, mut along_t) = (1.0_f64, 1.0_f64);
    for line in 0..SAMPLES {
        along_s = along_s.min(min_cosine(&normals[line..], SAMPLES));
        along_t = along_t.min(min_cosine(&normals[line * SAMPLES..][..SAMPLES], 1));
    }
    Some([along_s.acos(), along_t.acos()])
}

/// Returns whether all normals are within half the tolerance of one of them, so that
/// any two are within the tolerance; one comparison for each instead of one for each pair.
fn is_within_half(normals: &[Option<DVec3>], tolerance: f64) -> bool {
    let Some(middle) = normals[normals.len() / 2 + 1] else { return false };
    let least = (0.5 * tolerance).cos();
    normals.iter().flatten().all(|normal| normal.dot(middle) >= least)
}

/// Returns the smallest cosine between any two of every `step`-th normal, undefined ones left out.
fn min_cosine(normals: &[Option<DVec3>], step: usize) -> f64 {
    let mut least = 1.0_f64;
    for (index, first) in normals.iter().enumerate().step_by(step) {
        let Some(first) = first else { continue };
        for second in normals[index..].iter().step_by(step).flatten() {
            least = least.min(first.dot(*second));
        }
    }
    least.max(-1.0)
}
