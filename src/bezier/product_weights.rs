//! Products of Bernstein polynomials.

/// `C(p,i) C(m,k) / C(p+m,i+k)`: the weight of the product of controls i and k,
/// of degrees p and m, in coefficient i + k of the product; k fastest. O(p m).
pub(crate) fn product_weights(p: usize, m: usize) -> Vec<f64> {
    let row = |n: usize| {
        let mut row = vec![1.0];
        for k in 0..n {
            row.push(row[k] * (n - k) as f64 / (k + 1) as f64);
        }
        row
    };
    let (of_p, of_m, of_product) = (row(p), row(m), row(p + m));
    let mut weights = Vec::with_capacity((p + 1) * (m + 1));
    for i in 0..=p {
        for k in 0..=m {
            weights.push(of_p[i] * of_m[k] / of_product[i + k]);
        }
    }
    weights
}
