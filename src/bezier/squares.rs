//! Squares of rational functions in Bernstein form.

use super::{scaled, unscale};
use glam::{DVec4, Vec4Swizzles};

/// The Bernstein coefficients, of twice the degrees, of `|n|²` and `d²` of the
/// rational function n/d with homogeneous controls `(n, d)`, t fastest; degrees
/// are at most twice those of patches.
///
/// With `d > 0` their quotients contain between them the squared lengths that
/// the function takes. O(p^2 q^2).
pub(crate) fn squares(degree: [usize; 2], controls: &[DVec4]) -> Vec<(f64, f64)> {
    let scaled = scaled(degree, controls);
    let doubled = degree.map(|degree| 2 * degree);
    let mut sums = vec![DVec4::ZERO; (doubled[0] + 1) * (doubled[1] + 1)];
    match degree[1] {
        // The most common degrees are unrolled.
        2 => add_products(scaled.as_chunks::<3>().0, &mut sums),
        3 => add_products(scaled.as_chunks::<4>().0, &mut sums),
        q => add_products(&scaled.chunks_exact(q + 1).collect::<Vec<_>>(), &mut sums),
    }
    unscale(doubled, &mut sums);
    sums.iter().map(|sum| (sum.x + sum.y + sum.z, sum.w)).collect()
}

/// Adds the products of the rows' coordinates.
#[inline(always)]
fn add_products<R: AsRef<[DVec4]>>(rows: &[R], sums: &mut [DVec4]) {
    // Every pair of rows once, as its product counts twice.
    for (i, one) in rows.iter().enumerate() {
        for (k, other) in rows.iter().enumerate().skip(i) {
            let (one, other) = (one.as_ref(), other.as_ref());
            let times = if i == k { 1.0 } else { 2.0 };
            let doubled = 2 * one.len() - 1;
            let sums = &mut sums[(i + k) * doubled..][..doubled];
            for j in 0..one.len() {
                let left = times * one[j];
                for l in 0..one.len() {
                    sums[j + l] += left * other[l];
                }
            }
        }
    }
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
