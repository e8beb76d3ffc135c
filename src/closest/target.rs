//! The patches that points are projected on.

use crate::bezier::{OrientedBox, PatchSet};
use crate::bvh::{Aabb, Bvh};
use crate::parallel::map_pairs;

/// Flat patches with their bounding volume hierarchy.
#[derive(Debug, Clone)]
pub struct Target {
    /// The patches.
    pub patches: PatchSet,
    /// The hierarchy of their axis-aligned boxes.
    pub tree: Bvh,
    /// A closer, oriented box around each patch.
    pub(crate) boxes: Vec<OrientedBox>,
    /// The largest degree of a patch in either direction.
    pub(crate) max_degree: usize,
}

impl Target {
    /// Builds the boxes and the hierarchy. O(n log n).
    #[must_use]
    pub fn new(patches: PatchSet) -> Self {
        Self::with_tree(patches, Bvh::new)
    }

    /// Returns a target with the hierarchy of this one over patches that have moved, as
    /// many as before. O(n).
    pub(crate) fn refitted(&self, patches: PatchSet) -> Self {
        Self::with_tree(patches, |boxes| self.tree.refitted(boxes))
    }

    fn with_tree(patches: PatchSet, tree: impl FnOnce(&[Aabb]) -> Bvh) -> Self {
        let (boxes, oriented) = map_pairs(patches.len(), |index| {
            let patch = patches.patch(index);
            (patch.bounding_box(), OrientedBox::new(&patch))
        });
        let max_degree = patches.iter().flat_map(|patch| patch.degree).max().unwrap_or(0);
        Self { tree: tree(&boxes), boxes: oriented, max_degree, patches }
    }
}
