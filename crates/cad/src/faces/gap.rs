//! The distance between a trimming curve on its surface and the edge in space.

use super::metric::Metric;
use crate::gap::Lifted;

/// A distance, and whether it is a measurement at points and no upper bound.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Gap {
    pub(super) length: f64,
    pub(super) is_measured: bool,
}

/// The factor by which a bound may exceed the distance found.
const LOOSENESS: f64 = 4.0;

/// The accuracy of bounds, relative to the size of the surface, below that of any fit.
const RESOLUTION: f64 = 1e-10;

impl Gap {
    /// An upper bound.
    pub(super) fn proven(length: f64) -> Self {
        Self { length, is_measured: false }
    }

    /// The largest distance found at points.
    pub(super) fn measured(length: f64) -> Self {
        Self { length, is_measured: true }
    }

    /// The proven bound on the distance of a curve from its edge, or what is measured where no
    /// bound is found, as on offsets that are not rational.
    pub(super) fn of(lifted: &Lifted<'_>) -> Self {
        let found = lifted.gap().map_or_else(|| Self::measured(lifted.measured_by_spans()), Self::proven);
        found.plus(Self::proven(lifted.edge_error()))
    }

    /// Returns the sum with the gap of an approximation of the same curve.
    pub(super) fn plus(self, other: Self) -> Self {
        let Self { length, is_measured } = other;
        Self { length: self.length + length, is_measured: self.is_measured || is_measured }
    }

    /// The bound on a distance that was found at points, or what was found where the bound is
    /// far too large, as the metric's is where the parameters are singular.
    pub(super) fn bounded(bound: f64, found: f64, metric: &Metric) -> Self {
        let is_tight = bound <= (LOOSENESS * found).max(RESOLUTION * metric.size);
        if is_tight { Self::proven(bound) } else { Self::measured(found) }
    }
}
