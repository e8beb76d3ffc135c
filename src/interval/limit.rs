//! A limit on the distance that is to be decided.

use super::Interval;

/// A limit, and the sum of the gaps of both models: how far the distance of their sources may
/// be from that of the models.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Limit {
    pub(crate) at: f64,
    pub(crate) gap: f64,
}

impl Limit {
    /// A limit on the distance of the models as they are.
    #[cfg(all(test, not(target_arch = "wasm32")))]
    pub(crate) fn exact(at: f64) -> Self {
        Self { at, gap: 0.0 }
    }

    /// Returns the distances of the models that are to be distinguished, ascending: up to the
    /// first every source keeps the limit, up to the second the models do, above the third no
    /// source does. Each is rounded to the safe side.
    fn levels(self) -> [f64; 3] {
        let Self { at, gap } = self;
        let [below, above] = if gap > 0.0 { [(at - gap).next_down(), (at + gap).next_up()] } else { [at; 2] };
        [below, at, above]
    }

    /// Returns the level next to be decided where a distance of `lower` is found: a cell that
    /// is not beyond it needs no halving. `None` if all levels are exceeded.
    pub(crate) fn next_level(self, lower: f64) -> Option<f64> {
        self.levels().into_iter().find(|&level| lower <= level)
    }

    /// Returns whether the distance in an interval is at most the limit, if that is known.
    pub(crate) fn keeps(self, interval: Interval) -> Option<bool> {
        Self::verdict(interval, [self.at; 2])
    }

    /// As [`Self::keeps`], for every pair of sources within the gap.
    pub(crate) fn sources_keep(self, interval: Interval) -> Option<bool> {
        let [below, _, above] = self.levels();
        Self::verdict(interval, [below, above])
    }

    fn verdict(Interval { lower, upper }: Interval, [below, above]: [f64; 2]) -> Option<bool> {
        if upper <= below {
            Some(true)
        } else if lower > above {
            Some(false)
        } else {
            None
        }
    }
}
