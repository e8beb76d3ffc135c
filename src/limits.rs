//! Limits of the input within which float64 neither overflows nor underflows.

/// The largest absolute value of a coordinate, translation, weight or knot.
///
/// Weights are divided by a power of two between 1/2 and 1 of the surface's
/// largest, so homogeneous coordinates are below 1e102. The largest numbers that
/// bounds form are squared sums of their products with weights and binomials, at
/// most `(2^60 1e102)² < 1e241`.
const MAX_SIZE: f64 = 1e100;

/// The smallest weight: divided by the surface's largest it is a normal number.
pub(crate) const MIN_WEIGHT: f64 = 1e-100;

/// The largest ratio of two weights of a surface: the product of four weights is
/// at least 1e-120, so that underflow of a numerator stays below 1e-100 in length.
pub(crate) const MAX_WEIGHT_RATIO: f64 = 1e30;

/// Returns whether the number is at most 1e100 in size; false for NaN.
pub(crate) fn is_in_range(number: f64) -> bool {
    number.abs() <= MAX_SIZE
}

/// The largest degree accepted in either direction.
///
/// CAD exchange formats stay below it, and the kernels keep the (15 + 1)² control
/// points of a patch in private memory.
pub const MAX_DEGREE: usize = 15;

/// The highest degree that a file may state, that of OpenCASCADE; above [`MAX_DEGREE`] a reader fits a lower
/// one with a proven distance.
pub const MAX_FILE_DEGREE: usize = 25;

/// The largest number of control points of a patch along one direction.
pub const MAX_ORDER: usize = MAX_DEGREE + 1;
