//! The stages of method `hierarchy` in float64 on the CPU: reference and fallback.

use crate::bezier::BezierModel;
use crate::bvh::Aabb;
use crate::error::Result;
use crate::hierarchy::{GridTree, LevelBounds, Pairs, Traversal, boxes, extremes, pyramid};
use crate::model::RigidTransform;
use crate::parallel::map;
use crate::progress::Progress;
use std::ops::Range;

/// The number of boxes of A between two checkpoints.
const CHUNK: usize = 64;

/// Returns the boxes of every level of a moved model's tree, enlarged by `margin`.
pub(super) fn level_boxes(
    model: &BezierModel,
    tree: &GridTree,
    transform: &RigidTransform,
    margin: f64,
) -> Vec<Vec<Aabb>> {
    let part_box = |index: usize| {
        let part = &tree.parts[index];
        boxes(&model.patches.patch(part.patch), part, transform, margin)
    };
    pyramid(&tree.levels, map(tree.parts.len(), part_box))
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
    for chunk in chunks(nodes) {
        progress.checkpoint(0.5 * chunk.start as f64 / nodes as f64).await?;
        bounds.append(&mut traversal.bound(chunk));
    }
    let extremes = extremes(&bounds);
    let (mut pairs, mut pair_count) = (Pairs::new(), 0);
    for chunk in chunks(bounds.len()) {
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

/// Divides `0..count` into ranges of [`CHUNK`].
fn chunks(count: usize) -> impl Iterator<Item = Range<usize>> {
    (0..count).step_by(CHUNK).map(move |start| start..(start + CHUNK).min(count))
}
