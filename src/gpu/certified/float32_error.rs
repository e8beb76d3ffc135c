//! What float32 loses in evaluating a piece by Horner's rule.

use crate::bezier::Patch;
use crate::gpu::float32::{ROUNDING, power_of_two_to_one};
use glam::{DVec4, Vec4Swizzles};

/// A rounding of float64.
const FINE_UNIT: f64 = 0.5 * f64::EPSILON;

/// Roundings of a quotient's numerator, each relative to the sum of its terms'
/// sizes: up to five products and four sums one after another.
const NUMERATOR_ROUNDINGS: f64 = 9.0;

/// Roundings of the product with the weight's inverse: 2.5 units of the
/// division, one of the product.
const QUOTIENT_ROUNDINGS: f64 = 4.0;

/// Orders of derivative bounded, plus one.
const ORDERS: usize = 3;

/// Bounds of the error of a piece's point and derivatives by (σ, τ) as
/// `piece_jet` of `horner.wgsl` computes them, in the units of the piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PieceError {
    pub(crate) value: f64,
    pub(crate) first: [f64; 2],
    pub(crate) second: [f64; 3],
}

impl PieceError {
    /// From the coefficients `c_ij` of [`Patch::monomials`].
    ///
    /// Numerators. With |σ|, |τ| <= 1, a sum of terms each of which passes
    /// through n roundings is off by at most `n u` times the sum of their
    /// sizes, in whatever order a compiler sums them. Horner's rule takes two
    /// roundings a degree; the a-th derivative by it works on results of the
    /// (a-1)-th, so its terms pass through `2 (a+1) p`. With one for rounding
    /// the coefficient and one each for the factors a!,
    ///
    /// `δ_ab <= (2 (a+1) p + 2 (b+1) q + 3) u S_ab`,
    /// `S_ab = Σ p_a(i) p_b(j) |c_ij|`, `p_a(i) = i!/(i-a)!`,
    ///
    /// and ω_ab, T_ab alike for the weights. To `S_ab` comes what the change
    /// of basis lost in float64.
    ///
    /// Quotients. As in `derivative_bounds`, by Leibniz' rule
    /// `x_ab = (X_ab - Σ C w_ij x_(a-i)(b-j)) / w`. Its exact size is at most
    /// `B_ab = (S_ab + Σ C T_ij B_(a-i)(b-j)) / w_min`. With the error `e` of
    /// the x before it and the numerator's own roundings, the computed one is
    /// off by at most
    ///
    /// `(δ_ab + Σ C (ω_ij B + (T_ij + ω_ij) e) + r u (S_ab + Σ C T_ij (B + e))) / w'
    ///  + B_ab ω_00 / w' + quotient's roundings`, `w' = w_min - ω_00`.
    ///
    /// Infinite where the weight's error reaches its least value.
    pub(crate) fn of(patch: &Patch<'_>, scale: f64) -> Self {
        let [p, q] = patch.degree;
        let lighter = normal_weight(patch);
        let controls = || patch.controls.iter().map(|control| scaled(*control, lighter, scale));
        let least = controls().fold(f64::INFINITY, |least, control| least.min(control.w));
        let largest = controls().fold(0.0, |largest: f64, control| largest.max(control.length()));
        let (mut sizes, mut weights) = ([[0.0; ORDERS]; ORDERS], [[0.0; ORDERS]; ORDERS]);
        let lost = (p + q + 4) as f64 * FINE_UNIT * 2_f64.powi((p + q) as i32) * largest;
        for (index, c) in patch.monomials().iter().enumerate() {
            let c = scaled(*c, lighter, scale);
            let (i, j) = (index / (q + 1), index % (q + 1));
            for a in 0..ORDERS {
                for b in 0..ORDERS - a {
                    let factor = falling(i, a) * falling(j, b);
                    sizes[a][b] += factor * (c.xyz().length() + lost);
                    weights[a][b] += factor * (c.w.abs() + lost);
                }
            }
        }
        let roundings = |a: usize, b: usize| (2 * (a + 1) * p + 2 * (b + 1) * q + 3) as f64 * ROUNDING;
        let lost_part = |a: usize, b: usize| roundings(a, b) * weights[a][b];
        let below = least - lost_part(0, 0) - lost;
        if below <= 0.0 {
            return Self { value: f64::INFINITY, first: [f64::INFINITY; 2], second: [f64::INFINITY; 3] };
        }
        let (mut exact, mut error) = ([[0.0; ORDERS]; ORDERS], [[0.0; ORDERS]; ORDERS]);
        for order in 0..ORDERS {
            for a in 0..=order {
                let b = order - a;
                let mut size = sizes[a][b];
                let mut off = roundings(a, b) * sizes[a][b] + lost * falling(p, a) * falling(q, b);
                for i in 0..=a {
                    for j in 0..=b {
                        if i + j == 0 {
                            continue;
                        }
                        let count = if (a, i) == (2, 1) || (b, j) == (2, 1) { 2.0 } else { 1.0 };
                        let (before, its) = (exact[a - i][b - j], error[a - i][b - j]);
                        size += count * weights[i][j] * (before + its);
                        off += count * (lost_part(i, j) * before + (weights[i][j] + lost_part(i, j)) * its);
                    }
                }
                exact[a][b] = size / least;
                error[a][b] = (off + NUMERATOR_ROUNDINGS * ROUNDING * size) / below
                    + exact[a][b] * (lost_part(0, 0) / below + QUOTIENT_ROUNDINGS * ROUNDING);
            }
        }
        Self {
            value: error[0][0],
            first: [error[1][0], error[0][1]],
            second: [error[2][0], error[1][1], error[0][2]],
        }
    }

    /// At most what a cell of the whole piece loses.
    pub(crate) fn total(&self) -> f64 {
        let [ss, st, tt] = self.second;
        self.value + self.first[0] + self.first[1] + 0.5 * ss + st + 0.5 * tt
    }
}

/// What the weights are multiplied by: to 1 where they are equal, else to about 1.
pub(crate) fn normal_weight(patch: &Patch<'_>) -> f64 {
    let heaviest = patch.controls.iter().map(|control| control.w).fold(0.0, f64::max);
    if patch.rational { power_of_two_to_one(heaviest) } else { heaviest.recip() }
}

/// A homogeneous coefficient in the units of the kernels.
pub(crate) fn scaled(coefficient: DVec4, lighter: f64, scale: f64) -> DVec4 {
    lighter * (coefficient.xyz() * scale).extend(coefficient.w)
}

/// `i! / (i - a)!`
fn falling(i: usize, a: usize) -> f64 {
    (0..a).map(|k| i as f64 - k as f64).product()
}
