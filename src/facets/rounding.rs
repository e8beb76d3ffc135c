//! The rounding of distances to facets, by the lemmas of `docs/meshes.md`.

use crate::rounding::{VANISHING_LENGTH, gamma};

/// The roundings of the distance to a facet, relative to the largest length of the target and of
/// all corners: lemmas F1, F2 and F3.
const FACET_ROUNDINGS: f64 = 32.0;

/// The roundings of a corner of a part of a triangle, relative to the triangle's largest length:
/// lemma F4.
const CUT_ROUNDINGS: f64 = 6.0;

/// The roundings of the distance between a patch and the two triangles that stand for it, relative
/// to the largest length of its control points: lemma F6.
const SAG_ROUNDINGS: f64 = 256.0;

/// The roundings of the distance between a patch and the quadrangle around it, relative to the largest length of its
/// control points: lemma F13.
const SLAB_ROUNDINGS: f64 = 4096.0;

/// Returns an upper bound on the error of a distance to a facet, for points at most this far from
/// the origin.
pub(crate) fn facet_rounding(length: f64) -> f64 {
    gamma(FACET_ROUNDINGS) * length + VANISHING_LENGTH
}

/// Returns an upper bound on how far cutting moves a point of a triangle at each level.
pub(super) fn cut_rounding(length: f64) -> f64 {
    gamma(CUT_ROUNDINGS) * length
}

/// Returns an upper bound on the error of the distance of a patch from its two triangles.
pub(super) fn sag_rounding(length: f64) -> f64 {
    gamma(SAG_ROUNDINGS) * length
}

/// Returns an upper bound on the error of the distance of a patch from the quadrangle around it.
pub(super) fn slab_rounding(length: f64) -> f64 {
    gamma(SLAB_ROUNDINGS) * length
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn the_rounding_of_a_facet_adds_what_underflow_takes() {
        assert_eq!(facet_rounding(0.0), VANISHING_LENGTH);
    }
}
