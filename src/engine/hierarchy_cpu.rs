//! The stages of method `hierarchy` in float64 on the CPU: reference and fallback.

use crate::bezier::BezierModel;
use crate::bvh::Aabb;
use crate::error::Result;
use crate::hierarchy::LevelBounds;
use crate::hierarchy::{GridTree, Pairs, Traversal, boxes, extremes, pyramid};
use crate::model::RigidTransform;
use crate::parallel::map;
use crate::progress::Progress;
use std::ops::Range;

/// Boxes of A between two looks at the monitor.
const CHUNK: usize = 64;

/// The boxes of every level of a moved model's tree.
pub(super) fn boxes_of(
    model: &BezierModel,
    tree: &GridTree,
    transform: &RigidTransform,
    slack: f64,
) -> Vec<Vec<Aabb>> {
    let of_part = |index: usize| {
        let part = &tree.parts[index];
        boxes(&model.patches.patch(part.patch), part, transform, slack)
    };
    pyramid(&tree.levels, map(tree.parts.len(), of_part))
}

/// Stages `bound`, `extremes` and `cull` on the level below; goes there if no
/// more than `most_pairs` are left.
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub(super) async fn descend(
    traversal: &mut Traversal<'_>,
    most_pairs: usize,
    progress: &mut Progress<'_>,
) -> Result<LevelBounds> {
    let nodes = traversal.pairs().nodes();
    let mut bounds = Vec::new();
    for chunk in chunks(nodes) {
        progress.checkpoint(0.5 * chunk.start as f64 / nodes as f64).await?;
        bounds.append(&mut traversal.bound(chunk));
    }
    let extremes = extremes(&bounds);
    let (mut pairs, mut wanted) = (Pairs::new(), 0);
    for chunk in chunks(bounds.len()) {
        progress.checkpoint(0.5 + 0.5 * chunk.start as f64 / bounds.len() as f64).await?;
        let bounds = &bounds[chunk];
        let culled = map(bounds.len(), |index| traversal.cull(&bounds[index], extremes.near));
        for (bound, partners) in bounds.iter().zip(culled) {
            wanted += partners.len() as u64;
            if wanted <= most_pairs as u64 && !partners.is_empty() {
                pairs.push(bound.node, &partners);
            }
        }
    }
    if wanted <= most_pairs as u64 {
        traversal.descend_to(pairs);
    }
    Ok(LevelBounds::new(wanted, extremes))
}

fn chunks(count: usize) -> impl Iterator<Item = Range<usize>> {
    (0..count).step_by(CHUNK).map(move |start| start..(start + CHUNK).min(count))
}
