//! Cubic curves in the parameters of a surface, fitted to projected edges.

use super::{Projection, Projector};
use crate::digits::three_digits;
use crate::nurbs::{Curve, Spline, Surface, Unconvertible};
use crate::report::FaceFault;
use crate::topology::{Edge, SpaceCurve};
use glam::{DAffine3, DVec3};

/// The tolerance of a fit in space, relative to the size of the edge.
const FIT_TOLERANCE: f64 = 1e-8;

/// The part of an edge's distance from its surface by which a fit may deviate, if that is more.
/// A fit to less of it would make the gap no smaller, and converges slowly: the tangents of
/// projections are exact for edges on the surface alone.
const PART_OF_DISTANCE: f64 = 0.1;

/// The distance from an edge to its surface, relative to the size of the edge, beyond which
/// the nearest point is searched globally.
const NEAR: f64 = 1e-3;

/// The largest distance, relative to the size, of an edge of the surface; its tolerance counts if
/// that is more. Systems write edges of half as much, and `gap` states it.
const FARTHEST: f64 = 1e-2;

/// The pieces at the start, and the deepest bisection of a piece.
const FIRST_PIECES: usize = 8;
const MAX_DEPTH: usize = 10;

/// The fractions of a piece at which its deviation is measured.
const CHECKS: [f64; 3] = [0.25, 0.5, 0.75];

/// The difference of an edge's parameters, relative to its range, in difference quotients;
/// rounding and the third derivative move a tangent by about 1e-10 of it.
const DIFFERENCE: f64 = 1e-5;

/// The distance, relative to the range, of the points from which a curve is continued into
/// the singular point of a surface, by a parabola: what it misses is about its cube.
const BESIDE_SINGULAR: f64 = 1e-3;

/// The image in the face's coordinates of an edge's curve in space.
pub(in crate::faces) struct Traced<'a> {
    pub(in crate::faces) curve: &'a Curve,
    pub(in crate::faces) range: [f64; 2],
    pub(in crate::faces) to_face: DAffine3,
    /// The diagonal of the box of its samples.
    pub(in crate::faces) size: f64,
    /// The tolerance of the edge in the face's coordinates.
    tolerance: f64,
}

impl<'a> Traced<'a> {
    /// The curve `space` of an edge, mapped by `to_face`, which enlarges lengths by `scale`.
    ///
    /// # Errors
    /// [`Unconvertible::Range`] if the range is empty or reversed.
    pub(in crate::faces) fn new(
        curve: &'a Curve,
        space: &SpaceCurve,
        to_face: DAffine3,
        edge: &Edge,
        scale: f64,
    ) -> Result<Self, Unconvertible> {
        if space.range[0] >= space.range[1] {
            return Err(Unconvertible::Range);
        }
        let mut traced =
            Self { curve, range: space.range, to_face, size: 0.0, tolerance: scale * edge.tolerance };
        let points = || super::super::inversion::samples(space.range).map(|t| traced.point(t));
        let low = points().fold(DVec3::INFINITY, DVec3::min);
        traced.size = low.distance(points().fold(DVec3::NEG_INFINITY, DVec3::max));
        Ok(traced)
    }

    pub(in crate::faces) fn point(&self, t: f64) -> DVec3 {
        self.to_face.transform_point3(self.curve.point(t))
    }

    /// Returns the derivative by a difference quotient of second order inside of a part of the
    /// range on which the edge is smooth.
    fn tangent(&self, t: f64, [start, end]: [f64; 2]) -> DVec3 {
        let step = DIFFERENCE * (end - start);
        let inner = t.clamp(start + step, end - step);
        let [a, b, c] = [inner - step, inner, inner + step].map(|t| self.point(t));
        // The derivative at t of the parabola through the three points.
        ((c - a) + 2.0 * ((t - inner) / step) * (c - 2.0 * b + a)) / (2.0 * step)
    }

    /// Returns the parameters of equally spaced points of the edge on the surface, each beside
    /// the one before it, and their largest distance from it.
    ///
    /// # Errors
    /// `BREP_NO_P_CURVE` if the edge leaves the surface.
    pub(in crate::faces) fn parameters(
        &self,
        projector: &mut Projector<'_>,
    ) -> Result<(Vec<DVec3>, f64), FaceFault> {
        let samples: Vec<f64> = super::super::inversion::samples(self.range).collect();
        // From the middle to both ends, which may be singular.
        let middle = samples.len() / 2;
        let first = self.project(projector, samples[middle], None)?;
        let mut distance = first.distance;
        let mut follow = |indices: &mut dyn Iterator<Item = usize>| -> Result<Vec<DVec3>, FaceFault> {
            let mut last = first.parameters;
            indices
                .map(|index| {
                    let found = self.project(projector, samples[index], Some(last))?;
                    distance = distance.max(found.distance);
                    let before = std::mem::replace(&mut last, found.parameters);
                    if let Some(axis) = projector.vanishing_tangent(last) {
                        // All of that parameter's values are the same point.
                        last[axis] = before[axis];
                    }
                    Ok(last)
                })
                .collect()
        };
        let after = follow(&mut (middle + 1..samples.len()))?;
        let mut all = follow(&mut (0..middle).rev())?;
        all.reverse();
        all.push(first.parameters);
        all.extend(after);
        Ok((all, distance))
    }

    /// Returns the parts of the range between the edge's knots.
    fn smooth_parts(&self) -> Vec<[f64; 2]> {
        let [start, end] = self.range;
        let mut breaks = vec![start];
        let mut last = start;
        while last < end {
            let next = self.curve.cell(last)[1].min(end);
            if next <= last {
                break;
            }
            breaks.push(next);
            last = next;
        }
        if last < end {
            breaks.push(end);
        }
        breaks.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    }

    fn project(
        &self,
        projector: &mut Projector<'_>,
        t: f64,
        near: Option<DVec3>,
    ) -> Result<Projection, FaceFault> {
        let fault = |why: String| FaceFault::new("BREP_NO_P_CURVE", why);
        let found = projector
            .project(self.point(t), near, NEAR * self.size)
            .ok_or_else(|| fault("no curve in the parameters, and no points to make one of".to_owned()))?;
        self.check(found.distance)?;
        Ok(found)
    }

    /// Checks the distance of a point of the edge from the surface.
    ///
    /// # Errors
    /// `BREP_NO_P_CURVE` for one that no edge of the surface has.
    pub(in crate::faces) fn check(&self, distance: f64) -> Result<(), FaceFault> {
        if distance <= (FARTHEST * self.size).max(self.tolerance) {
            return Ok(());
        }
        let why = format!("the edge is {} from the surface", three_digits(distance));
        Err(FaceFault::new("BREP_NO_P_CURVE", why))
    }

    /// Returns the cubic spline of the parameters that passes through points of the edge with
    /// its tangents: at least 8 pieces between the edge's knots, halved until the deviation at
    /// three points of each is within the tolerance. Tangents at knots are those of each side.
    ///
    /// # Errors
    /// `BREP_NO_P_CURVE` if the edge leaves the surface, or deeper halving would be needed.
    pub(in crate::faces) fn fit(
        &self,
        surface: &Surface,
        projector: &mut Projector<'_>,
    ) -> Result<Spline, FaceFault> {
        let (samples, distance) = self.parameters(projector)?;
        let [start, end] = self.range;
        let near = |t: f64| {
            let sample = (t - start) / (end - start) * (samples.len() - 1) as f64;
            samples[(sample.round() as usize).min(samples.len() - 1)]
        };
        let tolerance = (FIT_TOLERANCE * self.size).max(PART_OF_DISTANCE * distance);
        let parts = self.smooth_parts();
        let pieces = FIRST_PIECES.div_ceil(parts.len());
        let mut spline = Spline { degree: 3, knots: vec![start; 4], controls: Vec::new() };
        for part in parts {
            let [low, high] = part;
            let at = |piece: usize| {
                let fraction = piece as f64 / pieces as f64;
                if piece == pieces { high } else { low + fraction * (high - low) }
            };
            let mut from = self.node(projector, low, near(low), part)?;
            match spline.controls.last() {
                None => spline.controls.push(from.at.extend(1.0)),
                Some(last) if is_across_seam(surface, from.at - last.truncate()) => {
                    let why = format!("the edge crosses the seam of the {}", surface.kind());
                    return Err(FaceFault::new("BREP_NO_P_CURVE", why));
                }
                Some(_) => {}
            }
            for piece in 1..=pieces {
                let to = self.node(projector, at(piece), near(at(piece)), part)?;
                let piece = Piece { surface, tolerance, part, depth: 0 };
                self.piece(&piece, projector, [from, to], &mut spline)?;
                from = to;
            }
        }
        spline.knots.push(end);
        Ok(spline)
    }

    /// Appends the cubic between two nodes, or those between its halves.
    fn piece(
        &self,
        piece: &Piece<'_>,
        projector: &mut Projector<'_>,
        [from, to]: [Node; 2],
        spline: &mut Spline,
    ) -> Result<(), FaceFault> {
        let Piece { surface, tolerance, part, depth } = *piece;
        let third = (to.t - from.t) / 3.0;
        let controls = [from.at, from.at + third * from.velocity, to.at - third * to.velocity, to.at];
        let mut deviation = 0.0_f64;
        for fraction in CHECKS {
            let at = cubic(controls, fraction);
            let t = from.t + fraction * (to.t - from.t);
            let nearest = self.project(projector, t, Some(at))?.parameters;
            let on_surface = surface.point(at.x, at.y);
            let moved = on_surface.distance(surface.point(nearest.x, nearest.y));
            // NaN is no deviation that a piece may have.
            deviation = if moved.is_nan() { f64::INFINITY } else { deviation.max(moved) };
        }
        // Where the edge runs along the end of the surface and leaves it, no cubic follows its
        // projection; the edge's own tolerance allows for that, and the gap states it.
        if deviation <= tolerance || depth == MAX_DEPTH && deviation <= self.tolerance {
            spline.controls.extend(controls[1..].iter().map(|control| control.extend(1.0)));
            spline.knots.extend([to.t; 3]);
            return Ok(());
        }
        if depth == MAX_DEPTH {
            let why = format!("no cubic curve on the {} follows the edge", surface.kind());
            return Err(FaceFault::new("BREP_NO_P_CURVE", why));
        }
        let middle = self.node(projector, 0.5 * (from.t + to.t), cubic(controls, 0.5), part)?;
        let half = Piece { depth: depth + 1, ..*piece };
        self.piece(&half, projector, [from, middle], spline)?;
        self.piece(&half, projector, [middle, to], spline)
    }

    /// Returns the node at a parameter of a smooth part of the edge.
    fn node(
        &self,
        projector: &mut Projector<'_>,
        t: f64,
        near: DVec3,
        part: [f64; 2],
    ) -> Result<Node, FaceFault> {
        let at = self.project(projector, t, Some(near))?.parameters;
        if let Some(velocity) = projector.velocity(at, self.tangent(t, part)) {
            return Ok(Node { t, at, velocity });
        }
        // Where a tangent of the surface vanishes, the curve continues that beside the point.
        let [start, end] = part;
        let step = BESIDE_SINGULAR * (end - start) * if t - start > end - t { -1.0 } else { 1.0 };
        let mut beside = [near; 3];
        for index in [2, 1, 0] {
            let guess = if index == 2 { near } else { beside[index + 1] };
            beside[index] = self.project(projector, t + (index + 1) as f64 * step, Some(guess))?.parameters;
        }
        let [a, b, c] = beside;
        // The parabola through the points at 1, 2 and 3 steps, at 0.
        let mut continued =
            Node { t, at: 3.0 * a - 3.0 * b + c, velocity: (4.0 * b - 2.5 * a - 1.5 * c) / step };
        // The parameter along the other tangent is exact.
        let [u, v] = projector.tangents(at);
        let exact = if u.length() > v.length() { 0 } else { 1 };
        continued.at[exact] = at[exact];
        Ok(continued)
    }
}

/// Returns whether a step of the parameters leads from one end of a closed surface to the other, where they do
/// not continue.
pub(in crate::faces) fn is_across_seam(surface: &Surface, step: DVec3) -> bool {
    let (closures, periods) = (surface.closures(), surface.periods());
    let is_across = |axis: usize| closures[axis].is_some_and(|length| step[axis].abs() > 0.5 * length);
    (0..2).any(|axis| periods[axis].is_none() && is_across(axis))
}

/// The conditions under which a piece of a fit is made.
#[derive(Clone, Copy)]
struct Piece<'a> {
    surface: &'a Surface,
    tolerance: f64,
    /// The smooth part of the edge that the piece is of.
    part: [f64; 2],
    depth: usize,
}

/// A point of the edge in the parameters, with the derivative by the edge's parameter.
#[derive(Debug, Clone, Copy)]
struct Node {
    t: f64,
    at: DVec3,
    velocity: DVec3,
}

fn cubic(mut controls: [DVec3; 4], fraction: f64) -> DVec3 {
    for level in 1..4 {
        for index in 0..4 - level {
            controls[index] = controls[index].lerp(controls[index + 1], fraction);
        }
    }
    controls[0]
}
