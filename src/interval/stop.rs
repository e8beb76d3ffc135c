//! The end of a search.

/// Why a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Stop {
    /// The interval is as narrow as requested, or the limit is decided.
    Converged,
    /// The budget of cells is spent.
    Cells,
    /// The budget of time is spent.
    Time,
    /// The interval is as narrow as float64 allows for these coordinates.
    Precision,
    /// The caller cancelled.
    Cancelled,
}
