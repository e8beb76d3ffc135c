//! A model as plain arrays, not validated, as readers of CAD files yield it.

use super::trim::FaceArrays;
use serde::{Deserialize, Serialize};

/// The row-major 3x4 matrix of the identity.
pub const IDENTITY: [f64; 12] = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];

/// A model as plain arrays, not validated.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ModelArrays {
    /// The model's name.
    pub name: Option<String>,
    /// Metres per coordinate unit; `None` is unknown.
    pub unit: Option<f64>,
    /// The faces.
    pub faces: Vec<FaceArrays>,
    /// The placements of the faces; empty is each face once, where it is.
    pub instances: Vec<InstanceArrays>,
}

/// A placement of some faces of a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InstanceArrays {
    /// The indices of the faces placed.
    pub surfaces: Vec<usize>,
    /// The affine map as a row-major 3x4 matrix; the translation is the last column.
    pub transform: [f64; 12],
    /// The instance's name in its source.
    pub name: Option<String>,
    /// The number of the solid that the placed faces bound, in place of those of the faces: instances with the same number
    /// are of one solid. Without it each instance has shells and solids of its own.
    pub solid: Option<u32>,
}
