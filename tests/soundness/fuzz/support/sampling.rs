//! Samples of a model by the independent evaluator, with the distance from any
//! point of the model to the nearest sample.

use crate::support::evaluator::{Vector, distance, evaluate_on_span, length};
use nurbs_hausdorff::{Axis, Model, NurbsSurface};

/// Points of a model that come within `radius` of every point of it.
pub struct Samples {
    pub points: Vec<Vector>,
    pub radius: f64,
}

impl Samples {
    /// `steps` steps along each axis of every span.
    pub fn new(model: &Model, steps: usize) -> Self {
        let (mut points, mut radius) = (Vec::new(), 0.0_f64);
        for surface in model.surfaces() {
            let speed = Axis::BOTH.map(|axis| speed(surface, axis));
            let [us, vs] = Axis::BOTH.map(|axis| spans(surface, axis));
            for &u in &us {
                for &v in &vs {
                    let [[u0, u1], [v0, v1]] = [ends(surface, Axis::U, u), ends(surface, Axis::V, v)];
                    // Half a step along each axis.
                    let half = [u1 - u0, v1 - v0].map(|width| 0.5 * width / steps as f64);
                    radius = radius.max(half[0] * speed[0] + half[1] * speed[1]);
                    for index in 0..(steps + 1) * (steps + 1) {
                        let part = |index: usize| index as f64 / steps as f64;
                        let [x, y] = [part(index / (steps + 1)), part(index % (steps + 1))];
                        let (u, v, spans) = ((1.0 - x) * u0 + x * u1, (1.0 - y) * v0 + y * v1, [u, v]);
                        points.push(evaluate_on_span(surface, spans, u, v, [0.0; 3]).point);
                    }
                }
            }
        }
        Self { points, radius }
    }

    /// The distance from a point to the nearest sample, an upper bound on that to the model.
    pub fn distance(&self, point: Vector) -> f64 {
        self.points.iter().map(|&sample| distance(sample, point)).fold(f64::INFINITY, f64::min)
    }

    /// Lower and upper bounds on the directed distance to the other model.
    pub fn directed_distance(&self, other: &Self) -> [f64; 2] {
        let sampled = self.points.iter().map(|&point| other.distance(point)).fold(0.0, f64::max);
        [(sampled - other.radius).max(0.0), sampled + self.radius]
    }
}

/// The indices of the knots at which the non-empty spans of the domain begin.
pub fn spans(surface: &NurbsSurface, axis: Axis) -> Vec<usize> {
    let knots = surface.knots(axis);
    (surface.degree()[axis]..surface.counts()[axis]).filter(|&i| knots[i] < knots[i + 1]).collect()
}

/// The index of the knot at which the span around a parameter begins.
pub fn span_at(surface: &NurbsSurface, axis: Axis, parameter: f64) -> usize {
    spans(surface, axis).into_iter().rfind(|&span| ends(surface, axis, span)[0] <= parameter).unwrap()
}

/// The ends of the span that begins at this knot.
pub fn ends(surface: &NurbsSurface, axis: Axis, span: usize) -> [f64; 2] {
    [surface.knots(axis)[span], surface.knots(axis)[span + 1]]
}

/// An upper bound on the length of the derivative along an axis.
///
/// With X = w (x - c) the derivative is `(X' - w' (x - c)) / w`, and X', w' are
/// convex combinations of the differences of the homogeneous net (The NURBS
/// Book, eq. 3.8).
fn speed(surface: &NurbsSurface, axis: Axis) -> f64 {
    let (net, [rows, columns]) = (surface.control_points(), surface.counts());
    let (knots, degree) = (surface.knots(axis), surface.degree()[axis]);
    let center = [net[0][0], net[0][1], net[0][2]];
    let local = |index: usize| [0, 1, 2].map(|k| net[index][k] - center[k]);
    let (stride, count) = if axis == Axis::U { (columns, rows) } else { (1, columns) };
    let (mut radius, mut lightest, mut space, mut weight) = (0.0_f64, f64::INFINITY, 0.0_f64, 0.0_f64);
    for index in 0..net.len() {
        radius = radius.max(length(local(index)));
        lightest = lightest.min(net[index][3]);
        let along = if axis == Axis::U { index / columns } else { index % columns };
        if along + 1 == count {
            continue;
        }
        let width = knots[along + degree + 1] - knots[along + 1];
        if width > 0.0 {
            let (next, scale) = (index + stride, degree as f64 / width);
            let weighted = |index: usize| local(index).map(|x| net[index][3] * x);
            space = space.max(scale * distance(weighted(index), weighted(next)));
            weight = weight.max(scale * (net[next][3] - net[index][3]).abs());
        }
    }
    (space + weight * radius) / lightest
}
