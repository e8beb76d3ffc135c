//! Where a region has no boundary, by a parabola near its loops.

use super::piece::{TrimPiece, point_of};
use super::winding::{Arc, Winding};
use crate::axis::Axis;
use crate::param_box::ParamBox;
use crate::rounding::{gamma, upper_max};
use glam::{DMat3, DVec2, DVec3};

/// The largest number of halvings of an arc, and of pieces of arcs in a box.
const MAX_HALVINGS: u32 = 32;
const MAX_PIECES: usize = 64;

/// The length of a piece relative to the box's diagonal.
const PIECE_LENGTH: f64 = 0.25;

/// How far beyond the parabola a box is extended, relative to its length.
const EXTENSION: f64 = 0.25;

/// The part of the trace that is added to the normal equations of a parabola.
const REGULARIZATION: f64 = 1e-13;

/// Roundings of a coefficient besides those for each product, relative to the sizes of its terms.
const COEFFICIENT_ROUNDINGS: f64 = 32.0;

/// A parabola over one parameter that says where a region has no boundary.
///
/// In fractions of the domain, relative to a point, and with v for the parameter along `axis` and u for the
/// other one: every point of the box with `±v < a + b u + c u²` belongs to the region, + if it is
/// upwards, and so does the whole side of the box towards which ±v falls.
#[derive(Debug, Clone, Copy)]
pub struct Rim {
    /// The axis of v.
    pub axis: Axis,
    /// Whether the region ends towards larger v.
    pub is_upwards: bool,
    /// a, b and c.
    pub coefficients: [f64; 3],
    /// The box, in fractions of the domain.
    pub region: ParamBox,
}

impl Winding {
    /// Finds the rim of the region in a box of parameters that is at least the one given, relative to a point;
    /// `None` where it is not found. O(pieces).
    ///
    /// The points of the box below the parabola by what arcs fall below it are connected by the box's lower
    /// side, no arc enters them, and one of them has winding number 1.
    #[must_use]
    pub fn rim(&self, parameters: &ParamBox, origin: [f64; 2]) -> Option<Rim> {
        let margin = DVec2::splat(self.rounding());
        let [low, high] = [parameters.low(), parameters.high()].map(|corner| self.fraction(corner.into()));
        let bounds = [(low - margin).clamp(DVec2::ZERO, DVec2::ONE), (high + margin).clamp(DVec2::ZERO, DVec2::ONE)];
        let is_inside = low.cmpge(-4.0 * margin).all() && high.cmple(DVec2::ONE + 4.0 * margin).all();
        if !(is_inside && bounds[0].cmplt(bounds[1]).all()) {
            return None;
        }
        let pieces = self.pieces_in(bounds)?;
        let graph = Graph::through(&pieces, bounds, self.fraction(origin.into()))?;
        [true, false].into_iter().find_map(|is_upwards| self.rim_of(&graph, bounds, is_upwards))
    }

    fn rim_of(&self, graph: &Graph, bounds: [DVec2; 2], is_upwards: bool) -> Option<Rim> {
        let sign = if is_upwards { 1.0 } else { -1.0 };
        let (v, u) = (graph.axis.index(), graph.axis.other().index());
        let [low, high] = bounds.map(|corner| corner.to_array());
        let lowest = graph.lowest(sign, [low[u], high[u]]);
        let [near, far] = if is_upwards { [low[v], high[v]] } else { [high[v], low[v]] };
        let bottom = (sign * (near - graph.origin[v])).min(lowest) - EXTENSION * (high[v] - low[v]);
        let side = graph.origin[v] + sign * bottom;
        if !(0.0..=1.0).contains(&side) {
            return None;
        }
        let [mut region, mut middle] = [ParamBox::new([low[0], high[0]], [low[1], high[1]]); 2];
        region[graph.axis] = [side.min(far), side.max(far)];
        middle[graph.axis] = [side; 2];
        let is_within = self.holds(middle.middle().into());
        let arcs = self.pieces_in([region.low().into(), region.high().into()])?;
        let depth = arcs.iter().map(|arc| -graph.least(&arc.piece, sign, self.rounding())).fold(0.0, upper_max);
        let holds = is_within && bottom < lowest - depth;
        let [a, b, c] = graph.coefficients.map(|coefficient| sign * coefficient);
        let rounding = 8.0 * self.rounding() * (1.0 + b.abs() + c.abs());
        let coefficients = [a - depth - rounding, b, c];
        holds.then_some(Rim { axis: graph.axis, is_upwards, coefficients, region })
    }

    /// The pieces of arcs that may enter a box, each short against it; `None` where they are many.
    fn pieces_in(&self, [low, high]: [DVec2; 2]) -> Option<Vec<Arc>> {
        let longest = PIECE_LENGTH * low.distance(high);
        let mut pieces = Vec::new();
        let arcs = self.arcs().filter(|arc| !arc.is_on_border && !arc.is_apart([low, high]));
        let mut stack: Vec<(Arc, u32)> = arcs.map(|arc| (arc.clone(), 0)).collect();
        while let Some((arc, halvings)) = stack.pop() {
            if arc.is_apart([low, high]) {
                continue;
            }
            if arc.length <= longest {
                pieces.push(arc);
            } else if halvings < MAX_HALVINGS && pieces.len() + stack.len() < MAX_PIECES {
                stack.extend(self.halves(&arc, halvings).map(|half| (half, halvings + 1)));
            } else {
                return None;
            }
        }
        Some(pieces)
    }
}

/// The function v = a + b u + c u² relative to a point.
struct Graph {
    axis: Axis,
    origin: DVec2,
    coefficients: [f64; 3],
}

impl Graph {
    /// The parabola nearest to the ends of these pieces, over the parameter along which they run in the box.
    fn through(pieces: &[Arc], [low, high]: [DVec2; 2], origin: DVec2) -> Option<Self> {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let run: DVec2 = pieces.iter().map(|arc| (arc.ends[1] - arc.ends[0]).abs() / half).sum();
        let axis = if run.x >= run.y { Axis::V } else { Axis::U };
        let (v, u) = (axis.index(), axis.other().index());
        let (mut matrix, mut right) = (DMat3::ZERO, DVec3::ZERO);
        for end in pieces.iter().flat_map(|arc| arc.ends) {
            let place = (end - middle) / half;
            let row = DVec3::new(1.0, place[u], place[u] * place[u]);
            matrix += DMat3::from_cols(row.x * row, row.y * row, row.z * row);
            right += place[v] * row;
        }
        let trace = matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z;
        let [h0, h1, h2] =
            ((matrix + DMat3::from_diagonal(DVec3::splat(REGULARIZATION * trace))).inverse() * right).to_array();
        // Relative to the point and not to the middle.
        let (shift, ratio) = ((origin[u] - middle[u]) / half[u], half[v] / half[u]);
        let coefficients = [
            middle[v] - origin[v] + half[v] * (h0 + shift * (h1 + shift * h2)),
            ratio * (h1 + 2.0 * shift * h2),
            ratio / half[u] * h2,
        ];
        coefficients.iter().all(|value| value.is_finite()).then_some(Self { axis, origin, coefficients })
    }

    /// The least value of ±v over a range of u.
    fn lowest(&self, sign: f64, range: [f64; 2]) -> f64 {
        let [a, b, c] = self.coefficients;
        let origin = self.origin[self.axis.other().index()];
        let [low, high] = range.map(|end| end - origin);
        let vertex = (-b / (2.0 * c)).clamp(low, high);
        let vertex = if vertex.is_nan() { low } else { vertex };
        let value = |u: f64| sign * (a + u * (b + u * c));
        value(low).min(value(high)).min(value(vertex))
    }

    /// A lower bound on `±(v - a - b u - c u²)` over a piece.
    ///
    /// With homogeneous controls (U, V, W) relative to the point, the coefficients of
    /// `±(V - a W - b U) W ∓ c U²` over those of W².
    fn least(&self, piece: &TrimPiece, sign: f64, rounding: f64) -> f64 {
        let [a, b, c] = self.coefficients;
        let (v, u) = (self.axis.index(), self.axis.other().index());
        let moved = |control: &DVec3| {
            let place = point_of(*control) - self.origin;
            [place[u], place[v], control.z]
        };
        let controls: Vec<[f64; 3]> = piece.controls.iter().map(moved).collect();
        let term = |[x, y, w]: [f64; 3], [other_x, _, other_w]: [f64; 3]| {
            let weight = w * other_w;
            (weight * sign * (y - a - b * x - c * x * other_x), weight)
        };
        let degree = piece.degree();
        let row = binomials(degree);
        let (mut values, mut weights) = (vec![0.0; 2 * degree + 1], vec![0.0; 2 * degree + 1]);
        for (i, left) in controls.iter().enumerate() {
            for (k, right) in controls.iter().enumerate() {
                let (value, weight) = term(*left, *right);
                values[i + k] += row[i] * row[k] * value;
                weights[i + k] += row[i] * row[k] * weight;
            }
        }
        let reach = controls.iter().fold(0.0, |reach, [x, ..]| upper_max(reach, x.abs()));
        let height = controls.iter().fold(0.0, |height, [_, y, _]| upper_max(height, y.abs()));
        let slope = 1.0 + b.abs() + 2.0 * c.abs() * reach;
        let roundings = (2 * (degree + 1)) as f64 + COEFFICIENT_ROUNDINGS;
        let of_points = rounding + gamma(f64::from(MAX_HALVINGS) * (2.0 * degree as f64 + 4.0));
        let sizes = height + a.abs() + reach * (b.abs() + reach * c.abs());
        let error = slope * of_points + gamma(2.0 * roundings) * sizes;
        let mut least = f64::INFINITY;
        for (value, weight) in values.iter().zip(&weights) {
            let value = value / weight;
            // NaN bounds nothing.
            least = if value >= least { least } else { value };
        }
        if least.is_nan() { f64::NEG_INFINITY } else { least - error }
    }
}

/// `C(n, k)` for k from 0 to n.
fn binomials(n: usize) -> Vec<f64> {
    let mut row = vec![1.0];
    for k in 0..n {
        row.push(row[k] * (n - k) as f64 / (k + 1) as f64);
    }
    row
}
