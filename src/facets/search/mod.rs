//! Branch and bound over the facets or patches of A, measured to the facets of B.
//!
//! The theorem is that of method `certified` (docs/method.md, section 2); the bounds are those of
//! docs/meshes.md. Any choice of nearest facets and of cuts is valid: it decides only the number of
//! nodes.

#[cfg(any(test, feature = "internals"))]
mod audit;
mod cover;
mod explore;
mod node;
mod part;
mod patch_cell;
mod sampled;
mod slab;
mod source;
mod spread;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod step_tests;

#[cfg(any(test, feature = "internals"))]
pub use audit::{Audit, audit_facet_searches};
pub(crate) use node::Domain;
pub(crate) use source::{Certified, Measured, Source, Start};
pub(crate) use spread::{PartOf, Parts, Spread, Weighted, WeightedPart};

use super::Facet;
use super::rounding::{cut_rounding, facet_rounding};
use crate::interval::{Interval, Limit};
use crate::model::RigidTransform;
use crate::rounding::{UNIT_ROUNDOFF, gamma, upper_max};
use crate::sorting::sort_by_number;
use crate::threads::parallel::{map_items, map_short, ranges};
use glam::DVec3;
use node::{Node, Region, Sample};
use part::MAX_LEVELS;
use patch_cell::PatchCell;
use std::collections::BinaryHeap;
use web_time::Instant;

/// The nodes of the frontier that are bounded between two updates of the incumbent.
const CHUNK: usize = 256;

/// The farthest samples of a chunk that are certified.
const MAX_CERTIFIED: usize = 8;

/// The number of points of A that are measured before the search, for a first incumbent.
const FIRST_SAMPLES: usize = 512;

/// Width of a witness's certificate, relative to the tolerance.
const CERTIFICATE_PART: f64 = 1e-2;

/// Part of the tolerance that rounding may take, as in method `certified`.
const MAX_ROUNDING_PART: f64 = 0.5;

/// Roundings of a finished bound, relative to it, as in method `certified`.
const BOUND_ROUNDINGS: f64 = 16.0;

/// Roundings of the centre of a box and of its half diagonal, relative to the largest length
/// (lemma F7 of docs/meshes.md).
const BOX_ROUNDINGS: f64 = 8.0;

/// The condition that ends a search, and the rounding of its bounds.
#[derive(Debug, Clone, Copy)]
struct Goal {
    /// The width that upper and lower bounds may differ by.
    tolerance: f64,
    /// A limit on the distance that is to be decided, instead of a width, with the gaps of both models.
    limit: Option<Limit>,
    /// The largest length of a point of either model.
    length: f64,
    /// The rounding of points of both models, which either end of the interval is moved by.
    points: f64,
    /// The rounding of upper bounds besides.
    bounds: f64,
    /// The part of an interval's width that rounding takes.
    lost: f64,
}

/// The farthest point of A that is certified.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Witness {
    /// The point of A, moved.
    pub(crate) point: DVec3,
    pub(crate) domain: Domain,
    pub(crate) closest: Certified,
}

/// Counters of the work done.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Work {
    /// Nodes bounded.
    pub(crate) cells: usize,
    /// The depth of the deepest node.
    pub(crate) levels: u32,
}

/// Why a search ended by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum End {
    /// Nothing is left to bound, or the limit is decided.
    Searched,
    /// Parts were left that are too small for float64.
    Exhausted,
}

/// A branch and bound for the directed distance from A, moved, to B.
///
/// Supported are facets or patches as A with facets as B, and points as A with patches as B.
pub(crate) struct FacetSearch<'a> {
    a: Source<'a>,
    b: Measured<'a>,
    transform: RigidTransform,
    goal: Goal,
    frontier: BinaryHeap<Node>,
    decided: f64,
    witness: Option<Witness>,
    exhausted: bool,
    work: Work,
    deadline: Option<Instant>,
    #[cfg(any(test, feature = "internals"))]
    audit: Option<std::sync::Arc<Audit>>,
}

impl<'a> FacetSearch<'a> {
    /// Starts a search for an interval of width `tolerance`, or with a `limit` until the distance is
    /// known to exceed it or not.
    pub(crate) fn new(
        a: Source<'a>,
        b: Measured<'a>,
        transform: RigidTransform,
        tolerance: f64,
        limit: Option<Limit>,
    ) -> Self {
        let goal = Goal::new(&a, &b, &transform, tolerance, limit);
        let mut search = Self {
            a,
            b,
            transform,
            goal,
            frontier: BinaryHeap::new(),
            decided: 0.0,
            witness: None,
            exhausted: false,
            work: Work::default(),
            deadline: None,
            #[cfg(any(test, feature = "internals"))]
            audit: audit::of_all(),
        };
        search.find_first_incumbent();
        let upper = search.bound_of_box();
        let root = |region| Node { upper, region, start: Start::default(), level: 0 };
        match a {
            Source::Facets { facets, .. } if facets.len() > 0 => search.frontier.push(root(Region::Node(0))),
            Source::Facets { .. } => {}
            Source::Patches { patches, .. } => {
                let cell = |index| root(Region::Cell(PatchCell::whole(index as u32)));
                search.frontier.extend((0..patches.len()).map(cell));
            }
        }
        search
    }

    /// Bounds no node after this time: those that are left keep their bounds, and the interval holds.
    pub(crate) fn stop_at(&mut self, deadline: Instant) {
        self.deadline = Some(deadline);
    }

    /// Whether that moment has come.
    pub(crate) fn is_late(&self) -> bool {
        self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// Returns an upper bound on the distance of all of A, by its box (lemma F7 of docs/meshes.md): a
    /// search that ends at once has a finite interval.
    fn bound_of_box(&self) -> f64 {
        let aabb = self.a.bounding_box();
        let center = self.transform.apply(0.5 * (aabb.min + aabb.max));
        let (distance, _) = self.b.nearest(center, Start::default(), self.gap(), 0.0);
        distance + 0.5 * (aabb.max - aabb.min).length()
    }

    /// The interval so far.
    pub(crate) fn interval(&self) -> [f64; 2] {
        let waiting = self.frontier.peek().map_or(0.0, |node| node.upper);
        let certified = self.witness.map_or(0.0, |witness| witness.closest.upper);
        let upper = [waiting, certified].into_iter().fold(self.decided, upper_max);
        [self.lower_bound(), self.goal.rounded_up(upper)]
    }

    /// The least width that an interval can be requested to have, given the rounding of these
    /// coordinates.
    pub(crate) fn min_tolerance(&self) -> f64 {
        self.goal.lost / MAX_ROUNDING_PART
    }

    pub(crate) fn witness(&self) -> Option<&Witness> {
        self.witness.as_ref()
    }

    /// Returns the weights of the corners of a facet of A at a point that was moved with it.
    pub(crate) fn weights(&self, facet: Facet, point: DVec3) -> [f64; 3] {
        facet.nearest(self.transform.apply_inverse(point)).weights
    }

    pub(crate) fn work(&self) -> Work {
        self.work
    }

    /// Whether the distance is at most the limit, once that is known.
    pub(crate) fn within(&self) -> Option<bool> {
        let [lower, upper] = self.interval();
        self.goal.limit?.keeps(Interval { lower, upper })
    }

    /// Bounds a chunk of nodes, about `max_cells` at most; `Some` when nothing is left to do.
    pub(crate) fn advance(&mut self, max_cells: usize) -> Option<End> {
        let lower = self.lower_bound();
        let is_above = self.goal.limit.is_some_and(|limit| limit.next_level(lower).is_none());
        let threshold = self.threshold();
        while self.frontier.peek().is_some_and(|node| node.upper <= threshold) {
            self.decided =
                self.frontier.pop().map_or(self.decided, |node| upper_max(self.decided, node.upper));
        }
        if is_above || self.frontier.is_empty() {
            return Some(if self.exhausted { End::Exhausted } else { End::Searched });
        }
        let count = CHUNK.min(max_cells).min(self.frontier.len());
        let nodes: Vec<Node> = (0..count).filter_map(|_| self.frontier.pop()).collect();
        let explored = map_short(nodes.len(), |index| self.explore(nodes[index], threshold));
        let mut samples = Vec::new();
        for explored in explored {
            self.decided = upper_max(self.decided, explored.decided);
            self.exhausted |= explored.exhausted;
            self.work.cells += explored.cells;
            self.work.levels = self.work.levels.max(explored.levels);
            self.frontier.extend(explored.waiting);
            samples.extend(explored.farthest);
        }
        self.certify(samples);
        None
    }

    /// The largest certified lower bound.
    fn lower_bound(&self) -> f64 {
        let lower = self.witness.map_or(0.0, |witness| witness.closest.lower - self.goal.points);
        if lower > 0.0 { lower } else { 0.0 }
    }

    /// A node whose upper bound is at most this is not searched further.
    fn threshold(&self) -> f64 {
        let lower = self.lower_bound();
        let within = lower + self.goal.tolerance;
        let level = self.goal.limit.and_then(|limit| limit.next_level(lower));
        let limit = level.map_or(f64::NEG_INFINITY, |level| self.goal.before_rounding_up(level));
        if limit > within { limit } else { within }
    }

    /// The excess that the distance of a nearest point may have.
    fn gap(&self) -> f64 {
        CERTIFICATE_PART * self.goal.tolerance
    }

    /// Certifies the farthest samples while they seem to raise the lower bound.
    fn certify(&mut self, mut samples: Vec<Sample>) {
        sort_by_number(&mut samples, |sample| -sample.distance);
        for sample in samples.into_iter().take(MAX_CERTIFIED) {
            if !(sample.distance > self.lower_bound() + self.gap()) {
                return;
            }
            let Sample { point, domain, start, moved, .. } = sample;
            let Some(mut closest) = self.b.certified(point, start, self.gap(), self.goal.length) else {
                return;
            };
            let lower = closest.lower - moved;
            closest.lower = if lower > 0.0 { lower } else { 0.0 };
            if self.witness.is_none_or(|witness| closest.lower > witness.closest.lower) {
                self.witness = Some(Witness { point, domain, closest });
            }
        }
    }

    /// Returns a point of a facet or patch of A with its distance.
    fn sample(&self, place: u32, start: Start) -> Sample {
        let (point, domain) = match self.a {
            Source::Facets { facets, .. } => {
                (facets.facet(place).point([1.0, 0.0, 0.0]), Domain::Facet(place))
            }
            Source::Patches { patches, .. } => {
                let middle = [0.5; 2];
                (patches.patch(place as usize).point(middle), Domain::Patch(place, middle))
            }
        };
        let point = self.transform.apply(point);
        let (distance, start) = self.b.nearest(point, start, self.gap(), 0.0);
        Sample { point, domain, start, distance, moved: 0.0 }
    }

    /// Certifies the farthest of a few points of A.
    fn find_first_incumbent(&mut self) {
        let count = match self.a {
            Source::Facets { facets, .. } => facets.len(),
            Source::Patches { patches, .. } => patches.len(),
        };
        let step = count.div_ceil(FIRST_SAMPLES).max(1);
        let chunks = map_items(ranges(count.div_ceil(step)).collect(), |range| {
            let mut start = Start::default();
            let mut samples: Vec<Sample> = Vec::with_capacity(range.len());
            for index in range {
                let found = self.sample((index * step) as u32, start);
                start = found.start;
                samples.push(found);
            }
            samples
        });
        let samples = chunks.into_iter().flatten().collect();
        self.certify(samples);
        if let (None, true) = (self.witness, count > 0) {
            // All samples lie on B: the first of them is the witness of distance 0.
            let Sample { point, domain, start, .. } = self.sample(0, Start::default());
            let closest = self.b.certified(point, start, self.gap(), self.goal.length);
            self.witness = closest.map(|closest| Witness { point, domain, closest });
        }
    }
}

impl Goal {
    fn new(
        a: &Source<'_>,
        b: &Measured<'_>,
        transform: &RigidTransform,
        tolerance: f64,
        limit: Option<Limit>,
    ) -> Self {
        let a_length = a.bounding_box().farthest_from_origin();
        let length =
            upper_max(a_length + transform.offset().length(), b.bounding_box().farthest_from_origin());
        let points = a.error() + b.error() + transform.rounding(a_length);
        let bounds = facet_rounding(length)
            + f64::from(MAX_LEVELS) * cut_rounding(length)
            + gamma(BOX_ROUNDINGS) * length;
        // A certified distance is rounded, and so are both ends of the interval.
        let lost = 2.0 * points + bounds + facet_rounding(length);
        let reachable = if lost < MAX_ROUNDING_PART * tolerance { tolerance - lost } else { lost };
        Self { tolerance: reachable, limit, length, points, bounds, lost }
    }

    /// An upper bound on the distance, for one on that of the computed points.
    fn rounded_up(&self, upper: f64) -> f64 {
        upper * (1.0 + BOUND_ROUNDINGS * UNIT_ROUNDOFF) + self.bounds + self.points
    }

    /// The largest bound whose [`Goal::rounded_up`] is at most `limit`.
    fn before_rounding_up(&self, limit: f64) -> f64 {
        (limit - self.bounds - self.points) * (1.0 - (BOUND_ROUNDINGS + 2.0) * UNIT_ROUNDOFF)
    }
}
