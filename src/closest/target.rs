//! The patches that points are projected on.

use crate::bezier::{OrientedBox, PatchSet};
use crate::bvh::Bvh;

/// Flat patches with their bounding volume hierarchy.
#[derive(Debug, Clone)]
pub struct Target {
    /// The patches.
    pub patches: PatchSet,
    /// The hierarchy of their axis-aligned boxes.
    pub tree: Bvh,
    /// A closer, oriented box around each patch.
    pub(crate) boxes: Vec<OrientedBox>,
}

impl Target {
    /// Builds the boxes and the hierarchy. O(n log n).
    #[must_use]
    pub fn new(patches: PatchSet) -> Self {
        let boxes: Vec<_> = patches.iter().map(|patch| patch.bounding_box()).collect();
        let oriented = patches.iter().map(|patch| OrientedBox::new(&patch)).collect();
        Self { tree: Bvh::new(&boxes), boxes: oriented, patches }
    }
}
