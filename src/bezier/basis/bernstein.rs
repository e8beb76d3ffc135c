//! Bernstein polynomials and their derivatives.

/// The values and the first two derivatives of all Bernstein polynomials of one
/// degree below `N`: `basis[k][i]` is the k-th derivative of `B_i`.
pub(in crate::bezier) type Basis<const N: usize> = [[f64; N]; 3];

/// Evaluates the basis of a degree of at least 1 at `t` in [0, 1].
///
/// The degree-raising recurrence adds numbers of one sign only and is therefore
/// accurate to a few units in the last place; derivatives are differences of
/// polynomials of lower degree (Farin, *Curves and Surfaces for CAGD*, section
/// 5.3). O(degree²), unrolled where the degree is a constant.
#[inline(always)]
pub(in crate::bezier) fn fill<const N: usize>(basis: &mut Basis<N>, degree: usize, t: f64) {
    let scale = degree as f64;
    let mut values = [0.0; N];
    values[0] = 1.0;
    for current in 0..degree.saturating_sub(2) {
        raise(&mut values, current, t);
    }
    if degree >= 2 {
        basis[2] = values;
        raise(&mut values, degree - 2, t);
        differentiate(&mut basis[2], degree - 1, scale - 1.0);
        differentiate(&mut basis[2], degree, scale);
    }
    basis[1] = values;
    raise(&mut values, degree - 1, t);
    differentiate(&mut basis[1], degree, scale);
    basis[0] = values;
}

/// Turns the Bernstein polynomials of degree `degree` into those of `degree + 1`.
#[inline(always)]
fn raise(values: &mut [f64], degree: usize, t: f64) {
    let complement = 1.0 - t;
    for index in (1..=degree + 1).rev() {
        values[index] = t * values[index - 1] + complement * values[index];
    }
    values[0] *= complement;
}

/// Turns values of degree `degree - 1` into derivatives of degree `degree`:
/// `B_i' = degree (B_(i-1) - B_i)`.
#[inline(always)]
fn differentiate(values: &mut [f64], degree: usize, scale: f64) {
    for index in (1..=degree).rev() {
        values[index] = scale * (values[index - 1] - values[index]);
    }
    values[0] *= -scale;
}
