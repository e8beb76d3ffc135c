//! Functions of space by which a cell is compared with B.

use super::fit::{Fit, ORDERS, POINTS_ALONG};
use super::piece::Piece;
use super::quadric::{Cubic, Quadric};
use glam::DVec3;

/// The part of the threshold, for each order, by which a function may vary over a cell: no closer one of that
/// order is looked for.
const SUFFICIENT_SPREAD: f64 = 0.125;

/// A function with its range on the cell.
pub(super) struct Candidate {
    pub(super) function: Cubic,
    pub(super) range: [f64; 2],
}

/// Functions of rising order that nearly vanish on a cell, with the height over the plane at first: those whose values
/// on the cell may let a bound reach the threshold.
pub(super) fn candidates(
    a: &Piece,
    normal: DVec3,
    tangent: DVec3,
    threshold: f64,
) -> impl Iterator<Item = Candidate> + '_ {
    let plane = std::iter::once(Cubic::of(Quadric::of_plane(normal)));
    let fits = std::iter::once_with(move || Fit::new(normal, tangent, &a.samples([POINTS_ALONG; 2])));
    let fitted = fits.flatten().flat_map(move |mut fit| {
        let mut sufficient = threshold;
        ORDERS.into_iter().filter_map(move |terms| {
            sufficient *= SUFFICIENT_SPREAD;
            fit.add(terms, sufficient);
            (fit.spread() <= threshold).then(|| fit.function())
        })
    });
    let all = plane.chain(fitted).map(move |function| Candidate::new(function, a));
    all.filter(move |candidate| {
        let [low, high] = candidate.range;
        high - low <= 2.0 * threshold
    })
}

impl Candidate {
    /// Takes any function.
    pub(super) fn new(function: Cubic, a: &Piece) -> Self {
        let range = a.range(&function);
        Self { function, range }
    }
}
