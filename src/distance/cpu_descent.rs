//! The stages of method `hierarchy` in float64 on the CPU: reference and fallback.

use super::{Descend, Descended, Progress};
use crate::bezier::BezierModel;
use crate::error::Result;
use crate::hierarchy::{CellTree, Pairs, Traversal, boxes, extremes, pyramid};
use crate::model::RigidTransform;
use crate::parallel::map;
use crate::tree::Aabb;
use std::ops::Range;

/// Boxes of A between two looks at the monitor.
const CHUNK: usize = 64;

/// The boxes of every level of a moved model's tree.
pub(super) fn boxes_of(
    model: &BezierModel,
    tree: &CellTree,
    transform: &RigidTransform,
    slack: f64,
) -> Vec<Vec<Aabb>> {
    let of_piece = |index: usize| {
        let piece = &tree.pieces[index];
        boxes(&model.patches.patch(piece.patch), piece, transform, slack)
    };
    pyramid(&tree.levels, map(tree.pieces.len(), of_piece))
}

impl Descend for Traversal<'_> {
    fn levels(&self) -> usize {
        self.finest()
    }

    async fn descend(&mut self, most_pairs: usize, progress: &mut Progress<'_>) -> Result<Descended> {
        let nodes = self.pairs().nodes();
        let mut bounds = Vec::new();
        for chunk in chunks(nodes) {
            progress.checkpoint(0.5 * chunk.start as f64 / nodes as f64).await?;
            bounds.extend(self.bound(chunk));
        }
        let extremes = extremes(&bounds);
        let (mut pairs, mut wanted) = (Pairs::new(), 0);
        for chunk in chunks(bounds.len()) {
            progress.checkpoint(0.5 + 0.5 * chunk.start as f64 / bounds.len() as f64).await?;
            let bounds = &bounds[chunk];
            for (bound, partners) in
                bounds.iter().zip(map(bounds.len(), |index| self.cull(&bounds[index], extremes.near)))
            {
                wanted += partners.len() as u64;
                if wanted <= most_pairs as u64 && !partners.is_empty() {
                    pairs.push(bound.node, &partners);
                }
            }
        }
        if wanted <= most_pairs as u64 {
            self.descend_to(pairs);
        }
        Ok(Descended::new(wanted, extremes))
    }

    async fn farthest(&mut self) -> Result<[usize; 2]> {
        Ok(Traversal::farthest(self))
    }
}

fn chunks(count: usize) -> impl Iterator<Item = Range<usize>> {
    (0..count).step_by(CHUNK).map(move |start| start..(start + CHUNK).min(count))
}
