//! Boundaries as graphs u = g(v) of polynomials, with a proven bound on the error.

use super::run::Run;
use crate::approximation::chebyshev::{coefficients, node_factor, nodes, to_bernstein};
use crate::rounding::upper_max;
use crate::untrim::curve::{Curve, casteljau, divided, restricted};
use glam::{DVec2, DVec3};

/// The degrees tried, increasing; above 9 more pieces are cheaper than higher degrees.
const DEGREES: [usize; 7] = [1, 2, 3, 4, 5, 7, 9];

/// The largest of [`DEGREES`].
const MAX_GRAPH_DEGREE: usize = 9;

/// The number of nodes, in multiples of the residual's degree, at which it is evaluated:
/// its largest value there is within a factor √2 of its largest value.
const OVERSAMPLING: usize = 2;

/// The polynomial graph u = g(v) over an interval.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::untrim) struct Graph {
    /// The interval of v.
    pub(in crate::untrim) v: [f64; 2],
    /// The Bernstein coefficients of g over it.
    pub(in crate::untrim) coefficients: Vec<f64>,
}

impl Graph {
    /// Makes the straight line from (u0, v0) to (u1, v1).
    pub(in crate::untrim) fn line(u: [f64; 2], v: [f64; 2]) -> Self {
        let coefficients = if u[0] == u[1] { vec![u[0]] } else { u.to_vec() };
        Self { v, coefficients }
    }

    pub(in crate::untrim) fn degree(&self) -> usize {
        self.coefficients.len() - 1
    }

    fn local(&self, v: f64) -> f64 {
        ((v - self.v[0]) / (self.v[1] - self.v[0])).clamp(0.0, 1.0)
    }

    /// Returns g(v). O(degree²).
    pub(in crate::untrim) fn at(&self, v: f64) -> f64 {
        casteljau(&self.coefficients, self.local(v))
    }

    /// Returns the part over [from, to] as a curve of constant speed in v, of degree at least 1.
    pub(in crate::untrim) fn restricted(&self, [from, to]: [f64; 2]) -> Curve {
        let mut values = restricted(&self.coefficients, [self.local(from), self.local(to)]);
        if values.len() == 1 {
            values.push(values[0]);
        }
        let degree = (values.len() - 1) as f64;
        let at = |share: f64| (1.0 - share) * from + share * to;
        let controls =
            values.iter().enumerate().map(|(k, &u)| DVec3::new(u, at(k as f64 / degree), 1.0)).collect();
        Curve { controls }
    }
}

/// Returns a graph of least degree for a chain of runs of increasing v, head to tail,
/// that has the chain's ends and is within `tolerance` of it in u at equal v, with the proven
/// bound; `None` where degree 9 does not suffice.
pub(super) fn fit(chain: &[Run], [start, end]: [DVec2; 2], tolerance: f64) -> Option<(Graph, f64)> {
    let v = [start.y, end.y];
    let u_at = |v: f64| {
        let piece = chain.partition_point(|run| run.ends[1].y < v).min(chain.len() - 1);
        let curve = &chain[piece].curve;
        curve.point(curve.solve(v)).x
    };
    let values: Vec<f64> = nodes(MAX_GRAPH_DEGREE + 1).map(|x| u_at((1.0 - x) * v[0] + x * v[1])).collect();
    let series = coefficients(&values);
    for degree in DEGREES {
        let estimate: f64 = series[degree + 1..].iter().map(|c| c.abs()).sum();
        // The last coefficients say whether the series converges at all.
        if estimate > tolerance || series[MAX_GRAPH_DEGREE].abs() > 0.25 * tolerance {
            continue;
        }
        let mut bernstein = to_bernstein(&series, degree);
        // The ends are exact, so that neighbouring cells share their corners.
        let (at_start, at_end) = (start.x - bernstein[0], end.x - bernstein[degree]);
        for (k, coefficient) in bernstein.iter_mut().enumerate() {
            let share = k as f64 / degree as f64;
            *coefficient += (1.0 - share) * at_start + share * at_end;
        }
        (bernstein[0], bernstein[degree]) = (start.x, end.x);
        if degree == 1 && start.x == end.x {
            bernstein.truncate(1);
        }
        let graph = Graph { v, coefficients: bernstein };
        let error = chain.iter().map(|run| residual(&graph, &run.curve)).fold(0.0, upper_max);
        if error <= tolerance {
            return Some((graph, error));
        }
    }
    None
}

/// Returns an upper bound on |u(τ) - g(v(τ))| along the curve.
///
/// The product with w^m, m the degree of g, is a polynomial of degree d m in τ, which
/// [`node_factor`] bounds from its values at nodes.
pub(in crate::untrim) fn residual(graph: &Graph, curve: &Curve) -> f64 {
    let at = |point: DVec2| (point.x - graph.at(point.y)).abs();
    if curve.degree() == 1 && curve.is_polynomial() && graph.degree() <= 1 {
        // Two straight lines differ most at an end.
        return upper_max(at(curve.start()), at(curve.end()));
    }
    let power = graph.degree().max(1);
    let degree = curve.degree() * power;
    let count = (OVERSAMPLING * degree).max(2);
    let least = curve.controls.iter().map(|control| control.z).fold(f64::INFINITY, f64::min);
    let mut largest = 0.0_f64;
    for node in nodes(count) {
        let homogeneous = curve.at(node);
        let weight = (homogeneous.z / least).powi(power as i32);
        largest = upper_max(largest, weight * at(divided(homogeneous)));
    }
    largest * node_factor(degree, count)
}
