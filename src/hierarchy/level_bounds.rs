//! The bounds that one level of the traversal gives.

use super::DistanceBounds;

/// The outcome of stages `bound`, `extremes` and `cull` on one level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LevelBounds {
    /// The number of pairs left after culling, counted even if they are too many to keep.
    pub(crate) pairs: u64,
    /// A lower bound on the directed distance, in model units.
    pub(crate) lower: f64,
    /// An upper bound on the directed distance, in model units.
    pub(crate) upper: f64,
}

impl LevelBounds {
    /// Makes the bounds from squared bounds in model units; a lower bound that
    /// overflowed counts as 0.
    pub(crate) fn new(pairs: u64, DistanceBounds { near, far }: DistanceBounds) -> Self {
        Self { pairs, lower: if near.is_finite() { near.sqrt() } else { 0.0 }, upper: far.sqrt() }
    }
}
