//! Two directed results into the symmetric one.

use super::{Bounds, CertifiedDetails, DistanceResult, HierarchyDetails, IterationDetails, Stop};

impl DistanceResult {
    /// The larger of two directed results, both kept: the symmetric distance
    /// is their maximum, so its interval is that of the maxima.
    pub(super) fn symmetric(forward: Self, reverse: Self) -> Self {
        let larger = if reverse.computed > forward.computed { &reverse } else { &forward };
        let &Self { method, backend, diagonal, computed, witness, patches, .. } = larger;
        let (adapter, notice) = (larger.adapter.clone(), larger.notice.clone());
        let mut seconds = forward.seconds;
        seconds += reverse.seconds;
        Self {
            method,
            backend,
            adapter,
            diagonal,
            computed,
            lower: forward.lower.max(reverse.lower),
            upper: forward.upper.max(reverse.upper),
            converged: forward.converged && reverse.converged,
            witness,
            iteration: forward.iteration.zip(reverse.iteration).map(IterationDetails::combined),
            certified: forward.certified.zip(reverse.certified).map(CertifiedDetails::combined),
            hierarchy: forward
                .hierarchy
                .as_ref()
                .zip(reverse.hierarchy.as_ref())
                .map(HierarchyDetails::combined),
            patches,
            seconds,
            notice,
            statistics: None,
            field: Vec::new(),
            forward: Some(Box::new(forward)),
            reverse: Some(Box::new(reverse)),
        }
    }
}

impl IterationDetails {
    fn combined((forward, reverse): (Self, Self)) -> Self {
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
    /// The trees are the same two, so both directions have as many levels.
    fn combined((forward, reverse): (&Self, &Self)) -> Self {
        let pairs = forward.pairs.iter().zip(&reverse.pairs).map(|(forward, reverse)| forward + reverse);
        Self { pairs: pairs.collect(), ..forward.clone() }
    }
}

impl CertifiedDetails {
    fn combined((forward, reverse): (Self, Self)) -> Self {
        Self {
            tolerance: forward.tolerance,
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
        }
    }
}
