//! Bernstein coefficients of the polynomial through points.

use crate::approximation::elimination::eliminated;
use crate::limits::MAX_ORDER;
use std::f64::consts::PI;

/// Returns the values at `t` in [0, 1] of the Bernstein polynomials of a degree below
/// `MAX_ORDER`, in the first degree + 1 entries. O(degree²).
#[must_use]
pub fn bernstein(degree: usize, t: f64) -> [f64; MAX_ORDER] {
    let mut values = [0.0; MAX_ORDER];
    values[0] = 1.0;
    for level in 1..=degree {
        for index in (0..=level).rev() {
            let below = if index > 0 { values[index - 1] } else { 0.0 };
            values[index] = t * below + (1.0 - t) * values[index];
        }
    }
    values
}

/// The interpolation of values at the extrema of a Chebyshev polynomial on [0, 1].
pub struct Interpolation {
    nodes: Vec<f64>,
    /// The inverse of the matrix of the Bernstein polynomials at the nodes.
    inverse: Vec<Vec<f64>>,
}

impl Interpolation {
    /// Inverts the matrix, which is totally positive. The degree is at least 1 and below `MAX_ORDER`.
    /// O(degree⁴).
    #[must_use]
    pub fn new(degree: usize) -> Self {
        let order = degree + 1;
        let angle = |k: usize| PI * k as f64 / degree as f64;
        let nodes: Vec<f64> = (0..order).map(|k| (0.5 * angle(k)).sin().powi(2)).collect();
        let matrix: Vec<Vec<f64>> =
            nodes.iter().map(|&node| bernstein(degree, node)[..order].to_vec()).collect();
        let column = |k: usize| {
            let unit = (0..order).map(|row| if row == k { 1.0 } else { 0.0 }).collect();
            eliminated(matrix.clone(), unit)
        };
        let columns: Vec<Vec<f64>> = (0..order).map(column).collect();
        let inverse = (0..order).map(|row| columns.iter().map(|column| column[row]).collect()).collect();
        Self { nodes, inverse }
    }

    /// Returns the degree + 1 nodes, from 0 to 1.
    #[must_use]
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Returns, for each Bernstein coefficient of a polynomial, the weights of its values at the
    /// nodes in it. The first and the last coefficient are the values there.
    pub fn weights(&self) -> impl Iterator<Item = &[f64]> {
        self.inverse.iter().map(Vec::as_slice)
    }

    /// Returns the Bernstein coefficients of the polynomial with these values at the nodes.
    /// O(degree²).
    pub fn coefficients<T: crate::approximation::bernstein::Linear>(&self, values: &[T]) -> Vec<T> {
        let combined = |weights: &[f64]| {
            weights.iter().zip(values).fold(T::ZERO, |sum, (&weight, &value)| sum + value * weight)
        };
        self.weights().map(combined).collect()
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_is_reproduced_with_its_ends() {
        // x³ has the Bernstein coefficients C(k, 3) / C(n, 3) of degree n.
        for degree in [3, 7, 15] {
            let interpolation = Interpolation::new(degree);
            let values: Vec<f64> = interpolation.nodes().iter().map(|x| x * x * x).collect();
            let coefficients = interpolation.coefficients(&values);
            assert!(coefficients[0] == 0.0 && coefficients[degree] == 1.0);
            // The condition of the matrix is below 3^degree.
            let tolerance = 1e-15 * 3.0_f64.powi(degree as i32);
            for (k, found) in coefficients.iter().enumerate() {
                let expected = (k as f64 * (k as f64 - 1.0) * (k as f64 - 2.0))
                    / (degree as f64 * (degree as f64 - 1.0) * (degree as f64 - 2.0));
                assert!((found - expected).abs() <= tolerance, "{degree} {k} {found} {expected}");
            }
        }
    }
}
