//! The rims of trimmed faces: whether they meet themselves.
//!
//! What is stated of points of one face is stated along its surface, which may go on beyond the rim. If the rim does not
//! meet itself, neither does the region within it, and what is one point of the surface is one point of the face (lemma S10
//! of docs/solids.md).

use super::audit::{FromShared, Ways};
use super::complex::{Complex, RimArc};
use super::directions::{Direction, Directions, common_side};
use super::piece::{Piece, Side};
use super::search::{AUDITED_DISTANCES, GOOD_STRETCH, MAX_LEVEL, PAIRS_AT_ONCE, PAIRS_EACH, PATIENCE};
use super::{Doubt, Limits, Verdict};
use crate::bezier::PatchSet;
use crate::bvh::{Aabb, Bvh};
use crate::clearance::hull_distance;
use crate::param_box::ParamBox;
use crate::rounding::upper_max;
use glam::DVec3;

/// A part of an arc at which a face ends.
struct Part {
    /// The arc's number.
    arc: usize,
    rim: RimArc,
    /// The patch over the parameters of the part; only its side counts.
    piece: Piece,
    points: Vec<DVec3>,
    aabb: Aabb,
    along: Directions,
    halves: Option<[usize; 2]>,
}

/// What is to be decided.
#[derive(Clone, Copy)]
enum Task {
    One(usize),
    Two([usize; 2]),
}

/// The search over all pairs of parts of the rims of the same face.
pub(super) struct RimSearch<'a> {
    patches: &'a PatchSet,
    complex: &'a Complex,
    limits: &'a Limits<'a>,
    /// The distance up to which points are near each other, with the rounding of distances of computed points.
    apart: f64,
    parts: Vec<Part>,
    within: f64,
    is_refuted: bool,
}

impl<'a> RimSearch<'a> {
    pub(super) fn new(
        patches: &'a PatchSet,
        complex: &'a Complex,
        limits: &'a Limits<'a>,
        apart: f64,
    ) -> Self {
        let parts = complex.rims().iter().enumerate();
        let parts = parts.map(|(arc, &rim)| Part::new(patches, arc, rim, 0)).collect();
        Self { patches, complex, limits, apart, parts, within: 0.0, is_refuted: false }
    }

    /// Decides all pairs, or returns the first that is not decided.
    pub(super) fn run(mut self) -> Verdict {
        let boxes: Vec<Aabb> = self.parts.iter().map(|part| part.aabb.grown(self.apart)).collect();
        let mut tasks: Vec<Task> = (0..boxes.len()).map(Task::One).collect();
        Bvh::new(&boxes).for_each_pair(|a, b| {
            let pair = [a as usize, b as usize];
            let [one, other] = pair.map(|index| self.parts[index].rim.sheet);
            if one == other {
                tasks.push(Task::Two(pair));
            }
        });
        let budget = PAIRS_EACH * tasks.len();
        let mut count = 0;
        while let Some(task) = tasks.pop() {
            count += 1;
            if count > budget || (count % PAIRS_AT_ONCE == 0 && (self.limits.is_late)()) {
                return self.undecided(task, Doubt::Budget);
            }
            let is_decided = self.is_decided(task);
            if self.is_refuted {
                return self.undecided(task, Doubt::Refuted);
            }
            if is_decided {
                continue;
            }
            let is_small = |part: &Part| part.piece.level >= MAX_LEVEL || part.aabb.diagonal() <= self.apart;
            if task.parts().iter().all(|&index| is_small(&self.parts[index])) {
                return self.undecided(task, Doubt::Contact);
            }
            self.divide(task, &mut tasks);
        }
        Verdict::Embedded { within: self.within }
    }

    fn undecided(&self, task: Task, doubt: Doubt) -> Verdict {
        let parts = task.parts().map(|index| &self.parts[index]);
        let [a, b] = parts.map(|part| part.aabb);
        let common = Aabb { min: a.min.max(b.min), max: a.max.min(b.max) };
        Verdict::Undecided { doubt, parts: parts.map(|part| part.rim.patch), point: common.center() }
    }

    fn divide(&mut self, task: Task, tasks: &mut Vec<Task>) {
        match task {
            Task::One(index) => {
                let [low, high] = self.halves(index);
                tasks.extend([Task::One(low), Task::One(high), Task::Two([low, high])]);
            }
            Task::Two([a, b]) => {
                let [of_a, of_b] = [a, b].map(|index| {
                    let part = &self.parts[index];
                    if part.piece.level < MAX_LEVEL { part.aabb.diagonal() } else { -1.0 }
                });
                let (divided, other) = if of_a >= of_b { (a, b) } else { (b, a) };
                tasks.extend(self.halves(divided).map(|half| Task::Two([half, other])));
            }
        }
    }

    /// Returns the two parts of a part.
    fn halves(&mut self, index: usize) -> [usize; 2] {
        let part = &self.parts[index];
        if let Some(halves) = part.halves {
            return halves;
        }
        let RimArc { range: [from, to], corners: [start, end], .. } = part.rim;
        let middle = 0.5 * (from + to);
        let ends = [([from, middle], [start, None]), ([middle, to], [None, end])];
        let (arc, level) = (part.arc, part.piece.level + 1);
        let rims = ends.map(|(range, corners)| RimArc { range, corners, ..part.rim });
        let first = self.parts.len();
        self.parts.extend(rims.map(|rim| Part::new(self.patches, arc, rim, level)));
        let halves = [first, first + 1];
        self.parts[index].halves = Some(halves);
        halves
    }

    fn is_decided(&mut self, task: Task) -> bool {
        let is_early = task.parts().iter().any(|&index| self.parts[index].piece.level < PATIENCE);
        let most = if is_early { GOOD_STRETCH * self.apart } else { self.limits.most };
        let found = match task {
            Task::One(index) => {
                let part = &self.parts[index];
                let along: Vec<Direction> = part.along.turned(false).collect();
                // The way between two points of a part begins at one of them, and so does that of the middle to both ends.
                let [from, middle, to] = part.samples(self.patches);
                let ways = [from, to].map(|end| vec![FromShared { point: end, way: end.distance(middle) }]);
                self.stated(along, 2.0 * part.along.rest, most, ways)
            }
            Task::Two([a, b]) => self.apart([a, b], most),
        };
        match found {
            Some(Ok(within)) => self.within = upper_max(self.within, within),
            Some(Err(Refuted)) => self.is_refuted = true,
            None => {}
        }
        found.is_some()
    }

    /// Returns an upper bound on the ways along the rim between points of two parts that are near each other, 0 if there are
    /// none.
    fn apart(&self, pair: [usize; 2], most: f64) -> Option<Result<f64, Refuted>> {
        let [a, b] = pair.map(|index| &self.parts[index]);
        if !a.aabb.grown(self.apart).meets(&b.aabb) {
            return Some(Ok(0.0));
        }
        let start = a.aabb.center() - b.aabb.center();
        if hull_distance(&a.points, &b.points, start, 2.0 * self.apart, 0.0).lower > self.apart {
            return Some(Ok(0.0));
        }
        if let Some(found) = self.along_edge([a, b], most) {
            return Some(found);
        }
        let ends = (0..2).flat_map(|of_a| (0..2).map(move |of_b| [of_a, of_b]));
        ends.filter_map(|[of_a, of_b]| Some(([of_a, of_b], self.spread([a, b], [of_a, of_b])?))).find_map(
            |([of_a, of_b], spread)| {
                let back = b.along.turned(of_b == 0);
                let directions = a.along.turned(of_a == 1).chain(back).collect();
                let ways = [(a, of_a), (b, of_b)].map(|(part, end)| part.points_from(end, self.patches));
                self.stated(directions, spread + 2.0 * (a.along.rest + b.along.rest), most, ways)
            },
        )
    }

    /// Returns an upper bound on the ways between points of two parts that are near each other, along both and with a step
    /// between them, if these are of arcs that are joined to each other.
    fn along_edge(&self, [a, b]: [&Part; 2], most: f64) -> Option<Result<f64, Refuted>> {
        let (edges, is_swapped) = self.complex.edges([a.rim.patch, b.rim.patch]);
        let orders = if is_swapped { [[b, a], [a, b]] } else { [[a, b], [b, a]] };
        let count = if a.rim.patch == b.rim.patch { 2 } else { 1 };
        let all = edges.iter().flat_map(|edge| orders[..count].iter().map(move |&order| (order, edge)));
        let own = all.filter(|(parts, edge)| (0..2).all(|k| parts[k].rim.side == edge.sides[k]));
        let found = own.flat_map(|(parts, edge)| {
            let pieces = parts.map(|part| &part.piece);
            let widths = [0, 1].map(|first| edge.width(pieces, first, self.apart));
            widths.into_iter().flatten().map(move |width| (parts, width))
        });
        let mut stated = found.filter_map(|([one, other], (width, is_reversed))| {
            let directions = one.along.turned(false).chain(other.along.turned(is_reversed)).collect();
            let rest = width + 2.0 * (one.along.rest + other.along.rest);
            self.stated(directions, rest, most, [Vec::new(), Vec::new()])
        });
        stated.next()
    }

    /// Returns how far these ends of two parts are from each other, if they are one point of the rim or one corner.
    fn spread(&self, [a, b]: [&Part; 2], [of_a, of_b]: [usize; 2]) -> Option<f64> {
        if a.arc == b.arc && of_a != of_b && a.rim.range[of_a] == b.rim.range[of_b] {
            return Some(0.0);
        }
        let corner = a.rim.corners[of_a].filter(|_| a.rim.corners[of_a] == b.rim.corners[of_b])?;
        Some(self.complex.spread(corner))
    }

    /// Returns the bound on the ways between points that are near each other, whose difference is a sum of these directions
    /// and of a rest, if it is at most `most`; an error if these points contradict it.
    fn stated(
        &self,
        directions: Vec<Direction>,
        rest: f64,
        most: f64,
        [one, other]: [Vec<FromShared>; 2],
    ) -> Option<Result<f64, Refuted>> {
        let (_, margin) = common_side(&directions)?;
        let ways = Ways { margin, rest };
        let within = ways.at(self.apart);
        if within > most {
            return None;
        }
        let holds = ways.hold_between([&one, &other], AUDITED_DISTANCES * self.apart);
        Some(if holds { Ok(within) } else { Err(Refuted) })
    }
}

/// Points contradicted what was stated.
#[derive(Clone, Copy)]
struct Refuted;

impl Part {
    fn new(patches: &PatchSet, arc: usize, rim: RimArc, level: u32) -> Self {
        let mut range = ParamBox::UNIT;
        range[rim.side.axis.other()] = rim.range;
        let patch = patches.patch(rim.patch as usize);
        let piece = Piece::new(&patch, rim.patch, range, level, std::iter::empty());
        let points = piece.side_points(rim.side);
        let aabb = points.iter().copied().fold(Aabb::EMPTY, Aabb::with);
        let along = piece.along_side(rim.side);
        Self { arc, rim, piece, points, aabb, along, halves: None }
    }

    /// Returns the points at both ends and in the middle.
    fn samples(&self, patches: &PatchSet) -> [DVec3; 3] {
        let Side { axis, end } = self.rim.side;
        let grid = self.piece.grid(patches);
        [0, 1, 2].map(
            |along: usize| {
                if axis.index() == 0 { grid[2 * end][along] } else { grid[along][2 * end] }
            },
        )
    }

    /// Returns the points with their ways from an end.
    fn points_from(&self, end: usize, patches: &PatchSet) -> Vec<FromShared> {
        let samples = self.samples(patches);
        samples.iter().map(|&point| FromShared { point, way: point.distance(samples[2 * end]) }).collect()
    }
}

impl Task {
    fn parts(self) -> [usize; 2] {
        match self {
            Self::One(index) => [index; 2],
            Self::Two(pair) => pair,
        }
    }
}
