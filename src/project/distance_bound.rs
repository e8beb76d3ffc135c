//! A lower bound of the distance from a point to a patch.

use crate::bezier::MAX_ORDER;
use glam::{DVec3, DVec4, Vec4Swizzles};
use std::sync::OnceLock;

/// Roundings of 2^-53 on the way to one coefficient, per degree and besides.
const ROUNDINGS_PER_DEGREE: f64 = 4.0;
const ROUNDINGS_BESIDES: f64 = 32.0;

/// At most the squared distance from `target` to the patch of these degrees
/// and homogeneous controls, both relative to the same point.
///
/// With `Y = X - w target`, the squared distance is `|Y|^2 / w^2`. Numerator and
/// denominator are Bernstein polynomials of degree (2p, 2q), the denominator's
/// coefficients positive, so the quotient is at least the smallest quotient of
/// coefficients. The gap falls with the square of the patch's size, and is
/// zero where the distance is constant, as from the axis of a cylinder.
/// Rounding is taken off. O(p^2 q^2).
#[must_use]
pub fn least_distance_squared(degree: [usize; 2], controls: &[DVec4], target: DVec3) -> f64 {
    let [p, q] = degree;
    let (columns, doubled) = (q + 1, 2 * q + 1);
    let mut products = vec![(0.0_f64, 0.0_f64); (2 * p + 1) * doubled];
    let weights = [product_weights(p), product_weights(q)];
    let relative: Vec<DVec4> =
        controls.iter().map(|control| (control.xyz() - control.w * target).extend(control.w)).collect();
    // Every pair of rows once, as its product counts twice.
    for i in 0..=p {
        for k in i..=p {
            let in_s = weights[0][i * (p + 1) + k] * if i == k { 1.0 } else { 2.0 };
            for j in 0..=q {
                let left = relative[i * columns + j];
                for l in 0..=q {
                    let right = relative[k * columns + l];
                    let weight = in_s * weights[1][j * columns + l];
                    let product = &mut products[(i + k) * doubled + j + l];
                    product.0 += weight * left.xyz().dot(right.xyz());
                    product.1 += weight * left.w * right.w;
                }
            }
        }
    }
    let largest = relative.iter().fold(0.0_f64, |largest, y| largest.max(y.xyz().length_squared()));
    let rounding = (ROUNDINGS_PER_DEGREE * (p + q) as f64 + ROUNDINGS_BESIDES) * f64::EPSILON * largest;
    let least = products.iter().fold(f64::INFINITY, |least, &(numerator, denominator)| {
        least.min((numerator - rounding) / denominator)
    });
    least.max(0.0)
}

/// `C(n,i) C(n,k) / C(2n,i+k)`: the weight of control products i, k in
/// coefficient i + k of a product of Bernstein polynomials. Made once a degree.
fn product_weights(degree: usize) -> &'static [f64] {
    static MADE: [OnceLock<Vec<f64>>; MAX_ORDER] = [const { OnceLock::new() }; MAX_ORDER];
    MADE[degree].get_or_init(|| {
        let row = |n: usize| -> Vec<f64> {
            let mut row = vec![1.0];
            for k in 0..n {
                row.push(row[k] * (n - k) as f64 / (k + 1) as f64);
            }
            row
        };
        let (single, double) = (row(degree), row(2 * degree));
        let size = degree + 1;
        (0..size * size)
            .map(|at| single[at / size] * single[at % size] / double[at / size + at % size])
            .collect()
    })
}
