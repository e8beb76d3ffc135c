//! The winding number of a point, by the ellipse bound.
//!
//! A piece from P₀ to P₁ whose control polygon has length L is at most as long, and so
//! lies in the ellipse `|x - P₀| + |x - P₁| <= L`: with positive weights a line meets the
//! curve at most as often as its polygon, and Cauchy's and Crofton's formula turns counts
//! into lengths. A point q outside the ellipse sees the piece under the angle of its
//! chord, as the ellipse is convex; any other piece is halved. After C. Bao, J. Shen and
//! W. Wang, arXiv 2510.25159 (2025), and J. Spainhour, D. Gunderman and K. Weiss,
//! ACM Transactions on Graphics 43(4) (2024), article 38.

mod conic;
mod enclosure;
mod rim;

pub use rim::{Rim, RimSide};

use super::piece::{TrimPiece, homogeneous, point_of};
use crate::axis::Axis;
use crate::param_box::ParamBox;
use crate::rounding::gamma;
use glam::DVec2;
use std::f64::consts::TAU;

/// The largest number of halvings of a piece: 2^-50 of the domain is below the rounding
/// of its coordinates.
const MAX_HALVINGS: u32 = 50;

/// The distance from a curve, as a fraction of the domain, within which a point may be
/// undecided.
pub const RESOLUTION: f64 = 1e-12;

/// The loops of a trimmed surface, prepared for winding numbers.
///
/// Coordinates are fractions of the domain's range, so that u and v weigh the same.
#[derive(Debug, Clone)]
pub struct Winding {
    domain: ParamBox,
    loops: Vec<Vec<WindingPiece>>,
    /// The rounding of a coordinate of the domain, as a fraction of its range.
    rounding: f64,
}

/// A piece in fractions of the domain.
#[derive(Debug, Clone)]
pub(super) struct WindingPiece {
    pub(super) piece: TrimPiece,
    pub(super) ends: [DVec2; 2],
    /// An upper bound on the length of the control polygon, with the rounding of its points.
    pub(super) length: f64,
    /// A box that contains it.
    pub(super) bounds: [DVec2; 2],
    /// Whether it runs along a border line of the domain.
    pub(super) is_on_border: bool,
}

impl Winding {
    /// Prepares closed loops: each piece ends in the floats that the next begins with.
    /// O(controls).
    #[must_use]
    pub fn new(loops: &[Vec<TrimPiece>], domain: ParamBox) -> Self {
        let size = |axis: usize| {
            let [low, high] = domain[axis];
            low.abs().max(high.abs()) / (high - low)
        };
        let rounding = gamma(8.0) * (1.0 + size(0).max(size(1)));
        let mut winding = Self { domain, loops: Vec::with_capacity(loops.len()), rounding };
        for pieces in loops {
            let mut arcs = Vec::with_capacity(pieces.len());
            for piece in pieces {
                let mut scaled = piece.clone();
                for control in &mut scaled.controls {
                    *control = homogeneous(winding.fraction(point_of(*control)), control.z);
                }
                arcs.push(WindingPiece::new(scaled, rounding));
            }
            winding.loops.push(arcs);
        }
        winding
    }

    /// Returns the place of (u, v) in fractions of the domain.
    pub(crate) fn place(&self, parameters: [f64; 2]) -> [f64; 2] {
        self.fraction(parameters.into()).to_array()
    }

    /// Returns the fraction of the domain that a unit of a parameter is.
    pub(crate) fn scale(&self, axis: Axis) -> f64 {
        self.domain.lengths()[axis.index()].recip()
    }

    pub(super) fn fraction(&self, point: DVec2) -> DVec2 {
        (point - DVec2::from(self.domain.low())) / DVec2::from(self.domain.lengths())
    }

    /// Returns the sum of the loops' winding numbers around (u, v); `None` where the
    /// point is so near to a curve that rounding decides, which it never is farther
    /// than about [`RESOLUTION`] of the domain from every curve.
    ///
    /// O(pieces), and O(degree² log) for the few pieces near the point.
    #[must_use]
    pub fn number(&self, parameters: [f64; 2]) -> Option<i32> {
        (0..self.loops.len()).map(|index| self.of_loop(index, parameters)).sum()
    }

    /// Returns the winding number of one loop around (u, v), or `None` as
    /// [`Winding::number`] does.
    #[must_use]
    pub fn of_loop(&self, index: usize, parameters: [f64; 2]) -> Option<i32> {
        let point = self.fraction(parameters.into());
        let mut angle = 0.0;
        for arc in &self.loops[index] {
            angle += self.angle(arc, point)?;
        }
        Some((angle / TAU).round() as i32)
    }

    /// Returns the rounding of a coordinate, as a fraction of the domain's range.
    pub(super) fn rounding(&self) -> f64 {
        self.rounding
    }

    /// Returns the pieces of all loops.
    pub(super) fn arcs(&self) -> impl Iterator<Item = &WindingPiece> {
        self.loops.iter().flatten()
    }

    /// Returns the pieces of a loop.
    pub(super) fn arcs_of(&self, index: usize) -> impl Iterator<Item = &WindingPiece> {
        self.loops[index].iter()
    }

    /// Returns the halves of an arc that was halved `halvings` times.
    pub(super) fn halves(&self, arc: &WindingPiece, halvings: u32) -> [WindingPiece; 2] {
        let rounding =
            self.rounding + gamma(f64::from(halvings + 1) * (2.0 * arc.piece.degree() as f64 + 4.0));
        arc.piece.halves().map(|half| WindingPiece::new(half, rounding))
    }

    /// Returns the number of loops.
    pub(super) fn loops(&self) -> usize {
        self.loops.len()
    }

    /// Returns an upper bound on the length of a loop, in fractions of the domain.
    pub(super) fn length(&self, index: usize) -> f64 {
        self.loops[index].iter().map(|arc| arc.length).sum()
    }

    /// Returns the signed area of a loop, in fractions of the domain: positive where the
    /// loop turns counterclockwise. An estimate for rational pieces.
    pub(super) fn signed_area(&self, index: usize) -> f64 {
        let Some(origin) = self.loops[index].first().map(|arc| arc.ends[0]) else { return 0.0 };
        self.loops[index].iter().map(|arc| arc.piece.signed_area(origin)).sum()
    }

    /// Returns the pieces of a loop in fractions of the domain.
    pub(super) fn scaled_pieces(&self, index: usize) -> impl Iterator<Item = &TrimPiece> {
        self.loops[index].iter().map(|arc| &arc.piece)
    }

    /// Returns the parameters (u, v) of fractions of the domain.
    pub(super) fn parameters(&self, fractions: DVec2) -> [f64; 2] {
        self.domain.at(fractions.into())
    }

    /// Returns the angle under which the point sees the arc.
    fn angle(&self, arc: &WindingPiece, point: DVec2) -> Option<f64> {
        if let Some(angle) = arc.chord_angle(point) {
            return Some(angle);
        }
        let mut angle = 0.0;
        let mut stack = vec![(arc.clone(), 0_u32)];
        while let Some((arc, halvings)) = stack.pop() {
            if let Some(chord) = arc.chord_angle(point) {
                angle += chord;
            } else if halvings == MAX_HALVINGS || arc.length < RESOLUTION {
                return None;
            } else {
                stack.extend(self.halves(&arc, halvings).map(|half| (half, halvings + 1)));
            }
        }
        Some(angle)
    }
}

impl WindingPiece {
    /// Makes the arc of a piece whose points have this rounding.
    fn new(piece: TrimPiece, rounding: f64) -> Self {
        let mut length = 0.0;
        let mut previous = piece.start();
        let mut bounds = [previous; 2];
        let mut lines = [true; 4];
        for (index, point) in piece.points().enumerate() {
            if index > 0 {
                length += previous.distance(point) + 2.0 * rounding;
            }
            previous = point;
            bounds = [bounds[0].min(point), bounds[1].max(point)];
            let on = [point.x == 0.0, point.x == 1.0, point.y == 0.0, point.y == 1.0];
            lines = [0, 1, 2, 3].map(|line| lines[line] && on[line]);
        }
        let margin = DVec2::splat(rounding);
        Self {
            ends: [piece.start(), piece.end()],
            length: length * (1.0 + gamma(64.0)) + 4.0 * rounding,
            bounds: [bounds[0] - margin, bounds[1] + margin],
            is_on_border: lines.contains(&true),
            piece,
        }
    }

    /// Returns the angle of the chord if the point is outside the ellipse.
    fn chord_angle(&self, point: DVec2) -> Option<f64> {
        let [from, to] = self.ends.map(|end| end - point);
        let outside = from.length() + to.length() > self.length;
        outside.then(|| from.perp_dot(to).atan2(from.dot(to)))
    }
}
