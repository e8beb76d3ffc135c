//! The numbers that float64 can compute with.

use crate::error::Error;

/// The largest size of a coordinate, translation, weight or knot: a coordinate times a weight
/// is 1e200 at most, and the square of a length far from overflow.
const LARGEST: f64 = 1e100;

/// The least weight: a coordinate divided by two weights is far from overflow.
pub(crate) const MIN_WEIGHT: f64 = 1e-100;

/// Whether the number is neither too large nor none at all.
pub(crate) fn is_in_range(number: f64) -> bool {
    number.abs() <= LARGEST
}

/// The error for a number that is not [`is_in_range`].
pub(crate) fn out_of_range(surface: usize, what: &'static str, index: usize, found: f64) -> Error {
    if found.is_finite() {
        Error::NumberTooLarge { surface, what, index, found }
    } else {
        Error::NonFinite { surface, what, index, found }
    }
}

/// The largest degree accepted in either direction.
///
/// CAD exchange formats stay below it, and the kernels keep one patch's
/// (15 + 1)^2 control points in private memory.
pub const MAX_DEGREE: usize = 15;
