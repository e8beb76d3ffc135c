//! Validation of knot vectors.

use super::MAX_DEGREE;
use crate::axis::Axis;
use crate::error::{Error, Result};
use crate::limits::is_in_range;

/// Checks degree, number of control points and knots along one axis.
///
/// Valid knots do not decrease, `knots[degree] < knots[count]` bound the domain,
/// and no knot is repeated more than degree + 1 times, so that every non-empty
/// span has its degree + 1 basis functions. O(knots).
pub(super) fn validate(surface: usize, axis: Axis, degree: usize, count: usize, knots: &[f64]) -> Result<()> {
    if !(1..=MAX_DEGREE).contains(&degree) {
        return Err(Error::DegreeOutOfRange { surface, axis, found: degree });
    }
    if count <= degree {
        return Err(Error::TooFewControlPoints { surface, axis, found: count, expected: degree + 1 });
    }
    let expected = count + degree + 1;
    if knots.len() != expected {
        return Err(Error::KnotsLength { surface, axis, found: knots.len(), expected });
    }
    if let Some(index) = knots.iter().position(|&knot| !is_in_range(knot)) {
        let what = match axis {
            Axis::U => "knot in u",
            Axis::V => "knot in v",
        };
        return Err(Error::number_out_of_range(surface, what, index, knots[index]));
    }
    if let Some(index) = knots.windows(2).position(|pair| pair[1] < pair[0]) {
        return Err(Error::KnotsDecreasing {
            surface,
            axis,
            index: index + 1,
            found: knots[index + 1],
            expected: knots[index],
        });
    }
    let (start, end) = (knots[degree], knots[count]);
    if start >= end {
        return Err(Error::KnotsEmptyDomain { surface, axis, start, end });
    }
    let mut index = 0;
    while index < knots.len() {
        let found = knots[index..].iter().take_while(|&&knot| knot == knots[index]).count();
        if found > degree + 1 {
            return Err(Error::KnotsMultiplicity { surface, axis, index, found, expected: degree + 1 });
        }
        index += found;
    }
    Ok(())
}
