//! Scaled Bernstein form, in which products are sums of products.

use super::MAX_ORDER;
use glam::DVec4;
use std::sync::OnceLock;

/// `C(n, k)` for k from 0 to n, made once; n is at most that of the square of
/// a product of patches.
fn binomials(n: usize) -> &'static [f64] {
    static MADE: [OnceLock<Vec<f64>>; 4 * MAX_ORDER] = [const { OnceLock::new() }; 4 * MAX_ORDER];
    MADE[n].get_or_init(|| {
        let mut row = vec![1.0];
        for k in 0..n {
            row.push(row[k] * (n - k) as f64 / (k + 1) as f64);
        }
        row
    })
}

/// The controls times their binomials `C(p, i) C(q, j)`; t fastest.
///
/// Of such coefficients, that of i in a product is the sum of the factors' products
/// of k and i - k (Farouki and Rajan, *Algorithms for polynomials in Bernstein
/// form*, section 4). O(p q).
pub(crate) fn scaled(degree: [usize; 2], controls: &[DVec4]) -> Vec<DVec4> {
    let [of_s, of_t] = degree.map(binomials);
    let mut scaled = Vec::with_capacity(controls.len());
    for (row, s) in controls.chunks_exact(of_t.len()).zip(of_s) {
        for (&control, t) in row.iter().zip(of_t) {
            scaled.push(s * t * control);
        }
    }
    scaled
}

/// The controls that were scaled. O(p q).
pub(crate) fn unscale(degree: [usize; 2], controls: &mut [DVec4]) {
    let [of_s, of_t] = degree.map(binomials);
    for (row, s) in controls.chunks_exact_mut(of_t.len()).zip(of_s) {
        for (control, t) in row.iter_mut().zip(of_t) {
            *control *= 1.0 / (s * t);
        }
    }
}
