//! The difference of a block and a surface of B as one spline.

use super::super::spline::BlockMap;
use super::BlockUpperBound;
use super::context::BlockContext;
use crate::axis::Axis;
use crate::certified::audit::Lemma;
use crate::certified::nearest::Sample;

/// The bound by one affine map of the block. O(patches p q).
pub(in crate::certified) struct OneSpline;

impl BlockUpperBound for OneSpline {
    fn lemma(&self) -> Lemma {
        Lemma::OneSpline
    }

    fn evaluate(
        &self,
        context: &BlockContext<'_>,
        threshold: f64,
        bounds: &mut [Option<f64>],
    ) -> Option<Sample> {
        let map = BlockMap {
            pair: context.pair,
            sheets: context.sheets,
            block: context.block,
            chart: &context.chart,
            orientation: context.linearization.orientation,
            images: Axis::BOTH.map(|axis| context.ends(axis)),
        };
        for (bound, of_patch) in bounds.iter_mut().zip(map.upper_bounds().unwrap_or_default()) {
            if of_patch <= threshold {
                *bound = Some(of_patch);
            }
        }
        None
    }
}
