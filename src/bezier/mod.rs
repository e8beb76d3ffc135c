//! Rational Bézier patches: extraction from NURBS surfaces, evaluation,
//! subdivision, and bounds on points and derivatives.

mod bernstein;
mod bernstein_product;
mod derivative_bounds;
mod evaluate;
mod extract;
mod grid_basis;
mod knot_removal;
mod local_derivative_bounds;
mod oriented_box;
mod patch;
mod point_error;
mod power_form;
mod seam_jumps;
mod subdivide;

pub use bernstein::MAX_ORDER;
pub(crate) use bernstein_product::{length_bounds, scaled, squares, unscale};
pub use derivative_bounds::DerivativeBounds;
pub use evaluate::Jet;
pub(crate) use evaluate::normal;
pub use extract::{BezierModel, PatchGrid, extract};
pub(crate) use extract::{center_grid, power_of_two_below, snapped, spans};
pub(crate) use grid_basis::GridBasis;
pub(crate) use knot_removal::without_removable_knots;
pub use local_derivative_bounds::LocalDerivativeBounds;
pub(crate) use local_derivative_bounds::{BEYOND, MAX_DEGREES};
pub use oriented_box::OrientedBox;
pub(crate) use patch::relative;
pub use patch::{Patch, PatchSet};
pub use point_error::PointError;
pub(crate) use seam_jumps::SeamJumps;
