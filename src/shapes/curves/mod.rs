//! NURBS curves in a plane: profiles of surfaces of revolution and wing sections.

mod circle;
mod interpolation;
mod naca;
mod plane_curve;

pub(super) use circle::{UNIT_CIRCLE, UNIT_CIRCLE_KNOTS};
pub use circle::{circle, half_circle};
pub(super) use interpolation::{DEGREE, UniformSpline, basis, interpolate};
pub use naca::Naca4;
pub use plane_curve::PlaneCurve;
pub(super) use plane_curve::clamped_knots;
