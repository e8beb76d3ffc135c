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

    /// Forgets what was pruned; the witness stays, as its distance is certified.
    pub(super) fn forget_pruned(&mut self) {
        self.pruned_upper_bound = 0.0;
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

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn witness(lower: f64) -> Witness {
        let closest = Closest { patch: 0, parameters: [0.5; 2], point: DVec3::ZERO, upper: lower, lower };
        Witness { patch: 0, parameters: [0.5; 2], point: DVec3::ZERO, closest }
    }

    #[test]
    fn the_farthest_witness_is_kept() {
        let mut incumbent = Incumbent::default();
        assert_eq!((incumbent.witness(), incumbent.lower_bound()), (None, 0.0));
        for (lower, kept) in [(0.0, 0.0), (2.0, 2.0), (1.0, 2.0), (f64::NAN, 2.0), (3.0, 3.0)] {
            incumbent.improve(witness(lower));
            assert_eq!(incumbent.lower_bound(), kept);
        }
    }

    #[test]
    fn the_largest_pruned_bound_is_kept() {
        let mut incumbent = Incumbent::default();
        for (bound, largest) in
            [(0.0, 0.0), (2.0, 2.0), (1.0, 2.0), (f64::NAN, f64::INFINITY), (3.0, f64::INFINITY)]
        {
            incumbent.prune(bound);
            assert_eq!(incumbent.pruned_upper_bound(), largest);
        }
    }
}
