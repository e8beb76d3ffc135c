//! The power form of a patch, in parameters about its middle.

use crate::bezier::{MAX_ORDER, Patch};
use glam::DVec4;

impl Patch<'_> {
    /// Returns the homogeneous coefficients `c_ij` of `σ^i τ^j`, j fastest, with
    /// `s = (1 + σ)/2` and `t = (1 + τ)/2`, relative to the patch's centre.
    ///
    /// The change of basis has dyadic entries, and the absolute values in one
    /// column add up to at most `2^p`, so the error of a coefficient is at most
    /// `(p + q + 4) 2^(p + q - 53)` of the largest control. O(p q (p + q)).
    #[must_use]
    pub fn monomials(&self) -> Vec<DVec4> {
        let [p, q] = self.degree;
        let columns = q + 1;
        let mut coefficients = self.controls.to_vec();
        for row in coefficients.chunks_exact_mut(columns) {
            to_powers(row, q, 1);
        }
        for column in 0..columns {
            to_powers(&mut coefficients[column..], p, columns);
        }
        coefficients
    }
}

/// Converts one line of controls, which lie `stride` apart.
fn to_powers(line: &mut [DVec4], degree: usize, stride: usize) {
    let mut powers = [DVec4::ZERO; MAX_ORDER];
    for i in 0..=degree {
        let bernstein = bernstein_in_powers(degree, i);
        for (power, factor) in powers.iter_mut().zip(bernstein).take(degree + 1) {
            *power += factor * line[i * stride];
        }
    }
    for (k, power) in powers.iter().enumerate().take(degree + 1) {
        line[k * stride] = *power;
    }
}

/// Returns the coefficients of `C(p,i) ((1 + σ)/2)^i ((1 - σ)/2)^(p-i)` in powers
/// of σ; they are exact, being integers below 2^53 divided by `2^p`.
fn bernstein_in_powers(degree: usize, i: usize) -> [f64; MAX_ORDER] {
    let mut powers = [0.0; MAX_ORDER];
    powers[0] = (0..i).fold(1.0, |product, k| product * (degree - k) as f64 / (k + 1) as f64);
    for factor in 0..degree {
        let sign = if factor < i { 1.0 } else { -1.0 };
        for k in (0..=factor).rev() {
            powers[k + 1] += 0.5 * sign * powers[k];
            powers[k] *= 0.5;
        }
    }
    powers
}
