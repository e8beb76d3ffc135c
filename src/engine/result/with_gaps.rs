//! The interval that holds for the sources of the models.

use crate::interval::{Interval, Limit};
use serde::Serialize;

/// The interval that holds for every pair of sources within the gaps of both models, and the
/// verdict that follows from it.
///
/// Guarantee: if each source is at a Hausdorff distance of at most its model's gap from the
/// model, the distance of the sources is in `[lower, upper]`, since it differs from that of
/// the models by at most the sum of both gaps. Where the gap is not proven it is an estimate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct WithGaps {
    /// A lower bound on the distance of the sources.
    pub lower: f64,
    /// An upper bound on the distance of the sources.
    pub upper: f64,
    /// With a limit: whether the distance of the sources is at most the limit, absent where the
    /// gaps could change that or the search ended before it was known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within: Option<bool>,
}

impl WithGaps {
    pub(in crate::engine) fn new(interval: Interval, gap: f64, limit: Option<f64>) -> Self {
        let within = limit.and_then(|at| Limit { at, gap }.sources_keep(interval));
        let Interval { lower, upper } = interval;
        if gap == 0.0 {
            return Self { lower, upper, within };
        }
        let lower = (lower - gap).next_down();
        Self { lower: if lower > 0.0 { lower } else { 0.0 }, upper: (upper + gap).next_up(), within }
    }

    /// Returns that of both directions: their maximum is the distance.
    pub(super) fn of_both(&self, reverse: &Self) -> Self {
        let within = match (self.within, reverse.within) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        };
        let larger = |one: f64, other: f64| if one > other { one } else { other };
        Self { lower: larger(self.lower, reverse.lower), upper: larger(self.upper, reverse.upper), within }
    }
}
