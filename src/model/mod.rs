//! What a user hands over: NURBS surfaces, parsed once and valid ever after.

mod json;
mod knots;
mod nurbs;
mod rigid_transform;
mod surface;

pub use crate::limits::MAX_DEGREE;
pub use nurbs::Model;
pub use rigid_transform::RigidTransform;
pub use surface::{NurbsSurface, SurfaceArrays};
