//! The bodies of a model as models of their own.

use super::{BodyParts, PreparedModel};
use crate::bezier::{BezierModel, PatchGrid, PatchSet};
use crate::bvh::Aabb;
use crate::error::Result;
use crate::facets::{Facet, Facets, PreparedFacets, TriangleMesh};
use crate::pieces::FacePieces;
use crate::symmetry::Revolution;
use glam::DVec3;

impl PreparedModel {
    /// Returns the bodies, in their order, each as a model of the same patches or triangles. O(n log n).
    ///
    /// # Errors
    /// [`crate::Error::FacetsUnsupported`] for a cloud of points.
    pub(in crate::engine) fn single_bodies(&self) -> Result<Vec<Self>> {
        self.require_faces("bodies of a model")?;
        let single = |parts: &BodyParts| {
            let faces = self.faces_of(parts);
            let mut surfaces: Vec<u32> =
                parts.shells.iter().flat_map(|shell| shell.surfaces.iter().copied()).collect();
            surfaces.sort_unstable();
            match &self.facets {
                Some(facets) => self.of_triangles(facets, &surfaces),
                None => Ok(self.of_surfaces(&surfaces, &faces)),
            }
        };
        self.body_parts().iter().map(single).collect()
    }

    /// Returns the model of some pieces of these faces, both in order. Coordinates and their errors are those of
    /// the whole, and so are the faces beyond the ends of pieces.
    fn of_surfaces(&self, surfaces: &[u32], faces: &[usize]) -> Self {
        let mut patches = PatchSet::default();
        let mut grids = Vec::with_capacity(surfaces.len());
        for (surface, &whole) in surfaces.iter().enumerate() {
            let mut grid = self.bezier.grids[whole as usize].clone();
            let count: usize = grid.counts().iter().product();
            let first = std::mem::replace(&mut grid.first, patches.len());
            for index in first..first + count {
                let mut patch = self.bezier.patches.patch(index);
                patch.surface = surface;
                patches.push(patch);
            }
            grids.push(grid);
        }
        let face_gaps: Vec<f64> = faces.iter().map(|&face| self.face_gaps[face]).collect();
        let pieces = self.pieces.some(surfaces, faces);
        let revolutions = surfaces.iter().map(|&surface| self.revolutions[surface as usize]).collect();
        let trimmed_faces = self.trimmed_faces.as_ref().map(|faces| faces.some(surfaces));
        Self { trimmed_faces, ..self.of_patches(patches, grids, (face_gaps, pieces, revolutions)) }
    }

    /// Returns a model of other patches with this one's unit, gaps and errors, and what is known of its surfaces.
    pub(super) fn of_patches(
        &self,
        patches: PatchSet,
        grids: Vec<PatchGrid>,
        (face_gaps, pieces, revolutions): (Vec<f64>, FacePieces, Vec<Option<Revolution>>),
    ) -> Self {
        let aabb = patches.iter().fold(Aabb::EMPTY, |aabb, patch| aabb.union(patch.bounding_box()));
        Self {
            name: None,
            unit: self.unit,
            source: None,
            gap: self.gap,
            face_gaps,
            is_gap_proven: self.is_gap_proven,
            pieces,
            trimmed_faces: None,
            facets: None,
            bezier: BezierModel { patches, grids, point_error: self.bezier.point_error },
            revolutions,
            bounding_box: aabb,
            control_box: aabb,
            kept: super::Kept::default(),
            refits: 0,
        }
    }

    /// Returns the mesh of some triangles, by their places.
    fn of_triangles(&self, facets: &PreparedFacets, places: &[u32]) -> Result<Self> {
        let corners = |&place: &u32| match facets.target.facet(place) {
            Facet::Triangle(corners) => corners,
            Facet::Point(point) => [point; 3],
        };
        self.of_corners(facets, places.iter().flat_map(corners).collect())
    }

    /// Returns the mesh of triangles that have these corners, in threes, with the unit, the gap and the errors of this
    /// one.
    pub(super) fn of_corners(&self, facets: &PreparedFacets, corners: Vec<DVec3>) -> Result<Self> {
        let count = (corners.len() / 3) as u32;
        let triangles: Vec<[u32; 3]> =
            (0..count).map(|index| [3 * index, 3 * index + 1, 3 * index + 2]).collect();
        let mut prepared = PreparedFacets::new(&Facets::Mesh(TriangleMesh::new(&corners, &triangles)?));
        prepared.error = facets.error;
        Ok(Self::with_facets(prepared, self.gap, self.unit))
    }
}

#[cfg(test)]
#[cfg(not(target_arch = "wasm32"))]
mod tests {
    use crate::certified::testing::{face, unit_plane};
    use crate::model::trim::FaceArrays;
    use crate::model::{InstanceArrays, Model, ModelArrays, RigidTransform};
    use crate::{DQuat, DVec3, DistanceOptions, Engine, PreparedModel};

    /// The square [-1, 1]² at height 0, less its rim, with a square hole that stands askew.
    fn plate() -> FaceArrays {
        let outer = [[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]];
        let hole = [[0.4, 0.1], [0.1, -0.4], [-0.4, -0.1], [-0.1, 0.4]];
        face(unit_plane(), &[&outer, &hole])
    }

    /// Plates beside each other, each its own body.
    fn plates(count: usize) -> PreparedModel {
        let place = |index: usize| {
            let x = 10.0 * index as f64;
            [1.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]
        };
        let instance = |index| InstanceArrays {
            surfaces: vec![index],
            transform: place(index),
            name: None,
            solid: None,
        };
        let arrays = ModelArrays {
            faces: vec![plate(); count],
            instances: (0..count).map(instance).collect(),
            ..ModelArrays::default()
        };
        PreparedModel::new(&Model::from_faces(arrays).unwrap()).unwrap()
    }

    #[test]
    fn a_body_is_searched_as_the_model_that_it_is_alone() {
        let alone = plates(1);
        let of_two = plates(2).single_bodies().unwrap().swap_remove(0);
        // By a quarter turn the plate lies on itself, cut along other lines.
        let turn = DQuat::from_axis_angle(DVec3::Z, std::f64::consts::FRAC_PI_2);
        let transform = RigidTransform::about(turn, DVec3::ZERO, DVec3::ZERO);
        let options = DistanceOptions { transform, ..DistanceOptions::default() };
        let found =
            [&alone, &of_two].map(|model| Engine::cpu().distance(model, model, &options).wait().unwrap());
        assert!(found[0].converged && found[0].upper < 1e-5, "{:?}", found[0]);
        let cells = found.map(|result| result.certified().unwrap().cells);
        assert_eq!(cells[0], cells[1]);
    }
}
