//! Stage `raise`: the farthest samples, certified, raise the lower bound.

use super::across::across;
use super::bound::Bounded;
use super::climb::climb;
use super::extreme::extreme;
use super::feet::{Foot, Sample};
use super::met::Met;
use super::nearest::{foot_on, nearest_within};
use super::search::Farthest;
use super::{Search, Side};
use crate::gather::Gather;
use crate::project::{Closest, closest_above};
use glam::DVec3;

/// Farthest samples of a chunk that are certified, at most.
const MOST_CERTIFIED: usize = 8;

/// Patches that a sample climbs on to from the first, at most.
const MOST_CROSSINGS: usize = 8;

/// Width asked of a sample's certificate, relative to the tolerance.
const CERTIFICATE_PART: f64 = 1e-2;

/// Part of what may still be gained that a step of the first point's climb is
/// to promise until that point is known to be the better start: a way along a
/// ridge that leads low is not followed to its end.
const BEGIN_PART: f64 = 2e-3;

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

    /// Certifies the chunk's farthest samples while they exceed the best by more
    /// than a certificate's width.
    pub(super) fn raise(&mut self, bounded: &[Option<Bounded>]) {
        let mut samples: Vec<&Bounded> = bounded.iter().flatten().gather();
        for _ in 0..MOST_CERTIFIED.min(samples.len()) {
            let mut farthest = (0, -1.0);
            for (index, bounded) in samples.iter().enumerate() {
                if bounded.sample.foot.distance_squared > farthest.1 {
                    farthest = (index, bounded.sample.foot.distance_squared);
                }
            }
            let Bounded { patch, sample, .. } = samples.swap_remove(farthest.0);
            if !self.climb_from(*patch, *sample) {
                return;
            }
        }
    }

    /// Certifies a sample moved to where the distance is locally largest; tells
    /// whether it seemed farther than the best.
    pub(super) fn climb_from(&mut self, patch: u32, sample: Sample) -> bool {
        let most = self.lower() + self.width();
        if sample.foot.distance() <= most {
            return false;
        }
        let sample = self.with_nearest(patch, sample, most);
        if sample.foot.distance() > most {
            self.raise_from(patch, sample);
        }
        true
    }

    /// Takes the sample, moved to where the distance is locally largest, for the
    /// farthest point if its certificate says so or there is none yet.
    fn raise_from(&mut self, patch: u32, sample: Sample) {
        let width = self.width();
        let (patch, Sample { parameters, foot }) = self.climbed(patch, sample, width);
        let known = Some((foot.patch, foot.parameters));
        let found = self.certificate(patch, parameters, width, known, self.lower());
        let is_better =
            |found: &Farthest| self.farthest.is_none_or(|best| found.closest.lower > best.closest.lower);
        self.farthest = found.filter(is_better).or(self.farthest);
    }

    /// The sample moved to where the distance is locally largest, over the edges
    /// of its patch too, as long as it gains more than `least`.
    fn climbed(&self, patch: u32, sample: Sample, least: f64) -> (u32, Sample) {
        let mut met = Met::new();
        let mut climb =
            |patch, sample| climb(&self.a, &self.b, &self.transform, patch, sample, least, &mut met);
        let mut best = (patch, climb(patch, sample));
        let mut seen = vec![patch];
        for _ in 0..MOST_CROSSINGS {
            let before = best;
            for (patch, parameters) in across(&self.a, before.0, before.1.parameters) {
                if seen.contains(&patch) {
                    continue;
                }
                seen.push(patch);
                let further = climb(patch, Sample { parameters, ..before.1 });
                if further.foot.distance() > best.1.foot.distance() + least {
                    best = (patch, further);
                    break;
                }
            }
            if best.0 == before.0 {
                break;
            }
        }
        best
    }

    /// The sample with the nearest foot, or one at most `enough` away.
    fn with_nearest(&self, patch: u32, sample: Sample, enough: f64) -> Sample {
        let point = self.transform.apply(self.a.patch(patch).point(sample.parameters));
        Sample { foot: nearest_within(&self.b, point, sample.foot, enough), ..sample }
    }

    /// Begins with the point that goes farthest away from B, from its centre to
    /// A's: a witness also where the boxes alone answer, and the farthest point
    /// of a moved copy. It climbs for as long as it gains a part of what is left
    /// to be gained; then the middle of the first patch may be the better start.
    pub(super) fn begin(&mut self) {
        let roots = [&self.a, &self.b].map(|side| side.target.tree.nodes().first());
        let [Some(of_a), Some(of_b)] = roots else { return };
        let [from, to] = [of_a.aabb.center(), of_b.aabb.center()];
        let away = self.transform.inverse().rotate(self.transform.apply(from) - to);
        let start = |(patch, parameters)| {
            let start = Sample { parameters, foot: Foot::start(0, [0.5; 2]) };
            (patch, self.with_nearest(patch, start, 0.0))
        };
        let middle = start((self.a.target.tree.item(of_a), [0.5; 2]));
        let (patch, sample) = start(extreme(&self.a, away).unwrap_or((0, [0.5; 2])));
        let left = self.interval().upper - sample.foot.distance();
        let climbed = self.climbed(patch, sample, self.width().max(BEGIN_PART * left));
        let is_better = middle.1.foot.distance_squared > climbed.1.foot.distance_squared;
        let [first, second] = if is_better { [middle, climbed] } else { [climbed, middle] };
        self.raise_from(first.0, first.1);
        self.climb_from(second.0, second.1);
    }

    /// Width asked of a sample's certificate.
    fn width(&self) -> f64 {
        CERTIFICATE_PART * self.tolerance
    }

    /// Raises the upper bound to what is told of the farthest point.
    pub(crate) fn finish(&mut self) {
        if let Some(best) = &self.farthest {
            self.dropped = self.dropped.max(best.closest.upper - self.rounding);
        }
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
