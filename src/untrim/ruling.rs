//! Cells as ruled maps of the unit square, which do not fold.

use super::arcs::Side;
use super::curve::{Curve, divided, elevated, halves, product};
use super::face::{Face, V_ROUNDING};
use super::graph::Graph;
use super::sweep::Cell;
use crate::chebyshev::{coefficients, node_factor, nodes, to_bernstein};
use glam::{DVec2, DVec3};

/// The map `φ(s, t) = (1 - s) left(t) + s right(t)` of the unit square onto a cell.
#[derive(Debug, Clone)]
pub(super) struct Ruling {
    pub(super) left: Curve,
    pub(super) right: Curve,
    /// The degree of v in t where both sides have the same v and weight at equal t;
    /// `None` where they differ.
    pub(super) height: Option<usize>,
    pub(super) rectangle: [usize; 2],
    /// An upper bound on the distance in u between the map's image and the cell.
    pub(super) error: f64,
}

/// A cell that is one ruled map, several cells to be mapped, or one to be halved.
pub(super) enum Mapped {
    One(Ruling),
    Cells([Cell; 2]),
    Halve,
}

/// The degrees tried for the composition of a graph with a height function, increasing.
const COMPOSITE_DEGREES: [usize; 9] = [1, 2, 3, 4, 5, 7, 9, 12, 15];

/// The parts of the tolerance of crossings that the crossing of the sides and each of the two
/// shifts of a side may take.
const CROSSING_PART: f64 = 0.5;
const SHIFT_PART: f64 = 0.25;

/// The highest degree in s of a patch over rulings that are no parameter lines.
const MAX_TILTED_DEGREE: usize = crate::limits::MAX_DEGREE;

/// The number of halvings in the proof that a difference has one sign.
const MAX_SIGN_DEPTH: usize = 30;

/// Coefficients of a Jacobian count as 0 below this part of the largest.
const JACOBIAN_ROUNDING: f64 = 256.0 * f64::EPSILON;

/// Maps a cell, or says how to cut it.
pub(super) fn mapped(face: &Face, cell: &Cell) -> Mapped {
    match &cell.sides {
        [Side::Graph(left), Side::Graph(right)] => {
            matched(face, cell, left.restricted(cell.v), right.restricted(cell.v), 1, 0.0)
        }
        [Side::Own(curve), Side::Graph(graph)] => {
            let left = part(curve, cell.v);
            match composed(face, graph, &left) {
                Some((right, error)) => {
                    let height = left.degree();
                    matched(face, cell, left, right, height, error)
                }
                None => Mapped::Halve,
            }
        }
        [Side::Graph(graph), Side::Own(curve)] => {
            let right = part(curve, cell.v);
            match composed(face, graph, &right) {
                Some((left, error)) => {
                    let height = right.degree();
                    matched(face, cell, left, right, height, error)
                }
                None => Mapped::Halve,
            }
        }
        [Side::Own(left), Side::Own(right)] => {
            two_curves(face, cell, part(left, cell.v), part(right, cell.v))
        }
    }
}

/// Returns the part of a curve of increasing v over an interval of v.
fn part(curve: &Curve, [low, high]: [f64; 2]) -> Curve {
    if low == high {
        return curve.clone();
    }
    curve.restricted(curve.solve(low), curve.solve(high))
}

/// Returns the map between two sides with equal v and weight at equal parameters.
fn matched(face: &Face, cell: &Cell, left: Curve, right: Curve, height: usize, error: f64) -> Mapped {
    let degree = left.degree().max(right.degree());
    let (left, right) = (elevated(&left.controls, degree), elevated(&right.controls, degree));
    let difference: Vec<DVec2> = left.iter().zip(&right).map(|(l, r)| DVec2::new(r.x - l.x, l.z)).collect();
    let Some(crossing) = negative_part(&difference, CROSSING_PART * face.tolerances.crossing) else {
        return Mapped::Halve;
    };
    let (left, right) = (Curve { controls: left }, Curve { controls: right });
    let Some((left, right, shift)) = confined(face, cell, left, right) else {
        return Mapped::Halve;
    };
    let rectangle = cell.rectangle;
    // Sides that cross, and sides moved inwards, are at most this far from the cell's.
    let error = error + crossing + shift;
    Mapped::One(Ruling { left, right, height: Some(height), rectangle, error })
}

/// Returns the sides moved into the cell's rectangle of knots, and by how much, if that is
/// within the tolerance of crossings: only there the patch is the surface (lemma T3).
fn confined(face: &Face, cell: &Cell, left: Curve, right: Curve) -> Option<(Curve, Curve, f64)> {
    let [low, high] = face.rectangle(cell.rectangle)[0];
    let mut largest = 0.0_f64;
    let mut moved = |curve: Curve, edge: f64, sign: f64| {
        let room: Vec<DVec2> =
            curve.controls.iter().map(|c| DVec2::new(sign * (c.x - edge * c.z), c.z)).collect();
        let outside = negative_part(&room, SHIFT_PART * face.tolerances.crossing)?;
        largest = largest.max(outside);
        let shifted = |c: &DVec3| DVec3::new(c.x + sign * outside * c.z, c.y, c.z);
        Some(if outside > 0.0 {
            Curve { controls: curve.controls.iter().map(shifted).collect() }
        } else {
            curve
        })
    };
    let (left, right) = (moved(left, low, 1.0)?, moved(right, low, 1.0)?);
    let (left, right) = (moved(left, high, -1.0)?, moved(right, high, -1.0)?);
    Some((left, right, 2.0 * largest))
}

/// Returns an upper bound on the negative part of a rational function with these Bernstein
/// coefficients, if it is at most `tolerance`: the sharpest of a few that can be proven.
fn negative_part(coefficients: &[DVec2], tolerance: f64) -> Option<f64> {
    let sharp = [V_ROUNDING, tolerance / 256.0, tolerance / 16.0, tolerance];
    sharp.into_iter().find_map(|bound| reversal(coefficients, bound.min(tolerance), MAX_SIGN_DEPTH))
}

/// Returns an upper bound on the negative part of a rational function with these
/// Bernstein coefficients of numerator and denominator, if it is at most `tolerance`.
fn reversal(coefficients: &[DVec2], tolerance: f64, depth: usize) -> Option<f64> {
    let negative = |c: &DVec2| (-c.x / c.y).max(0.0);
    let bound = coefficients.iter().map(negative).fold(0.0, f64::max);
    if bound <= tolerance {
        return Some(bound);
    }
    let ends = [coefficients[0], coefficients[coefficients.len() - 1]];
    if depth == 0 || ends.iter().map(negative).any(|value| value > tolerance) {
        return None;
    }
    let [low, high] = halves(coefficients);
    Some(reversal(&low, tolerance, depth - 1)?.max(reversal(&high, tolerance, depth - 1)?))
}

/// Returns the graph as a curve with the same v and weight as `height` at equal
/// parameters, with a proven bound on its distance in u from the graph.
fn composed(face: &Face, graph: &Graph, height: &Curve) -> Option<(Curve, f64)> {
    let degree = height.degree();
    if graph.degree() <= 1 {
        // u is affine in v.
        let from = graph.coefficients[0];
        let slope = match graph.coefficients.get(1) {
            Some(to) => (to - from) / (graph.v[1] - graph.v[0]),
            None => 0.0,
        };
        // A slope may be steep enough to magnify the rounding of v to a visible step: where v
        // is between the ends, u stays there, too.
        let to = graph.coefficients[graph.degree()];
        let (low, high) = (from.min(to), from.max(to));
        let control = |c: &DVec3| {
            let (u, v) = (from * c.z + slope * (c.y - graph.v[0] * c.z), c.y / c.z);
            let is_between = graph.v[0] - V_ROUNDING <= v && v <= graph.v[1] + V_ROUNDING;
            DVec3::new(if is_between { u.clamp(low * c.z, high * c.z) } else { u }, c.y, c.z)
        };
        return Some((Curve { controls: height.controls.iter().map(control).collect() }, 0.0));
    }
    let value = |t: f64| {
        let homogeneous = height.at(t);
        (homogeneous, graph.at(divided(homogeneous).y))
    };
    let least = height.controls.iter().map(|control| control.z).fold(f64::INFINITY, f64::min);
    let ends = [value(0.0).1, value(1.0).1];
    for own in COMPOSITE_DEGREES {
        let samples: Vec<f64> = nodes(own + 1).map(value).map(|(homogeneous, u)| homogeneous.z * u).collect();
        let mut x = to_bernstein(&coefficients(&samples), own);
        let weights = [height.controls[0].z, height.controls[degree].z];
        let shifts = [ends[0] * weights[0] - x[0], ends[1] * weights[1] - x[own]];
        for (k, x) in x.iter_mut().enumerate() {
            let share = k as f64 / own as f64;
            *x += (1.0 - share) * shifts[0] + share * shifts[1];
        }
        // (x - w g(y / w)) w^(m - 1) is a polynomial, m the degree of g.
        let power = graph.degree() - 1;
        let total = (own + degree * power).max(degree * graph.degree());
        let count = 2 * total;
        let mut largest = 0.0_f64;
        for t in nodes(count) {
            let (homogeneous, u) = value(t);
            let residual = super::curve::casteljau(&x, t) - homogeneous.z * u;
            largest = largest.max(residual.abs() / least * (homogeneous.z / least).powi(power as i32));
        }
        let error = largest * node_factor(total, count);
        if error <= face.tolerances.composite {
            let raised = own.max(degree);
            let x = x.iter().map(|&x| DVec3::new(x, 0.0, 0.0)).collect::<Vec<_>>();
            let (x, height) = (elevated(&x, raised), elevated(&height.controls, raised));
            let controls = x.iter().zip(&height).map(|(x, h)| DVec3::new(x.x, h.y, h.z)).collect();
            return Some((Curve { controls }, error));
        }
    }
    None
}

/// Maps a cell between two curves in their own parameters.
fn two_curves(face: &Face, cell: &Cell, left: Curve, right: Curve) -> Mapped {
    if is_level(&left, &right) {
        let height = left.degree();
        return matched(face, cell, left, right, height, 0.0);
    }
    let degree: usize = face.patch(cell.rectangle).degree.iter().sum();
    let is_tilted = (face.affine || degree <= MAX_TILTED_DEGREE) && is_unfolded(&left, &right);
    if is_tilted && let Some((left, right, error)) = confined(face, cell, left.clone(), right.clone()) {
        return Mapped::One(Ruling { left, right, height: None, rectangle: cell.rectangle, error });
    }
    // A straight line between them, if their boxes at the ends leave room for one.
    let [low, high] = [0.5 * (left.start().x + right.start().x), 0.5 * (left.end().x + right.end().x)];
    let line = Side::Graph(Graph::line([low, high], cell.v));
    let cells = [
        Cell { sides: [cell.sides[0].clone(), line.clone()], ..cell.clone() },
        Cell { sides: [line, cell.sides[1].clone()], ..cell.clone() },
    ];
    if cells.iter().all(|cell| matches!(mapped(face, cell), Mapped::One(_))) {
        return Mapped::Cells(cells);
    }
    Mapped::Halve
}

/// Returns whether two curves have the same v and weight at equal parameters, up to rounding.
fn is_level(left: &Curve, right: &Curve) -> bool {
    left.degree() == right.degree()
        && left.controls.iter().zip(&right.controls).all(|(l, r)| {
            (l.y - r.y).abs() <= 4.0 * f64::EPSILON && (l.z - r.z).abs() <= 4.0 * f64::EPSILON * l.z
        })
}

/// Returns whether the map between the curves has a Jacobian of one sign: its Bernstein
/// coefficients, after multiplication with positive powers of the weights, have one.
///
/// The Jacobian is linear in s, so that it is enough to test s = 0 and s = 1:
/// `det(right - left, left')` and `det(right - left, right')` (lemma T6).
fn is_unfolded(left: &Curve, right: &Curve) -> bool {
    let coordinate = |curve: &Curve, axis: usize| -> Vec<f64> {
        curve.controls.iter().map(|control| control[axis]).collect()
    };
    let [left_weight, right_weight] = [coordinate(left, 2), coordinate(right, 2)];
    let across = [0, 1].map(|axis| {
        let r = product(&coordinate(right, axis), &left_weight);
        let l = product(&coordinate(left, axis), &right_weight);
        r.iter().zip(&l).map(|(r, l)| r - l).collect::<Vec<f64>>()
    });
    [left, right].iter().all(|curve| {
        let along = [curve.derivative(0), curve.derivative(1)];
        let plus = product(&across[0], &along[1]);
        let minus = product(&across[1], &along[0]);
        let size = plus.iter().chain(&minus).fold(0.0, |size: f64, value| size.max(value.abs()));
        plus.iter().zip(&minus).all(|(plus, minus)| plus - minus >= -JACOBIAN_ROUNDING * size)
    })
}
