//! Polynomials in Bernstein form, Chebyshev interpolation, least squares, linear systems.

pub(crate) mod bernstein;
pub mod chebyshev;
pub(crate) mod elimination;
pub(crate) mod least_squares;
