//! The symmetric result of two directed ones.

use crate::engine::{
    Bounds, CertifiedDetails, Details, DistanceResult, HierarchyDetails, IterationDetails, Stop,
};

impl DistanceResult {
    /// The larger of two directed results, both kept: the symmetric distance
    /// is their maximum, so its interval is that of the maxima.
    pub(in crate::engine) fn symmetric(forward: Self, reverse: Self) -> Self {
        let larger = if reverse.computed > forward.computed { &reverse } else { &forward };
        let &Self { backend, diagonal, unit, gap, gap_proven, computed, patches, .. } = larger;
        let witness = larger.witness.clone();
        let (adapter, notice) = (larger.adapter.clone(), larger.notice.clone());
        let mut seconds = forward.seconds;
        seconds += reverse.seconds;
        Self {
            details: forward.details.combined(&reverse.details),
            backend,
            adapter,
            diagonal,
            unit,
            hint: None,
            gap,
            gap_proven,
            with_gaps: forward.with_gaps.of_both(&reverse.with_gaps),
            computed,
            lower: forward.lower.max(reverse.lower),
            upper: forward.upper.max(reverse.upper),
            converged: forward.converged && reverse.converged,
            witness,
            patches,
            seconds,
            notice,
            statistics: None,
            deviations: Vec::new(),
            forward: Some(Box::new(forward)),
            reverse: Some(Box::new(reverse)),
        }
    }
}

impl Details {
    /// The details of both directions, which are of one method.
    fn combined(&self, reverse: &Self) -> Self {
        match (self, reverse) {
            (Self::Certified(forward), Self::Certified(reverse)) => {
                Self::Certified(forward.combined(reverse))
            }
            (Self::Iteration(forward), Self::Iteration(reverse)) => {
                Self::Iteration(forward.combined(reverse))
            }
            (Self::Hierarchy(forward), Self::Hierarchy(reverse)) => {
                Self::Hierarchy(forward.combined(reverse))
            }
            // One call measures both directions by the method of its options.
            _ => self.clone(),
        }
    }
}

impl IterationDetails {
    fn combined(&self, reverse: &Self) -> Self {
        let forward = self;
        let mut statuses = forward.statuses;
        statuses += reverse.statuses;
        Self {
            bounds: Bounds {
                k_a: forward.bounds.k_a.max(reverse.bounds.k_a),
                k_a_rigorous: forward.bounds.k_a_rigorous.max(reverse.bounds.k_a_rigorous),
                k_b: forward
                    .bounds
                    .k_b
                    .zip(reverse.bounds.k_b)
                    .map(|(forward, reverse)| forward.max(reverse)),
            },
            samples: forward.samples + reverse.samples,
            statuses,
        }
    }
}

impl HierarchyDetails {
    /// The two trees are the same in both directions, and so is the number of levels.
    fn combined(&self, reverse: &Self) -> Self {
        let pairs = self.pairs.iter().zip(&reverse.pairs).map(|(forward, reverse)| forward + reverse);
        Self { pairs: pairs.collect(), ..*self }
    }
}

impl CertifiedDetails {
    fn combined(&self, reverse: &Self) -> Self {
        let forward = self;
        Self {
            tolerance: forward.tolerance,
            min_tolerance: forward.min_tolerance.max(reverse.min_tolerance),
            cells: forward.cells + reverse.cells,
            cpu_cells: forward.cpu_cells + reverse.cpu_cells,
            levels: forward.levels.max(reverse.levels),
            stop: if forward.stop == Stop::Converged { reverse.stop } else { forward.stop },
            // One direction beyond the limit decides; both within it do.
            within: match (forward.within, reverse.within) {
                (Some(false), _) | (_, Some(false)) => Some(false),
                (Some(true), Some(true)) => Some(true),
                _ => None,
            },
            audit: forward.audit.combined(&reverse.audit),
        }
    }
}
