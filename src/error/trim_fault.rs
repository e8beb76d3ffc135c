//! The ways in which the trimming loops of a surface can be invalid.

use thiserror::Error as ThisError;

/// A violation of the rules of trimming loops. Lengths are fractions of the surface's
/// domain, so that 1 is the whole range of u or v.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, ThisError)]
pub enum TrimFault {
    /// Trimming without loops, which would leave nothing of the surface.
    #[error("0 trimming loops, expected at least 1")]
    NoLoops,
    /// A curve with invalid degree, knots or control points.
    #[error("loop {loop_index}, curve {curve}: {found}")]
    CurveInvalid {
        /// The index of the loop.
        loop_index: usize,
        /// The index of the curve in its loop.
        curve: usize,
        /// The value found and the value expected, in words.
        found: String,
    },
    /// A weight of a curve is not positive, or too small beside the others.
    #[error(
        "loop {loop_index}, curve {curve}: weight of control point {index} is {found:?}, expected at least {expected:?}"
    )]
    WeightNotPositive {
        /// The index of the loop.
        loop_index: usize,
        /// The index of the curve in its loop.
        curve: usize,
        /// The index of the control point.
        index: usize,
        /// The weight.
        found: f64,
        /// The smallest weight allowed.
        expected: f64,
    },
    /// A curve does not begin where the one before it ends.
    #[error(
        "loop {loop_index}, curve {curve}: begins {found:e} of the domain from the end of the curve before it, expected at most {expected:e}"
    )]
    LoopOpen {
        /// The index of the loop.
        loop_index: usize,
        /// The index of the curve that begins elsewhere.
        curve: usize,
        /// The larger of the differences in u and v.
        found: f64,
        /// The largest difference allowed.
        expected: f64,
    },
    /// A curve leaves the surface's domain.
    #[error(
        "loop {loop_index}, curve {curve}: leaves the domain by {found:e} of its range, expected at most {expected:e}"
    )]
    OutsideDomain {
        /// The index of the loop.
        loop_index: usize,
        /// The index of the curve.
        curve: usize,
        /// The largest distance outside, in u or v.
        found: f64,
        /// The largest distance allowed.
        expected: f64,
    },
    /// A loop encloses no area.
    #[error("loop {loop_index}: its mean width is {found:e} of the domain, expected at least {expected:e}")]
    LoopNoArea {
        /// The index of the loop.
        loop_index: usize,
        /// Twice the area over the length.
        found: f64,
        /// The smallest width allowed.
        expected: f64,
    },
    /// The loops cancel each other, so that the region is empty.
    #[error("the region's mean width is {found:e} of the domain, expected at least {expected:e}")]
    RegionNoArea {
        /// Twice the area over the length of the loops.
        found: f64,
        /// The smallest width allowed.
        expected: f64,
    },
    /// Two curves cross each other.
    #[error(
        "loop {loop_index}, curve {curve}: crosses curve {other_curve} of loop {other_loop} near {at:?}, so that the winding number there is {found}, expected 0 or 1"
    )]
    LoopsCross {
        /// The index of the loop.
        loop_index: usize,
        /// The index of the curve in its loop.
        curve: usize,
        /// The index of the other curve's loop.
        other_loop: usize,
        /// The index of the other curve in its loop.
        other_curve: usize,
        /// The point (u, v) near the crossing whose winding number is not 0 or 1.
        at: [f64; 2],
        /// Its winding number.
        found: i32,
    },
    /// A loop lies at the wrong depth among the others, or turns the wrong way.
    #[error(
        "loop {loop_index}: the winding number beside it, at {at:?}, is {found}, expected 0 or 1: {turn} where the others' winding number is {others}"
    )]
    WrongNesting {
        /// The index of the loop.
        loop_index: usize,
        /// A point (u, v) of the loop.
        at: [f64; 2],
        /// The winding number on one side of the loop.
        found: i32,
        /// The direction in which the loop turns, in words.
        turn: &'static str,
        /// The winding number of the other loops.
        others: i32,
    },
}

impl TrimFault {
    /// The stable code of the violation.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::NoLoops => "TRIM_NO_LOOPS",
            Self::CurveInvalid { .. } => "TRIM_CURVE_INVALID",
            Self::WeightNotPositive { .. } => "TRIM_WEIGHT_NOT_POSITIVE",
            Self::LoopOpen { .. } => "TRIM_LOOP_OPEN",
            Self::OutsideDomain { .. } => "TRIM_OUTSIDE_DOMAIN",
            Self::LoopNoArea { .. } => "TRIM_LOOP_NO_AREA",
            Self::RegionNoArea { .. } => "TRIM_REGION_NO_AREA",
            Self::LoopsCross { .. } => "TRIM_LOOPS_CROSS",
            Self::WrongNesting { .. } => "TRIM_WRONG_NESTING",
        }
    }
}
