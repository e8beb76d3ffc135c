//! Blocks of A's patches: one map bounds all patches of a rectangle of them, by a spline or piece by piece.

#[cfg(all(test, not(target_arch = "wasm32")))]
mod attained;
mod block;
mod by_pieces;
mod context;
mod knot_line_map;
mod one_spline;

pub(crate) use block::Block;
pub(in crate::certified) use by_pieces::DifferenceByPieces;
pub(in crate::certified) use context::BlockContext;
pub(in crate::certified) use one_spline::OneSpline;

use super::super::audit::Lemma;
use super::super::nearest::Sample;

/// Upper bounds on `max d(a, B)` over the points a of each patch of a block.
pub(in crate::certified) trait BlockUpperBound: Sync {
    /// The lemma that states and proves it.
    fn lemma(&self) -> Lemma;

    /// Enters a bound at most `threshold` for each patch, v fastest, that has none and that it decides.
    /// Returns about the farthest point of the others that it looked at, if it looked at any.
    fn evaluate(
        &self,
        context: &BlockContext<'_>,
        threshold: f64,
        bounds: &mut [Option<f64>],
    ) -> Option<Sample>;
}
