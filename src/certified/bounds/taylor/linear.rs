//! Linear functions over a cell's square.

use super::{Quadratic, UNIT_ROUNDOFF, coefficient_error, max_coefficient};
use glam::DVec3;

/// The roundings of a quotient and of its divisor.
const QUOTIENT_ROUNDINGS: f64 = 16.0;

/// `value + σ slopes[0] + τ slopes[1]` for (σ, τ) in [-1, 1]².
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::certified) struct Linear {
    pub(in crate::certified) value: f64,
    pub(in crate::certified) slopes: [f64; 2],
}

impl Linear {
    /// Returns the value at a place of the square.
    pub(in crate::certified) fn at(&self, [s, t]: [f64; 2]) -> f64 {
        self.value + s * self.slopes[0] + t * self.slopes[1]
    }

    /// Returns a linear function that |Q| plus the remainder does not exceed, from the coefficients of |Q|²; `None` if Q may
    /// vanish.
    ///
    /// Its slopes are those of |Q| at the centre. Lemma S4 of `docs/meshes.md`: for a positive linear λ and
    /// |Q|² - λ² <= D, |Q| is at most λ + D/(2 min λ).
    pub(super) fn above_length(
        quadratic: &Quadratic,
        squares: &[[f64; 5]; 5],
        remainder: f64,
    ) -> Option<Self> {
        let length = quadratic.value.length();
        let direction = quadratic.value / length;
        let slopes = [quadratic.s, quadratic.t].map(|slope| direction.dot(slope));
        let least = length - slopes[0].abs() - slopes[1].abs();
        let [zero, along] = [DVec3::ZERO, DVec3::X];
        let [s, t] = slopes.map(|slope| slope * along);
        let line = Quadratic { value: length * along, s, t, ss: zero, st: zero, tt: zero };
        let mut difference = *squares;
        for (row, of_line) in difference.iter_mut().zip(line.length_squared()) {
            for (value, of_line) in row.iter_mut().zip(of_line) {
                *value -= of_line;
            }
        }
        let excess = max_coefficient(&difference) + coefficient_error(quadratic) + coefficient_error(&line);
        let above = excess / (2.0 * least) * (1.0 + QUOTIENT_ROUNDINGS * UNIT_ROUNDOFF);
        // A NaN bounds nothing.
        (least > 0.0 && above >= 0.0).then_some(Self { value: length + above + remainder, slopes })
    }
}
