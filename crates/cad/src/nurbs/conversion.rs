//! The reasons for which a curve or surface has no exact NURBS.

/// A conversion's failure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Unconvertible {
    /// The offset of a curve or surface is not rational, and no piecewise polynomial of the
    /// size allowed follows it, as where it has cusps.
    Offset,
    /// The curve runs along the direction across which its offset lies, so that it is moved nowhere.
    OffsetSide,
    /// The degree is above the model's, and no pieces of a lower one of the number allowed follow the
    /// surface, as where its weights are far apart.
    Degree,
    /// The range is too long, or too far from the first period, to be that of an edge.
    Range,
}

impl Unconvertible {
    /// The stable code of the reason.
    pub(crate) fn code(self) -> &'static str {
        match self {
            Self::Offset => "BREP_OFFSET",
            Self::OffsetSide => "BREP_OFFSET_PARALLEL",
            Self::Degree => "BREP_DEGREE",
            Self::Range => "BREP_RANGE",
        }
    }

    /// The reason in words.
    pub(crate) fn why(self) -> &'static str {
        match self {
            Self::Offset => {
                "the offset is not rational, and no NURBS of the size allowed is within the tolerance of it"
            }
            Self::OffsetSide => {
                "the curve runs along the direction of its offset somewhere, so that the offset has no side"
            }
            Self::Degree => {
                "the degree is above 15, and no NURBS of the size allowed is within the tolerance of the surface"
            }
            Self::Range => "the range is longer than 16 periods, or a million periods from 0",
        }
    }
}

/// The longest range of a periodic parameter, in periods.
const MAX_PERIODS: f64 = 16.0;

/// The largest parameter, in periods: float64 still resolves 1e-10 of one.
const MAX_PARAMETER: f64 = 1e6;

/// Checks that a range is one that an edge may have, relative to the start of the first
/// period.
///
/// # Errors
/// [`Unconvertible::Range`] if not.
pub(crate) fn check_range([start, end]: [f64; 2], period: f64) -> Result<(), Unconvertible> {
    let near = [start, end].iter().all(|parameter| parameter.abs() <= MAX_PARAMETER * period);
    let valid = near && end > start && end - start <= MAX_PERIODS * period;
    if valid { Ok(()) } else { Err(Unconvertible::Range) }
}
