//! Points of models in results.

use crate::model::RigidTransform;
use glam::DVec3;
use serde::Serialize;

/// A point of a model.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct SurfacePoint {
    /// Index of the face.
    pub face: usize,
    /// The face's name in its source, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub face_name: Option<String>,
    /// Parameter u on it. Where a surface jumps at a knot, the last number before the knot stands for the end of what
    /// is before it, as in v: the surface at the knot is what comes after.
    pub u: f64,
    /// Parameter v on it.
    pub v: f64,
    /// On a mesh, the index of the triangle; u and v are then the weights of its second and
    /// third corner.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub triangle: Option<usize>,
    /// On a mesh, the weights of the triangle's corners: at least 0, with the sum 1 up to rounding.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub barycentric: Option<[f64; 3]>,
    /// Of a cloud, the index of the point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub index: Option<usize>,
    /// The point at these parameters: within 1024 roundings of the largest coordinate of its surface, because
    /// nearly removable knots are dropped (R15 of docs/rounding.md), and within the deviation of a trimmed
    /// face's cut. The interval includes both.
    pub point: [f64; 3],
}

impl SurfacePoint {
    /// Returns the image of the point under the transform, with the same parameters.
    pub(crate) fn moved(&self, transform: &RigidTransform) -> Self {
        let point = transform.apply(DVec3::from_array(self.point)).to_array();
        Self { point, face_name: self.face_name.clone(), ..*self }
    }
}
