//! The mirror image of a model.

use super::PreparedModel;
use crate::bezier::PatchSet;
use crate::error::Result;
use crate::facets::{Facet, PreparedFacets};
use glam::{DVec3, DVec4};

impl PreparedModel {
    /// Returns the model of one body with the sign of every x changed, which is exact. O(patches p q).
    ///
    /// # Errors
    /// Those of [`crate::TriangleMesh::new`].
    pub(in crate::engine) fn mirrored(&self) -> Result<Self> {
        if let Some(facets) = &self.facets {
            return self.mirrored_mesh(facets);
        }
        let mut patches = PatchSet::default();
        let mut controls: Vec<DVec4> = Vec::new();
        for mut patch in self.bezier.patches.iter() {
            controls.clear();
            controls.extend(patch.controls.iter().map(|&control| DVec4 { x: -control.x, ..control }));
            patch.center = mirror_image(patch.center);
            patch.controls = &controls;
            patches.push(patch);
        }
        let grids = self.bezier.grids.clone();
        let revolutions = grids.iter().map(|_| None).collect();
        Ok(self.of_patches(patches, grids, (self.face_gaps.clone(), self.pieces.clone(), revolutions)))
    }

    fn mirrored_mesh(&self, facets: &PreparedFacets) -> Result<Self> {
        let corners = |place: u32| match facets.target.facet(place) {
            Facet::Triangle([a, b, c]) => [a, c, b].map(mirror_image),
            Facet::Point(point) => [mirror_image(point); 3],
        };
        let count = facets.target.len() as u32;
        self.of_corners(facets, (0..count).flat_map(corners).collect())
    }
}

/// Returns a point with the sign of its x changed.
pub(in crate::engine) fn mirror_image(point: DVec3) -> DVec3 {
    DVec3 { x: -point.x, ..point }
}
