//! The search: pieces that may meet the other boundary are halved, those of the largest bounds first.

use super::look::{Found, Looking};
use super::pair::Pair;
use super::piece::Whole;
use super::undecided::{Known, Undecided};
use super::{PlacedSolid, Sides};
use crate::bvh::Aabb;
use crate::interval::Interval;
use crate::rounding::{gamma, upper_max};
use crate::threads::parallel::map;
use glam::DVec3;
use std::collections::BinaryHeap;

/// The number of pieces looked at between two returns to the caller, some milliseconds of work.
const PIECES_AT_ONCE: usize = 256;

/// The part of the largest bound from which on pieces are looked at together with the one that has it.
const TOGETHER: f64 = 0.125;

/// The part of what no halving makes less up to which the rest is halved where the goal is out of reach.
const REST: f64 = 0.25;

/// The part of its width that a search is to have left when it has looked at twice as many pieces: where boundaries
/// cross this is a quarter, where they lie on each other 1.
const MAX_REMAINDER: f64 = 0.9;

/// The roundings of a sum of bounds, relative to it.
const SUM_ROUNDINGS: f64 = 16.0;

/// The search for the volume that two solids have in common.
pub(crate) struct Search<'a> {
    looking: Looking<'a>,
    queue: BinaryHeap<Undecided<'a>>,
    stuck: Vec<Undecided<'a>>,
    /// The sums of bounds in the queue and of those that are stuck, as they are added up.
    waiting: f64,
    held: f64,
    /// The volume of the cones over what is known to be on the boundary of both, with what closes them.
    decided: Interval,
    pieces: usize,
    /// The number of pieces at which the width is looked at next, and the last width.
    next: usize,
    last: f64,
    has_stalled: bool,
}

impl<'a> Search<'a> {
    /// Begins with all patches of both solids.
    ///
    /// `patience` is the number of pieces from which on it is given up once its width no longer falls. Patches are
    /// compared until `is_late`, and the others have the bounds that need no look at the other solid.
    pub(crate) fn new(
        pair: &'a Pair,
        sides: &'a dyn Sides,
        patience: usize,
        is_late: &(dyn Fn() -> bool + Sync),
    ) -> Self {
        let [a, b] = &pair.solids;
        let common = [a.aabb, b.aabb].into_iter().reduce(intersection).unwrap_or(a.aabb);
        let looking = Looking { pair, sides, origin: common.center() };
        let mut search = Self {
            looking,
            queue: BinaryHeap::new(),
            stuck: Vec::new(),
            waiting: 0.0,
            held: 0.0,
            decided: Interval::about(0.0, pair.change),
            pieces: 0,
            next: patience,
            last: f64::INFINITY,
            has_stalled: false,
        };
        for solid in [0, 1] {
            search.include_cracks(&pair.solids[solid]);
            search.include(solid, is_late);
        }
        search
    }

    /// Adds what the strips of a solid within the other one may contribute.
    fn include_cracks(&mut self, solid: &PlacedSolid) {
        let radius = solid.aabb.max_distance_squared(self.looking.origin).sqrt() + solid.error(0);
        let bound = radius * solid.cracks / 3.0 * (1.0 + gamma(SUM_ROUNDINGS));
        self.decided = self.decided + Interval::about(0.0, bound);
    }

    /// Adds the patches of a solid: half of those that the other one has too, the rest to the queue.
    fn include(&mut self, solid: usize, is_late: &(dyn Fn() -> bool + Sync)) {
        let pair = self.looking.pair;
        let [own, other] = [solid, 1 - solid].map(|index| &pair.solids[index].patches);
        // The patch that takes the place of another one is within its reach.
        let reach = other.wholes.iter().map(|whole| whole.reach).fold(0.0, upper_max);
        let found = map(own.faces().count(), |index| {
            let whole = &own.wholes[index];
            if let Some(partner) = pair.partners.of(solid, index) {
                return Found::Decided(self.half(solid, whole, partner.distance));
            }
            let found = other.near(&whole.root.aabb, pair.margins[solid] + reach);
            let near = found.into_iter().map(|index| &other.wholes[index as usize]);
            let near: Vec<_> = near.map(|whole| (whole, &whole.root)).collect();
            if is_late() {
                return self.looking.not_looked_at(solid, (whole, &whole.root), near);
            }
            self.looking.look_at(solid, (whole, &whole.root), &near, Known::default())
        });
        found.into_iter().for_each(|found| self.add(found));
    }

    /// Returns half of the volume of the cone over a patch, with what moving it by `distance` onto its partner changes.
    fn half(&self, solid: usize, whole: &Whole, distance: f64) -> Interval {
        let moved = self.looking.pair.solids[solid].moved(0) + distance;
        self.looking.cone(solid, whole, &whole.root, moved) * 0.5
    }

    fn add(&mut self, found: Found<'a>) {
        match found {
            Found::Decided(volume) => self.decided = self.decided + volume,
            Found::Undecided(undecided) => {
                self.waiting += undecided.bound;
                self.queue.push(undecided);
            }
        }
    }

    /// Returns the number of pieces that were looked at.
    pub(crate) fn pieces(&self) -> usize {
        self.pieces
    }

    /// Returns about the width that [`Self::volume`] has.
    pub(crate) fn width(&self) -> f64 {
        self.waiting + self.held + self.decided.width()
    }

    /// Looks at the pieces of the largest bounds, and returns whether there is more to do for a volume of this width.
    pub(crate) fn advance(&mut self, width: f64) -> bool {
        let fixed = self.held + self.decided.width();
        let goal = upper_max(width - fixed, REST * fixed);
        let Some(largest) = self.queue.peek().map(|first| first.bound) else { return false };
        if self.waiting <= goal || self.stalls() {
            return false;
        }
        let mut batch = Vec::new();
        while batch.len() < PIECES_AT_ONCE {
            let Some(next) = self.queue.peek() else { break };
            if next.bound < TOGETHER * largest {
                break;
            }
            batch.extend(self.queue.pop());
        }
        self.pieces += batch.len();
        let found = map(batch.len(), |index| self.looking.look_at_halves(&batch[index]));
        for (before, found) in batch.into_iter().zip(found) {
            self.waiting -= before.bound;
            if let Some(halves) = found {
                halves.into_iter().for_each(|half| self.add(half));
            } else {
                self.held += before.bound;
                self.stuck.push(before);
            }
        }
        true
    }

    /// Returns whether the search ended because the width had hardly fallen.
    pub(crate) fn has_stalled(&self) -> bool {
        self.has_stalled
    }

    /// Returns whether the width has hardly fallen since half as many pieces.
    fn stalls(&mut self) -> bool {
        if self.pieces >= self.next {
            let width = self.width();
            self.has_stalled = width > MAX_REMAINDER * self.last;
            (self.next, self.last) = (2 * self.pieces, width);
        }
        self.has_stalled
    }

    /// Returns an interval that contains the volume; none where the sum is certainly negative, or larger than the volume
    /// of one of both: then a boundary is not as it is taken to be.
    pub(crate) fn volume(&self) -> Option<Interval> {
        let Pair { solids: [a, b], margins, change, .. } = self.looking.pair;
        // The boxes contain the boundaries but for the margin.
        if !a.aabb.grown(margins[0]).meets(&b.aabb) {
            return Some(Interval { lower: 0.0, upper: *change });
        }
        let undecided: Vec<&Undecided<'_>> = self.queue.iter().chain(&self.stuck).collect();
        let volumes = map(undecided.len(), |index| self.looking.value(undecided[index]));
        let sum = volumes.into_iter().fold(self.decided, |sum, volume| sum + volume);
        let most = if a.volume.upper < b.volume.upper { a.volume.upper } else { b.volume.upper };
        (sum.lower <= most && sum.upper >= 0.0).then(|| sum.clamped(0.0, most))
    }
}

/// Returns the common part of two boxes, or the first one where there is none.
fn intersection(a: Aabb, b: Aabb) -> Aabb {
    let min = DVec3::select(a.min.cmpgt(b.min), a.min, b.min);
    let max = DVec3::select(a.max.cmplt(b.max), a.max, b.max);
    if min.cmple(max).all() { Aabb { min, max } } else { a }
}
