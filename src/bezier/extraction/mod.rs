//! The Bézier patches of NURBS surfaces.

pub(in crate::bezier) mod extract;
mod knot_removal;

pub use extract::{BezierModel, PatchGrid, extract};
pub(crate) use extract::{center_grid, power_of_two_below, snapped};
pub(crate) use knot_removal::without_removable_knots;
