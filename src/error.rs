//! The one error type of the crate, with codes that stay stable across releases.

use crate::axis::Axis;
use thiserror::Error as ThisError;

/// What a function of this crate returns when its input or machine may fail it.
pub type Result<T> = std::result::Result<T, Error>;

/// Everything that can go wrong, each naming the surface, the index, what was
/// found and what was expected. [`Error::code`] is the part to match on.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, ThisError)]
pub enum Error {
    /// A coordinate, weight or knot is infinite or not a number.
    #[error("surface {surface}: {what} {index} is {found:?}, expected a finite number")]
    NonFinite {
        /// Index of the surface in its model.
        surface: usize,
        /// Which list the value stands in.
        what: &'static str,
        /// Its index in that list.
        index: usize,
        /// The value.
        found: f64,
    },
    /// A coordinate, weight or knot is so large that its square would overflow.
    #[error("surface {surface}: {what} {index} is {found:?}, expected at most 1e100 in size")]
    NumberTooLarge {
        /// Index of the surface in its model.
        surface: usize,
        /// Which list the value stands in.
        what: &'static str,
        /// Its index in that list.
        index: usize,
        /// The value.
        found: f64,
    },
    /// A weight is negative, zero or less than 1e-100.
    #[error("surface {surface}: weight of control point {index} is {found:?}, expected at least 1e-100")]
    WeightNotPositive {
        /// Index of the surface in its model.
        surface: usize,
        /// Index of the control point, v fastest.
        index: usize,
        /// The weight.
        found: f64,
    },
    /// A knot is smaller than the one before it.
    #[error("surface {surface}: knot {index} in {axis} is {found:?}, expected at least {expected:?}")]
    KnotsDecreasing {
        /// Index of the surface in its model.
        surface: usize,
        /// The axis of the knot vector.
        axis: Axis,
        /// Index of the knot.
        index: usize,
        /// The knot.
        found: f64,
        /// The knot before it.
        expected: f64,
    },
    /// A knot vector is not of length count + degree + 1.
    #[error("surface {surface}: {found} knots in {axis}, expected {expected} (control points + degree + 1)")]
    KnotsLength {
        /// Index of the surface in its model.
        surface: usize,
        /// The axis of the knot vector.
        axis: Axis,
        /// Its length.
        found: usize,
        /// The length that fits degree and net.
        expected: usize,
    },
    /// A knot is repeated more than degree + 1 times.
    #[error(
        "surface {surface}: knot {index} in {axis} is repeated {found} times, expected at most {expected} (degree + 1)"
    )]
    KnotsMultiplicity {
        /// Index of the surface in its model.
        surface: usize,
        /// The axis of the knot vector.
        axis: Axis,
        /// Index of the first of the equal knots.
        index: usize,
        /// How often it stands there.
        found: usize,
        /// How often it may.
        expected: usize,
    },
    /// The knots `[degree]` and `[count]`, which bound the domain, are equal.
    #[error("surface {surface}: the domain in {axis} is [{start:?}, {end:?}], expected a positive length")]
    KnotsEmptyDomain {
        /// Index of the surface in its model.
        surface: usize,
        /// The axis of the knot vector.
        axis: Axis,
        /// The first knot of the domain.
        start: f64,
        /// The last knot of the domain.
        end: f64,
    },
    /// A row of control points is not as long as the first, or the list not as long as the counts say.
    #[error("surface {surface}: row {index} of the net has {found} control points, expected {expected}")]
    RaggedNet {
        /// Index of the surface in its model.
        surface: usize,
        /// Index of the row (along u); 0 where the net is one list.
        index: usize,
        /// Its number of control points.
        found: usize,
        /// The number expected.
        expected: usize,
    },
    /// Fewer control points than degree + 1.
    #[error("surface {surface}: {found} control points in {axis}, expected at least {expected} (degree + 1)")]
    TooFewControlPoints {
        /// Index of the surface in its model.
        surface: usize,
        /// The axis.
        axis: Axis,
        /// The number of control points.
        found: usize,
        /// The least number.
        expected: usize,
    },
    /// A degree outside 1 to 15.
    #[error("surface {surface}: degree {found} in {axis}, expected 1 to {}", crate::limits::MAX_DEGREE)]
    DegreeOutOfRange {
        /// Index of the surface in its model.
        surface: usize,
        /// The axis.
        axis: Axis,
        /// The degree.
        found: usize,
    },
    /// A model without surfaces.
    #[error("the model has 0 surfaces, expected at least 1")]
    EmptyModel,
    /// JSON that is not of the interchange shape, or no JSON.
    #[error("the model is not interchange JSON: {found}")]
    JsonShape {
        /// What the parser found where, and what it expected.
        found: String,
    },
    /// A file or text over the size limit.
    #[error("the model is {found} bytes, expected at most {expected}")]
    FileTooLarge {
        /// Its size in bytes.
        found: u64,
        /// The limit in bytes.
        expected: u64,
    },
    /// A file that cannot be read.
    #[error("{path}: {found}")]
    FileUnreadable {
        /// The path as given.
        path: String,
        /// What the operating system said.
        found: String,
    },
    /// An option outside its range.
    #[error("option {option} is {found}, expected {expected}")]
    OptionOutOfRange {
        /// The option's name.
        option: &'static str,
        /// Its value.
        found: String,
        /// The range.
        expected: &'static str,
    },
    /// An option of another type or name than the options there are.
    #[error("options: {found}")]
    OptionInvalid {
        /// What was found, and what was expected.
        found: String,
    },
    /// A transform that is not a rotation and a translation of at most 1e100.
    #[error("the transform's {found}, expected a translation of at most 1e100 and a rotation of unit length")]
    TransformNotRigid {
        /// What is wrong with it.
        found: String,
    },
    /// A shape that the crate does not make.
    #[error("there is no shape \"{found}\", expected one of {expected}")]
    UnknownShape {
        /// The name asked for.
        found: String,
        /// The names there are.
        expected: String,
    },
    /// The GPU was asked for and there is none.
    #[error("no GPU adapter: {found}")]
    NoAdapter {
        /// What the platform said.
        found: String,
    },
    /// The GPU went away while it worked.
    #[error("the GPU device was lost: {found}")]
    DeviceLost {
        /// What the platform said.
        found: String,
    },
    /// The GPU refused a buffer, shader or read-back.
    #[error("the GPU failed: {found}")]
    GpuFailed {
        /// What the platform said.
        found: String,
    },
    /// Method `hierarchy` wants more pairs of boxes than its budget of memory holds.
    #[error(
        "level {level} of the hierarchy wants {found} pairs of boxes, expected at most {expected}, which fit the memory budget of {mebibytes} MiB"
    )]
    PairBudgetExceeded {
        /// The level, counted from the root's, 0.
        level: usize,
        /// The pairs left after culling.
        found: u64,
        /// The pairs that fit.
        expected: u64,
        /// The budget in MiB.
        mebibytes: usize,
    },
    /// The caller cancelled the work.
    #[error("cancelled")]
    Cancelled,
}

impl Error {
    /// Returns [`Error::OptionOutOfRange`] with what was found as Rust prints it.
    pub(crate) fn out_of_range(
        option: &'static str,
        found: impl std::fmt::Debug,
        expected: &'static str,
    ) -> Self {
        Self::OptionOutOfRange { option, found: format!("{found:?}"), expected }
    }

    /// The stable code, the same in Rust, on the command line and in JavaScript.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::NonFinite { .. } => "NON_FINITE",
            Self::NumberTooLarge { .. } => "NUMBER_TOO_LARGE",
            Self::WeightNotPositive { .. } => "WEIGHT_NOT_POSITIVE",
            Self::KnotsDecreasing { .. } => "KNOTS_DECREASING",
            Self::KnotsLength { .. } => "KNOTS_LENGTH",
            Self::KnotsMultiplicity { .. } => "KNOTS_MULTIPLICITY",
            Self::KnotsEmptyDomain { .. } => "KNOTS_EMPTY_DOMAIN",
            Self::RaggedNet { .. } => "RAGGED_NET",
            Self::TooFewControlPoints { .. } => "TOO_FEW_CONTROL_POINTS",
            Self::DegreeOutOfRange { .. } => "DEGREE_OUT_OF_RANGE",
            Self::EmptyModel => "EMPTY_MODEL",
            Self::JsonShape { .. } => "JSON_SHAPE",
            Self::FileTooLarge { .. } => "FILE_TOO_LARGE",
            Self::FileUnreadable { .. } => "FILE_UNREADABLE",
            Self::OptionOutOfRange { .. } => "OPTION_OUT_OF_RANGE",
            Self::OptionInvalid { .. } => "OPTION_INVALID",
            Self::TransformNotRigid { .. } => "TRANSFORM_NOT_RIGID",
            Self::UnknownShape { .. } => "UNKNOWN_SHAPE",
            Self::NoAdapter { .. } => "NO_ADAPTER",
            Self::DeviceLost { .. } => "DEVICE_LOST",
            Self::GpuFailed { .. } => "GPU_FAILED",
            Self::PairBudgetExceeded { .. } => "PAIR_BUDGET_EXCEEDED",
            Self::Cancelled => "CANCELLED",
        }
    }
}
