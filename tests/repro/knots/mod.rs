//! Knots that are next to each other, or cut elsewhere.

mod extract_weights;
mod split_copies;
mod ulp_crease;
mod ulp_gap;
mod ulp_gap_1e5;
mod ulp_spiral;

pub(crate) use extract_weights::extract_weights;
pub(crate) use split_copies::split_copies;
pub(crate) use ulp_crease::ulp_crease;
pub(crate) use ulp_gap::ulp_gap;
pub(crate) use ulp_gap_1e5::ulp_gap_1e5;
pub(crate) use ulp_spiral::ulp_spiral;

use super::models::{repeated, shelf, swept};
use nurbs_hausdorff::SurfaceArrays;

/// A parabola near the origin and a rectangle 0.02 below B's.
pub(super) fn parabola_and_shelf() -> Vec<SurfaceArrays> {
    let parabola = [[-0.060_899_999_999_999_996, 0.0009], [0.0009, -0.0009], [0.0591, 0.0009]];
    vec![swept(2, &repeated(2, &[0.0, 1.0]), &parabola), shelf(-5.02)]
}

/// The quarter of a curve that B has near the origin: no point of it is left
/// of x = 0, so that the parabola's end at x = -0.0609 is far from it.
pub(super) const HOOK: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];

/// From the parabola's end to the hook's start, exactly.
pub(super) fn from_parabola_to_hook() -> f64 {
    0.060_899_999_999_999_996_f64.hypot(0.0009)
}
