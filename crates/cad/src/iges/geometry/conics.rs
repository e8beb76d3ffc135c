//! Arcs of conics by the coefficients of their equation, type 104.

use super::Scale;
use crate::iges::file::{Entity, Found};
use crate::nurbs::{Conic, Curve, nearest_parameter};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// The angle below which an arc is a whole turn: its ends are one point to the digits of files.
const NO_ANGLE: f64 = 1e-9;

/// The part of the larger coefficient below which the other one of a parabola is 0.
const PARABOLIC: f64 = 1e-9;

/// Reads an arc of `A x² + B x y + C y² + D x + E y + F = 0` from one point to another: of an
/// ellipse counter-clockwise.
pub(super) fn conic(entity: &Entity, scale: Scale) -> Found<(Curve, [f64; 2])> {
    let fault = || entity.fault(1, "the equation of an ellipse, a parabola or a hyperbola");
    let [a, b, c, d, e, f] = [1, 2, 3, 4, 5, 6].map(|index| entity.real(index));
    let [a, b, c, d, e, f] = [a?, b?, c?, d?, e?, f?];
    let height = entity.real(7)?;
    let at = |index: usize| -> Found<DVec3> {
        Ok(DVec3::new(entity.real(index)?, entity.real(index + 1)?, height))
    };
    let [start, end] = [at(8)?, at(10)?];
    // In the axes of the quadratic form: p x² + q y² + r x + s y + f = 0.
    let angle = if b == 0.0 { 0.0 } else { 0.5 * b.atan2(a - c) };
    let (along, across) = (DVec2::from_angle(angle), DVec2::from_angle(angle).perp());
    let form = |v: DVec2| a * v.x * v.x + b * v.x * v.y + c * v.y * v.y;
    let linear = |v: DVec2| d * v.x + e * v.y;
    let local = Equation {
        axes: [along, across],
        squares: [form(along), form(across)],
        linear: [linear(along), linear(across)],
        constant: f,
    };
    let [p, q] = local.squares;
    let (curve, is_ellipse) = if (p * q).abs() <= PARABOLIC * p.abs().max(q.abs()).powi(2) {
        (local.parabola(), false)
    } else if p * q > 0.0 {
        (local.ellipse(), true)
    } else {
        (local.hyperbola(start.truncate()), false)
    };
    let Curve::Conic { conic, center, x, y } = curve.ok_or_else(fault)? else { return Err(fault()) };
    let curve = Curve::Conic { conic, center: center.with_z(height), x, y };
    let ends = [start, end].map(|end| nearest_parameter(&curve, end));
    let [Some(from), Some(to)] = ends else { return Err(fault()) };
    let curve = match curve {
        Curve::Conic { conic, center, x, y } => {
            Curve::Conic { conic, center: scale.0 * center, x: scale.0 * x, y: scale.0 * y }
        }
        other => other,
    };
    if is_ellipse {
        return Ok((curve, range_of(from, to)));
    }
    match from.partial_cmp(&to) {
        Some(std::cmp::Ordering::Less) => Ok((curve, [from, to])),
        Some(std::cmp::Ordering::Greater) => Ok((curve.reversed(), [-from, -to])),
        _ => Err(entity.fault(8, "two points that differ")),
    }
}

/// The equation of a conic in the axes of its quadratic form.
struct Equation {
    axes: [DVec2; 2],
    squares: [f64; 2],
    linear: [f64; 2],
    constant: f64,
}

impl Equation {
    fn vector(&self, x: f64, y: f64) -> DVec3 {
        (x * self.axes[0] + y * self.axes[1]).extend(0.0)
    }

    /// Returns the centre, and the squares of the half axes, negative along those that the curve
    /// does not meet.
    fn centered(&self) -> ([f64; 2], [f64; 2]) {
        let center = [0, 1].map(|axis| -self.linear[axis] / (2.0 * self.squares[axis]));
        let level = self.squares[0] * center[0] * center[0] + self.squares[1] * center[1] * center[1];
        let halves = self.squares.map(|square| (level - self.constant) / square);
        (center, halves)
    }

    fn ellipse(&self) -> Option<Curve> {
        let ([x, y], [a, b]) = self.centered();
        (a > 0.0 && b > 0.0).then(|| Curve::Conic {
            conic: Conic::Elliptic,
            center: self.vector(x, y),
            x: self.vector(a.sqrt(), 0.0),
            y: self.vector(0.0, b.sqrt()),
        })
    }

    /// The branch of the hyperbola on the side of a point.
    fn hyperbola(&self, on_side: DVec2) -> Option<Curve> {
        let ([x, y], [a, b]) = self.centered();
        let (across, along) = match (a > 0.0, b > 0.0) {
            (true, false) => (self.vector(a.sqrt(), 0.0), self.vector(0.0, (-b).sqrt())),
            (false, true) => (self.vector(0.0, b.sqrt()), self.vector((-a).sqrt(), 0.0)),
            _ => return None,
        };
        let center = self.vector(x, y);
        let side = if (on_side.extend(0.0) - center).dot(across) < 0.0 { -1.0 } else { 1.0 };
        Some(Curve::Conic { conic: Conic::Hyperbolic, center, x: side * across, y: along })
    }

    /// `y = -(p x² + r x + f) / s` in the axes, with the larger square's first.
    fn parabola(&self) -> Option<Curve> {
        let first = usize::from(self.squares[1].abs() > self.squares[0].abs());
        let second = 1 - first;
        let (p, r, s) = (self.squares[first], self.linear[first], self.linear[second]);
        let at = |x: f64, y: f64| {
            let mut local = [0.0; 2];
            (local[first], local[second]) = (x, y);
            self.vector(local[0], local[1])
        };
        let (x, y) = (-r / (2.0 * p), (r * r / (4.0 * p) - self.constant) / s);
        let center = at(x, y);
        let (opening, tangent) = (at(0.0, -p / s), at(1.0, 0.0));
        (center.is_finite() && opening.is_finite()).then_some(Curve::Conic {
            conic: Conic::Parabolic,
            center,
            x: opening,
            y: tangent,
        })
    }
}

/// Returns the range from an angle counter-clockwise to another one, a whole turn for equal ones.
pub(super) fn range_of(start: f64, end: f64) -> [f64; 2] {
    let angle = (end - start).rem_euclid(TAU);
    [start, start + if angle <= NO_ANGLE { TAU } else { angle }]
}
