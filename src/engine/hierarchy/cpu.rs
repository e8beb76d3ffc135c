//! The stages of method `hierarchy` in float64 on the CPU: reference and fallback.

use crate::bezier::BezierModel;
use crate::bvh::Aabb;
use crate::error::Result;
use crate::hierarchy::{BRANCHING, GridTree, LevelBounds, Pairs, Traversal, boxes, extremes, pyramid};
use crate::model::RigidTransform;
use crate::progress::Progress;
use crate::threads::parallel::map;
use std::ops::Range;

/// The number of boxes of A, or of parts, after which a checkpoint is due.
const MAX_BOXES: usize = 1024;

/// The number of pairs of boxes after which a checkpoint is due: a few milliseconds
/// on one thread.
const MAX_CHUNK_PAIRS: usize = 1 << 18;

/// Returns the boxes of every level of a moved model's tree, enlarged by `margin`.
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub(super) async fn level_boxes(
    model: &BezierModel,
    tree: &GridTree,
    transform: &RigidTransform,
    margin: f64,
    progress: &mut Progress<'_>,
) -> Result<Vec<Vec<Aabb>>> {
    let mut parts = Vec::with_capacity(tree.parts.len());
    for chunk in chunks(tree.parts.len(), |_| 1) {
        progress.checkpoint(0.0).await?;
        let part_box = |offset: usize| {
            let part = &tree.parts[chunk.start + offset];
            boxes(&model.patches.patch(part.patch), part, transform, margin)
        };
        parts.append(&mut map(chunk.len(), part_box));
    }
    Ok(pyramid(&tree.levels, parts))
}

/// Runs the stages `bound`, `extremes` and `cull` on the level below, and moves
/// there if at most `max_pairs` pairs are left.
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub(super) async fn descend(
    traversal: &mut Traversal<'_>,
    max_pairs: usize,
    progress: &mut Progress<'_>,
) -> Result<LevelBounds> {
    let nodes = traversal.pairs().nodes();
    let mut bounds = Vec::new();
    for chunk in chunks(nodes, |position| BRANCHING * BRANCHING * traversal.pairs().partner_count(position)) {
        progress.checkpoint(0.5 * chunk.start as f64 / nodes as f64).await?;
        bounds.append(&mut traversal.bound(chunk));
    }
    let extremes = extremes(&bounds);
    let (mut pairs, mut pair_count) = (Pairs::new(), 0);
    let child_pairs =
        |index: usize| BRANCHING * traversal.pairs().partner_count(bounds[index].parent as usize);
    for chunk in chunks(bounds.len(), child_pairs) {
        progress.checkpoint(0.5 + 0.5 * chunk.start as f64 / bounds.len() as f64).await?;
        let bounds = &bounds[chunk];
        let culled = map(bounds.len(), |index| traversal.cull(&bounds[index], extremes.near));
        for (bound, partners) in bounds.iter().zip(culled) {
            pair_count += partners.len() as u64;
            if pair_count <= max_pairs as u64 && !partners.is_empty() {
                pairs.push(bound.node, &partners);
            }
        }
    }
    if pair_count <= max_pairs as u64 {
        traversal.descend_to(pairs);
    }
    Ok(LevelBounds::new(pair_count, extremes))
}

/// Returns, on the last level, the cell of A with the largest lower bound and its
/// nearest cell of B.
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub(super) async fn farthest(traversal: &Traversal<'_>, progress: &mut Progress<'_>) -> Result<[usize; 2]> {
    let (mut farthest, mut best) = ([0, 0], f64::NEG_INFINITY);
    for chunk in chunks(traversal.pairs().nodes(), |position| traversal.pairs().partner_count(position)) {
        progress.checkpoint(1.0).await?;
        let (cells, lower) = traversal.farthest(chunk);
        if lower > best {
            (farthest, best) = (cells, lower);
        }
    }
    Ok(farthest)
}

/// Divides `0..count` into ranges of at most [`MAX_BOXES`] indices and, where they have
/// several, about [`MAX_CHUNK_PAIRS`] pairs.
fn chunks(count: usize, pairs: impl Fn(usize) -> usize) -> impl Iterator<Item = Range<usize>> {
    let mut start = 0;
    std::iter::from_fn(move || {
        let first = start;
        let mut sum = 0;
        while start < count && start - first < MAX_BOXES && sum < MAX_CHUNK_PAIRS {
            sum += pairs(start);
            start += 1;
        }
        (first < start).then_some(first..start)
    })
}
