//! Stage `raise`: the farthest samples raise the lower bound.

use super::across::across;
use super::bound::Bounded;
use super::climb::climb;
use super::extreme::extreme;
use super::feet::{Foot, Sample};
use super::met::Met;
use super::nearest::{foot_on, nearest_within};
use super::{BranchAndBound, Operand};
use crate::closest::closest_above;
use glam::DVec3;

/// Farthest samples of a chunk that are climbed from, at most.
const MAX_CLIMBED: usize = 8;

/// Patches that a sample climbs on to from the first, at most.
const MAX_CROSSINGS: usize = 8;

/// Width asked of a sample's certificate, relative to the tolerance.
const CERTIFICATE_PART: f64 = 1e-2;

/// Part of what may still be gained that a step of the first point's climb is
/// to promise until that point is known to be the better start: a way along a
/// ridge that leads low is not followed to its end.
const BEGIN_PART: f64 = 2e-3;

/// Width asked, relative to the tolerance, where the nearest foot is looked
/// for, which is doubted from half the tolerance on.
const FOOT_PART: f64 = 0.25;

impl BranchAndBound<'_> {
    /// The nearest foot by the search that certifies, unless the known one is nearer.
    pub(super) fn surest(&self, point: DVec3, known: Foot) -> Foot {
        let start = Some((known.patch, known.parameters));
        let Operand { target, candidates, .. } = &self.b;
        match closest_above(target, point, FOOT_PART * self.tolerance, start, 0.0, candidates.as_ref()) {
            Some(found) if found.upper * found.upper < known.distance_squared => {
                foot_on(&self.b, point, found.patch as u32, found.parameters)
            }
            _ => known,
        }
    }

    /// Climbs from the chunk's farthest samples while they exceed the best by more
    /// than a certificate's width.
    pub(super) fn raise(&mut self, bounded: &[Option<Bounded>]) {
        let mut samples: Vec<&Bounded> = bounded.iter().flatten().collect();
        for _ in 0..MAX_CLIMBED.min(samples.len()) {
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

    /// Offers a sample moved to where the distance is locally largest; tells
    /// whether it seemed farther than the best.
    pub(super) fn climb_from(&mut self, patch: u32, sample: Sample) -> bool {
        let most = self.believed() + self.width();
        if sample.foot.distance() <= most {
            return false;
        }
        let sample = self.with_nearest(patch, sample, most);
        if sample.foot.distance() > most {
            self.raise_from(patch, sample);
        }
        true
    }

    /// Offers the sample, moved to where the distance is locally largest.
    fn raise_from(&mut self, patch: u32, sample: Sample) {
        let (patch, sample) = self.climbed(patch, sample, self.width());
        self.offer(patch, sample);
    }

    /// The sample moved to where the distance is locally largest, over the edges
    /// of its patch too, as long as it gains more than `least`.
    fn climbed(&self, patch: u32, sample: Sample, least: f64) -> (u32, Sample) {
        let mut met = Met::new();
        let mut climb =
            |patch, sample| climb(&self.a, &self.b, &self.transform, patch, sample, least, &mut met);
        let mut best = (patch, climb(patch, sample));
        let mut seen = vec![patch];
        for _ in 0..MAX_CROSSINGS {
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

    /// The sample with the nearest foot, or one at most `prune_threshold` away.
    fn with_nearest(&self, patch: u32, sample: Sample, prune_threshold: f64) -> Sample {
        let point = self.transform.apply(self.a.patch(patch).point(sample.parameters));
        Sample { foot: nearest_within(&self.b, point, sample.foot, prune_threshold), ..sample }
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
        let middle = start((self.a.target.tree.primitive(of_a), [0.5; 2]));
        let (patch, sample) = start(extreme(&self.a, away).unwrap_or((0, [0.5; 2])));
        let left = self.interval().upper - sample.foot.distance();
        let climbed = self.climbed(patch, sample, self.width().max(BEGIN_PART * left));
        let is_better = middle.1.foot.distance_squared > climbed.1.foot.distance_squared;
        let [first, second] = if is_better { [middle, climbed] } else { [climbed, middle] };
        self.raise_from(first.0, first.1);
        self.climb_from(second.0, second.1);
    }

    /// Width asked of a sample's certificate.
    pub(super) fn width(&self) -> f64 {
        CERTIFICATE_PART * self.tolerance
    }

    /// Certifies the farthest point and raises the upper bound to what is told of it.
    pub(crate) fn finish(&mut self) {
        self.prove();
        if let Some(best) = &self.farthest {
            self.dropped = self.dropped.max(best.closest.upper - self.rounding);
        }
    }
}
