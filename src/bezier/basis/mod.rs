//! Bernstein polynomials: their values, products, power form and interpolation.

pub(in crate::bezier) mod bernstein;
mod bernstein_product;
mod grid_basis;
mod interpolation;
mod power_form;
mod restriction;

pub(crate) use bernstein_product::{
    binomials, dot_products, length_bounds, scaled, squares, triple_products, unscale,
};
pub(crate) use grid_basis::GridBasis;
pub use interpolation::{Interpolation, bernstein};
pub(crate) use restriction::{Restriction, elevation_shares};
