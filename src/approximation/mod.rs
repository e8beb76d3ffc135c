//! Functions near given values: Chebyshev interpolation, and least squares.

pub(crate) mod chebyshev;
pub(crate) mod least_squares;
