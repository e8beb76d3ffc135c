//! Products and squares of polynomials in Bernstein form.

use crate::bezier::MAX_ORDER;
use crate::rounding::{lower_min, upper_max};
use glam::{DVec4, Vec4Swizzles};
use std::sync::OnceLock;

/// Returns `C(n, k)` for k from 0 to n, computed once; n is at most the degree
/// of the square of a product of two patches. Exact for n up to 54 (docs/rounding.md, 6.6).
pub(crate) fn binomials(n: usize) -> &'static [f64] {
    static ROWS: [OnceLock<Vec<f64>>; 4 * MAX_ORDER] = [const { OnceLock::new() }; 4 * MAX_ORDER];
    ROWS[n].get_or_init(|| {
        let mut row = vec![1.0];
        for k in 0..n {
            row.push(row[k] * (n - k) as f64 / (k + 1) as f64);
        }
        row
    })
}

/// Returns the scaled Bernstein form: the controls times their binomials
/// `C(p, i) C(q, j)`, t fastest.
///
/// Coefficient i of a product in this form is the sum over k of the products of
/// coefficients k and i - k (Farouki and Rajan, *Algorithms for polynomials in
/// Bernstein form*, Computer Aided Geometric Design 5 (1988), section 4). O(p q).
pub(crate) fn scaled(degree: [usize; 2], controls: &[DVec4]) -> Vec<DVec4> {
    let [in_s, in_t] = degree.map(binomials);
    let mut scaled = Vec::with_capacity(controls.len());
    for (row, s) in controls.chunks_exact(in_t.len()).zip(in_s) {
        for (&control, t) in row.iter().zip(in_t) {
            scaled.push(s * t * control);
        }
    }
    scaled
}

/// Undoes [`scaled`] in place. O(p q).
pub(crate) fn unscale(degree: [usize; 2], controls: &mut [DVec4]) {
    let [in_s, in_t] = degree.map(binomials);
    for (row, s) in controls.chunks_exact_mut(in_t.len()).zip(in_s) {
        for (control, t) in row.iter_mut().zip(in_t) {
            *control *= 1.0 / (s * t);
        }
    }
}

/// Returns the Bernstein coefficients, of twice the degrees, of `|n|²` and `d²`
/// for the rational function n/d with homogeneous controls `(n, d)`, t fastest.
///
/// The degrees are at most twice those of patches. With `d > 0`, every squared
/// length that n/d takes lies between the smallest and the largest quotient of
/// two corresponding coefficients. O(p² q²).
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

/// Returns the Bernstein coefficients, of twice the degrees, of `n·m` and `d e` for the
/// homogeneous controls `(n, d)` and `(m, e)` of two rational functions of these degrees, t fastest.
///
/// O(p² q²).
pub(crate) fn dot_products(degree: [usize; 2], left: &[DVec4], right: &[DVec4]) -> Vec<(f64, f64)> {
    let [left, right] = [left, right].map(|controls| scaled(degree, controls));
    let (columns, doubled) = (degree[1] + 1, degree.map(|degree| 2 * degree));
    let mut sums = vec![DVec4::ZERO; (doubled[0] + 1) * (doubled[1] + 1)];
    for (i, left) in left.chunks_exact(columns).enumerate() {
        for (k, right) in right.chunks_exact(columns).enumerate() {
            let sums = &mut sums[(i + k) * (doubled[1] + 1)..][..=doubled[1]];
            for (j, &factor) in left.iter().enumerate() {
                for (sum, &control) in sums[j..].iter_mut().zip(right) {
                    *sum += factor * control;
                }
            }
        }
    }
    unscale(doubled, &mut sums);
    sums.iter().map(|sum| (sum.x + sum.y + sum.z, sum.w)).collect()
}

/// Returns the Bernstein coefficients, of three times the degrees, of `n·m` and `d e`, with the scaled
/// controls `(n, d)` of a rational function of these degrees and `(m, e)`, of twice the degrees, the sum
/// of what `inner` gives for each two of them, by their indices. O(p² q²).
pub(crate) fn triple_products(
    degree: [usize; 2],
    controls: &[DVec4],
    inner: impl Fn(usize, usize) -> DVec4,
) -> Vec<(f64, f64)> {
    let [rows, columns] = degree.map(|degree| degree + 1);
    let [doubled, tripled] = [2, 3].map(|factor| degree.map(|degree| factor * degree));
    let stride = doubled[1] + 1;
    let mut right = vec![DVec4::ZERO; (doubled[0] + 1) * stride];
    for first in 0..rows * columns {
        for second in 0..rows * columns {
            let row = first / columns + second / columns;
            right[row * stride + first % columns + second % columns] += inner(first, second);
        }
    }
    let mut sums = vec![DVec4::ZERO; (tripled[0] + 1) * (tripled[1] + 1)];
    for (i, left) in controls.chunks_exact(columns).enumerate() {
        for (k, right) in right.chunks_exact(stride).enumerate() {
            let sums = &mut sums[(i + k) * (tripled[1] + 1)..][..=tripled[1]];
            for (j, &factor) in left.iter().enumerate() {
                for (sum, &control) in sums[j..].iter_mut().zip(right) {
                    *sum += factor * control;
                }
            }
        }
    }
    unscale(tripled, &mut sums);
    sums.iter().map(|sum| (sum.x + sum.y + sum.z, sum.w)).collect()
}

/// Adds the products of each two rows, coordinate by coordinate, to `sums`.
#[inline(always)]
fn add_products<R: AsRef<[DVec4]>>(rows: &[R], sums: &mut [DVec4]) {
    // Every pair of different rows occurs twice in the square and is multiplied once.
    for (i, left) in rows.iter().enumerate() {
        for (k, right) in rows.iter().enumerate().skip(i) {
            let (left, right) = (left.as_ref(), right.as_ref());
            let multiplicity = if i == k { 1.0 } else { 2.0 };
            let doubled = 2 * left.len() - 1;
            let sums = &mut sums[(i + k) * doubled..][..doubled];
            for j in 0..left.len() {
                let factor = multiplicity * left[j];
                for l in 0..left.len() {
                    sums[j + l] += factor * right[l];
                }
            }
        }
    }
}

/// Rounding operations of one coefficient, not counting one for each product that it sums.
const OTHER_ROUNDINGS: usize = 8;

/// Returns a lower and an upper bound on the length of a rational function
/// with these controls; 0 and +∞ where a coefficient overflows.
///
/// A coefficient of `|n|²` is off by its rounding operations times `Σ |n_i| |n_j|`
/// of its products, one of `d²` by its own times `Σ d_i d_j`, so that the error
/// of their quotient is at most that number times the largest `|n_i / d_i|²`.
/// O(p² q²).
pub(crate) fn length_bounds(degree: [usize; 2], controls: &[DVec4]) -> [f64; 2] {
    let (mut least, mut largest, mut longest) = (f64::INFINITY, 0.0_f64, 0.0_f64);
    for (length_squared, weight_squared) in squares(degree, controls) {
        let quotient = length_squared / weight_squared;
        (least, largest) = (lower_min(least, quotient), upper_max(largest, quotient));
    }
    for control in controls {
        longest = upper_max(longest, control.xyz().length_squared() / (control.w * control.w));
    }
    let rounding = (controls.len() + OTHER_ROUNDINGS) as f64 * f64::EPSILON * longest;
    [(least - rounding).max(0.0).sqrt(), (largest + rounding).sqrt()]
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// The straight line from (3, 0, 0) to (0, 4, 0) is at least 2.4 from the
    /// origin and at most 4; the coefficients give (9, 0, 16).
    #[test]
    fn lengths_of_a_line() {
        let line = [DVec4::new(3.0, 0.0, 0.0, 1.0), DVec4::new(0.0, 4.0, 0.0, 1.0)];
        let [least, largest] = length_bounds([1, 0], &line);
        assert!(least <= 2.4 && (4.0..4.0 + 1e-12).contains(&largest), "{least} {largest}");
    }

    /// The product of two different nets has the values of the product, and that of a net with itself
    /// the coefficients of its square.
    #[test]
    fn dot_products_are_those_of_the_functions() {
        let left = [DVec4::new(1.0, 2.0, 0.5, 1.0), DVec4::new(-1.0, 3.0, 2.0, 0.5)];
        let right = [DVec4::new(0.5, -1.0, 4.0, 2.0), DVec4::new(3.0, 1.0, -2.0, 1.5)];
        let found = dot_products([1, 0], &left, &right);
        // The middle coefficients are means: (l0·r1 + l1·r0) / 2.
        let expected = [(0.5, 2.0), (0.5 * (4.0 + 4.5), 0.5 * (1.5 + 1.0)), (-4.0, 0.75)];
        for (found, expected) in found.iter().zip(expected) {
            assert!((found.0 - expected.0).abs() < 1e-15 && (found.1 - expected.1).abs() < 1e-15);
        }
        assert_eq!(dot_products([1, 0], &left, &left), squares([1, 0], &left));
    }

    /// Numerators of 1e160 have squares beyond float64, whose differences are NaN.
    #[test]
    fn coefficients_that_overflow_bound_nothing() {
        let line = [DVec4::new(1e160, 0.0, 0.0, 1e100), DVec4::new(-1e160, 1e160, 0.0, 1e100)];
        assert_eq!(length_bounds([1, 0], &line), [0.0, f64::INFINITY]);
    }
}
