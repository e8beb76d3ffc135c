//! The curves of a boundary in space and in the parameters, each checked against the other.

use crate::gap::Lifted;
use crate::iges::geometry::Leaf;
use crate::nurbs::{Curve, Spline, Surface};
use glam::{DAffine3, DVec3};

/// The distance of curves that stand for each other, relative to the size of the boundary: files
/// of known systems reach half of it, and curves of different edges exceed it.
const NEAR: f64 = 1e-2;

/// The same where the file prefers the curves in space.
const NEAR_PREFERRED: f64 = 1e-3;

/// The most curves that are compared with all others; of more, each with the next alone.
const MAX_COMPARED: usize = 1000;

/// A part of a boundary.
#[derive(Debug)]
pub(super) enum Piece {
    /// A curve in space with its curve in the parameters, in its direction.
    Both {
        leaf: Leaf,
        curve: Spline,
        pair: Pair,
    },
    Space(Leaf),
    /// A curve in the parameters alone, and whether it is a point in space.
    Parameters(Spline, bool),
}

/// How a curve in the parameters stands for one in space.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    /// Whether both have one direction.
    pub(super) along: bool,
    /// About the largest distance of one from the other.
    pub(super) distance: f64,
}

/// A surface where a face has it.
pub(super) struct Ground<'a> {
    pub(super) surface: &'a Surface,
    pub(super) location: DAffine3,
    /// The distance below which points are one.
    pub(super) tolerance: f64,
}

impl Ground<'_> {
    /// Returns the parts of a boundary along its curves in the parameters; `None` where these and
    /// the curves in space do not stand for each other one to one.
    pub(super) fn pieces(
        &self,
        parameters: &[Spline],
        space: &[Leaf],
        prefers_space: bool,
    ) -> Option<Vec<Piece>> {
        let space: Vec<&Leaf> =
            space.iter().filter(|leaf| leaf.curve.size(leaf.range) > self.tolerance).collect();
        let parameters: Vec<(Spline, bool)> = self
            .with_points(parameters)
            .into_iter()
            .map(|curve| {
                let is_point = self.is_point(&curve);
                (curve, is_point)
            })
            .collect();
        if space.is_empty() {
            let alone = |(curve, is_point)| Piece::Parameters(curve, is_point);
            return Some(parameters.into_iter().map(alone).collect());
        }
        let near = if prefers_space { NEAR_PREFERRED } else { NEAR };
        let allowed = self.tolerance.max(near * size(&space));
        let pairs = self.pairs(&parameters, &space, allowed)?;
        let piece = |((curve, _), pair): ((Spline, bool), Option<(usize, Pair)>)| match pair {
            Some((index, pair)) => {
                let curve = if pair.along { curve } else { curve.reversed() };
                Piece::Both { leaf: space[index].clone(), curve, pair }
            }
            None => Piece::Parameters(curve, true),
        };
        Some(parameters.into_iter().zip(pairs).map(piece).collect())
    }

    /// Returns closed curves with the segments between their ends that are points in space, as
    /// along a pole: writers leave these out.
    fn with_points(&self, parameters: &[Spline]) -> Vec<Spline> {
        let mut closed = Vec::with_capacity(parameters.len());
        let next = parameters.iter().cycle().skip(1);
        for (curve, next) in parameters.iter().zip(next) {
            closed.push(curve.clone());
            let segment = Spline::segment([0.0, 1.0], curve.end(), next.start());
            if self.is_apart(&segment, parameters) && self.is_point(&segment) {
                closed.push(segment);
            }
        }
        closed
    }

    /// Returns whether the ends of a segment are apart, compared to the curves beside it.
    fn is_apart(&self, segment: &Spline, curves: &[Spline]) -> bool {
        let points = || curves.iter().flat_map(Spline::points);
        let low = points().fold(DVec3::INFINITY, DVec3::min);
        let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
        let apart = (segment.end() - segment.start()).abs();
        (0..2).any(|axis| apart[axis] > APART * (high[axis] - low[axis]))
    }

    /// Returns for each curve in the parameters, but those that are points, the curve in space
    /// that it stands for, and whether in its direction; `None` unless each has one.
    fn pairs(
        &self,
        parameters: &[(Spline, bool)],
        space: &[&Leaf],
        allowed: f64,
    ) -> Option<Vec<Option<(usize, Pair)>>> {
        if parameters.iter().filter(|(_, is_point)| !is_point).count() != space.len() {
            return None;
        }
        let mut is_used = vec![false; space.len()];
        let mut pairs = Vec::with_capacity(parameters.len());
        // The place of the last curve found, and the step to the next one.
        let (mut last, mut step) = (space.len() - 1, 1);
        for (curve, is_point) in parameters {
            if *is_point {
                pairs.push(None);
                continue;
            }
            let next = (last + step) % space.len();
            let others = (0..space.len()).filter(|_| space.len() <= MAX_COMPARED);
            let mut candidates = std::iter::once(next).chain(others).filter(|&index| !is_used[index]);
            let found = candidates.find_map(|index| Some((index, self.pair(curve, space[index], allowed)?)));
            let (index, pair) = found?;
            is_used[index] = true;
            (last, step) = (index, if pair.along { 1 } else { space.len() - 1 });
            pairs.push(Some((index, pair)));
        }
        Some(pairs)
    }

    /// Returns how a curve in the parameters of an edge stands for the edge's curve in space;
    /// `None` if it does not.
    pub(super) fn pair_of_edge(&self, curve: &Spline, leaf: &Leaf) -> Option<Pair> {
        self.pair(curve, leaf, self.tolerance.max(NEAR * size(&[leaf])))
    }

    fn pair(&self, curve: &Spline, leaf: &Leaf, allowed: f64) -> Option<Pair> {
        let ends = [curve.start(), curve.end()].map(|at| self.lifted(at));
        let points = leaf.range.map(|t| leaf.location.transform_point3(leaf.curve.point(t)));
        [true, false].into_iter().find_map(|along| {
            let [start, end] = if along { points } else { [points[1], points[0]] };
            let is_near = ends[0].distance(start) <= allowed && ends[1].distance(end) <= allowed;
            let distance = if is_near { self.distance(curve, leaf, along) } else { f64::INFINITY };
            (distance <= allowed).then_some(Pair { along, distance })
        })
    }

    /// Returns about the largest distance of the curve on the surface from the curve in space.
    fn distance(&self, curve: &Spline, leaf: &Leaf, along: bool) -> f64 {
        let curve = if along { curve.clone() } else { curve.clone().reversed() };
        let curve = Curve::Spline(curve.into());
        let lifted = Lifted {
            surface: self.surface,
            surface_location: self.location,
            curve: &curve,
            range: [0.0, 1.0],
            edge: &leaf.curve,
            edge_location: leaf.location,
            edge_range: leaf.range,
        };
        lifted.measured()
    }

    /// Returns for each part of a boundary the earlier part that is the other side of the same
    /// seam, and whether both curves in space have one direction: these are one curve, which the
    /// boundary runs along once each way.
    pub(super) fn seams(&self, pieces: &[Piece]) -> Vec<Option<(usize, bool)>> {
        let is_closed = self.surface.closures().iter().any(Option::is_some) && pieces.len() <= MAX_COMPARED;
        let mut seams: Vec<Option<(usize, bool)>> = vec![None; pieces.len()];
        for index in (0..pieces.len()).filter(|_| is_closed) {
            let Piece::Both { leaf, pair, .. } = &pieces[index] else { continue };
            let found = (0..index).find_map(|other| {
                let Piece::Both { leaf: first, pair: of_first, .. } = &pieces[other] else { return None };
                let same = self.is_same(first, leaf)?;
                let is_free = !seams.iter().flatten().any(|&(taken, _)| taken == other);
                ((pair.along == same) != of_first.along && is_free).then_some((other, same))
            });
            seams[index] = found;
        }
        seams
    }

    /// Returns whether two curves in space that are the same have one direction.
    fn is_same(&self, first: &Leaf, second: &Leaf) -> Option<bool> {
        let points = |leaf: &Leaf| {
            let [start, end] = leaf.range;
            [start, 0.5 * (start + end), end].map(|t| leaf.location.transform_point3(leaf.curve.point(t)))
        };
        let (a, mut b) = (points(first), points(second));
        [true, false].into_iter().find(|&same| {
            if !same {
                b.reverse();
            }
            a.iter().zip(&b).all(|(a, b)| a.distance(*b) <= self.tolerance)
        })
    }

    fn lifted(&self, at: DVec3) -> DVec3 {
        self.location.transform_point3(self.surface.point(at.x, at.y))
    }

    /// Returns whether a curve in the parameters is a point in space, as at a pole.
    fn is_point(&self, curve: &Spline) -> bool {
        let points = [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| self.lifted(curve.point(t)));
        points.iter().all(|point| point.distance(points[0]) <= self.tolerance)
    }
}

/// Part of the extent of curves by which their ends are apart.
const APART: f64 = 1e-3;

/// Returns the diagonal of the box of points of some curves.
fn size(leaves: &[&Leaf]) -> f64 {
    let points = leaves.iter().flat_map(|leaf| {
        let [start, end] = leaf.range;
        [0.0, 0.25, 0.5, 0.75, 1.0]
            .map(|part| leaf.location.transform_point3(leaf.curve.point(start + part * (end - start))))
    });
    let bounds = points
        .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], point| [low.min(point), high.max(point)]);
    bounds[0].distance(bounds[1])
}

/// The points of a piece in the polygon that stands for it.
const POLYGON_POINTS: usize = 8;

/// Returns about the signed area within closed curves in the parameters; `None` where one is
/// not known.
pub(super) fn area(pieces: &[Piece]) -> Option<f64> {
    let mut points: Vec<DVec3> = Vec::new();
    for piece in pieces {
        let (curve, along) = match piece {
            Piece::Both { curve, pair, .. } => (curve, pair.along),
            Piece::Parameters(curve, _) => (curve, true),
            Piece::Space(_) => return None,
        };
        let first = points.len();
        for part in curve.pieces() {
            let [start, end] = part.domain();
            let at = |index: usize| start + (end - start) * index as f64 / POLYGON_POINTS as f64;
            points.extend((0..POLYGON_POINTS).map(|index| part.point(at(index))));
        }
        points.push(curve.end());
        if !along {
            points[first..].reverse();
        }
    }
    let origin = *points.first()?;
    let next = points.iter().cycle().skip(1);
    Some(0.5 * points.iter().zip(next).map(|(&a, &b)| (a - origin).cross(b - origin).z).sum::<f64>())
}
