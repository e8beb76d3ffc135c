//! The model that distances are measured to.

use super::bezier::{Net, Patch, project};
use super::boxes::box_distance;
use super::closest::{Finder, Foot};
use super::interval::Interval;

use super::vector::{Vector, difference, dot, exactly, middle, norm};
use std::time::Instant;

/// B's patches, and near points on them.
pub(crate) struct Target {
    pub(crate) patches: Vec<Patch>,
    pub(crate) finder: Finder,
}

/// Where a point is, compared with a limit.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Comparison {
    /// Proved farther than the limit from every point of B.
    Farther,
    /// A point of B was found that is, to rounding, within the limit.
    Nearer(Foot),
    /// Neither before the deadline or the last piece.
    Open,
}

/// Where a box of parameters is, compared with a trimmed region.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Inside,
    Outside,
    /// Neither, or not known.
    Open,
}

/// A part of a patch of B, over `ranges` of its parameters.
struct Piece {
    patch: usize,
    net: Net,
    ranges: [[f64; 2]; 2],
}

impl Target {
    pub(crate) fn new(patches: Vec<Patch>) -> Self {
        let finder = Finder::new(&patches);
        Self { patches, finder }
    }

    /// Whether every point of the box `point` is farther than `limit` from all of B.
    ///
    /// Branch and bound: B is subdivided until every piece is proved farther. Every patch is
    /// covered, as the halves of a piece cover it and the tree of boxes leaves out only patches
    /// that are farther themselves. Given up after `max_pieces` pieces.
    pub(crate) fn compare(
        &self,
        point: &Vector,
        limit: f64,
        max_pieces: usize,
        deadline: Instant,
    ) -> Comparison {
        self.compare_part(point, limit, max_pieces, deadline, &|_, _| Side::Inside)
    }

    /// As [`Self::compare`], with the part of B of the parameters that are not outside. `side`
    /// returns the side of all parameters in a box of a surface.
    pub(crate) fn compare_part(
        &self,
        point: &Vector,
        limit: f64,
        max_pieces: usize,
        deadline: Instant,
        side: &dyn Fn(usize, [[f64; 2]; 2]) -> Side,
    ) -> Comparison {
        let at = middle(point);
        let is_near = |foot: &Foot| {
            let ranges = foot.at.map(|parameter| [parameter; 2]);
            foot.distance <= limit && self.side(foot.patch, ranges, side) == Side::Inside
        };
        if let Some(&foot) = self.finder.nearest(at, 1).first().filter(|foot| is_near(foot)) {
            return Comparison::Nearer(foot);
        }
        let whole =
            |patch: usize| Piece { patch, net: self.patches[patch].net.clone(), ranges: [[0.0, 1.0]; 2] };
        let mut pieces: Vec<Piece> = self.finder.tree().within(point, limit).into_iter().map(whole).collect();
        let mut count = pieces.len();
        while let Some(piece) = pieces.pop() {
            if lower_bound(point, &piece.net) > limit
                || self.side(piece.patch, piece.ranges, side) == Side::Outside
            {
                continue;
            }
            let center = piece.ranges.map(|[start, end]| 0.5 * (start + end));
            let foot = self.finder.project(piece.patch, at, center);
            if is_near(&foot) {
                return Comparison::Nearer(foot);
            }
            count += 2;
            if count > max_pieces || Instant::now() >= deadline {
                return Comparison::Open;
            }
            pieces.extend(piece.halves());
        }
        Comparison::Farther
    }

    /// The side of the surface's parameters over `ranges` of a patch's own, to a few roundings.
    fn side(&self, patch: usize, ranges: [[f64; 2]; 2], side: &dyn Fn(usize, [[f64; 2]; 2]) -> Side) -> Side {
        let patch = &self.patches[patch];
        let corners = [0, 1].map(|end| patch.parameters(ranges.map(|range| range[end])));
        side(patch.surface, corners)
    }
}

impl Piece {
    /// The halves across the longer direction.
    fn halves(self) -> [Self; 2] {
        let [along_u, along_v] = lengths(&self.net);
        let axis = usize::from(along_v > along_u);
        let [start, end] = self.ranges[axis];
        let center = 0.5 * (start + end);
        let mut halves = self.net.split(axis).into_iter().zip([[start, center], [center, end]]);
        std::array::from_fn(|_| {
            let mut ranges = self.ranges;
            let (net, range) = halves.next().unwrap_or_else(|| unreachable!("there are two halves"));
            ranges[axis] = range;
            Self { patch: self.patch, net, ranges }
        })
    }
}

/// The larger distances of the net's corners along each axis.
pub(crate) fn lengths(net: &Net) -> [f64; 2] {
    let [a, b, c, d] = net.corners().map(|corner| exactly(middle(&corner)));
    let between = |from: &Vector, to: &Vector| norm(&difference(from, to)).hi;
    [between(&a, &c).max(between(&b, &d)), between(&a, &b).max(between(&c, &d))]
}

/// A lower bound of the distance of every point of a box from a patch: that of the boxes, or the
/// least of n · (p - q) / |n| over the control points p for a direction n towards the patch, since
/// |x - q| >= n · (x - q) / |n| for all x in their convex hull. The second converges as the square
/// of the patch's size where the patch is orthogonal to n.
fn lower_bound(point: &Vector, net: &Net) -> f64 {
    let between_boxes = box_distance(point, &net.bounding_box());
    let inner = project(&net.points[net.points.len() / 2]);
    let towards = exactly(middle(&difference(&inner, point)));
    let length = norm(&towards);
    let along = |control: Vector| dot(&towards, &difference(&control, point)) / length;
    let directed = net.hull_points().map(|control| along(control).lo).fold(f64::INFINITY, f64::min);
    between_boxes.max(directed)
}

/// The distances between two boxes of points.
pub(crate) fn distance(a: &Vector, b: &Vector) -> Interval {
    norm(&difference(a, b))
}
