//! Feet that slide along B by the tangential part of a difference.
//!
//! A fit keeps neither the parameters nor the feet of its surface: `D = A - B∘φ` is often
//! many times as long along B as it is across, and only the latter counts.
//!
//! Lemma (sliding feet). Let φ map a piece to a box of a surface's parameters, let `P` be any
//! linear map of space to parameter steps, `δ = P D`, and let φ + δ stay in the surface. Let T be
//! the surface's derivatives at the middle of the box, `N = I - T P`, and C_s, C_t bounds on how far
//! its derivatives differ from T over the box widened by the largest |δ_s| and |δ_t|. Then
//!
//! `d(·, B) <= max |N D| + C_s max |δ_s| + C_t max |δ_t|` .
//!
//! Proof. φ + δ is a map into B's parameters as well. `A - B(φ + δ) = D - T δ - (B(φ + δ) - B(φ) - T δ)`,
//! `D - T δ = N D`, and the rest is the integral of `(B' - T) δ` along the step. ∎
//!
//! With homogeneous coefficients n_k of D and d_k > 0 of its denominator, `max |N D|` is at most the
//! largest `|N n_k| / d_k`, and `max |δ_i|` the largest `|(P n_k)_i| / d_k`, as N and P are linear.
//! With P the pseudo-inverse of T, N projects on the normal, and the excess over the part of D across
//! B is the turn of B's tangents over the piece times the part along it: of second order where
//! |D| is of first.

use crate::certified::rounding::gamma;
use crate::certified::sheets::Chart;
use crate::rounding::upper_max;
use glam::DVec3;

/// The smallest squared sine of the angle between the tangents with which both parameters slide.
const MIN_SINE_SQUARED: f64 = 1e-6;

/// Roundings of `N n_k`, relative to the sizes of its terms: three of a dot product, four of a
/// row of P, a product and two sums.
const RESIDUAL_ROUNDINGS: f64 = 12.0;

/// A factor by which boxes and steps are widened for the rounding of their sums.
const WIDENED: f64 = 1.0 + 16.0 * f64::EPSILON;

/// The image of a piece on a surface of B, and the tangents about which feet slide.
#[derive(Debug)]
pub(super) struct Sliding<'a> {
    /// About the middle of the image.
    chart: Chart<'a>,
    /// Half the widths of the image.
    half: [f64; 2],
    tangents: [DVec3; 2],
}

/// What a slide makes of a difference.
struct Slid {
    /// A bound on `N D`.
    residual: f64,
    /// The largest steps.
    steps: [f64; 2],
}

impl<'a> Sliding<'a> {
    /// Takes the image of a piece in the patch that is so many patches away from that of a chart.
    pub(super) fn new(chart: &Chart<'a>, offsets: [isize; 2], image: [[f64; 2]; 2]) -> Self {
        let middle = image.map(|[low, high]| 0.5 * (low + high));
        let half = [0, 1].map(|axis| {
            let [low, high] = image[axis];
            WIDENED * (high - middle[axis]).max(middle[axis] - low)
        });
        let chart = chart.moved(offsets, middle);
        let jet = chart.jet();
        Self { chart, half, tangents: [jet.s, jet.t] }
    }

    /// The length of a vector without its part along the tangents.
    pub(super) fn residual(&self, vector: DVec3) -> f64 {
        let inverse = self.inverse([true; 2]);
        self.residual_of(vector, &inverse).length()
    }

    /// An upper bound on the distance of a piece by the lemma, given the coefficients of D divided
    /// by those of its denominator, if it is at most `threshold`. O(p q).
    pub(super) fn upper_bound(&self, coefficients: &[DVec3], threshold: f64) -> Option<f64> {
        let mut free = [true; 2];
        // Once with both, with one, and with the other parameter fixed.
        for _ in 0..2 {
            let slid = self.slid(coefficients, free);
            let is_small = slid.residual <= threshold;
            if !is_small {
                return None;
            }
            let half = [0, 1].map(|axis| WIDENED * (self.half[axis] + slid.steps[axis]));
            let reach = self.chart.reach(half);
            let is_inside = |axis: usize| {
                let ([low, high], at) = (reach.domain[axis], self.chart.parameters[axis]);
                low <= at - half[axis] && at + half[axis] <= high
            };
            let stays = [0, 1].map(|axis| slid.steps[axis] == 0.0 || is_inside(axis));
            if stays == [true; 2] {
                return [false, true].into_iter().find_map(|is_local| {
                    let slope = self.chart.slope(&reach, half, is_local);
                    let error = slope.error(slid.steps) + self.chart.slope_rounding(slid.steps);
                    let bound = slid.residual + WIDENED * error;
                    (bound <= threshold).then_some(bound)
                });
            }
            free = [0, 1].map(|axis| free[axis] && stays[axis]);
            if free == [false; 2] {
                return None;
            }
        }
        None
    }

    /// The rows of P: the pseudo-inverse of the tangents of the parameters that are free.
    fn inverse(&self, free: [bool; 2]) -> [DVec3; 2] {
        let [s, t] = self.tangents;
        let [ss, st, tt] = [s.dot(s), s.dot(t), t.dot(t)];
        let along = |axis: usize| {
            let tangent = self.tangents[axis] / self.tangents[axis].length_squared();
            if free[axis] && tangent.is_finite() { tangent } else { DVec3::ZERO }
        };
        let determinant = ss * tt - st * st;
        if free == [true; 2] && determinant > MIN_SINE_SQUARED * ss * tt {
            [(tt * s - st * t) / determinant, (ss * t - st * s) / determinant]
        } else if free == [true; 2] {
            // Parallel tangents, or one that vanishes.
            if ss >= tt { [along(0), DVec3::ZERO] } else { [DVec3::ZERO, along(1)] }
        } else {
            [along(0), along(1)]
        }
    }

    fn residual_of(&self, vector: DVec3, inverse: &[DVec3; 2]) -> DVec3 {
        vector - inverse[0].dot(vector) * self.tangents[0] - inverse[1].dot(vector) * self.tangents[1]
    }

    fn slid(&self, coefficients: &[DVec3], free: [bool; 2]) -> Slid {
        let inverse = self.inverse(free);
        let (mut residual, mut longest, mut steps) = (0.0_f64, 0.0_f64, [0.0_f64; 2]);
        for &coefficient in coefficients {
            residual = upper_max(residual, self.residual_of(coefficient, &inverse).length());
            longest = upper_max(longest, coefficient.length());
            for (step, row) in steps.iter_mut().zip(&inverse) {
                *step = upper_max(*step, row.dot(coefficient).abs());
            }
        }
        let [s, t] = [0, 1].map(|axis| inverse[axis].length() * self.tangents[axis].length());
        let rounding = gamma(RESIDUAL_ROUNDINGS * (1.0 + s + t)) * longest;
        let steps =
            [0, 1].map(|axis| steps[axis] + gamma(RESIDUAL_ROUNDINGS) * inverse[axis].length() * longest);
        Slid { residual: residual + rounding, steps }
    }
}
