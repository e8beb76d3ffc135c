//! The float32 error of evaluating a subpatch by Horner's rule.

use crate::bezier::Patch;
use crate::gpu::float32::{UNIT_ROUNDOFF, normalizing_power};
use glam::{DVec4, Vec4Swizzles};

/// The unit roundoff of float64.
const FLOAT64_UNIT_ROUNDOFF: f64 = 0.5 * f64::EPSILON;

/// Successive roundings in a quotient's numerator, each relative to the sum of
/// the sizes of its terms: up to five products and four sums.
const NUMERATOR_ROUNDINGS: f64 = 9.0;

/// Roundings of the product with the weight's inverse: 2.5 units for the
/// division, as WGSL allows, and one for the product.
const QUOTIENT_ROUNDINGS: f64 = 4.0;

/// The number of orders of derivatives, from 0 to 2.
const ORDERS: usize = 3;

/// Upper bounds on the error of a subpatch's point and derivatives by (σ, τ) as
/// `subpatch_jet` of `horner.wgsl` computes them, times the scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Float32Error {
    pub(crate) value: f64,
    pub(crate) first: [f64; 2],
    pub(crate) second: [f64; 3],
}

impl Float32Error {
    /// Bounds the errors from the coefficients `c_ij` of [`Patch::monomials`].
    ///
    /// Numerators. Let u be the unit roundoff. With |σ|, |τ| <= 1, a sum of
    /// terms that pass through n roundings each is off by at most
    /// `n u` times the sum of their sizes, in any order of summation that a
    /// compiler chooses. Horner's rule takes two roundings a degree; the a-th
    /// derivative by it operates on results of the (a-1)-th, so its terms pass
    /// through `2 (a+1) p`. With one for rounding the coefficient and one for
    /// each of the factors a! and b!,
    ///
    /// `δ_ab <= (2 (a+1) p + 2 (b+1) q + 3) u S_ab`,
    /// `S_ab = Σ p_a(i) p_b(j) |c_ij|`, `p_a(i) = i!/(i-a)!`,
    ///
    /// and ω_ab, T_ab likewise for the weights. The error of the change of
    /// basis in float64 is added to every `|c_ij|`.
    ///
    /// Quotients. As in `derivative_bounds`, by Leibniz' rule
    /// `x_ab = (X_ab - Σ C w_ij x_(a-i)(b-j)) / w`. Its exact size is at most
    /// `B_ab = (S_ab + Σ C T_ij B_(a-i)(b-j)) / w_min`. With the errors `e` of
    /// the preceding x and the numerator's own roundings r, the computed one is
    /// off by at most
    ///
    /// `(δ_ab + Σ C (ω_ij B + (T_ij + ω_ij) e) + r u (S_ab + Σ C T_ij (B + e))) / w'
    ///  + B_ab ω_00 / w' + the quotient's roundings`, `w' = w_min - ω_00`.
    ///
    /// All are +∞ where the weight's error reaches its smallest value.
    pub(crate) fn new(patch: &Patch<'_>, scale: f64) -> Self {
        let [p, q] = patch.degree;
        let weight_scale = weight_scale(patch);
        let controls = || patch.controls.iter().map(|control| scaled(*control, weight_scale, scale));
        let min_weight = controls().fold(f64::INFINITY, |min_weight, control| min_weight.min(control.w));
        let max_size = controls().fold(0.0, |max_size: f64, control| max_size.max(control.length()));
        let (mut sizes, mut weights) = ([[0.0; ORDERS]; ORDERS], [[0.0; ORDERS]; ORDERS]);
        let basis_error = (p + q + 4) as f64 * FLOAT64_UNIT_ROUNDOFF * 2_f64.powi((p + q) as i32) * max_size;
        for (index, c) in patch.monomials().iter().enumerate() {
            let c = scaled(*c, weight_scale, scale);
            let (i, j) = (index / (q + 1), index % (q + 1));
            for a in 0..ORDERS {
                for b in 0..ORDERS - a {
                    let factor = falling(i, a) * falling(j, b);
                    sizes[a][b] += factor * (c.xyz().length() + basis_error);
                    weights[a][b] += factor * (c.w.abs() + basis_error);
                }
            }
        }
        let roundings = |a: usize, b: usize| (2 * (a + 1) * p + 2 * (b + 1) * q + 3) as f64 * UNIT_ROUNDOFF;
        let weight_error = |a: usize, b: usize| roundings(a, b) * weights[a][b];
        let min_computed_weight = min_weight - weight_error(0, 0) - basis_error;
        if min_computed_weight <= 0.0 {
            return Self { value: f64::INFINITY, first: [f64::INFINITY; 2], second: [f64::INFINITY; 3] };
        }
        let (mut exact, mut error) = ([[0.0; ORDERS]; ORDERS], [[0.0; ORDERS]; ORDERS]);
        for order in 0..ORDERS {
            for a in 0..=order {
                let b = order - a;
                let mut size = sizes[a][b];
                let mut error_sum =
                    roundings(a, b) * sizes[a][b] + basis_error * falling(p, a) * falling(q, b);
                for i in 0..=a {
                    for j in 0..=b {
                        if i + j == 0 {
                            continue;
                        }
                        let count = if (a, i) == (2, 1) || (b, j) == (2, 1) { 2.0 } else { 1.0 };
                        let (size_before, error_before) = (exact[a - i][b - j], error[a - i][b - j]);
                        size += count * weights[i][j] * (size_before + error_before);
                        error_sum += count
                            * (weight_error(i, j) * size_before
                                + (weights[i][j] + weight_error(i, j)) * error_before);
                    }
                }
                exact[a][b] = size / min_weight;
                error[a][b] = (error_sum + NUMERATOR_ROUNDINGS * UNIT_ROUNDOFF * size) / min_computed_weight
                    + exact[a][b]
                        * (weight_error(0, 0) / min_computed_weight + QUOTIENT_ROUNDINGS * UNIT_ROUNDOFF);
            }
        }
        Self {
            value: error[0][0],
            first: [error[1][0], error[0][1]],
            second: [error[2][0], error[1][1], error[0][2]],
        }
    }

    /// Upper bound on the error over a cell that is the whole subpatch: of its
    /// Taylor quadratic at the centre.
    pub(crate) fn total(&self) -> f64 {
        let [ss, st, tt] = self.second;
        self.value + self.first[0] + self.first[1] + 0.5 * ss + st + 0.5 * tt
    }
}

/// The factor that scales the weights: to 1 where they are equal, else to about 1.
pub(crate) fn weight_scale(patch: &Patch<'_>) -> f64 {
    let max_weight = patch.controls.iter().map(|control| control.w).fold(0.0, f64::max);
    if patch.rational { normalizing_power(max_weight) } else { max_weight.recip() }
}

/// A homogeneous coefficient as the kernels use it.
pub(crate) fn scaled(coefficient: DVec4, weight_scale: f64, scale: f64) -> DVec4 {
    weight_scale * (coefficient.xyz() * scale).extend(coefficient.w)
}

/// The falling factorial `i! / (i - a)!`.
fn falling(i: usize, a: usize) -> f64 {
    (0..a).map(|k| i as f64 - k as f64).product()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::param_box::ParamBox;
    use glam::DVec3;

    /// The recursion of [`Float32Error::new`] written out, for patches on which every term
    /// counts: of low degrees that of float32, of high ones the change of basis in float64.
    #[test]
    fn every_order_has_the_terms_of_the_lemma() {
        const U: f64 = UNIT_ROUNDOFF;
        const SCALE: f64 = 4.0;
        for degree in [[3, 2], [2, 4], [15, 14]] {
            let [p, q] = degree.map(|degree| degree as f64);
            let random = &mut fastrand::Rng::with_seed(3);
            // Noise as small as float32's digits keeps high monomials small.
            let mut noise = || if p < 9.0 { random.f64() } else { 1e-6 * random.f64() };
            let mut controls = Vec::new();
            for i in 0..=degree[0] {
                for j in 0..=degree[1] {
                    let w = 1.0 + 0.25 * i as f64 / p + 0.25 * noise();
                    let point = DVec3::new(0.5 + noise(), j as f64 / q, noise());
                    controls.push(DVec4::from((w * point, w)));
                }
            }
            let (center, domain) = (DVec3::ZERO, ParamBox::UNIT);
            // Weights of 8 and more, which are scaled to 1 and more.
            let heavy: Vec<DVec4> = controls.iter().map(|&control| 8.0 * control).collect();
            let patch = Patch { surface: 0, degree, domain, center, controls: &heavy, rational: true };
            let as_used = |c: DVec4| (0.125 * SCALE * c.xyz()).extend(0.125 * c.w);
            let monomials: Vec<DVec4> = patch.monomials().into_iter().map(as_used).collect();
            let lightest = controls.iter().fold(f64::INFINITY, |least, control| least.min(control.w));
            let largest = heavy
                .iter()
                .map(|&control| as_used(control).length())
                .fold(0.0, |a, b| if a < b { b } else { a });
            let of_basis = (p + q + 4.0) * 2.0_f64.powf(p + q - 53.0) * largest;
            let factor = |i: usize, a: u32| [1, i, i * i.saturating_sub(1)][a as usize] as f64;
            let sum = |size: fn(&DVec4) -> f64, a: u32, b: u32| -> f64 {
                let columns = degree[1] + 1;
                let term = |(index, c): (usize, &DVec4)| {
                    factor(index / columns, a) * factor(index % columns, b) * (size(c) + of_basis)
                };
                monomials.iter().enumerate().map(term).sum()
            };
            let space = |a, b| sum(|c| c.xyz().length(), a, b);
            let weight = |a, b| sum(|c| c.w.abs(), a, b);
            let roundings =
                |a: u32, b: u32| U * (2.0 * f64::from(a + 1) * p + 2.0 * f64::from(b + 1) * q + 3.0);
            let omega = |a, b| roundings(a, b) * weight(a, b);
            let w = lightest - omega(0, 0) - of_basis;
            // The error of one order: the sizes of its terms, and the errors of those.
            let order = |a, b, size: f64, errors: f64| {
                let exact = size / lightest;
                let of_basis = of_basis * factor(degree[0], a) * factor(degree[1], b);
                let numerator = roundings(a, b) * space(a, b) + of_basis + errors + 9.0 * U * size;
                (exact, numerator / w + exact * (omega(0, 0) / w + 4.0 * U))
            };
            let size = |[i, j]: [u32; 2], (exact, error): (f64, f64)| weight(i, j) * (exact + error);
            let errors = |[i, j]: [u32; 2], (exact, error): (f64, f64)| {
                omega(i, j) * exact + (weight(i, j) + omega(i, j)) * error
            };
            let x = order(0, 0, space(0, 0), 0.0);
            let s = order(1, 0, space(1, 0) + size([1, 0], x), errors([1, 0], x));
            let t = order(0, 1, space(0, 1) + size([0, 1], x), errors([0, 1], x));
            let ss = order(
                2,
                0,
                space(2, 0) + 2.0 * size([1, 0], s) + size([2, 0], x),
                2.0 * errors([1, 0], s) + errors([2, 0], x),
            );
            let st = order(
                1,
                1,
                space(1, 1) + size([1, 0], t) + size([0, 1], s) + size([1, 1], x),
                errors([1, 0], t) + errors([0, 1], s) + errors([1, 1], x),
            );
            let tt = order(
                0,
                2,
                space(0, 2) + 2.0 * size([0, 1], t) + size([0, 2], x),
                2.0 * errors([0, 1], t) + errors([0, 2], x),
            );
            let found = Float32Error::new(&patch, SCALE);
            let pairs = [
                (found.value, x),
                (found.first[0], s),
                (found.first[1], t),
                (found.second[0], ss),
                (found.second[1], st),
                (found.second[2], tt),
            ];
            for (index, (found, (_, lemma))) in pairs.into_iter().enumerate() {
                assert!((found / lemma - 1.0).abs() <= 1e-9, "{index}: {found:e} and {lemma:e}");
            }
        }
    }

    /// Equal weights become 1, others at most about 1, by a power of two.
    #[test]
    fn weights_are_scaled_to_one() {
        let scale_of = |weights: [f64; 4], rational: bool| {
            let controls = weights.map(|w| (w * DVec3::X).extend(w));
            let (degree, domain, center) = ([1, 1], ParamBox::UNIT, DVec3::ZERO);
            weight_scale(&Patch { surface: 0, degree, domain, center, controls: &controls, rational })
        };
        assert_eq!(scale_of([3.0; 4], false), 1.0 / 3.0);
        let scale = scale_of([1.0, 24.0, 2.0, 3.0], true);
        assert_eq!(scale.log2().fract(), 0.0);
        assert!((0.5..=2.0).contains(&(24.0 * scale)), "{scale}");
    }
}
