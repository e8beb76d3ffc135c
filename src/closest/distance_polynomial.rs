//! Lower bounds of the distance from a point to a patch.

use super::Foot;
use crate::bezier::{Patch, relative, squares};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// Roundings of 2^-53 on the way to one coefficient, per degree and besides.
const ROUNDINGS_PER_DEGREE: f64 = 4.0;
const ROUNDINGS_BESIDES: f64 = 32.0;

/// The squared distance from a point to a patch as a quotient of Bernstein
/// polynomials of degree (2p, 2q): with `Y = X - w target`, `|Y|^2 / w^2`.
#[derive(Debug)]
pub struct SquaredDistance {
    degree: [usize; 2],
    /// Coefficients of numerator and denominator, t fastest.
    products: Vec<(f64, f64)>,
    /// What rounding may have changed a coefficient by, relative to the largest.
    unit: f64,
    /// At least the largest numerator's coefficient.
    largest: f64,
}

/// A point of the patch, from which a bound is taken.
#[derive(Debug, Clone, Copy)]
pub struct CriticalPoint {
    /// (s, t) in [0, 1]^2.
    pub parameters: [f64; 2],
    /// The squared distance there.
    pub distance_squared: f64,
    /// Its derivatives by s and t.
    pub gradient: [f64; 2],
}

impl CriticalPoint {
    /// Where an iteration ended.
    pub(crate) fn new(patch: &Patch<'_>, target: DVec3, foot: &Foot) -> Self {
        let Foot { parameters, distance_squared, .. } = *foot;
        let jet = patch.jet(parameters);
        let residual = jet.point - target;
        let gradient = [2.0 * residual.dot(jet.s), 2.0 * residual.dot(jet.t)];
        Self { parameters, distance_squared, gradient }
    }
}

impl SquaredDistance {
    /// Of the patch of these degrees and homogeneous controls, which are
    /// relative to the same point as `target`. O(p^2 q^2).
    #[must_use]
    pub fn new(degree: [usize; 2], controls: &[DVec4], target: DVec3) -> Self {
        let [p, q] = degree;
        let relative = relative(controls, target);
        let products = squares(degree, &relative);
        let largest = relative.iter().fold(0.0_f64, |largest, y| largest.max(y.xyz().length_squared()));
        let unit = (ROUNDINGS_PER_DEGREE * (p + q) as f64 + ROUNDINGS_BESIDES) * f64::EPSILON;
        Self { degree: [2 * p, 2 * q], products, unit, largest }
    }

    /// At most the squared distance from the target to the patch.
    ///
    /// The denominator's coefficients are positive, so the quotient is at least
    /// the smallest quotient of coefficients. The gap falls with the square of
    /// the patch's size, and is zero where the distance is constant, as from
    /// the axis of a cylinder. Rounding is taken off. O(p q).
    #[must_use]
    pub fn least(&self) -> f64 {
        let lost = self.unit * self.largest;
        let least = self.products.iter().fold(f64::INFINITY, |least, &(numerator, denominator)| {
            least.min((numerator - lost) / denominator)
        });
        least.max(0.0)
    }

    /// The same from what is known of one point, with no gap where the squared
    /// distance is convex and the point its minimum. O(p q).
    ///
    /// With λ the squared distance at the point, `P = |Y|^2 - λ w^2` is 0 there
    /// and has w^2 times its gradient. With the least `m_ss`, `m_tt` of P's
    /// second derivatives over the patch and the largest size `m_st` of the
    /// mixed one, from differences of coefficients, and a step δ of at most 1,
    ///
    /// `P >= w^2 g·δ + ½ m_ss δ_s² + ½ m_tt δ_t² - m_st |δ_s δ_t|`,
    ///
    /// where for positive m_ss, m_tt the first two squares outweigh
    /// `sqrt(m_ss m_tt) |δ_s δ_t|`; and `|Y|^2 / w^2 = λ + P / w^2`.
    #[must_use]
    pub fn least_about(&self, known: &CriticalPoint) -> f64 {
        let [p, q] = self.degree;
        let doubled = q + 1;
        let at = |i: usize, j: usize| {
            let (numerator, denominator) = self.products[i * doubled + j];
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
        for &(_, denominator) in &self.products {
            (lightest, heaviest) = (lightest.min(denominator), heaviest.max(denominator));
        }
        let lost = self.unit * (self.largest + known.distance_squared * heaviest);
        let [p, q] = self.degree.map(|degree| degree as f64);
        let (ss, tt) = (p * (p - 1.0) * (ss - 4.0 * lost), q * (q - 1.0) * (tt - 4.0 * lost));
        let st = p * q * (st + 4.0 * lost);
        let bent = 0.5 * (ss.min(0.0) + tt.min(0.0)) - (st - (ss.max(0.0) * tt.max(0.0)).sqrt()).max(0.0);
        let along = |axis: usize| {
            let (gradient, parameter) = (known.gradient[axis], known.parameters[axis]);
            (-gradient * parameter).min(gradient * (1.0 - parameter))
        };
        let least = known.distance_squared + (heaviest * (along(0) + along(1)) + bent - lost) / lightest;
        // What is no number bounds nothing: `max` passes over it.
        least.max(0.0).min(known.distance_squared)
    }
}
