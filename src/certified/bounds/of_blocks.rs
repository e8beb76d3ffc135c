//! The bounds of a block's patches.

use super::OF_BLOCKS;
use crate::certified::Pair;
use crate::certified::audit::{Lemma, Lemmas};
use crate::certified::near_copies::blocks::{Block, BlockContext};
use crate::certified::nearest::{Foot, NearestPoint, Query, Sample};
use crate::certified::sheets::Sheets;
use crate::rounding::upper_max;

/// The decided bound and the undecided patches of a block.
pub(in crate::certified) struct BlockBound {
    /// An upper bound on the distance of the patches that are decided.
    pub(in crate::certified) decided: f64,
    /// The bound of each patch that is decided, v fastest, with its lemma.
    pub(in crate::certified) by_patch: Vec<Option<(f64, Lemma)>>,
    /// The undecided patches of the block, v fastest: no bound of theirs is at most the threshold.
    pub(in crate::certified) undecided: Vec<bool>,
    /// A point in the middle of the block with its foot.
    pub(in crate::certified) sample: Sample,
    /// Of the undecided patches' middles about the farthest, with its foot.
    pub(in crate::certified) farthest: Sample,
}

/// Bounds the patches of a block of A's sheets by the bounds of [`OF_BLOCKS`] in turn, from the nearest foot
/// near a known one.
pub(in crate::certified) fn block(
    pair: &Pair<'_>,
    sheets: Sheets<'_>,
    nearest: &NearestPoint<'_>,
    block: &Block,
    known: &Foot,
    threshold: f64,
    struck: Lemmas,
) -> BlockBound {
    let sample = sample(pair, sheets, nearest, block, known);
    let [rows, columns] = block.size();
    let mut bounds = vec![None; (rows * columns) as usize];
    let mut by_patch: Vec<Option<(f64, Lemma)>> = vec![None; bounds.len()];
    let mut farthest = None;
    let is_near = sample.foot.distance() <= threshold;
    if is_near && let Some(context) = BlockContext::new(pair, sheets, block, &sample) {
        for bound in OF_BLOCKS.into_iter().filter(|bound| !struck.contains(bound.lemma())) {
            if bounds.iter().any(Option::is_none) {
                farthest = bound.evaluate(&context, threshold, &mut bounds).or(farthest);
            }
            for (upper, entry) in bounds.iter().zip(&mut by_patch) {
                *entry = entry.or(upper.map(|upper| (upper, bound.lemma())));
            }
        }
    }
    let farthest = farthest.map_or(sample, |Sample { patch, parameters, foot }| {
        let target = pair.point_of_a(patch, parameters);
        Sample { patch, parameters, foot: nearest.on_patch(target, foot.patch, foot.parameters) }
    });
    BlockBound {
        decided: bounds.iter().flatten().copied().fold(0.0, upper_max),
        by_patch,
        undecided: bounds.iter().map(Option::is_none).collect(),
        sample,
        farthest,
    }
}

/// A point in the middle of a block with its foot.
fn sample(
    pair: &Pair<'_>,
    sheets: Sheets<'_>,
    nearest: &NearestPoint<'_>,
    block: &Block,
    known: &Foot,
) -> Sample {
    let flat = sheets.flat_patches(sheets.index(block.surface, block.middle())).start;
    let parameters = [0.5; 2];
    let target = pair.point_of_a(flat, parameters);
    let known = nearest.at(target, known.patch, known.parameters);
    let foot = nearest.near(&Query { target, known, sufficient: 0.0 }).nearest();
    Sample { patch: flat, parameters, foot }
}
