//! The 2012 paper's criterion: the angle spanned by sampled normals.

use super::{SAMPLES, sample_parameter};
use crate::bezier::{Jet, Patch};
use crate::elementary::{acos, cos};
use glam::DVec3;

/// A tangent this much shorter than the patch's longest is that of a
/// degenerate edge, a pole: its direction, and so the normal's, is rounding.
const DEGENERATE_RATIO: f64 = 1e-6;

/// The largest angle between normals of the same s-line and t-line, if some
/// two normals of the patch are more than `tolerance` radians apart.
///
/// Points without a normal are left out.
pub(super) fn excess(patch: &Patch<'_>, tolerance: f64) -> Option<[f64; 2]> {
    let jets: [[Jet; SAMPLES]; SAMPLES] = std::array::from_fn(|i| {
        std::array::from_fn(|j| patch.jet([sample_parameter(i), sample_parameter(j)]))
    });
    let longest = |tangent: fn(&Jet) -> DVec3| {
        jets.iter().flatten().map(|jet| tangent(jet).length()).fold(0.0, f64::max)
    };
    let least = [DEGENERATE_RATIO * longest(|jet| jet.s), DEGENERATE_RATIO * longest(|jet| jet.t)];
    let normals = jets.map(|line| {
        line.map(|jet| {
            let regular = jet.s.length() > least[0] && jet.t.length() > least[1];
            if regular { jet.normal() } else { None }
        })
    });
    let cosine = least_cosine(normals.iter().flatten());
    (cosine < cos(tolerance)).then(|| {
        let along = |line: &dyn Fn(usize, usize) -> Option<DVec3>| {
            let cosines = (0..SAMPLES).map(|fixed| {
                let normals: [_; SAMPLES] = std::array::from_fn(|moving| line(fixed, moving));
                least_cosine(normals.iter())
            });
            acos(cosines.fold(1.0, f64::min))
        };
        [along(&|fixed, moving| normals[moving][fixed]), along(&|fixed, moving| normals[fixed][moving])]
    })
}

fn least_cosine<'a>(normals: impl Iterator<Item = &'a Option<DVec3>> + Clone) -> f64 {
    let mut least = 1.0_f64;
    let mut rest = normals.flatten();
    while let Some(first) = rest.next() {
        for second in rest.clone() {
            least = least.min(first.dot(*second));
        }
    }
    least.max(-1.0)
}
