//! The bound by Lipschitz continuity.

use crate::certified::audit::Lemma;
use crate::certified::cell_context::{CellContext, UpperBound};

/// The distance of the cell's centre from its foot and the cell's radius, as distances to B
/// change by at most the length of a step. O(1).
pub(super) struct Lipschitz;

impl UpperBound for Lipschitz {
    fn lemma(&self) -> Lemma {
        Lemma::Lipschitz
    }

    fn evaluate(&self, context: &mut CellContext<'_>, _: f64) -> Option<f64> {
        Some(context.foot().distance() + context.radius)
    }
}
