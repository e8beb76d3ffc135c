//! The result of one direction, before it is named by model.

use crate::engine::{Details, FaceDeviations};
use crate::surface_point::SurfacePoint;

/// The result of one direction by one method; points are in the frame of `to`.
pub(in crate::engine) struct DirectedResult {
    /// The distance of the witness.
    pub(in crate::engine) computed: f64,
    /// A lower bound on the directed distance.
    pub(in crate::engine) lower: f64,
    /// An upper bound on the directed distance.
    pub(in crate::engine) upper: f64,
    pub(in crate::engine) converged: bool,
    /// The witness on the model `from`.
    pub(in crate::engine) from: SurfacePoint,
    /// The witness on the model `to`.
    pub(in crate::engine) to: SurfacePoint,
    pub(in crate::engine) details: Details,
    pub(in crate::engine) deviations: Vec<FaceDeviations>,
}
