//! Maps as arrays.

use crate::deviation::{Map, Placing};
use crate::engine::Signs;
use glam::DVec3;

/// The maps of two models, in the unit of A.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DeviationMaps {
    /// The larger diagonal of the two models.
    pub diagonal: f64,
    /// The map of A, if it was asked for.
    pub a: Option<DeviationMap>,
    /// The map of B, if it was asked for.
    pub b: Option<DeviationMap>,
}

/// The triangles of a model with the deviation from the other one at each vertex; without triangles the points of a
/// cloud.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DeviationMap {
    /// x, y, z of each vertex relative to `origin`, in the model's own coordinates.
    pub positions: Vec<f32>,
    /// x, y, z of the unit normal at each vertex; 0 where the surface has none.
    pub normals: Vec<f32>,
    /// The point that positions are relative to.
    pub origin: DVec3,
    /// Three vertices a triangle.
    pub indices: Vec<u32>,
    /// The face of each triangle; those of a face follow each other. A mesh is one face.
    pub faces: Vec<u32>,
    /// x, y, z of the point of the model that was measured for each vertex, in the model's own coordinates. It is
    /// nearer to the model than the vertex, which is on a triangle.
    pub points: Vec<f64>,
    /// The most that the model is from each of these points, but for the rounding of float32, in A's unit.
    pub slacks: Vec<f64>,
    /// The distance of each point from the other model, in A's unit.
    pub distances: Vec<f64>,
    /// The distances with the signs that `signs` names; NaN without one.
    pub signed: Vec<f64>,
    /// x, y, z of the nearest points on the other model, in the coordinates of a result.
    pub feet: Vec<f64>,
    /// What the signs stand for.
    pub signs: Signs,
}

impl DeviationMap {
    /// Returns the arrays of a map in the model's own coordinates.
    pub(super) fn new(map: &Map, placing: &Placing, signs: Signs) -> Self {
        let single = |vector: DVec3| vector.as_vec3().to_array();
        let vertices = || map.vertices.iter();
        Self {
            positions: vertices().flat_map(|vertex| single(vertex.position - map.origin)).collect(),
            normals: vertices().flat_map(|vertex| single(vertex.normal)).collect(),
            origin: map.origin,
            indices: map.triangles.corners.as_flattened().to_vec(),
            faces: map.triangles.faces.clone(),
            points: vertices().flat_map(|vertex| vertex.point.to_array()).collect(),
            slacks: vertices().map(|vertex| placing.length(vertex.slack)).collect(),
            distances: map.values.iter().map(|&[_, distance]| distance).collect(),
            signed: map.values.iter().map(|&[signed, _]| signed).collect(),
            feet: map.feet.iter().flat_map(|foot| foot.to_array()).collect(),
            signs,
        }
    }
}
