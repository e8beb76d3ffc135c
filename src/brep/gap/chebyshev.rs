//! Interpolation at Chebyshev nodes.

use glam::DVec3;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// The zeros of a Chebyshev polynomial T_n and the values there of those of lower degree.
pub(super) struct Nodes {
    pub(super) count: usize,
    /// `cos(π m / 2n)`.
    cosines: Vec<f64>,
}

/// Nodes for curves from straight ones to arcs of several turns.
pub(super) static NODES: LazyLock<[Nodes; 5]> = LazyLock::new(|| [2, 4, 8, 16, 28].map(Nodes::new));

impl Nodes {
    fn new(count: usize) -> Self {
        let cosines = (0..4 * count).map(|m| (0.5 * PI * m as f64 / count as f64).cos()).collect();
        Self { count, cosines }
    }

    /// Returns the nodes in [-1, 1].
    pub(super) fn points(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.count).map(|k| self.cosines[2 * k + 1])
    }

    /// Returns an upper bound on the length of the polynomial of degree n - 1 with these values
    /// at the nodes: of its constant and linear part at the ends of [-1, 1], and of
    /// the other Chebyshev coefficients by `|T_j| ≤ 1`.
    pub(super) fn largest(&self, values: &[DVec3]) -> f64 {
        let coefficient = |j: usize| -> DVec3 {
            let angle = |k: usize| j * (2 * k + 1) % (4 * self.count);
            let sum: DVec3 =
                values.iter().enumerate().map(|(k, &value)| self.cosines[angle(k)] * value).sum();
            sum * (if j == 0 { 1.0 } else { 2.0 } / self.count as f64)
        };
        let (constant, linear) = (coefficient(0), coefficient(1));
        let ends = (constant + linear).length().max((constant - linear).length());
        (2..self.count).fold(ends, |sum, j| sum + coefficient(j).length())
    }

    /// Returns the factor `4 ρ^(1-n) / (ρ - 1)` of the error of the interpolant of a function
    /// that is analytic within the ellipse of half-axes (ρ ± 1/ρ) / 2.
    pub(super) fn remainder(&self, rho: f64) -> f64 {
        4.0 * rho.powi(1 - self.count as i32) / (rho - 1.0)
    }
}
