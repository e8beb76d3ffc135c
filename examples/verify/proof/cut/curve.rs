//! Closed outlines of rational Bézier curves, and winding numbers about boxes.

use super::{Box2, Controls};
use crate::proof::bezier::Net;
use crate::proof::interval::Interval;
use std::cell::OnceCell;

/// The halvings of a curve after which it counts as touching a box.
pub(super) const MAX_HALVINGS: u32 = 40;

/// The halvings of each curve for the area: a relative error of about 1e-3.
const AREA_HALVINGS: u32 = 9;

/// A homogeneous point (w u, w v, w).
pub(super) type Point = [Interval; 3];

const HALF: Interval = Interval { lo: 0.5, hi: 0.5 };

/// A closed outline, the union of closed loops.
pub(super) struct Outline {
    pub(super) chains: Vec<Node>,
}

/// A part of a curve, or of a chain of them, with its box, and its halves once they are needed.
pub(super) struct Node {
    /// The control points of a curve, none of a chain.
    controls: Vec<Point>,
    pub(super) hull: Box2,
    /// Points in the enclosures of the ends: parts that meet have the same one there.
    pub(super) ends: [[f64; 2]; 2],
    halves: OnceCell<Box<[Node; 2]>>,
}

fn project([x, y, w]: Point) -> Box2 {
    [x / w, y / w]
}

fn middle(point: Point) -> [f64; 2] {
    project(point).map(Interval::mid)
}

impl Node {
    fn new(controls: Vec<Point>, ends: [[f64; 2]; 2]) -> Self {
        let mut node = Self { controls, hull: [Interval::ENTIRE; 2], ends, halves: OnceCell::new() };
        let hull = node.points().reduce(|a, b| std::array::from_fn(|axis| a[axis].hull(b[axis])));
        node.hull = hull.unwrap_or(node.hull);
        node
    }

    /// A side of a map, whose ends meet no other curve.
    pub(super) fn side(controls: Vec<Point>) -> Self {
        let ends = [controls[0], controls[controls.len() - 1]].map(middle);
        Self::new(controls, ends)
    }

    pub(super) fn controls(&self) -> &[Point] {
        &self.controls
    }

    /// The start (0) or the end (1) of a curve.
    pub(super) fn end(&self, end: usize) -> Box2 {
        project(self.controls[end * (self.controls.len() - 1)])
    }

    /// One coordinate of a curve, as a patch that does not depend on its first parameter.
    pub(super) fn coordinate(&self, axis: usize) -> Net {
        let point = |point: &Point| [point[axis], Interval::ZERO, Interval::ZERO, point[2]];
        Net { degree: [0, self.controls.len() - 1], points: self.controls.iter().map(point).collect() }
    }

    /// The points whose convex hull contains the curve: the control points and its ends.
    pub(super) fn points(&self) -> impl Iterator<Item = Box2> {
        let ends = self.ends.map(|end| end.map(Interval::point));
        self.controls.iter().map(|&point| project(point)).chain(ends)
    }

    /// The part of the curve over this part of [0, 1], which halvings make.
    pub(super) fn over(&self, part: [f64; 2]) -> &Self {
        let (mut node, mut range) = (self, [0.0, 1.0]);
        while range != part {
            let middle = 0.5 * (range[0] + range[1]);
            let half = usize::from(part[0] >= middle);
            range[1 - half] = middle;
            node = &node.halves()[half];
        }
        node
    }

    /// Whether the box of the curve meets another.
    pub(super) fn meets(&self, target: &Box2) -> bool {
        (0..2).all(|axis| self.hull[axis].hi >= target[axis].lo && self.hull[axis].lo <= target[axis].hi)
    }

    /// The chain of curves that each begin where the one before ends.
    fn chain(mut nodes: Vec<Self>) -> Self {
        let rest = nodes.split_off(nodes.len().div_ceil(2));
        if rest.is_empty() {
            return nodes.swap_remove(0);
        }
        let [low, high] = [nodes, rest].map(Self::chain);
        let hull = std::array::from_fn(|axis| low.hull[axis].hull(high.hull[axis]));
        let ends = [low.ends[0], high.ends[1]];
        Self { controls: Vec::new(), hull, ends, halves: OnceCell::from(Box::new([low, high])) }
    }

    pub(super) fn is_chain(&self) -> bool {
        self.controls.is_empty()
    }

    pub(super) fn halves(&self) -> &[Node; 2] {
        self.halves.get_or_init(|| {
            let (mut low, mut high) = (self.controls.clone(), self.controls.clone());
            for round in 1..low.len() {
                for k in 0..low.len() - round {
                    high[k] = std::array::from_fn(|axis| (high[k][axis] + high[k + 1][axis]) * HALF);
                }
                low[round] = high[0];
            }
            let joint = middle(high[0]);
            let [start, end] = self.ends;
            Box::new([Self::new(low, [start, joint]), Self::new(high, [joint, end])])
        })
    }

    /// Crossings of the curve with the ray from the box to the right, upwards ones positive;
    /// `None` where the curve may touch the box.
    ///
    /// A part whose box does not meet this one is replaced by the chord of its ends: both lie in
    /// its box, which is convex.
    fn crossings(&self, target: &Box2, halvings: u32) -> Option<i32> {
        let [x, y] = &self.hull;
        if x.hi < target[0].lo || y.hi < target[1].lo || y.lo > target[1].hi {
            return Some(0);
        }
        if x.lo > target[0].hi {
            let height = target[1].mid();
            let [start, end] = self.ends;
            return Some(match (start[1] <= height, end[1] <= height) {
                (true, false) => 1,
                (false, true) => -1,
                _ => 0,
            });
        }
        let within =
            |end: [f64; 2]| (0..2).all(|axis| target[axis].lo <= end[axis] && end[axis] <= target[axis].hi);
        // What is smaller than the box by far is not worth a closer look.
        let is_smaller = (0..2).all(|axis| {
            64.0 * (self.hull[axis].hi - self.hull[axis].lo) <= target[axis].hi - target[axis].lo
        });
        if halvings == MAX_HALVINGS || is_smaller || self.ends.iter().any(|&end| within(end)) {
            return None;
        }
        let [low, high] = self.halves();
        Some(low.crossings(target, halvings + 1)? + high.crossings(target, halvings + 1)?)
    }
}

impl Node {
    /// The area between the curve and a point.
    fn area(&self, origin: &Box2, halvings: u32) -> Interval {
        if halvings > 0 {
            let [low, high] = self.halves();
            let halvings = if self.is_chain() { halvings } else { halvings - 1 };
            return low.area(origin, halvings) + high.area(origin, halvings);
        }
        let [from, to] = self.ends.map(|end| [0, 1].map(|axis| Interval::point(end[axis]) - origin[axis]));
        let size = |axis: usize| Interval::point(self.hull[axis].hi) - Interval::point(self.hull[axis].lo);
        let between = (size(0) * size(1)).magnitude();
        HALF * (from[0] * to[1] - to[0] * from[1]) + Interval { lo: -between, hi: between }
    }
}

impl Outline {
    /// The outline of closed loops of curves, head to tail.
    pub(super) fn new(loops: impl Iterator<Item = Vec<Controls>>) -> Self {
        let exact = |controls: Controls| controls.iter().map(|point| point.map(Interval::point)).collect();
        Self::of_intervals(loops.map(|curves| curves.into_iter().map(exact).collect()))
    }

    /// As [`Self::new`] for controls that are known to rounding. Ends that differ are joined by a
    /// segment, which is in the box of the curve before.
    pub(super) fn of_intervals(loops: impl Iterator<Item = Vec<Vec<Point>>>) -> Self {
        let chain = |curves: Vec<Vec<Point>>| {
            let starts: Vec<[f64; 2]> = curves.iter().map(|controls| middle(controls[0])).collect();
            let next = starts.iter().skip(1).chain(starts.first());
            let ends = starts.iter().zip(next).map(|(&start, &end)| [start, end]);
            Node::chain(
                curves.into_iter().zip(ends).map(|(controls, ends)| Node::new(controls, ends)).collect(),
            )
        };
        Self { chains: loops.filter(|curves| !curves.is_empty()).map(chain).collect() }
    }

    /// The winding number of the outline about all points of a box, `None` where it may touch it.
    pub(super) fn winding(&self, target: &Box2) -> Option<i32> {
        self.chains.iter().try_fold(0, |sum, chain| Some(sum + chain.crossings(target, 0)?))
    }

    /// The signed area within the outline: that of the polygon through points of the curves, off by
    /// at most the boxes of the parts between them.
    pub(super) fn area(&self) -> Interval {
        let origin = self.bounds().map(|bounds| Interval::point(bounds.mid()));
        self.chains.iter().fold(Interval::ZERO, |sum, chain| sum + chain.area(&origin, AREA_HALVINGS))
    }

    /// The box of the outline.
    pub(super) fn bounds(&self) -> Box2 {
        let hulls = self.chains.iter().map(|chain| chain.hull);
        let union = hulls.reduce(|a, b| std::array::from_fn(|axis| a[axis].hull(b[axis])));
        union.unwrap_or([Interval::ZERO; 2])
    }
}
