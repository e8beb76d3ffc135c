//! The result of one direction, before it is named by model.

use super::{Details, Field, SurfacePoint};
use crate::model::RigidTransform;
use glam::DVec3;

/// The result of one direction by one method; points are in the frame of `to`.
pub(super) struct DirectedResult {
    /// The distance of the witness.
    pub(super) computed: f64,
    /// A lower bound on the directed distance.
    pub(super) lower: f64,
    /// An upper bound on the directed distance.
    pub(super) upper: f64,
    pub(super) converged: bool,
    /// The witness on the model `from`.
    pub(super) from: SurfacePoint,
    /// The witness on the model `to`.
    pub(super) to: SurfacePoint,
    pub(super) details: Details,
    pub(super) field: Vec<Field>,
}

impl SurfacePoint {
    /// Returns the image of the point under the transform, with the same parameters.
    pub(super) fn moved(&self, transform: &RigidTransform) -> Self {
        let point = transform.apply(DVec3::from_array(self.point)).to_array();
        Self { point, part: self.part.clone(), ..*self }
    }
}
