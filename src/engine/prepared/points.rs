//! Points of patches and of facets, as points of faces.

use super::PreparedModel;
use crate::facets::weights;
use crate::surface_point::SurfacePoint;
use glam::DVec3;

impl PreparedModel {
    /// Returns the face of one of the surfaces of [`PreparedModel::bezier`].
    pub(in crate::engine) fn face_of(&self, surface: usize) -> usize {
        match &self.facets {
            Some(facets) => facets.group(facets.target.index(surface as u32)),
            None => self.pieces.face(surface),
        }
    }

    /// Returns a point of one of the surfaces of [`PreparedModel::bezier`] as a point of a face.
    pub(in crate::engine) fn surface_point(
        &self,
        surface: usize,
        parameters: [f64; 2],
        point: DVec3,
    ) -> SurfacePoint {
        match &self.facets {
            Some(_) => self.facet_point(surface as u32, weights(parameters), point),
            None => self.pieces.surface_point(surface, parameters, point),
        }
    }

    /// Returns a point of a facet, by its place in the order of the leaves.
    pub(in crate::engine) fn facet_point(&self, place: u32, weights: [f64; 3], point: DVec3) -> SurfacePoint {
        self.point_of_facet(
            self.facets.as_ref().map_or(0, |facets| facets.target.index(place)),
            weights,
            point,
        )
    }

    /// Returns a point of a facet, by its index in the model.
    pub(in crate::engine) fn point_of_facet(
        &self,
        index: usize,
        weights: [f64; 3],
        point: DVec3,
    ) -> SurfacePoint {
        let is_cloud = self.is_cloud();
        let [_, u, v] = if is_cloud { [1.0, 0.0, 0.0] } else { weights };
        let face = self.facets.as_ref().map_or(0, |facets| facets.group(index));
        SurfacePoint {
            face,
            face_name: self.face_name(face).map(str::to_owned),
            u,
            v,
            triangle: (!is_cloud).then_some(index),
            barycentric: (!is_cloud).then_some(weights),
            index: is_cloud.then_some(index),
            point: point.to_array(),
        }
    }
}
