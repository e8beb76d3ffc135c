//! Limits of the input within which float64 neither overflows nor underflows.

use crate::error::Error;

/// The largest absolute value of a coordinate, translation, weight or knot: a
/// coordinate times a weight is at most 1e200, and the square of a length is far
/// from overflow.
const MAX_SIZE: f64 = 1e100;

/// The smallest weight: a coordinate divided by two weights is far from overflow.
pub(crate) const MIN_WEIGHT: f64 = 1e-100;

/// Returns whether the number is at most 1e100 in size; false for NaN.
pub(crate) fn is_in_range(number: f64) -> bool {
    number.abs() <= MAX_SIZE
}

/// Returns the error for a number that is not [`is_in_range`].
pub(crate) fn out_of_range(surface: usize, what: &'static str, index: usize, found: f64) -> Error {
    if found.is_finite() {
        Error::NumberTooLarge { surface, what, index, found }
    } else {
        Error::NonFinite { surface, what, index, found }
    }
}

/// The largest degree accepted in either direction.
///
/// CAD exchange formats stay below it, and the kernels keep the (15 + 1)² control
/// points of a patch in private memory.
pub const MAX_DEGREE: usize = 15;
