//! The curves of a boundary in space and in the parameters, each checked against the other.

use crate::brep::gap::Lifted;
use crate::brep::iges::geometry::Leaf;
use crate::brep::nurbs::{Curve, Spline, Surface};
use glam::{DAffine3, DVec3};

/// The part of an edge's size by which its curve in the parameters may be off: files of the best
/// known systems reach it, and a curve of another edge exceeds it.
const NEAR: f64 = 1e-2;

/// The most curves that are compared with all others; of more, each with the next alone.
const MAX_COMPARED: usize = 1000;

/// A part of a boundary.
#[derive(Debug)]
pub(super) enum Piece {
    /// A curve in space with its curve in the parameters, in its direction, and whether the
    /// boundary runs along it.
    Both(Leaf, Spline, bool),
    Space(Leaf),
    /// A curve in the parameters alone, and whether it is a point in space.
    Parameters(Spline, bool),
}

/// A surface where a face has it.
pub(super) struct Ground<'a> {
    pub(super) surface: &'a Surface,
    pub(super) location: DAffine3,
    /// The distance below which points are one.
    pub(super) tolerance: f64,
}

impl Ground<'_> {
    /// Returns the parts of a boundary along its curves in the parameters. Where these and the
    /// curves in space do not stand for each other one to one, those in space count alone.
    pub(super) fn pieces(&self, parameters: Vec<Spline>, space: Vec<Leaf>) -> Vec<Piece> {
        let space: Vec<Leaf> =
            space.into_iter().filter(|leaf| leaf.curve.size(leaf.range) > self.tolerance).collect();
        let parameters: Vec<(Spline, bool)> = parameters
            .into_iter()
            .map(|curve| {
                let is_point = self.is_point(&curve);
                (curve, is_point)
            })
            .collect();
        if space.is_empty() {
            return parameters
                .into_iter()
                .map(|(curve, is_point)| Piece::Parameters(curve, is_point))
                .collect();
        }
        match self.pairs(&parameters, &space) {
            Some(pairs) => {
                let piece = |((curve, _), pair): ((Spline, bool), Option<(usize, bool)>)| match pair {
                    Some((index, true)) => Piece::Both(space[index].clone(), curve, true),
                    Some((index, false)) => Piece::Both(space[index].clone(), curve.reversed(), false),
                    None => Piece::Parameters(curve, true),
                };
                parameters.into_iter().zip(pairs).map(piece).collect()
            }
            None => space.into_iter().map(Piece::Space).collect(),
        }
    }

    /// Returns for each curve in the parameters, but those that are points, the curve in space
    /// that it stands for, and whether in its direction; `None` unless each has one.
    fn pairs(&self, parameters: &[(Spline, bool)], space: &[Leaf]) -> Option<Vec<Option<(usize, bool)>>> {
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
            let found = candidates.find_map(|index| Some((index, self.direction(curve, &space[index])?)));
            let (index, along) = found?;
            is_used[index] = true;
            (last, step) = (index, if along { 1 } else { space.len() - 1 });
            pairs.push(Some((index, along)));
        }
        Some(pairs)
    }

    /// Returns whether a curve in the parameters runs along a curve in space or against it;
    /// `None` if it does neither.
    pub(super) fn direction(&self, curve: &Spline, leaf: &Leaf) -> Option<bool> {
        let allowed = self.tolerance.max(NEAR * leaf.curve.size(leaf.range));
        let ends = [curve.start(), curve.end()].map(|at| self.lifted(at));
        let points = leaf.range.map(|t| leaf.location.transform_point3(leaf.curve.point(t)));
        let fits = |along: bool| {
            let [start, end] = if along { points } else { [points[1], points[0]] };
            let near = ends[0].distance(start) <= allowed && ends[1].distance(end) <= allowed;
            near && self.distance(curve, leaf, along) <= allowed
        };
        [true, false].into_iter().find(|&along| fits(along))
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

    fn lifted(&self, at: DVec3) -> DVec3 {
        self.location.transform_point3(self.surface.point(at.x, at.y))
    }

    /// Returns whether a curve in the parameters is a point in space, as at a pole.
    fn is_point(&self, curve: &Spline) -> bool {
        let points = [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| self.lifted(curve.point(t)));
        points.iter().all(|point| point.distance(points[0]) <= self.tolerance)
    }
}

/// The points of a piece in the polygon that stands for it.
const POLYGON_POINTS: usize = 8;

/// Returns about the signed area within closed curves in the parameters; `None` where one is
/// not known.
pub(super) fn area(pieces: &[Piece]) -> Option<f64> {
    let mut points: Vec<DVec3> = Vec::new();
    for piece in pieces {
        let (curve, along) = match piece {
            Piece::Both(_, curve, along) => (curve, *along),
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
