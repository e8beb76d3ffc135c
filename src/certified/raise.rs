//! Stage `raise`: the farthest samples, certified, raise the lower bound.

use super::climb::climb;
use super::corners::Sample;
use super::nearest::{Foot, foot_on};
use super::search::{Bounded, Farthest, Interval};
use super::{Search, Side};
use crate::gather::Gather;
use crate::order::by_falling;
use crate::project::{Closest, closest_above};
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
        let start = Some((known.patch, known.parameters));
        match self.closest(point, FOOT_PART * self.tolerance, start, 0.0) {
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
        for bounded in samples.into_iter().take(MOST_CERTIFIED) {
            if !self.raise_to(bounded.patch, bounded.sample, upper) {
                return;
            }
        }
    }

    /// Certifies a sample, moved to where the distance is locally largest or as
    /// it is, while the distance may be `upper`; tells whether it exceeds the
    /// best by more than a certificate's width.
    pub(super) fn raise_to(&mut self, patch: u32, sample: Sample, upper: f64) -> bool {
        let Sample { parameters, foot } = sample;
        let width = self.certificate_width(upper);
        if foot.distance_squared.sqrt() <= self.lower() + width {
            return false;
        }
        let climbed = climb(&self.a, &self.b, &self.transform, patch, parameters, foot);
        for (parameters, foot) in [climbed, (parameters, foot)] {
            if self.certify_sample(patch, parameters, &foot, width) {
                break;
            }
        }
        true
    }

    /// Takes the point for the farthest if its certificate says so.
    fn certify_sample(&mut self, patch: u32, parameters: [f64; 2], foot: &Foot, width: f64) -> bool {
        let start = Some((foot.patch, foot.parameters));
        let found = self.certificate(patch, parameters, width, start, self.lower());
        let best = self.farthest;
        let better = found.filter(|found| best.is_none_or(|best| found.closest.lower > best.closest.lower));
        self.farthest = better.or(best);
        better.is_some()
    }

    /// Takes some point for the farthest: a witness also where the models'
    /// boxes alone answer.
    pub(super) fn begin(&mut self, upper: f64) {
        if !self.a.target.patches.is_empty() {
            self.farthest = self.certificate(0, [0.5; 2], self.certificate_width(upper), None, 0.0);
        }
    }

    /// Certifies the farthest point as narrowly as the last ones are, if it was
    /// found while less was asked or told to be beyond the upper bound; what is
    /// still told to be beyond it raises it.
    pub(crate) fn finish(&mut self) {
        let Some(mut best) = self.farthest else { return };
        let Interval { lower, upper } = self.interval();
        let mut width = LAST_PART * self.tolerance;
        let is_beyond = best.closest.upper > upper;
        if is_beyond {
            width = width.min(0.5 * (upper - lower));
        }
        let start = Some((best.closest.patch as u32, best.closest.parameters));
        if (is_beyond || best.closest.upper - best.closest.lower > width + self.rounding)
            && let Some(mut found) = self.certificate(best.patch, best.parameters, width, start, 0.0)
        {
            found.closest.lower = found.closest.lower.max(best.closest.lower);
            best = found;
        }
        self.dropped = self.dropped.max(best.closest.upper - self.rounding);
        self.farthest = Some(best);
    }

    /// The width asked of a certificate while the distance may be `upper`.
    fn certificate_width(&self, upper: f64) -> f64 {
        (CERTIFICATE_PART * (upper - self.lower())).max(LAST_PART * self.tolerance)
    }

    /// A point of A with its distance to B, as narrow as `width` if that can be
    /// told and it exceeds `floor`, from a point of B where one is known.
    fn certificate(
        &self,
        patch: u32,
        parameters: [f64; 2],
        width: f64,
        known: Option<(u32, [f64; 2])>,
        floor: f64,
    ) -> Option<Farthest> {
        let point = self.transform.apply(self.a.patch(patch).point(parameters));
        let mut closest = self.closest(point, width, known, floor)?;
        closest.lower = (closest.lower - self.rounding).max(0.0);
        Some(Farthest { patch, parameters, point, closest })
    }

    /// The closest point of B, by the list of patches where that suffices.
    fn closest(&self, point: DVec3, gap: f64, known: Option<(u32, [f64; 2])>, floor: f64) -> Option<Closest> {
        let Side { target, candidates, .. } = &self.b;
        closest_above(&target.patches, &target.tree, point, gap, known, floor, candidates.as_ref())
    }
}
