//! Stage `raise`: the farthest samples, certified, raise the lower bound.

use super::bound::{Bounded, Kind};
use super::climb::climb;
use super::feet::{Foot, Sample};
use super::nearest::{foot_on, nearest_within};
use super::search::{Farthest, Interval};
use super::{Search, Side};
use crate::gather::Gather;
use crate::project::{Closest, closest_above};
use glam::DVec3;

/// Farthest samples of a chunk that are certified, at most.
const MOST_CERTIFIED: usize = 8;

/// Width asked of a sample's certificate, relative to the interval's.
const CERTIFICATE_PART: f64 = 3e-2;

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

    /// Certifies the chunk's farthest samples that exceed the best by more than
    /// a certificate's width.
    ///
    /// From the middles of patches it climbs in any case: the farthest point is
    /// seldom on the patch whose middle is farthest, and knowing it before cells
    /// are bounded spares most of them.
    pub(super) fn raise(&mut self, bounded: &[Option<Bounded>]) {
        let mut samples: Vec<&Bounded> = bounded.iter().flatten().gather();
        let upper = samples.iter().fold(0.0_f64, |upper, bounded| upper.max(bounded.upper));
        for _ in 0..MOST_CERTIFIED.min(samples.len()) {
            let mut farthest = (0, -1.0);
            for (index, bounded) in samples.iter().enumerate() {
                if bounded.sample.foot.distance_squared > farthest.1 {
                    farthest = (index, bounded.sample.foot.distance_squared);
                }
            }
            let Bounded { patch, sample, kind, upper: most, .. } = samples.swap_remove(farthest.0);
            let is_farther = match kind {
                Kind::Node => self.raise_to(*patch, *sample, self.certificate_width(upper)),
                Kind::Patch if *most > self.enough() => self.climb_from(*patch, *sample, 0.0),
                Kind::Patch | Kind::Cell => self.climb_from(*patch, *sample, self.lower()),
            };
            if !is_farther {
                return;
            }
        }
    }

    /// Certifies a sample moved to where the distance is locally largest, if it
    /// is farther than `floor`; tells whether it seemed so.
    pub(super) fn climb_from(&mut self, patch: u32, sample: Sample, floor: f64) -> bool {
        let width = LAST_PART * self.tolerance;
        if sample.foot.distance() <= floor + width {
            return false;
        }
        let sample = self.with_nearest(patch, sample, floor + width);
        if sample.foot.distance() > floor + width {
            let climbed = climb(&self.a, &self.b, &self.transform, patch, sample, width);
            self.raise_to(patch, climbed, width);
        }
        true
    }

    /// Takes a sample for the farthest point if its certificate says so; tells
    /// whether it seemed farther by more than the certificate's width.
    fn raise_to(&mut self, patch: u32, sample: Sample, width: f64) -> bool {
        let most = self.lower() + width;
        if sample.foot.distance() <= most {
            return false;
        }
        let Sample { parameters, foot } = self.with_nearest(patch, sample, most);
        if foot.distance() > most {
            let start = Some((foot.patch, foot.parameters));
            let found = self.certificate(patch, parameters, width, start, self.lower());
            let is_better = |found: &Farthest| found.closest.lower > self.lower();
            self.farthest = found.filter(is_better).or(self.farthest);
        }
        true
    }

    /// The sample with the nearest foot, or one at most `enough` away.
    fn with_nearest(&self, patch: u32, sample: Sample, enough: f64) -> Sample {
        let point = self.transform.apply(self.a.patch(patch).point(sample.parameters));
        Sample { foot: nearest_within(&self.b, point, sample.foot, enough), ..sample }
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
        closest_above(target, point, gap, known, floor, candidates.as_ref())
    }
}
