//! Ascents to far points of A, which raise the incumbent.

use super::super::ascent::{ascend_across, starting_points};
use super::super::nearest::Sample;
use super::BranchAndBound;
use super::evaluation::Evaluation;
use super::incumbent::Witness;
use crate::closest::closest_above;

/// Width of a witness's certificate, relative to the tolerance.
const CERTIFICATE_PART: f64 = 1e-2;

/// The farthest samples of a chunk from which an ascent starts.
const MAX_ASCENTS: usize = 8;

impl BranchAndBound<'_> {
    /// Finds the first incumbent: the higher of an ascent from the support point
    /// and, where that ends below it, one from the middle of a patch.
    pub(super) fn find_first_incumbent(&mut self) {
        let Some([support, middle]) = starting_points(&self.pair, &self.nearest) else { return };
        let ascend = |start| ascend_across(&self.pair, &self.nearest, start, self.certificate_gap());
        let top = ascend(support);
        let is_low = middle.foot.distance_squared > top.foot.distance_squared;
        let top = if is_low { ascend(middle) } else { top };
        self.certify(top);
    }

    /// Ascents from the chunk's farthest samples while they exceed the
    /// incumbent by more than a certificate's width.
    pub(super) fn ascend_from_farthest(&mut self, evaluations: &[Option<Evaluation>]) {
        let mut samples: Vec<Sample> =
            evaluations.iter().flatten().map(|evaluation| evaluation.farthest).collect();
        for _ in 0..MAX_ASCENTS.min(samples.len()) {
            let mut farthest = 0;
            for (index, sample) in samples.iter().enumerate() {
                if sample.foot.distance_squared > samples[farthest].foot.distance_squared {
                    farthest = index;
                }
            }
            let sample = samples.swap_remove(farthest);
            if !self.ascend_from(sample) {
                return;
            }
        }
    }

    /// Certifies the local maximum above a sample if the sample is farther than
    /// the incumbent; returns whether it seemed to be.
    pub(super) fn ascend_from(&mut self, sample: Sample) -> bool {
        let bound = self.incumbent.lower_bound() + self.certificate_gap();
        if sample.foot.distance() <= bound {
            return false;
        }
        let target = self.pair.point_of_a(sample.patch, sample.parameters);
        let foot = self.nearest.nearest(target, sample.foot, bound);
        if foot.distance() > bound {
            let start = Sample { foot, ..sample };
            let top = ascend_across(&self.pair, &self.nearest, start, self.certificate_gap());
            self.certify(top);
        }
        true
    }

    /// Certifies a sample's distance, which becomes the incumbent if it is the largest.
    fn certify(&mut self, sample: Sample) {
        let point = self.pair.point_of_a(sample.patch, sample.parameters);
        let known = Some((sample.foot.patch, sample.foot.parameters));
        let floor = self.incumbent.lower_bound();
        let found = closest_above(self.pair.b.target, point, self.certificate_gap(), known, floor, None);
        if let Some(mut closest) = found {
            closest.lower = (closest.lower - self.goal.rounding).max(0.0);
            let Sample { patch, parameters, .. } = sample;
            self.incumbent.improve(Witness { patch, parameters, point, closest });
        }
    }

    fn certificate_gap(&self) -> f64 {
        CERTIFICATE_PART * self.goal.tolerance
    }
}
