//! Lower bounds on the distance from a point to a patch, from the Bernstein
//! form of the squared distance.

use super::Foot;
use crate::bezier::{Patch, relative, squares};
use crate::rounding::upper_max;
use glam::{DVec3, DVec4, Vec4Swizzles};

/// Rounding errors of 2^-53 on the way to one coefficient: this many for each
/// degree, and this many others.
const ROUNDINGS_PER_DEGREE: f64 = 4.0;
const OTHER_ROUNDINGS: f64 = 32.0;

/// The largest `|Y|²` for which no coefficient overflows: the scaled products
/// that one sums add up to at most `2^(2p + 2q) <= 2^60` times it.
const MAX_SQUARE: f64 = 1e280;

/// The squared distance from a point to a patch as a quotient of Bernstein
/// polynomials of degree (2p, 2q): with `Y = X - w target`, `|Y|² / w²`.
#[derive(Debug)]
pub struct SquaredDistance {
    degree: [usize; 2],
    /// The coefficients of numerator and denominator, t fastest.
    coefficients: Vec<(f64, f64)>,
    /// An upper bound on the rounding error of a coefficient, relative to the largest.
    unit: f64,
    /// An upper bound on the numerator's coefficients; above [`MAX_SQUARE`] they
    /// may have overflowed, and bound nothing.
    largest: f64,
}

/// A point of a patch at which the squared distance and its gradient are known.
#[derive(Debug, Clone, Copy)]
pub struct CriticalPoint {
    /// (s, t) in [0, 1]².
    pub parameters: [f64; 2],
    /// The squared distance.
    pub distance_squared: f64,
    /// Its derivatives by s and t.
    pub gradient: [f64; 2],
}

impl CriticalPoint {
    /// Returns the point at which an iteration ended.
    pub(crate) fn new(patch: &Patch<'_>, target: DVec3, foot: &Foot) -> Self {
        let Foot { parameters, distance_squared, .. } = *foot;
        let jet = patch.jet(parameters);
        let residual = jet.point - target;
        let gradient = [2.0 * residual.dot(jet.s), 2.0 * residual.dot(jet.t)];
        Self { parameters, distance_squared, gradient }
    }
}

impl SquaredDistance {
    /// Returns the squared distance from `target` to the patch of these degrees
    /// and homogeneous controls; both are relative to the same point. O(p² q²).
    #[must_use]
    pub fn new(degree: [usize; 2], controls: &[DVec4], target: DVec3) -> Self {
        let [p, q] = degree;
        let relative = relative(controls, target);
        let coefficients = squares(degree, &relative);
        let largest = relative.iter().fold(0.0, |largest, y| upper_max(largest, y.xyz().length_squared()));
        let unit = (ROUNDINGS_PER_DEGREE * (p + q) as f64 + OTHER_ROUNDINGS) * f64::EPSILON;
        Self { degree: [2 * p, 2 * q], coefficients, unit, largest }
    }

    /// Returns a lower bound on the squared distance from the target to the
    /// patch, with rounding subtracted; 0 where coefficients may have overflowed.
    ///
    /// The denominator's coefficients are positive, so the quotient is at least
    /// the smallest quotient of corresponding coefficients. The gap falls with
    /// the square of the patch's size, and is zero where the distance is
    /// constant, as from the axis of a cylinder. O(p q).
    #[must_use]
    pub fn lower_bound(&self) -> f64 {
        if self.largest > MAX_SQUARE {
            return 0.0;
        }
        let rounding = self.unit * self.largest;
        let quotients =
            self.coefficients.iter().map(|&(numerator, denominator)| (numerator - rounding) / denominator);
        quotients.fold(f64::INFINITY, f64::min).max(0.0)
    }

    /// Returns a lower bound as [`SquaredDistance::lower_bound`] does, expanded
    /// about one point; there is no gap where the squared distance is convex and
    /// the point its minimum. O(p q).
    ///
    /// Let λ be the squared distance at the point. Then `P = |Y|² - λ w²` is 0
    /// there and its gradient is w² times that of the squared distance, g. With
    /// the least values `m_ss`, `m_tt` of P's second derivatives over the patch
    /// and the largest absolute value `m_st` of the mixed one, all from
    /// differences of coefficients, and a step δ of at most 1 along each axis,
    ///
    /// `P >= w² g·δ + ½ m_ss δ_s² + ½ m_tt δ_t² - m_st |δ_s δ_t|`,
    ///
    /// where for positive m_ss, m_tt the sum of the two squares is at least
    /// `sqrt(m_ss m_tt) |δ_s δ_t|`; and `|Y|² / w² = λ + P / w²`.
    #[must_use]
    pub fn lower_bound_about(&self, known: &CriticalPoint) -> f64 {
        if self.largest > MAX_SQUARE {
            return 0.0;
        }
        let [p, q] = self.degree;
        let columns = q + 1;
        let at = |i: usize, j: usize| {
            let (numerator, denominator) = self.coefficients[i * columns + j];
            numerator - known.distance_squared * denominator
        };
        let (mut ss, mut tt, mut st) = (f64::INFINITY, f64::INFINITY, 0.0_f64);
        for i in 0..=p {
            for j in 0..=q {
                if i + 2 <= p {
                    ss = ss.min(at(i + 2, j) - 2.0 * at(i + 1, j) + at(i, j));
                }
                if j + 2 <= q {
                    tt = tt.min(at(i, j + 2) - 2.0 * at(i, j + 1) + at(i, j));
                }
                if i < p && j < q {
                    st = st.max((at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j)).abs());
                }
            }
        }
        let (mut lightest, mut heaviest) = (f64::INFINITY, 0.0_f64);
        for &(_, denominator) in &self.coefficients {
            (lightest, heaviest) = (lightest.min(denominator), heaviest.max(denominator));
        }
        let rounding = self.unit * (self.largest + known.distance_squared * heaviest);
        let [p, q] = self.degree.map(|degree| degree as f64);
        let (ss, tt) = (p * (p - 1.0) * (ss - 4.0 * rounding), q * (q - 1.0) * (tt - 4.0 * rounding));
        let st = p * q * (st + 4.0 * rounding);
        let convexity = (ss.max(0.0) * tt.max(0.0)).sqrt();
        let quadratic = 0.5 * (ss.min(0.0) + tt.min(0.0)) - (st - convexity).max(0.0);
        let linear = |axis: usize| {
            let (gradient, parameter) = (known.gradient[axis], known.parameters[axis]);
            (-gradient * parameter).min(gradient * (1.0 - parameter))
        };
        let excess = (heaviest * (linear(0) + linear(1)) + quadratic - rounding) / lightest;
        // `max` raises NaN, which bounds nothing, to 0 as well.
        (known.distance_squared + excess).max(0.0).min(known.distance_squared)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// A plane patch 1e70 wide, one unit below the target, with weights so large
    /// that the squared numerators overflow: the distance is 1 nevertheless.
    #[test]
    fn coefficients_that_overflow_bound_nothing() {
        const WEIGHT: f64 = 1e100;
        let corners = [[-1e70, -1e70], [-1e70, 1e70], [1e70, -1e70], [1e70, 1e70]];
        let controls = corners.map(|[x, y]| (WEIGHT * DVec3::new(x, y, -1.0)).extend(WEIGHT));
        let form = SquaredDistance::new([1, 1], &controls, DVec3::ZERO);
        let known = CriticalPoint { parameters: [0.5; 2], distance_squared: 1.0, gradient: [0.0; 2] };
        assert!(form.lower_bound() <= 1.0 && form.lower_bound_about(&known) <= 1.0, "{form:?}");
    }
}
