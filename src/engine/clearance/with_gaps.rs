//! The clearance of the sources of the models.

use crate::interval::Interval;
use serde::Serialize;

/// The interval that holds for every pair of sources within the gaps of both models, and the
/// verdict that follows from it.
///
/// Guarantee: as [`crate::result::WithGaps`], for the least distance. Each point of a source is
/// within the gap of a point of its model and the other way round, so that the least distances
/// differ by at most the sum of both gaps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct ClearanceWithGaps {
    /// A lower bound on the least distance of the sources.
    pub lower: f64,
    /// An upper bound on the least distance of the sources.
    pub upper: f64,
    /// With a limit: whether the clearance of the sources is at least the limit, absent where the
    /// gaps could change that or it is not known for the models.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_least: Option<bool>,
}

impl ClearanceWithGaps {
    /// `gap` is the sum of both models' gaps, `at_least` the verdict for the models.
    pub(super) fn new(interval: Interval, gap: f64, limit: Option<f64>, at_least: Option<bool>) -> Self {
        let Interval { lower, upper } = interval;
        if gap == 0.0 {
            return Self { lower, upper, at_least };
        }
        let lower = (lower - gap).next_down();
        let (lower, upper) = (if lower > 0.0 { lower } else { 0.0 }, (upper + gap).next_up());
        let keeps = |at_least: &bool| {
            limit.is_some_and(|at| if *at_least { lower > 0.0 && lower >= at } else { upper < at })
        };
        Self { lower, upper, at_least: at_least.filter(keeps) }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_is_kept_where_no_gap_changes_it() {
        let of = |lower, upper, gap, verdict| {
            let interval = Interval { lower, upper };
            ClearanceWithGaps::new(interval, gap, Some(1.0), Some(verdict)).at_least
        };
        assert_eq!(of(1.2, 1.3, 0.1, true), Some(true));
        assert_eq!(of(1.2, 1.3, 0.25, true), None);
        assert_eq!(of(0.7, 0.8, 0.1, false), Some(false));
        assert_eq!(of(0.7, 0.8, 0.25, false), None);
        assert_eq!(of(1.0, 1.0, 0.0, true), Some(true));
        // At least 0 means apart.
        let at_zero =
            |gap| ClearanceWithGaps::new(Interval { lower: 0.1, upper: 0.2 }, gap, Some(0.0), Some(true));
        assert_eq!([at_zero(0.05), at_zero(0.15)].map(|found| found.at_least), [Some(true), None]);
    }
}
