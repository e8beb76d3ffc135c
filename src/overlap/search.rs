//! The search: pieces that may meet the other boundary are halved, those of the largest bounds first.

use super::flush::{RELATIVE_FLATNESS, Slabs, height};
use super::piece::{Piece, Whole, bounds};
use super::separation::may_meet;
use super::shared::{RELATIVE_REACH, shared};
use super::solid::MAX_DEPTH;
use super::{BoundarySide, PlacedSolid, Sides};
use crate::bvh::Aabb;
use crate::facts::Interval;
use crate::rounding::{gamma, upper_max};
use crate::solid::{Enclosing, Side};
use crate::threads::parallel::map;
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::sync::Arc;

/// The number of pieces looked at between two returns to the caller, some milliseconds of work.
const PIECES_AT_ONCE: usize = 256;

/// The part of the largest bound from which on pieces are looked at together with the one that has it.
const TOGETHER: f64 = 0.125;

/// The part of what no halving makes less up to which the rest is halved where the goal is out of reach.
const REST: f64 = 0.25;

/// The largest ratio of the size of a piece of the other boundary to that of the piece that it is compared with.
const SIZE_RATIO: f64 = 1.0;

/// The number of pieces from which on a search is given up whose width no longer falls.
const MIN_PIECES: usize = 8192;

/// The part of its width that a search is to have left when it has looked at twice as many pieces: where boundaries
/// cross this is a half, where they lie on each other 1.
const MAX_REMAINDER: f64 = 0.9;

/// The roundings of a sum of bounds, relative to it.
const SUM_ROUNDINGS: f64 = 16.0;

/// A point of a piece, with the shells of the other solid about it.
type Reference = Arc<(DVec3, Enclosing)>;

/// A piece that may have points on either side of the other boundary.
struct Undecided<'a> {
    solid: usize,
    whole: &'a Whole,
    piece: &'a Piece,
    /// An upper bound on the integral of |(x − origin)·n| / 3 over it.
    bound: f64,
    /// The pieces of the other boundary that may be near.
    near: Vec<(&'a Whole, &'a Piece)>,
    reference: Option<Reference>,
}

impl PartialEq for Undecided<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Undecided<'_> {}
impl PartialOrd for Undecided<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Undecided<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

/// What is found of a piece.
enum Found<'a> {
    /// It lies within the other solid, and its cone has this volume.
    Inside(Interval),
    Outside,
    /// It has been halved.
    Halved([Undecided<'a>; 2]),
    /// It is halved no further.
    Stuck(Undecided<'a>),
}

/// The search for the volume that two solids have in common.
pub(crate) struct Search<'a> {
    solids: [&'a PlacedSolid; 2],
    sides: &'a dyn Sides,
    origin: DVec3,
    slabs: Slabs<'a>,
    /// The distances within which pieces of each solid may meet the other's boundary.
    margins: [f64; 2],
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
}

impl<'a> Search<'a> {
    /// Begins with all patches of both solids.
    pub(crate) fn new(solids: [&'a PlacedSolid; 2], sides: &'a dyn Sides) -> Self {
        let [a, b] = solids;
        let common = [a.aabb, b.aabb].into_iter().reduce(intersection).unwrap_or(a.aabb);
        let origin = common.center();
        let diagonal = upper_max(a.aabb.diagonal(), b.aabb.diagonal());
        let reach = RELATIVE_REACH * diagonal;
        // Moved patches are within the reach of their partners.
        let margins = [b.margin(a) + 2.0 * reach, a.margin(b) + 2.0 * reach];
        let flatness = RELATIVE_FLATNESS * diagonal;
        let height = height(flatness, margins, reach);
        let slabs = Slabs { solids, sides, flatness, height, origin };
        // Of a piece within a slab the other boundary is within two heights.
        let margins = margins.map(|margin| margin + 2.0 * height);
        let mut search = Self {
            solids,
            sides,
            origin,
            slabs,
            margins,
            queue: BinaryHeap::new(),
            stuck: Vec::new(),
            waiting: 0.0,
            held: 0.0,
            decided: Interval::exactly(0.0),
            pieces: 0,
            next: MIN_PIECES,
            last: f64::INFINITY,
        };
        for solid in solids {
            search.include_cracks(solid);
        }
        let partners = shared(&a.patches, &b.patches, reach).partners;
        for (solid, partners) in partners.iter().enumerate() {
            search.include(solid, partners);
        }
        search
    }

    /// Adds what the strips of a solid within the other one may contribute.
    fn include_cracks(&mut self, solid: &PlacedSolid) {
        let radius = solid.aabb.max_distance_squared(self.origin).sqrt() + solid.error(0);
        let bound = radius * solid.cracks / 3.0 * (1.0 + gamma(SUM_ROUNDINGS));
        self.decided = self.decided + Interval::about(0.0, bound);
    }

    /// Adds the patches of a solid: half of those that the other one has too, the rest to the queue.
    fn include(&mut self, solid: usize, partners: &[Option<f64>]) {
        let other = self.solids[1 - solid];
        let patches = &self.solids[solid].patches;
        let bounds = bounds(patches, self.origin, self.solids[solid].moved(0));
        for ((whole, &bound), partner) in patches.wholes.iter().zip(&bounds).zip(partners) {
            let piece = &whole.root;
            if let (Some(distance), true) = (partner, whole.side != BoundarySide::Unknown) {
                self.decided = self.decided + self.half(solid, whole, *distance);
                continue;
            }
            let found = other.patches.near(&piece.aabb, self.margins[solid]);
            let near = found.into_iter().map(|index| &other.patches.wholes[index as usize]);
            let near = near.map(|whole| (whole, &whole.root)).collect();
            self.push(Undecided { solid, whole, piece, bound, near, reference: None });
        }
    }

    /// Returns half of the volume of the cone over a patch, with what moving it by `distance` onto its partner changes.
    fn half(&self, solid: usize, whole: &Whole, distance: f64) -> Interval {
        let moved = self.solids[solid].moved(0) + distance;
        let patches = &self.solids[solid].patches;
        let volume = patches.moments(whole, &whole.root, self.origin, moved).volume() * 0.5;
        if whole.side == BoundarySide::Outward { volume } else { -volume }
    }

    fn push(&mut self, undecided: Undecided<'a>) {
        self.waiting += undecided.bound;
        self.queue.push(undecided);
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
        if self.waiting <= goal || self.has_stalled() {
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
        let found = map(batch.len(), |index| self.look_at(&batch[index]));
        for (before, found) in batch.iter().zip(found) {
            self.waiting -= before.bound;
            match found {
                Found::Inside(volume) => self.decided = self.decided + volume,
                Found::Outside => {}
                Found::Halved(halves) => halves.into_iter().for_each(|half| self.push(half)),
                Found::Stuck(undecided) => {
                    self.held += undecided.bound;
                    self.stuck.push(undecided);
                }
            }
        }
        true
    }

    /// Returns whether the width has hardly fallen since half as many pieces.
    fn has_stalled(&mut self) -> bool {
        if self.pieces < self.next {
            return false;
        }
        let width = self.width();
        let has_stalled = width > MAX_REMAINDER * self.last;
        (self.next, self.last) = (2 * self.pieces, width);
        has_stalled
    }

    /// Compares a piece with the other boundary.
    fn look_at(&self, undecided: &Undecided<'a>) -> Found<'a> {
        let Undecided { solid, whole, piece, bound, ref near, ref reference } = *undecided;
        let near = self.still_near(solid, (whole, piece), near);
        let same = |near| Undecided { solid, whole, piece, bound, near, reference: reference.clone() };
        if near.is_empty() {
            return match self.side(solid, piece, reference.as_ref()) {
                Some(Side::Outside) => Found::Outside,
                Some(Side::Inside) if whole.side != BoundarySide::Unknown => {
                    Found::Inside(self.cone(solid, whole, piece))
                }
                _ => Found::Stuck(same(near)),
            };
        }
        if whole.side != BoundarySide::Unknown
            && let Some(flush) = self.slabs.flush((whole, piece), &near, bound)
        {
            let cone = self.cone(solid, whole, piece);
            return Found::Inside(cone * flush.part + Interval::about(0.0, flush.error));
        }
        let Some(halves) = whole.halves(piece) else { return Found::Stuck(same(near)) };
        let reference = reference.clone().or_else(|| {
            let point = piece.points[0];
            let found = self.sides.side(1 - solid, point, None);
            found.map(|(enclosing, _)| Arc::new((point, enclosing)))
        });
        let patches = &self.solids[solid].patches;
        Found::Halved(halves.map(|piece| {
            let moved = self.solids[solid].moved(piece.depth);
            let bound = patches.bound(whole, piece, self.origin, moved);
            Undecided { solid, whole, piece, bound, near: near.clone(), reference: reference.clone() }
        }))
    }

    /// Returns the side of a piece that has no point of the other boundary near: that of any point of its hull.
    fn side(&self, solid: usize, piece: &Piece, reference: Option<&Reference>) -> Option<Side> {
        let last = piece.points.len() - 1;
        [0, last, last / 2].into_iter().find_map(|index| {
            let found = self.sides.side(1 - solid, piece.points[index], reference.map(AsRef::as_ref));
            found.map(|(_, side)| side).filter(|&side| side != Side::Undecided)
        })
    }

    /// Returns the pieces of the other boundary that may meet a piece, halved until they are as small.
    fn still_near(
        &self,
        solid: usize,
        piece: (&'a Whole, &'a Piece),
        near: &[(&'a Whole, &'a Piece)],
    ) -> Vec<(&'a Whole, &'a Piece)> {
        let margin = self.margins[solid];
        let (mut found, mut stack) = (Vec::new(), near.to_vec());
        while let Some(other) = stack.pop() {
            if !may_meet(piece, other, margin) {
                continue;
            }
            let is_large = other.1.radius > SIZE_RATIO * piece.1.radius && other.1.depth < MAX_DEPTH;
            match other.0.halves(other.1).filter(|_| is_large) {
                Some(halves) => stack.extend(halves.map(|half| (other.0, half))),
                None => found.push(other),
            }
        }
        found
    }

    /// Returns the volume of the cone over a piece, positive where its normals are outward and it faces away.
    fn cone(&self, solid: usize, whole: &Whole, piece: &Piece) -> Interval {
        let placed = self.solids[solid];
        let moved = placed.moved(piece.depth);
        let volume = placed.patches.moments(whole, piece, self.origin, moved).volume();
        if whole.side == BoundarySide::Outward { volume } else { -volume }
    }

    /// Returns an interval that contains the volume.
    pub(crate) fn volume(&self) -> Interval {
        let undecided: Vec<&Undecided<'_>> = self.queue.iter().chain(&self.stuck).collect();
        let volumes = map(undecided.len(), |index| self.any_part(undecided[index]));
        let sum = volumes.into_iter().fold(self.decided, |sum, volume| sum + volume);
        let [a, b] = self.solids.map(|solid| solid.volume.upper);
        let most = if a < b { a } else { b };
        sum.clamped(0.0, most)
    }

    /// Returns the volumes of the cones over all parts of a piece.
    fn any_part(&self, undecided: &Undecided<'_>) -> Interval {
        let &Undecided { solid, whole, piece, bound, .. } = undecided;
        if whole.side == BoundarySide::Unknown {
            return Interval::about(0.0, bound);
        }
        // Those of the parts where x·n is positive, and of those where it is negative, are at most half of the sum of
        // the bound and the whole, and of their difference.
        let cone = self.cone(solid, whole, piece);
        let bound = Interval::about(0.0, bound);
        let (most, least) = ((bound + cone) * 0.5, (bound - cone) * 0.5);
        Interval { lower: -least.upper, upper: most.upper }
    }
}

/// Returns the common part of two boxes, or the first one where there is none.
fn intersection(a: Aabb, b: Aabb) -> Aabb {
    let min = DVec3::select(a.min.cmpgt(b.min), a.min, b.min);
    let max = DVec3::select(a.max.cmplt(b.max), a.max, b.max);
    if min.cmple(max).all() { Aabb { min, max } } else { a }
}
