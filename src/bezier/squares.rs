//! Squares of rational functions in Bernstein form.

use super::product_weights;
use glam::{DVec4, Vec4Swizzles};

/// The Bernstein coefficients, of twice the degrees, of `|n|²` and `d²` of the
/// rational function n/d with homogeneous controls `(n, d)`, t fastest.
///
/// With `d > 0` their quotients contain between them the squared lengths that
/// the function takes. O(p^2 q^2).
pub(crate) fn squares(controls: &[DVec4], [p, q]: [usize; 2]) -> Vec<[f64; 2]> {
    let columns = 2 * q + 1;
    let mut squares = vec![[0.0; 2]; (2 * p + 1) * columns];
    let (in_s, in_t) = (product_weights(p, p), product_weights(q, q));
    for (a, x) in controls.iter().enumerate() {
        let (i, j) = (a / (q + 1), a % (q + 1));
        for (b, y) in controls.iter().enumerate() {
            let (k, l) = (b / (q + 1), b % (q + 1));
            let weight = in_s[i * (p + 1) + k] * in_t[j * (q + 1) + l];
            let square = &mut squares[(i + k) * columns + j + l];
            square[0] += weight * x.xyz().dot(y.xyz());
            square[1] += weight * x.w * y.w;
        }
    }
    squares
}

/// Roundings of a coefficient beside one for each of its products.
const ROUNDINGS_BESIDES: usize = 8;

/// The least and the largest length that a rational function with these
/// controls may take.
///
/// A coefficient of `|n|²` is off by its roundings times `Σ |n_i| |n_j|` of its
/// products, one of `d²` by theirs times `Σ d_i d_j`, so that their quotient is
/// off by the roundings times the longest `|n_i / d_i|` squared, at most.
pub(crate) fn lengths(controls: &[DVec4], degree: [usize; 2]) -> [f64; 2] {
    let (mut least, mut largest, mut longest) = (f64::INFINITY, 0.0_f64, 0.0_f64);
    for [length_squared, weight_squared] in squares(controls, degree) {
        let quotient = length_squared / weight_squared;
        (least, largest) = (least.min(quotient), largest.max(quotient));
    }
    for control in controls {
        longest = longest.max(control.xyz().length_squared() / (control.w * control.w));
    }
    let lost = (controls.len() + ROUNDINGS_BESIDES) as f64 * f64::EPSILON * longest;
    [(least - lost).max(0.0).sqrt(), (largest + lost).sqrt()]
}
