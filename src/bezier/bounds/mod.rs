//! Bounds of one patch: its derivatives, its box, its rounding, and its jumps at a seam.

mod derivative_bounds;
mod local_derivative_bounds;
mod oriented_box;
mod point_error;
mod seam_jumps;

pub use derivative_bounds::DerivativeBounds;
pub use local_derivative_bounds::LocalDerivativeBounds;
pub(crate) use local_derivative_bounds::{BEYOND, MAX_DEGREES};
pub use oriented_box::OrientedBox;
pub use point_error::PointError;
pub(crate) use seam_jumps::SeamJumps;
