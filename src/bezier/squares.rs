//! Squares of rational functions in Bernstein form.

use super::{MAX_ORDER, product_weights};
use glam::{DVec4, Vec4Swizzles};
use std::sync::OnceLock;

/// The Bernstein coefficients, of twice the degrees, of `|n|²` and `d²` of the
/// rational function n/d with homogeneous controls `(n, d)`, t fastest; degrees
/// are at most twice those of patches.
///
/// With `d > 0` their quotients contain between them the squared lengths that
/// the function takes. O(p^2 q^2).
pub(crate) fn squares([p, q]: [usize; 2], controls: &[DVec4]) -> Vec<(f64, f64)> {
    let (columns, doubled) = (q + 1, 2 * q + 1);
    let mut squares = vec![(0.0_f64, 0.0_f64); (2 * p + 1) * doubled];
    let weights = [square_weights(p), square_weights(q)];
    // Every pair of rows once, as its product counts twice.
    for i in 0..=p {
        for k in i..=p {
            let in_s = weights[0][i * (p + 1) + k] * if i == k { 1.0 } else { 2.0 };
            for j in 0..=q {
                let left = controls[i * columns + j];
                for l in 0..=q {
                    let right = controls[k * columns + l];
                    let weight = in_s * weights[1][j * columns + l];
                    let square = &mut squares[(i + k) * doubled + j + l];
                    square.0 += weight * left.xyz().dot(right.xyz());
                    square.1 += weight * left.w * right.w;
                }
            }
        }
    }
    squares
}

/// The weights of a square's products, made once a degree.
fn square_weights(degree: usize) -> &'static [f64] {
    static MADE: [OnceLock<Vec<f64>>; 2 * MAX_ORDER] = [const { OnceLock::new() }; 2 * MAX_ORDER];
    MADE[degree].get_or_init(|| product_weights(degree, degree))
}

/// Roundings of a coefficient beside one for each of its products.
const ROUNDINGS_BESIDES: usize = 8;

/// The least and the largest length that a rational function with these
/// controls may take.
///
/// A coefficient of `|n|²` is off by its roundings times `Σ |n_i| |n_j|` of its
/// products, one of `d²` by theirs times `Σ d_i d_j`, so that their quotient is
/// off by the roundings times the longest `|n_i / d_i|` squared, at most.
pub(crate) fn lengths(degree: [usize; 2], controls: &[DVec4]) -> [f64; 2] {
    let (mut least, mut largest, mut longest) = (f64::INFINITY, 0.0_f64, 0.0_f64);
    for (length_squared, weight_squared) in squares(degree, controls) {
        let quotient = length_squared / weight_squared;
        (least, largest) = (least.min(quotient), largest.max(quotient));
    }
    for control in controls {
        longest = longest.max(control.xyz().length_squared() / (control.w * control.w));
    }
    let lost = (controls.len() + ROUNDINGS_BESIDES) as f64 * f64::EPSILON * longest;
    [(least - lost).max(0.0).sqrt(), (largest + lost).sqrt()]
}
