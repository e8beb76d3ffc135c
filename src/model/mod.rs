//! What a user hands over: NURBS surfaces, parsed once and valid ever after.

mod interchange;
mod knots;
mod nurbs;
mod range;
mod surface;
mod transform;

pub use interchange::MAX_JSON_BYTES;
pub use nurbs::Model;
pub use surface::{NurbsSurface, SurfaceArrays};
pub use transform::RigidTransform;

/// The largest degree accepted in either direction.
///
/// CAD exchange formats stay below it, and the kernels keep one patch's
/// (15 + 1)^2 control points in private memory.
pub const MAX_DEGREE: usize = 15;
