//! Nodes that are blocks of A's patches, where A is near B.

use super::super::audit::{CellBound, Lemmas};
use super::super::bounds::BlockBound;
use super::super::nearest::{NearestPoint, Sample};
use super::super::{Block, Cell, Operand, Pair, Sheets};
use super::{Domain, SearchNode, bounds};
use crate::sorting::sort_by_number;

/// The number of patches of A from which on they are searched by blocks where A is near B.
const MIN_BLOCK_PATCHES: usize = 16;

/// Maximum number of patches of A whose sizes are compared with the threshold.
const MAX_SIZES: usize = 64;

/// The size of a node of two patches, relative to that of one.
const SIZE_OF_TWO: f64 = 2.0;

/// The parts of a block.
pub(super) struct Split {
    /// An upper bound on what is decided of it.
    pub(super) decided: f64,
    /// What is not decided.
    pub(super) children: Vec<Domain>,
    /// The bounds of the flat patches that are decided.
    pub(super) by_patch: Vec<CellBound>,
}

/// The sheets of A if it is to be searched by blocks: if the median size of two of its patches
/// together exceeds the threshold, so that no bound of first order prunes them.
pub(super) fn by_blocks<'a>(a: &Operand<'a>, threshold: f64) -> Option<Sheets<'a>> {
    let (sheets, patches) = (a.sheets?, a.patches());
    if patches.len() < MIN_BLOCK_PATCHES {
        return None;
    }
    let mut sizes: Vec<f64> = (0..patches.len())
        .step_by(patches.len().div_ceil(MAX_SIZES))
        .map(|index| 0.5 * patches.patch(index).bounding_box().diagonal())
        .collect();
    sort_by_number(&mut sizes, |size| *size);
    (SIZE_OF_TWO * sizes[sizes.len() / 2] > threshold).then_some(sheets)
}

/// Bounds the patches of a block; returns what is left of it, a point in its middle and about the
/// farthest of its points that were looked at.
pub(super) fn split_block(
    pair: &Pair<'_>,
    nearest: &NearestPoint<'_>,
    block: &Block,
    node: &SearchNode,
    threshold: f64,
    struck: Lemmas,
) -> (Split, [Sample; 2]) {
    let Some(sheets) = pair.a.sheets else {
        // There are no blocks without sheets; nothing is known of one.
        let sample = Sample { patch: 0, parameters: [0.5; 2], foot: node.foot };
        let split = Split { decided: node.upper, children: Vec::new(), by_patch: Vec::new() };
        return (split, [sample; 2]);
    };
    let bound = bounds::block(pair, sheets, nearest, block, &node.foot, threshold, struck);
    let children = block.children(&bound.undecided).into_iter().flat_map(|block| domains(sheets, block));
    let split = Split {
        decided: bound.decided,
        children: children.collect(),
        by_patch: bounds_of_patches(sheets, block, &bound).collect(),
    };
    (split, [bound.sample, bound.farthest])
}

/// The bounds of the flat patches of a block's patches that are decided.
fn bounds_of_patches<'a>(
    sheets: Sheets<'a>,
    block: &'a Block,
    bound: &'a BlockBound,
) -> impl Iterator<Item = CellBound> + 'a {
    let columns = block.size()[1].max(1);
    let decided = (0_u32..).zip(&bound.by_patch).filter_map(|(place, decided)| Some((place, (*decided)?)));
    decided.flat_map(move |(place, (upper, lemma))| {
        let indices = [block.rows[0] + place / columns, block.columns[0] + place % columns];
        let flat = sheets.flat_patches(sheets.index(block.surface, indices));
        flat.map(move |patch| CellBound { cell: Cell::whole(patch), upper, lemma, foot: bound.sample.foot })
    })
}

/// A block, or the flat patches that a single patch was cut into.
pub(super) fn domains(sheets: Sheets<'_>, block: Block) -> Vec<Domain> {
    if !block.is_single() {
        return vec![Domain::Block(block)];
    }
    let index = sheets.index(block.surface, [block.rows[0], block.columns[0]]);
    sheets.flat_patches(index).map(|patch| Domain::Cell(Cell::whole(patch))).collect()
}
