//! Rounding errors of float64 in the bounds, by the lemmas of `docs/rounding.md`,
//! section 6.

use super::Pair;
use crate::bezier::Patch;
pub(super) use crate::rounding::{UNIT_ROUNDOFF, gamma};
use crate::rounding::{VANISHING_LENGTH, closest_rounding};

/// Roundings, relative to its length, of a rotated vector (lemma R2).
const ROTATION_ROUNDINGS: f64 = 64.0;

/// Roundings of a finished bound, relative to it.
const BOUND_ROUNDINGS: f64 = 16.0;

/// An upper bound with the rounding of its own sums and roots.
pub(super) fn rounded_up(bound: f64) -> f64 {
    bound * (1.0 + BOUND_ROUNDINGS * UNIT_ROUNDOFF)
}

/// The largest bound whose [`rounded_up`] is at most `limit`.
pub(super) fn before_rounding_up(limit: f64) -> f64 {
    limit * (1.0 - (BOUND_ROUNDINGS + 2.0) * UNIT_ROUNDOFF)
}

/// `E_A + E_B`: how far computed points of both models may be from the exact
/// ones (lemmas R2 to R5).
pub(super) fn point_error(pair: &Pair<'_>) -> f64 {
    let length = pair.a.control_box.farthest_from_origin();
    let offset = pair.transform.offset().length();
    // A point of A is rotated and moved; the offset of an inverse motion was rotated itself.
    let moved = gamma(ROTATION_ROUNDINGS * (length + offset) + length + offset);
    pair.a.point_error + pair.b.point_error + moved + VANISHING_LENGTH
}

/// The rounding that the lower bound of a certified closest-point query subtracts.
pub(super) fn closest_point_error(pair: &Pair<'_>) -> f64 {
    let length = pair.a.control_box.farthest_from_origin() + pair.transform.offset().length();
    closest_rounding(length.max(pair.b.control_box.farthest_from_origin()))
}

/// The quantities on which the error of a patch's derivatives depends (lemma R7).
#[derive(Debug, Clone, Copy)]
pub(super) struct JetScale {
    pub(super) degree: [usize; 2],
    /// The largest distance of a control point from the patch's centre.
    pub(super) radius: f64,
    /// The ratio of the largest weight to the smallest.
    pub(super) weight_ratio: f64,
}

/// Roundings of the chain rule's sums, with and without the rotation of A's
/// derivatives (lemma R8).
pub(super) const MOVED_JET_ROUNDINGS: f64 = 71.0;
pub(super) const JET_ROUNDINGS: f64 = 7.0;

impl JetScale {
    /// That of a patch of this radius. O(p q) for rational patches.
    pub(super) fn new(patch: &Patch<'_>, radius: f64) -> Self {
        let weight_ratio = if patch.rational {
            let weights = patch.controls.iter().map(|control| control.w);
            let (least, largest) =
                weights.fold((f64::INFINITY, 0.0_f64), |(least, largest), w| (least.min(w), largest.max(w)));
            largest / least
        } else {
            1.0
        };
        Self { degree: patch.degree, radius, weight_ratio }
    }

    /// `J`: how much the errors of the derivatives change a Taylor quadratic over
    /// steps of at most `extent` in the parameters, after `more` further
    /// roundings (lemma R8).
    pub(super) fn quadratic_error(&self, extent: [f64; 2], more: f64) -> f64 {
        let [p, q] = self.degree.map(|degree| degree as f64);
        let terms = 4.0 * (p + q) + 6.0;
        let reach = extent[0] * p + extent[1] * q;
        let first = (4.0 * terms + 6.0 + more) * 4.0 * self.weight_ratio * reach;
        let second =
            (6.0 * terms + 12.0 + more) * 12.0 * self.weight_ratio * self.weight_ratio * reach * reach;
        gamma((first + second) * self.radius)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// J of lemma R8, with κ = 3, ρ = 2, degrees (3, 2) and n = 4 · 5 + 6.
    #[test]
    fn the_error_of_a_quadratic_is_that_of_the_lemma() {
        let scale = JetScale { degree: [3, 2], radius: 2.0, weight_ratio: 3.0 };
        for (extent, more) in [([0.5, 0.25], 71.0), ([0.5, 0.0], 7.0), ([1e-4, 2e-4], 7.0)] {
            let reach = 3.0 * extent[0] + 2.0 * extent[1];
            let first = (4.0 * 26.0 + 6.0 + more) * 4.0 * 3.0 * reach;
            let second = (6.0 * 26.0 + 12.0 + more) * 12.0 * 9.0 * reach * reach;
            let part = scale.quadratic_error(extent, more) / (UNIT_ROUNDOFF * 2.0 * (first + second));
            assert!((1.0..=1.02).contains(&part), "{part} of J at {extent:?}");
        }
    }

    /// A bound is raised by 16 u, and a limit lowered by more.
    #[test]
    fn a_limit_is_kept_by_the_bound_rounded_up() {
        for limit in [1.0, 1.0 + f64::EPSILON, 1e-90, 3e100] {
            assert!(rounded_up(limit) >= limit * (1.0 + 15.0 * UNIT_ROUNDOFF));
            assert!(rounded_up(before_rounding_up(limit)) <= limit);
        }
    }
}
