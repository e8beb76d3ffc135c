//! Stage `raise`: the farthest samples, certified, raise the lower bound.

use super::Search;
use super::climb::climb;
use super::corners::Sample;
use super::nearest::{Foot, foot_on};
use super::search::{Bounded, Farthest};
use crate::gather::Gather;
use crate::order::by_falling;
use crate::project::closest;
use glam::DVec3;

/// Farthest samples of a chunk that are certified, at most.
const MOST_CERTIFIED: usize = 8;

/// Width asked of a sample's certificate, relative to the interval's.
const CERTIFICATE_PART: f64 = 1e-3;

/// Least width asked of one, relative to the tolerance.
const LAST_PART: f64 = 1e-2;

/// Width asked, relative to the tolerance, where the nearest foot is looked
/// for, which is doubted from half the tolerance on.
const FOOT_PART: f64 = 0.25;

impl Search<'_> {
    /// The nearest foot by the search that certifies, unless the known one is nearer.
    pub(super) fn surest(&self, point: DVec3, known: Foot) -> Foot {
        let target = self.b.target;
        match closest(&target.patches, &target.tree, point, FOOT_PART * self.tolerance) {
            Some(found) if found.upper * found.upper < known.distance_squared => {
                foot_on(&self.b, point, found.patch as u32, found.parameters)
            }
            _ => known,
        }
    }

    /// Certifies the chunk's farthest samples while they exceed the best by
    /// more than a certificate's width.
    pub(super) fn raise(&mut self, bounded: &[Option<Bounded>]) {
        let samples: Vec<&Bounded> = bounded.iter().flatten().gather();
        let upper = samples.iter().fold(0.0_f64, |upper, bounded| upper.max(bounded.upper));
        let samples = by_falling(&samples, |bounded| bounded.sample.foot.distance_squared);
        for sample in samples.into_iter().take(MOST_CERTIFIED) {
            let Sample { parameters, foot } = sample.sample;
            if foot.distance_squared.sqrt() <= self.lower() + self.certificate_width(upper) {
                return;
            }
            let climbed = climb(&self.a, &self.b, &self.transform, sample.patch, parameters, foot);
            for parameters in [climbed, parameters] {
                if self.certify_sample(sample.patch, parameters, upper) {
                    break;
                }
            }
        }
    }

    /// Certifies the farthest point as narrowly as the last ones are, if it was
    /// found while less was asked.
    pub(crate) fn finish(&mut self) {
        let Some(best) = self.farthest else { return };
        if best.closest.upper - best.closest.lower > self.certificate_width(0.0) + self.rounding {
            self.farthest = None;
            self.certify_sample(best.patch, best.parameters, 0.0);
            let found = self.farthest.get_or_insert(best);
            found.closest.lower = found.closest.lower.max(best.closest.lower);
        }
    }

    /// The width asked of a certificate while the distance may be `upper`.
    fn certificate_width(&self, upper: f64) -> f64 {
        (CERTIFICATE_PART * (upper - self.lower())).max(LAST_PART * self.tolerance)
    }

    /// Takes the point for the farthest if its certificate says so.
    pub(super) fn certify_sample(&mut self, patch: u32, parameters: [f64; 2], upper: f64) -> bool {
        let point = self.transform.apply(self.a.patch(patch).point(parameters));
        let target = self.b.target;
        let gap = self.certificate_width(upper);
        let Some(mut closest) = closest(&target.patches, &target.tree, point, gap) else { return false };
        closest.lower = (closest.lower - self.rounding).max(0.0);
        let better = self.farthest.is_none_or(|best| closest.lower > best.closest.lower);
        if better {
            self.farthest = Some(Farthest { patch, parameters, point, closest });
        }
        better
    }
}
