//! Bounds on a function by its interpolant at Chebyshev nodes (lemma T9 of docs/trimming.md).

use glam::DVec3;
use nurbs_hausdorff::workspace::chebyshev::{coefficients, nodes};

/// The numbers of nodes, for curves from straight ones to arcs of several turns.
pub(super) const COUNTS: [usize; 5] = [2, 4, 8, 16, 28];

/// Returns `count` nodes in [-1, 1].
pub(super) fn points(count: usize) -> impl Iterator<Item = f64> {
    nodes(count).map(|node| 2.0 * node - 1.0)
}

/// Returns an upper bound on the length of the polynomial with these values at the nodes, one
/// more than its degree: of its constant and linear part at the ends of [-1, 1], and of the
/// other Chebyshev coefficients by `|T_j| ≤ 1`.
pub(super) fn largest(values: &[DVec3]) -> f64 {
    let coefficients = coefficients(values);
    let (constant, linear) = (coefficients[0], coefficients[1]);
    let ends = (constant + linear).length().max((constant - linear).length());
    coefficients[2..].iter().fold(ends, |sum, coefficient| sum + coefficient.length())
}

/// Returns the factor `4 ρ^(1-n) / (ρ - 1)` of the error of the interpolant at n nodes of a
/// function that is analytic within the ellipse of half-axes (ρ ± 1/ρ) / 2.
pub(super) fn remainder(count: usize, rho: f64) -> f64 {
    4.0 * rho.powi(1 - count as i32) / (rho - 1.0)
}
