//! The search for the least distance, best first over pairs.

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

use super::Body;
use super::body::pair_error;
use super::hull::{HullDistance, hull_distance};
use super::newton::{Pairing, PatchPair};
use super::piece::Pieces;
use crate::bvh::{Aabb, Node};
use crate::interval::{Interval, Stop};
use crate::model::RigidTransform;
use crate::rounding::lower_min;
use crate::sorting::ordered_by;
use glam::{DMat3, DVec3};
use std::collections::BinaryHeap;

/// The largest number of halvings of a patch; a piece is then far smaller than rounding.
const MAX_LEVEL: u32 = 96;

/// The part of the permitted width within which a hull's bound need not be improved.
const HULL_GAP: f64 = 0.25;

/// The number of pairs bounded between two returns to the caller, about a millisecond of work.
pub(crate) const PAIRS_AT_ONCE: usize = 512;

/// The number of pairs bounded from which on the carriers of patches are looked for: most searches
/// end before.
const CARRIERS_FROM: usize = 2_048;

/// The condition that ends a search.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Goal {
    /// The permitted width of the interval.
    pub(crate) tolerance: f64,
    /// The distance that is to be compared with the clearance, instead of a width.
    pub(crate) limit: Option<f64>,
}

/// The nearest pair of points found.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Nearest {
    /// The patches of A and B.
    pub(crate) patches: [u32; 2],
    /// The parameters on them.
    pub(crate) parameters: [[f64; 2]; 2],
    /// The points, the one of A moved.
    pub(crate) points: [DVec3; 2],
    pub(crate) distance_squared: f64,
}

/// Two sets of points that may contain the nearest pair.
#[derive(Debug, Clone, Copy)]
enum Region {
    /// All patches below two nodes of the trees.
    Nodes([u32; 2]),
    /// Two pieces, with the direction that gave their bound.
    Pieces { pieces: [u32; 2], direction: DVec3 },
}

/// A region in the queue.
#[derive(Debug, Clone, Copy)]
struct Entry {
    /// A lower bound on the distance of its two sets, up to the error of pairs.
    lower: f64,
    region: Region,
}

// The smallest lower bound comes first.
ordered_by!(Entry, |entry| -entry.lower);

/// A search for the least distance of two models.
#[derive(Debug)]
pub(crate) struct Search<'a> {
    bodies: [Body<'a>; 2],
    transform: RigidTransform,
    /// The rotation's matrix, and the same with absolute entries.
    rotation: [DMat3; 2],
    goal: Goal,
    pieces: [Pieces<'a>; 2],
    queue: BinaryHeap<Entry>,
    /// The least lower bound of the regions that cannot be divided further.
    stuck: f64,
    nearest: Option<Nearest>,
    /// The number of pairs bounded.
    pairs: usize,
    /// The number of bounds that corners of both pieces refuted.
    refuted: usize,
}

impl<'a> Search<'a> {
    /// Begins the search over all of both models.
    pub(crate) fn new([a, b]: [Body<'a>; 2], transform: RigidTransform, goal: Goal) -> Self {
        let mut search = Self::without_pairs([a, b], transform, goal);
        let nodes = [a.target.tree.nodes(), b.target.tree.nodes()];
        if nodes.iter().all(|nodes| !nodes.is_empty()) {
            search.descend();
            search.bound_nodes([0, 0]);
        }
        search
    }

    /// Begins the search over these pairs of patches only.
    pub(crate) fn over(
        bodies: [Body<'a>; 2],
        transform: RigidTransform,
        goal: Goal,
        pairs: &[[u32; 2]],
    ) -> Self {
        let mut search = Self::without_pairs(bodies, transform, goal);
        for &patches in pairs {
            let pieces = [0, 1].map(|side| search.pieces[side].whole(patches[side]));
            search.bound_whole(pieces);
        }
        search
    }

    /// Returns the pairs of patches whose hulls are certainly not farther apart than `distance`, and
    /// those for which that is not certain. O(pairs of nodes as near).
    pub(crate) fn pairs_within(
        bodies: [Body<'a>; 2],
        transform: RigidTransform,
        distance: f64,
    ) -> Vec<[u32; 2]> {
        let goal = Goal { tolerance: distance, limit: None };
        let mut search = Self::without_pairs(bodies, transform, goal);
        if bodies.iter().any(|body| body.target.tree.nodes().is_empty()) {
            return Vec::new();
        }
        let within = (distance + search.error()).next_up();
        let (mut found, mut stack) = (Vec::new(), vec![[0, 0]]);
        while let Some(nodes) = stack.pop() {
            if search.box_distance(nodes) > within {
                continue;
            }
            if let Some(children) = search.halves(nodes) {
                stack.extend(children);
                continue;
            }
            let pieces = search.patches(nodes);
            let [a, b] = [0, 1].map(|side| search.pieces[side].piece(pieces[side]));
            let hulls = hull_distance(&a.points, &b.points, a.points[0] - b.points[0], within, 0.0);
            if hulls.lower <= within {
                found.push([a.patch, b.patch]);
            }
        }
        found
    }

    fn without_pairs(bodies: [Body<'a>; 2], transform: RigidTransform, goal: Goal) -> Self {
        let rotation = DMat3::from_quat(transform.rotation());
        Self {
            bodies,
            transform,
            rotation: [rotation, rotation.abs()],
            goal,
            pieces: [Pieces::new(bodies[0], Some(transform)), Pieces::new(bodies[1], None)],
            queue: BinaryHeap::new(),
            stuck: f64::INFINITY,
            nearest: None,
            pairs: 0,
            refuted: 0,
        }
    }

    /// Returns the number of pairs bounded.
    pub(crate) fn pairs(&self) -> usize {
        self.pairs
    }

    /// Returns the number of bounds that were refuted, and not relied on: none, unless there is a fault.
    pub(crate) fn refuted(&self) -> usize {
        self.refuted
    }

    /// Returns the nearest pair of points; `None` before there is one.
    pub(crate) fn nearest(&self) -> Option<Nearest> {
        self.nearest
    }

    /// Returns an interval that contains the least distance of the exact models (lemma C2).
    pub(crate) fn interval(&self) -> Interval {
        let error = self.error();
        Interval { lower: (self.lower() - error).max(0.0), upper: self.upper() + error }
    }

    /// Returns the least tolerance that the rounding of these coordinates allows.
    pub(crate) fn min_tolerance(&self) -> f64 {
        // Both ends have the error, and the search needs as much again to end.
        4.0 * self.error()
    }

    /// Returns whether the clearance is at least the limit, once that is known; `None` without
    /// a limit. At least 0 means that the models are certainly apart.
    pub(crate) fn at_least(&self) -> Option<bool> {
        let Interval { lower, upper } = self.interval();
        let limit = self.goal.limit?;
        if lower > 0.0 && lower >= limit {
            Some(true)
        } else if upper < limit {
            Some(false)
        } else {
            None
        }
    }

    /// Divides the nearest regions until at least [`PAIRS_AT_ONCE`] pairs are bounded, or at most
    /// `max_pairs` about; returns why the search has ended, if it has.
    pub(crate) fn advance(&mut self, max_pairs: usize) -> Option<Stop> {
        let end = self.pairs + PAIRS_AT_ONCE.min(max_pairs);
        loop {
            if let Some(stop) = self.ended() {
                return Some(stop);
            }
            if self.pairs >= end {
                return None;
            }
            let Entry { lower, region } = self.queue.pop()?;
            match region {
                Region::Nodes(nodes) => self.divide_nodes(nodes),
                Region::Pieces { pieces, direction } => self.divide_pieces(pieces, direction, lower),
            }
        }
    }

    fn error(&self) -> f64 {
        let deepest = self.pieces[0].deepest.max(self.pieces[1].deepest);
        pair_error([&self.bodies[0], &self.bodies[1]], &self.transform, deepest)
    }

    fn upper(&self) -> f64 {
        self.nearest.map_or(f64::INFINITY, |nearest| nearest.distance_squared.sqrt())
    }

    fn lower(&self) -> f64 {
        self.queue.peek().map_or(f64::INFINITY, |entry| entry.lower).min(self.stuck).min(self.upper())
    }

    /// Returns why the search has ended, if it has.
    fn ended(&self) -> Option<Stop> {
        let (lower, upper, error) = (self.lower(), self.upper(), self.error());
        if self.goal.limit.is_some() && self.at_least().is_some() {
            return Some(Stop::Converged);
        }
        let width = upper - lower + 2.0 * error;
        let has_limit = self.goal.limit.is_some();
        if !has_limit && width.min(upper + error) <= self.goal.tolerance {
            return Some(Stop::Converged);
        }
        (self.queue.is_empty() || upper - lower <= error || self.stuck <= lower).then_some(Stop::Precision)
    }

    /// Returns the bound from which on a pair need not be searched: the incumbent's distance, or
    /// the limit with the error.
    fn enough(&self) -> f64 {
        let limit = self.goal.limit.map_or(f64::INFINITY, |limit| (limit + self.error()).next_up());
        self.upper().min(limit)
    }

    fn push(&mut self, lower: f64, region: Region) {
        if lower < self.upper() || self.nearest.is_none() {
            self.queue.push(Entry { lower, region });
        }
    }

    /// Finds a first pair of points: from the roots always the nearer halves, down to two patches.
    fn descend(&mut self) {
        let mut nodes = [0, 0];
        while let Some(children) = self.halves(nodes) {
            let [low, high] = children.map(|pair| self.box_distance(pair));
            nodes = children[usize::from(high < low)];
        }
        let pieces = self.patches(nodes);
        let first = |side: usize| self.pieces[side].piece(pieces[side]).points[0];
        let [a, b] = [0, 1].map(|side| self.pieces[side].piece(pieces[side]));
        let found = hull_distance(&a.points, &b.points, first(0) - first(1), f64::INFINITY, 0.0);
        self.improve(pieces, &found, true);
    }

    /// Queues two nodes.
    fn bound_nodes(&mut self, nodes: [u32; 2]) {
        self.pairs += 1;
        self.push(self.box_distance(nodes), Region::Nodes(nodes));
    }

    /// Returns a lower bound on the distance of the patches below two nodes: that of their boxes,
    /// of A's moved and enlarged to the axes, or of B's moved back, the larger one (lemma C1).
    fn box_distance(&self, nodes: [u32; 2]) -> f64 {
        let [a, b] = self.boxes(nodes);
        let [rotation, absolute] = self.rotation;
        let between = self.transform.apply(a.center()) - b.center();
        let [half_a, half_b] = [0.5 * a.extent(), 0.5 * b.extent()];
        let moved = (between.abs() - absolute * half_a - half_b).max(DVec3::ZERO);
        let back = rotation.transpose() * between;
        let unmoved = (back.abs() - half_a - absolute.transpose() * half_b).max(DVec3::ZERO);
        moved.length().max(unmoved.length())
    }

    fn boxes(&self, nodes: [u32; 2]) -> [Aabb; 2] {
        [0, 1].map(|side| self.node(side, nodes[side]).aabb)
    }

    fn node(&self, side: usize, index: u32) -> Node {
        self.bodies[side].target.tree.nodes()[index as usize]
    }

    /// Divides the larger of two nodes; two leaves are a pair of patches.
    fn divide_nodes(&mut self, nodes: [u32; 2]) {
        match self.halves(nodes) {
            Some(children) => children.into_iter().for_each(|pair| self.bound_nodes(pair)),
            None => {
                let pieces = self.patches(nodes);
                self.bound_whole(pieces);
            }
        }
    }

    /// Returns two pairs of nodes, with the larger node's children; `None` for two leaves.
    fn halves(&self, nodes: [u32; 2]) -> Option<[[u32; 2]; 2]> {
        let leaves = [0, 1].map(|side| self.node(side, nodes[side]).is_leaf());
        let [a, b] = self.boxes(nodes).map(|aabb| aabb.diagonal());
        let side = match leaves {
            [true, true] => return None,
            [true, false] => 1,
            [false, true] => 0,
            [false, false] => usize::from(b > a),
        };
        let children = [nodes[side] + 1, self.node(side, nodes[side]).right_child];
        Some(children.map(|child| {
            let mut pair = nodes;
            pair[side] = child;
            pair
        }))
    }

    /// Returns the patches of two leaves as pieces.
    fn patches(&mut self, leaves: [u32; 2]) -> [u32; 2] {
        [0, 1].map(|side| {
            let patch = self.bodies[side].target.tree.primitive(&self.node(side, leaves[side]));
            self.pieces[side].whole(patch)
        })
    }

    /// Bounds two whole patches.
    fn bound_whole(&mut self, pieces: [u32; 2]) {
        let first = |side: usize| self.pieces[side].piece(pieces[side]).points[0];
        self.bound_pieces(pieces, first(0) - first(1), 0.0);
    }

    /// Bounds two pieces by their hulls and looks for a nearer pair of points there.
    fn bound_pieces(&mut self, pieces: [u32; 2], direction: DVec3, inherited: f64) {
        self.pairs += 1;
        let enough = self.enough();
        let gap = HULL_GAP * self.goal.tolerance;
        let [a, b] = [0, 1].map(|side| self.pieces[side].piece(pieces[side]));
        let found = hull_distance(&a.points, &b.points, direction, enough, gap);
        let is_whole = a.level + b.level == 0;
        let lower = self.audited(pieces, found.lower.max(inherited));
        if lower >= self.upper() {
            return;
        }
        self.improve(pieces, &found, is_whole);
        self.push(lower, Region::Pieces { pieces, direction: found.direction });
    }

    /// Returns a lower bound on the distance of two pieces, or 0 where corners of both refute it: they are points of
    /// both, up to the error of pairs. O(1).
    fn audited(&mut self, pieces: [u32; 2], lower: f64) -> f64 {
        let [a, b] = [0, 1].map(|side| {
            let piece = self.pieces[side].piece(pieces[side]);
            piece.corners(self.pieces[side].patch(piece.patch).degree)
        });
        let between = a.iter().flat_map(|corner| b.iter().map(|other| corner.distance_squared(*other)));
        let least = between.fold(f64::INFINITY, lower_min).sqrt();
        if least < lower && least + self.error() < lower {
            self.refuted += 1;
            return 0.0;
        }
        lower
    }

    /// Brings points of two pieces together where they are nearer than the nearest pair, or
    /// where the pieces are whole patches.
    fn improve(&mut self, pieces: [u32; 2], found: &HullDistance, always: bool) {
        let [a, b] = [0, 1].map(|side| self.pieces[side].piece(pieces[side]));
        let patches = [a.patch, b.patch];
        let pair = PatchPair {
            a: self.pieces[0].patch(a.patch),
            b: self.pieces[1].patch(b.patch),
            transform: &self.transform,
        };
        let of = |side: usize| found.pairs.iter().map(move |&(indices, weight)| (indices[side], weight));
        let [s, t] = a.parameters(pair.a.degree, of(0));
        let [u, v] = b.parameters(pair.b.degree, of(1));
        let start = pair.pairing([s, t, u, v]);
        let best = self.nearest.map_or(f64::INFINITY, |nearest| nearest.distance_squared);
        if !always && start.distance_squared >= best {
            return;
        }
        let Pairing { at: [s, t, u, v], distance_squared } = pair.minimize(start.at);
        if distance_squared < best || self.nearest.is_none() {
            let parameters = [[s, t], [u, v]];
            let points = [self.transform.apply(pair.a.point([s, t])), pair.b.point([u, v])];
            self.nearest = Some(Nearest { patches, parameters, points, distance_squared });
        }
    }

    /// Returns a lower bound on the distance of two patches by the spheres, cylinders, cones or
    /// tori that they lie on, 0 where none is known.
    fn carrier_distance(&mut self, pieces: [u32; 2]) -> f64 {
        if self.pairs < CARRIERS_FROM {
            return 0.0;
        }
        let [a, b] = [0, 1].map(|side| {
            let patch = self.pieces[side].piece(pieces[side]).patch;
            self.pieces[side].carrier(patch)
        });
        a.zip(b).map_or(0.0, |(a, b)| a.separation(&b))
    }

    /// Halves the piece whose hull reaches farther beyond its surface, unless the carriers of both
    /// give a larger bound.
    fn divide_pieces(&mut self, pieces: [u32; 2], direction: DVec3, lower: f64) {
        let better = self.carrier_distance(pieces);
        let better = self.audited(pieces, better);
        if better > lower {
            self.push(better, Region::Pieces { pieces, direction });
            return;
        }
        let [a, b] = [0, 1].map(|side| self.pieces[side].piece(pieces[side]));
        let side = if a.bend >= b.bend { 0 } else { 1 };
        let levels = [a.level, b.level];
        let Some(side) = [side, 1 - side].into_iter().find(|&side| levels[side] < MAX_LEVEL) else {
            self.stuck = lower_min(self.stuck, lower);
            return;
        };
        for half in self.pieces[side].halves(pieces[side]) {
            let mut pair = pieces;
            pair[side] = half;
            self.bound_pieces(pair, direction, lower);
        }
    }
}
