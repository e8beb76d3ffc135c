//! The patches that points are projected on.

use crate::area::{Area, area_of_part, negligible_width};
use crate::bezier::{OrientedBox, PatchSet};
use crate::bvh::{Aabb, Bvh};
use crate::param_box::ParamBox;
use crate::threads::LazyTable;
use crate::threads::parallel::map;
use glam::DVec3;
use std::sync::OnceLock;

/// Flat patches with their bounding volume hierarchy.
#[derive(Debug, Clone)]
pub struct Target {
    /// The patches.
    pub patches: PatchSet,
    /// The hierarchy of their axis-aligned boxes.
    pub tree: Bvh,
    /// A closer, oriented box around each patch, computed at its first use.
    boxes: LazyTable<OrientedBox>,
    /// The area of each patch, computed at its first use.
    areas: LazyTable<Area>,
    /// A width of a patch's area that is narrow enough, computed at its first use.
    negligible_width: OnceLock<f64>,
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
        let boxes = map(patches.len(), |index| patches.patch(index).bounding_box());
        let max_degree = patches.iter().flat_map(|patch| patch.degree).max().unwrap_or(0);
        Self {
            tree: tree(&boxes),
            boxes: LazyTable::default(),
            areas: LazyTable::default(),
            negligible_width: OnceLock::new(),
            max_degree,
            patches,
        }
    }

    /// Returns the oriented box around a patch. O(p q) at its first use.
    pub(crate) fn oriented_box(&self, patch: u32) -> &OrientedBox {
        let index = patch as usize;
        self.boxes.get(self.patches.len(), index, || OrientedBox::new(&self.patches.patch(index)))
    }

    /// Returns a lower bound on the squared distance from a point to a patch, by the patch's axis-aligned box and by its
    /// oriented one.
    pub(crate) fn distance_squared_to_boxes(&self, patch: u32, aabb: &Aabb, point: DVec3) -> f64 {
        aabb.min_distance_squared(point).max(self.oriented_box(patch).min_distance_squared(point))
    }

    /// Returns the area of a patch, as [`Self::area_of_part`] has it of all of its parameters: statistics of both
    /// directions and all thresholds ask for it.
    pub(crate) fn area(&self, patch: u32) -> Area {
        let new = || self.area_of_part(patch, ParamBox::UNIT);
        *self.areas.get(self.patches.len(), patch as usize, new)
    }

    /// Returns the area of a part of a patch, narrow beside itself or beside the area of all patches. One that folds takes
    /// up to a second.
    pub(crate) fn area_of_part(&self, patch: u32, range: ParamBox) -> Area {
        let negligible = *self.negligible_width.get_or_init(|| negligible_width(&self.patches));
        area_of_part(&self.patches.patch(patch as usize), range, negligible)
    }
}
