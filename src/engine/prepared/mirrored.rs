//! The mirror image of a model.

use super::PreparedModel;
use crate::bezier::{BezierModel, PatchSet};
use crate::bvh::Aabb;
use crate::error::Result;
use crate::facets::{Facet, Facets, PreparedFacets, TriangleMesh};
use glam::{DVec3, DVec4};

impl PreparedModel {
    /// Returns the model of one body with the sign of every x changed, which is exact. O(patches p q).
    ///
    /// # Errors
    /// Those of [`TriangleMesh::new`].
    pub(in crate::engine) fn mirrored(&self) -> Result<Self> {
        if let Some(facets) = &self.facets {
            return self.mirrored_mesh(facets);
        }
        let mut patches = PatchSet::default();
        let mut controls: Vec<DVec4> = Vec::new();
        for mut patch in self.bezier.patches.iter() {
            controls.clear();
            controls.extend(patch.controls.iter().map(|&control| DVec4 { x: -control.x, ..control }));
            patch.center = image(patch.center);
            patch.controls = &controls;
            patches.push(patch);
        }
        let aabb = patches.iter().fold(Aabb::EMPTY, |aabb, patch| aabb.union(patch.bounding_box()));
        let (grids, point_error) = (self.bezier.grids.clone(), self.bezier.point_error);
        Ok(Self {
            name: None,
            unit: self.unit,
            source: None,
            gap: self.gap,
            face_gaps: self.face_gaps.clone(),
            is_gap_proven: self.is_gap_proven,
            pieces: self.pieces.clone(),
            trimmed_faces: None,
            facets: None,
            revolutions: grids.iter().map(|_| None).collect(),
            bezier: BezierModel { patches, grids, point_error },
            bounding_box: aabb,
            control_box: aabb,
            kept: super::Kept::default(),
            refits: 0,
        })
    }

    fn mirrored_mesh(&self, facets: &PreparedFacets) -> Result<Self> {
        let corners = |place: u32| match facets.target.facet(place) {
            Facet::Triangle([a, b, c]) => [a, c, b].map(image),
            Facet::Point(point) => [image(point); 3],
        };
        let count = facets.target.len() as u32;
        let vertices: Vec<DVec3> = (0..count).flat_map(corners).collect();
        let triangles: Vec<[u32; 3]> =
            (0..count).map(|index| [3 * index, 3 * index + 1, 3 * index + 2]).collect();
        let mut prepared = PreparedFacets::new(&Facets::Mesh(TriangleMesh::new(&vertices, &triangles)?));
        prepared.error = facets.error;
        Ok(Self::with_facets(prepared, self.gap, self.unit))
    }
}

fn image(point: DVec3) -> DVec3 {
    DVec3 { x: -point.x, ..point }
}
