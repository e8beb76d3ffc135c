//! Rational Bézier patches: extraction from NURBS surfaces, evaluation,
//! subdivision, and bounds on points and derivatives.

mod basis;
mod bounds;
mod extraction;
mod grid_cells;
mod patch;

pub use crate::limits::MAX_ORDER;
pub(crate) use basis::{
    GridBasis, Restriction, binomials, dot_products, elevation_shares, length_bounds, scaled, squares,
    triple_products, unscale,
};
pub use basis::{Interpolation, bernstein};
pub(crate) use bounds::{BEYOND, MAX_DEGREES, SeamJumps};
pub use bounds::{DerivativeBounds, LocalDerivativeBounds, OrientedBox, PointError};
pub use extraction::{BezierModel, PatchGrid, extract};
pub(crate) use extraction::{center_grid, power_of_two_below, snapped, without_removable_knots};
pub(crate) use grid_cells::{cell_pieces, uniform};
#[cfg(feature = "gpu")]
pub(crate) use patch::net_length;
#[cfg(all(test, not(target_arch = "wasm32")))]
pub(crate) use patch::quarter_of_cylinder;
pub(crate) use patch::{HomogeneousTangents, normal, relative};
pub use patch::{Jet, Patch, PatchSet};
