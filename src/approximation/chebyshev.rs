//! Chebyshev interpolation on [0, 1], whose truncation errors are proven bounds.
//!
//! A polynomial of degree D is the sum of `c_j T_j(2x - 1)` for j from 0 to D, with
//! coefficients that its values at the D + 1 Chebyshev nodes give. As `|T_j| <= 1`, the
//! sum of `|c_j|` for j > n is an upper bound on the error of its truncation to degree n
//! (lemma T4 of docs/trimming.md).

use super::bernstein::{Linear, binomial, elevated};
use crate::rounding::upper_max;
use std::f64::consts::FRAC_PI_2;
use std::sync::OnceLock;

/// The largest number of nodes of one interpolation.
pub(crate) const MAX_NODES: usize = 512;

/// The highest degree that is converted to the Bernstein basis.
pub(crate) const MAX_BERNSTEIN: usize = crate::limits::MAX_DEGREE;

/// Returns `cos(k π / (2 count))` for k below 4 count, computed once for each count.
fn cosines(count: usize) -> &'static [f64] {
    static TABLES: [OnceLock<Vec<f64>>; MAX_NODES + 1] = [const { OnceLock::new() }; MAX_NODES + 1];
    TABLES[count].get_or_init(|| {
        let quarter = |k: usize| (FRAC_PI_2 * k as f64 / count as f64).cos();
        (0..4 * count)
            .map(|k| match k {
                _ if k == count || k == 3 * count => 0.0,
                _ if k < count => quarter(k),
                _ if k <= 2 * count => -quarter(2 * count - k),
                _ if k < 3 * count => -quarter(k - 2 * count),
                _ => quarter(4 * count - k),
            })
            .collect()
    })
}

/// Returns the zeros of `T_count(2x - 1)` in (0, 1), the largest first.
pub fn nodes(count: usize) -> impl Iterator<Item = f64> {
    let table = cosines(count);
    (0..count).map(move |k| 0.5 + 0.5 * table[2 * k + 1])
}

/// Returns the Chebyshev coefficients of the polynomial of degree below
/// `values.len()` with these values at [`nodes`]. O(values²).
pub fn coefficients<T: Linear>(values: &[T]) -> Vec<T> {
    let count = values.len();
    let table = cosines(count);
    (0..count)
        .map(|j| {
            let mut sum = T::ZERO;
            for (k, &value) in values.iter().enumerate() {
                sum = sum + value * table[j * (2 * k + 1) % (4 * count)];
            }
            sum * (if j == 0 { 1.0 } else { 2.0 } / count as f64)
        })
        .collect()
}

/// Returns the matrix whose entry `[j][i]` is Bernstein coefficient i, of degree
/// `degree`, of `T_j(2x - 1)`.
fn bernstein_matrix(degree: usize) -> &'static [Vec<f64>] {
    static MATRICES: [OnceLock<Vec<Vec<f64>>>; MAX_BERNSTEIN + 1] =
        [const { OnceLock::new() }; MAX_BERNSTEIN + 1];
    MATRICES[degree].get_or_init(|| {
        (0..=degree)
            .map(|j| {
                // Coefficient i of T_j in degree j is (-1)^(j-i) C(2j, 2i) / C(j, i).
                let sign = |i: usize| if (j - i).is_multiple_of(2) { 1.0 } else { -1.0 };
                let own = (0..=j).map(|i| sign(i) * binomial(2 * j, 2 * i) / binomial(j, i)).collect();
                elevated(own, degree)
            })
            .collect()
    })
}

/// Returns the Bernstein coefficients, of degree `degree`, of the Chebyshev series
/// truncated to that degree, at most [`MAX_BERNSTEIN`].
pub(crate) fn to_bernstein<T: Linear>(coefficients: &[T], degree: usize) -> Vec<T> {
    let matrix = bernstein_matrix(degree);
    (0..=degree)
        .map(|i| coefficients.iter().zip(matrix).fold(T::ZERO, |sum, (&c, row)| sum + c * row[i]))
        .collect()
}

/// Returns the condition of [`to_bernstein`]: its coefficients are at most this many times the largest size of those
/// that it is given.
pub(crate) fn bernstein_condition(degree: usize) -> f64 {
    let matrix = bernstein_matrix(degree);
    let of_one = |i: usize| matrix.iter().map(|row| row[i].abs()).sum::<f64>();
    (0..=degree).map(of_one).fold(0.0, upper_max)
}

/// Returns the factor for which `factor · max |P(x_k)|` over the `count` nodes is an
/// upper bound on |P| over [0, 1], for every polynomial P of degree `degree < count`; infinite
/// where there are no more nodes than the degree, which bound nothing.
///
/// The smaller one of `1 / cos(π degree / (2 count))` (Ehlich and Zeller, *Schwankung von
/// Polynomen zwischen Gitterpunkten*, Mathematische Zeitschrift 86 (1964)) and
/// `1 + (2 / π) ln count`, which bounds the Lebesgue constant (Rivlin, *The Chebyshev
/// Polynomials* (1974), theorem 1.2); lemma T5 of docs/trimming.md.
pub(crate) fn node_factor(degree: usize, count: usize) -> f64 {
    if degree >= count {
        return f64::INFINITY;
    }
    let oversampled = 1.0 / (FRAC_PI_2 * degree as f64 / count as f64).cos();
    oversampled.min(1.0 + (count as f64).ln() / FRAC_PI_2)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn coefficients_and_bernstein_form_of_a_cubic() {
        let cubic = |x: f64| 1.0 - 2.0 * x + 3.0 * x * x * x;
        let values: Vec<f64> = nodes(6).map(cubic).collect();
        let series = coefficients(&values);
        assert!(series[4].abs() < 1e-15 && series[5].abs() < 1e-15);
        // 1 - 2x + 3x³ has the Bernstein coefficients 1, 1 - 2/3, 1 - 4/3, 2.
        for (found, expected) in to_bernstein(&series, 3).into_iter().zip([1.0, 1.0 / 3.0, -1.0 / 3.0, 2.0]) {
            assert!((found - expected).abs() < 1e-15, "{found} {expected}");
        }
    }

    #[test]
    fn the_node_factor_bounds_polynomials_between_nodes() {
        // T_8 has size 1 everywhere and is small at nodes of T_9 near its zeros.
        let chebyshev = |x: f64| (8.0 * (2.0 * x - 1.0).acos()).cos();
        for count in [9, 12, 16, 24] {
            let largest = nodes(count).map(|x| chebyshev(x).abs()).fold(0.0, f64::max);
            assert!(largest * node_factor(8, count) >= 1.0 - 1e-12);
        }
    }

    /// The polynomial that is 1 and -1 at the nodes in turn is, at the end, the Lebesgue constant.
    #[test]
    fn the_node_factor_is_attained_where_there_are_as_few_nodes_as_may_be() {
        for count in 2..200 {
            let values: Vec<f64> = (0..count).map(|k| if k % 2 == 0 { 1.0 } else { -1.0 }).collect();
            let at_end: f64 = coefficients(&values).iter().sum();
            assert_eq!(node_factor(count, count), f64::INFINITY);
            let factor = node_factor(count - 1, count);
            assert!(
                at_end <= factor * (1.0 + 1e-12) && factor <= 1.04 * at_end,
                "{count}: {at_end} {factor}"
            );
        }
    }
}
