//! What float64 loses of lengths.

/// Rounding of coordinates, boxes and roots relative to the largest
/// coordinate: 128 units of 2^-53.
const COORDINATE_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Squares of lengths below it are smaller than 1e-300, and near there float64
/// has fewer digits or none.
const VANISHING_LENGTH: f64 = 1e-150;

/// What a few sums and a root of squares of coordinates of at most `largest` may lose.
pub(crate) fn coordinate_rounding(largest: f64) -> f64 {
    COORDINATE_ROUNDING * largest + VANISHING_LENGTH
}
