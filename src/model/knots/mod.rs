//! Validation of knot vectors.

mod blossom;
mod spans;

pub use blossom::blossom;
pub(crate) use spans::{Span, blossom_coefficients, breaks, multiplicities, spans};

use crate::axis::Axis;
use crate::error::{Error, Result};
use crate::limits::{MAX_DEGREE, is_in_range};
use std::fmt::{Display, Formatter};

/// The first rule that a degree, a number of control points and a knot vector violate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::model) enum KnotFault {
    /// The degree is not 1 to 15.
    Degree { found: usize },
    /// There are fewer control points than degree + 1.
    TooFewControlPoints { found: usize, expected: usize },
    /// The length is not control points + degree + 1.
    Length { found: usize, expected: usize },
    /// A knot is not finite or too large.
    Number { index: usize, found: f64 },
    /// A knot is smaller than the one before it.
    Decreasing { index: usize, found: f64, expected: f64 },
    /// `knots[degree]` and `knots[count]` are equal.
    EmptyDomain { start: f64, end: f64 },
    /// A knot is repeated too often.
    Multiplicity { index: usize, found: usize, expected: usize },
}

/// Checks degree, number of control points and knots.
///
/// Valid knots do not decrease, `knots[degree] < knots[count]` bound the domain,
/// and no knot is repeated more than degree + 1 times, so that every non-empty
/// span has its degree + 1 basis functions. O(knots).
pub(in crate::model) fn check(
    degree: usize,
    count: usize,
    knots: &[f64],
) -> std::result::Result<(), KnotFault> {
    if !(1..=MAX_DEGREE).contains(&degree) {
        return Err(KnotFault::Degree { found: degree });
    }
    if count <= degree {
        return Err(KnotFault::TooFewControlPoints { found: count, expected: degree + 1 });
    }
    let expected = count + degree + 1;
    if knots.len() != expected {
        return Err(KnotFault::Length { found: knots.len(), expected });
    }
    if let Some(index) = knots.iter().position(|&knot| !is_in_range(knot)) {
        return Err(KnotFault::Number { index, found: knots[index] });
    }
    if let Some(index) = knots.windows(2).position(|pair| pair[1] < pair[0]) {
        return Err(KnotFault::Decreasing {
            index: index + 1,
            found: knots[index + 1],
            expected: knots[index],
        });
    }
    let (start, end) = (knots[degree], knots[count]);
    if start >= end {
        return Err(KnotFault::EmptyDomain { start, end });
    }
    let mut index = 0;
    while index < knots.len() {
        let found = knots[index..].iter().take_while(|&&knot| knot == knots[index]).count();
        if found > degree + 1 {
            return Err(KnotFault::Multiplicity { index, found, expected: degree + 1 });
        }
        index += found;
    }
    Ok(())
}

/// Checks degree, number of control points and knots of a surface along one axis, by
/// the rules of [`check`].
pub(in crate::model) fn validate(
    surface: usize,
    axis: Axis,
    degree: usize,
    count: usize,
    knots: &[f64],
) -> Result<()> {
    check(degree, count, knots).map_err(|fault| fault.on_surface(surface, axis))
}

impl KnotFault {
    fn on_surface(self, surface: usize, axis: Axis) -> Error {
        match self {
            Self::Degree { found } => Error::DegreeOutOfRange { surface, axis, found },
            Self::TooFewControlPoints { found, expected } => {
                Error::TooFewControlPoints { surface, axis, found, expected }
            }
            Self::Length { found, expected } => Error::KnotsLength { surface, axis, found, expected },
            Self::Number { index, found } => {
                let what = match axis {
                    Axis::U => "knot in u",
                    Axis::V => "knot in v",
                };
                Error::number_out_of_range(surface, what, index, found)
            }
            Self::Decreasing { index, found, expected } => {
                Error::KnotsDecreasing { surface, axis, index, found, expected }
            }
            Self::EmptyDomain { start, end } => Error::KnotsEmptyDomain { surface, axis, start, end },
            Self::Multiplicity { index, found, expected } => {
                Error::KnotsMultiplicity { surface, axis, index, found, expected }
            }
        }
    }
}

/// The fault of a curve, in words.
impl Display for KnotFault {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        match *self {
            Self::Degree { found } => write!(formatter, "degree {found}, expected 1 to {MAX_DEGREE}"),
            Self::TooFewControlPoints { found, expected } => {
                write!(formatter, "{found} control points, expected at least {expected} (degree + 1)")
            }
            Self::Length { found, expected } => {
                write!(formatter, "{found} knots, expected {expected} (control points + degree + 1)")
            }
            Self::Number { index, found } => {
                write!(
                    formatter,
                    "knot {index} is {found:?}, expected a finite number of at most 1e100 in size"
                )
            }
            Self::Decreasing { index, found, expected } => {
                write!(formatter, "knot {index} is {found:?}, expected at least {expected:?}")
            }
            Self::EmptyDomain { start, end } => {
                write!(formatter, "the domain is [{start:?}, {end:?}], expected a positive length")
            }
            Self::Multiplicity { index, found, expected } => write!(
                formatter,
                "knot {index} is repeated {found} times, expected at most {expected} (degree + 1)"
            ),
        }
    }
}
