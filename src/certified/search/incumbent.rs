//! The incumbent: the farthest point of A known so far, certified.

use crate::closest::Closest;
use glam::DVec3;

/// A point of A with its certified closest point on B.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Witness {
    pub(crate) patch: u32,
    pub(crate) parameters: [f64; 2],
    /// The moved point.
    pub(crate) point: DVec3,
    pub(crate) closest: Closest,
}

/// The best witness, and the upper bounds of what was pruned on its account.
#[derive(Debug, Default)]
pub(super) struct Incumbent {
    witness: Option<Witness>,
    pruned_upper_bound: f64,
}

impl Incumbent {
    /// A lower bound on the directed distance: that of the witness.
    pub(super) fn lower_bound(&self) -> f64 {
        self.witness.map_or(0.0, |witness| witness.closest.lower)
    }

    pub(super) fn witness(&self) -> Option<&Witness> {
        self.witness.as_ref()
    }

    /// The largest upper bound of all that was pruned.
    pub(super) fn pruned_upper_bound(&self) -> f64 {
        self.pruned_upper_bound
    }

    /// Takes the witness if its lower bound is the largest.
    pub(super) fn improve(&mut self, witness: Witness) {
        if self.witness.is_none() || witness.closest.lower > self.lower_bound() {
            self.witness = Some(witness);
        }
    }

    /// Takes account of a part of A that will not be searched further; NaN
    /// counts as +∞.
    pub(super) fn prune(&mut self, upper_bound: f64) {
        let bound = if upper_bound.is_nan() { f64::INFINITY } else { upper_bound };
        self.pruned_upper_bound = self.pruned_upper_bound.max(bound);
    }
}
