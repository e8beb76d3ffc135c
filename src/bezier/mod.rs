//! Bézier patches: what every later stage works on.

mod bernstein;
mod derivative_bounds;
mod evaluate;
mod extract;
mod local_derivative_bounds;
mod oriented_box;
mod patch;
mod power_form;
mod restrict;
mod scaled;
mod split;
mod squares;
mod tangents;

pub use bernstein::MAX_ORDER;
pub use derivative_bounds::DerivativeBounds;
pub use evaluate::Jet;
pub(crate) use evaluate::normal;
pub use extract::{BezierModel, PatchGrid, extract};
pub(crate) use extract::{center_grid, power_of_two_below};
pub use local_derivative_bounds::LocalDerivativeBounds;
pub(crate) use local_derivative_bounds::{BEYOND, MAX_DEGREES};
pub use oriented_box::OrientedBox;
pub(crate) use patch::relative;
pub use patch::{Patch, PatchSet};
pub(crate) use scaled::{scaled, unscale};
pub(crate) use squares::{lengths, squares};
pub(crate) use tangents::GridBasis;
