//! Rational curves as polynomial pieces, with a proven bound on the error.

use crate::approximation::chebyshev::{coefficients, node_factor, nodes, to_bernstein};
use crate::rounding::upper_max;
use crate::untrim::curve::{Curve, divided};
use glam::DVec3;

/// The degrees tried, increasing.
const DEGREES: [usize; 4] = [3, 5, 6, 7];

/// The number of halvings of a curve that no piece of degree 7 approximates.
const MAX_DEPTH: usize = 24;

/// Returns polynomial curves head to tail with v increasing, and upper bounds on their
/// distances in u and v from `curve` at equal parameters, which are at most `tolerance`.
pub(super) fn polynomial_pieces(
    curve: &Curve,
    tolerance: [f64; 2],
) -> Result<(Vec<Curve>, [f64; 2]), String> {
    let mut pieces = Vec::new();
    let mut error = [0.0; 2];
    collect(curve, tolerance, MAX_DEPTH, &mut pieces, &mut error)?;
    Ok((pieces, error))
}

fn collect(
    curve: &Curve,
    tolerance: [f64; 2],
    depth: usize,
    pieces: &mut Vec<Curve>,
    error: &mut [f64; 2],
) -> Result<(), String> {
    for degree in DEGREES {
        let (piece, found) = approximation(curve, degree);
        let is_rising = piece.rise().iter().all(|&value| value >= 0.0);
        if is_rising && (0..2).all(|axis| found[axis] <= tolerance[axis]) {
            *error = [error[0].max(found[0]), error[1].max(found[1])];
            pieces.push(piece);
            return Ok(());
        }
    }
    if depth == 0 {
        let start = curve.start();
        return Err(format!("a curve near ({}, {}) that no polynomial approximates", start.x, start.y));
    }
    collect(&curve.restricted(0.0, 0.5), tolerance, depth - 1, pieces, error)?;
    collect(&curve.restricted(0.5, 1.0), tolerance, depth - 1, pieces, error)
}

/// Returns the polynomial of this degree through the curve's ends and near it between,
/// with the bound: the residual times w is a polynomial.
fn approximation(curve: &Curve, degree: usize) -> (Curve, [f64; 2]) {
    let points: Vec<_> = nodes(degree + 1).map(|t| curve.point(t)).collect();
    let [u, v] = [0, 1].map(|axis| {
        let series = coefficients(&points.iter().map(|point| point[axis]).collect::<Vec<_>>());
        let mut controls = to_bernstein(&series, degree);
        let (start, end) = (curve.start()[axis], curve.end()[axis]);
        let (at_start, at_end) = (start - controls[0], end - controls[degree]);
        for (k, control) in controls.iter_mut().enumerate() {
            let share = k as f64 / degree as f64;
            *control += (1.0 - share) * at_start + share * at_end;
        }
        (controls[0], controls[degree]) = (start, end);
        controls
    });
    let controls = u.into_iter().zip(v).map(|(u, v)| DVec3::new(u, v, 1.0)).collect();
    let piece = Curve { controls };
    let total = degree + curve.degree();
    let count = 2 * total;
    let least = curve.controls.iter().map(|control| control.z).fold(f64::INFINITY, f64::min);
    let mut error = [0.0_f64; 2];
    for t in nodes(count) {
        let homogeneous = curve.at(t);
        let difference = (divided(homogeneous) - piece.point(t)).abs() * (homogeneous.z / least);
        error = [upper_max(error[0], difference.x), upper_max(error[1], difference.y)];
    }
    (piece, error.map(|value| value * node_factor(total, count)))
}
