//! Upper bounds on the distance from a whole cell of A to B, and which of them are tried.
//!
//! The lists below are all there are, besides those of tree nodes in [`boxes`]. Each bound is a theorem of its own, proven in section 3 of `docs/method.md`. A bound
//! takes any feet: one that is not the nearest loosens it and cannot falsify it.

#[cfg(all(test, not(target_arch = "wasm32")))]
mod attained;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod attained_across_seams;
mod bilinear;
mod boxes;
mod convex_combination;
mod heights;
mod lipschitz;
mod of_blocks;
mod same_net;
mod sphere;
mod taylor;

pub(super) use boxes::{bvh_node, whole_models};
pub(super) use of_blocks::{BlockBound, block};
#[cfg(feature = "internals")]
pub use taylor::Quadratic;
pub(super) use taylor::{Lengths, Linear, distance_above, distance_from, halved_sides};

use super::cell_context::{CellContext, LeastBound, UpperBound};
use super::near_copies::blocks::{BlockUpperBound, DifferenceByPieces, OneSpline};
use super::near_copies::difference::{DifferenceOverKnotLines, PolynomialDifference, ProjectiveDifference};
use bilinear::Bilinear;
use convex_combination::ConvexCombination;
use heights::Heights;
use lipschitz::Lipschitz;
use same_net::SameNet;
use sphere::InSphere;
use taylor::{Taylor, TaylorAcrossSeams};

/// The bounds that any foot serves, cheapest first: with the foot inherited
/// from the cell's parent they decide most cells.
const WITH_ANY_FOOT: [&dyn UpperBound; 5] = [&SameNet, &InSphere, &Lipschitz, &Taylor, &TaylorAcrossSeams];

/// The bounds that need the nearest feet, cheapest first.
const WITH_NEAREST_FEET: [&dyn UpperBound; 10] = [
    &ConvexCombination,
    &InSphere,
    &Lipschitz,
    &Taylor,
    &TaylorAcrossSeams,
    &PolynomialDifference,
    &DifferenceOverKnotLines,
    &ProjectiveDifference,
    &Heights,
    &Bilinear,
];

/// The bounds of all patches of a block at once, cheapest first.
const OF_BLOCKS: [&dyn BlockUpperBound; 2] = [&OneSpline, &DifferenceByPieces];

/// The least of the bounds with the inherited foot, or the first that is at
/// most the threshold.
pub(super) fn with_any_foot(context: &mut CellContext<'_>, threshold: f64) -> LeastBound {
    least(&WITH_ANY_FOOT, context, threshold)
}

/// The least of the bounds with the nearest feet, or the first that is at most
/// the threshold.
pub(super) fn with_nearest_feet(context: &mut CellContext<'_>, threshold: f64) -> LeastBound {
    least(&WITH_NEAREST_FEET, context, threshold)
}

fn least(bounds: &[&dyn UpperBound], context: &mut CellContext<'_>, threshold: f64) -> LeastBound {
    let mut least = LeastBound::NONE;
    for bound in bounds {
        if context.struck.contains(bound.lemma()) {
            continue;
        }
        if let Some(upper) = bound.evaluate(context, threshold) {
            least.take(upper, bound.lemma());
            if least.upper <= threshold {
                break;
            }
        }
    }
    least
}
