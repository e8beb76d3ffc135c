//! Volumes of sets of two bodies from that of their intersection.

use crate::interval::Interval;
use serde::Serialize;

/// The volumes of sets of two bodies, each in an interval that contains it, in cubes of model units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct OverlapVolumes {
    /// Of A ∩ B.
    pub intersection: Interval,
    /// Of A ∪ B.
    pub union: Interval,
    /// Of A \ B.
    pub only_a: Interval,
    /// Of B \ A.
    pub only_b: Interval,
}

impl OverlapVolumes {
    /// Makes them from the volumes of A, of B and of their intersection.
    pub(super) fn new([a, b]: [Interval; 2], intersection: Interval) -> Self {
        let larger = a.larger(b);
        let union = a + b - intersection;
        Self {
            intersection,
            union: Interval { lower: union.larger(larger).lower, upper: union.upper },
            only_a: (a - intersection).not_negative(),
            only_b: (b - intersection).not_negative(),
        }
    }

    /// Returns the volume of the intersection over that of the union, which grows with the former and falls with the
    /// sum of those of A and B.
    pub(super) fn ratio(&self, [a, b]: [Interval; 2]) -> Interval {
        let sum = a + b;
        let at = |common: f64, sum: f64| {
            let common = Interval::exactly(common);
            common.over(Interval::exactly(sum) - common)
        };
        let lower = at(self.intersection.lower, sum.upper).lower;
        let upper = at(self.intersection.upper, sum.lower).upper;
        // Of a ratio that is not known 0 and 1 remain.
        Interval {
            lower: if lower >= 0.0 { lower } else { 0.0 },
            upper: if upper <= 1.0 { upper } else { 1.0 },
        }
    }
}
