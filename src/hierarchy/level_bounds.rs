//! What one level of the descent bounds.

use super::Distances;

/// What one level's descent found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LevelBounds {
    /// Pairs left after culling, also where they are too many to keep.
    pub(crate) pairs: u64,
    /// At most the distance, in model units.
    pub(crate) lower: f64,
    /// At least the distance.
    pub(crate) upper: f64,
}

impl LevelBounds {
    /// Of squared bounds in model units; what is beyond float64 bounds nothing from below.
    pub(crate) fn new(pairs: u64, Distances { near, far }: Distances) -> Self {
        Self { pairs, lower: if near.is_finite() { near.sqrt() } else { 0.0 }, upper: far.sqrt() }
    }
}
