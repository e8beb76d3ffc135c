//! A bound on the length of a vector-valued quadratic over a square.

use crate::rounding::upper_max;
use glam::DVec3;

/// `value + σ s + τ t + ½σ² ss + στ st + ½τ² tt` for (σ, τ) in [-1, 1]^2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadratic {
    /// The value at the centre.
    pub value: DVec3,
    /// First derivative by σ.
    pub s: DVec3,
    /// First derivative by τ.
    pub t: DVec3,
    /// Second derivative by σ.
    pub ss: DVec3,
    /// Mixed second derivative.
    pub st: DVec3,
    /// Second derivative by τ.
    pub tt: DVec3,
}

/// Quadratic Bernstein coefficients of σ on [-1, 1], and of σ².
const LINEAR: [f64; 3] = [-1.0, 0.0, 1.0];
const SQUARE: [f64; 3] = [1.0, -1.0, 1.0];

/// `C(2,i) C(2,k) / C(4,i+k)`: the coefficient of the product of the quadratic
/// Bernstein polynomials i and k at the quartic number i + k.
const PRODUCT: [[f64; 3]; 3] = [[1.0, 0.5, 1.0 / 6.0], [0.5, 2.0 / 3.0, 0.5], [1.0 / 6.0, 0.5, 1.0]];

/// The largest of the coefficients and 0; NaN where one is NaN.
pub(in crate::certified::bounds) fn max_coefficient(coefficients: &[[f64; 5]; 5]) -> f64 {
    let mut largest = 0.0_f64;
    for &coefficient in coefficients.iter().flatten() {
        if coefficient > largest || coefficient.is_nan() {
            largest = coefficient;
        }
    }
    largest
}

/// The mean over the square of a biquartic with these Bernstein coefficients and a density that is proportional to
/// 1 + aσ + bτ, |a| + |b| <= 1: a Bernstein polynomial of order 4 has the mean 1/5, and σ the mean (i - 2)/3 with
/// number i.
pub(super) fn mean_of_biquartic(coefficients: &[[f64; 5]; 5], [a, b]: [f64; 2]) -> f64 {
    let mean = |number: usize| (number as f64 - 2.0) / 3.0;
    let rows = coefficients.iter().zip(0..);
    let terms = rows.flat_map(|(row, i)| row.iter().zip(0..).map(move |(value, j)| (value, i, j)));
    terms.map(|(value, i, j)| value * (1.0 + a * mean(i) + b * mean(j))).sum::<f64>() / 25.0
}

impl Quadratic {
    /// An upper bound on `|Q|²` over the square: the largest of its
    /// coefficients. Exact where `|Q|²` is constant; NaN where a coefficient is NaN.
    #[must_use]
    pub fn max_length_squared(&self) -> f64 {
        max_coefficient(&self.length_squared())
    }

    /// An upper bound on the length of Q over the square by that of its terms.
    pub(super) fn size(&self) -> f64 {
        let [first, second] = [self.s.length() + self.t.length(), self.ss.length() + self.tt.length()];
        self.value.length() + first + self.st.length() + 0.5 * second
    }

    /// By how much about the longest Q falls if the square is halved about its centre along σ, and along
    /// τ: the sum of what its terms add to the length of the value, those along it in full and those
    /// across it by Pythagoras.
    pub(super) fn gains_of_halving(&self) -> [f64; 2] {
        let length = self.value.length();
        let added = |term: DVec3| {
            let square = term.length_squared();
            let along = if length > 0.0 { self.value.dot(term).abs() / length } else { 0.0 };
            let across = (square - along * along).max(0.0);
            along + across / (length + (length * length + across).sqrt()).max(f64::MIN_POSITIVE)
        };
        let mixed = added(self.st);
        [[self.s, self.ss], [self.t, self.tt]]
            .map(|[first, second]| 0.5 * added(first) + 0.375 * added(second) + 0.5 * mixed)
    }

    /// The largest length of the controls of Q, an upper bound on its length over the square.
    pub(super) fn max_control(&self) -> f64 {
        self.net().iter().flatten().fold(0.0, |longest, control| upper_max(longest, control.length()))
    }

    /// The Bernstein coefficients of Q.
    fn net(&self) -> [[DVec3; 3]; 3] {
        let mut net = [[DVec3::ZERO; 3]; 3];
        for (i, row) in net.iter_mut().enumerate() {
            for (j, control) in row.iter_mut().enumerate() {
                *control = self.value
                    + LINEAR[i] * self.s
                    + LINEAR[j] * self.t
                    + (0.5 * SQUARE[i]) * self.ss
                    + (LINEAR[i] * LINEAR[j]) * self.st
                    + (0.5 * SQUARE[j]) * self.tt;
            }
        }
        net
    }

    /// The 25 Bernstein coefficients of the biquartic `|Q|²`, whose largest the
    /// polynomial does not exceed (convex hull property).
    #[must_use]
    pub fn length_squared(&self) -> [[f64; 5]; 5] {
        let net = self.net();
        let mut coefficients = [[0.0_f64; 5]; 5];
        for i in 0..3 {
            for j in 0..3 {
                coefficients[2 * i][2 * j] += PRODUCT[i][i] * PRODUCT[j][j] * net[i][j].length_squared();
                // Each pair of controls once, as it has two products.
                for k in i..3 {
                    for l in if k == i { j + 1 } else { 0 }..3 {
                        coefficients[i + k][j + l] +=
                            2.0 * PRODUCT[i][k] * PRODUCT[j][l] * net[i][j].dot(net[k][l]);
                    }
                }
            }
        }
        coefficients
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn the_size_is_the_sum_of_the_terms() {
        let [value, s, t, ss, st, tt] = [1.0, 2.0, 4.0, 16.0, 32.0, 128.0].map(|length| length * DVec3::Y);
        let quadratic = Quadratic { value, s, t, ss, st, tt };
        assert_eq!(quadratic.size(), 1.0 + 2.0 + 4.0 + 8.0 + 32.0 + 64.0);
        // All terms have one sign at a corner, where the length is that.
        assert_eq!(quadratic.max_length_squared(), quadratic.size().powi(2));
    }

    /// Halving the square takes off half of what first and mixed terms add to the value's length and
    /// three quarters of what squares add: terms along the value in full, and across it by Pythagoras.
    #[test]
    fn the_gains_are_those_of_single_terms() {
        let constant = Quadratic {
            value: 4.0 * DVec3::Z,
            s: DVec3::ZERO,
            t: DVec3::ZERO,
            ss: DVec3::ZERO,
            st: DVec3::ZERO,
            tt: DVec3::ZERO,
        };
        let along = -2.0 * DVec3::Z;
        let across = 3.0 * DVec3::X;
        for (term, added) in [(along, 2.0), (across, 1.0)] {
            assert_eq!(Quadratic { s: term, ..constant }.gains_of_halving(), [0.5 * added, 0.0]);
            assert_eq!(Quadratic { t: term, ..constant }.gains_of_halving(), [0.0, 0.5 * added]);
            assert_eq!(Quadratic { ss: term, ..constant }.gains_of_halving(), [0.375 * added, 0.0]);
            assert_eq!(Quadratic { tt: term, ..constant }.gains_of_halving(), [0.0, 0.375 * added]);
            assert_eq!(Quadratic { st: term, ..constant }.gains_of_halving(), [0.5 * added; 2]);
        }
        let nothing = Quadratic { value: DVec3::ZERO, ..constant };
        assert_eq!(nothing.gains_of_halving(), [0.0; 2]);
        assert_eq!(Quadratic { s: across, ..nothing }.gains_of_halving(), [1.5, 0.0]);
    }

    /// The coefficients are those of `|Q|²`: the biquartic with them has its values.
    #[test]
    fn the_coefficients_are_those_of_the_square() {
        let vector = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        let quadratic = Quadratic {
            value: vector(1.0, -2.0, 0.5),
            s: vector(-0.5, 1.0, 2.0),
            t: vector(2.0, 0.25, -1.0),
            ss: vector(1.0, 3.0, -0.5),
            st: vector(0.75, -1.0, 1.5),
            tt: vector(-2.0, 0.5, 1.0),
        };
        let coefficients = quadratic.length_squared();
        let bernstein = |x: f64| {
            let (x, y) = (0.5 * (1.0 + x), 0.5 * (1.0 - x));
            [y.powi(4), 4.0 * x * y.powi(3), 6.0 * x * x * y * y, 4.0 * x.powi(3) * y, x.powi(4)]
        };
        for step in 0..81 {
            let [s, t] = [step / 9, step % 9].map(|step| f64::from(step) / 4.0 - 1.0);
            let Quadratic { value, s: by_s, t: by_t, ss, st, tt } = quadratic;
            let q = value + s * by_s + t * by_t + 0.5 * s * s * ss + s * t * st + 0.5 * t * t * tt;
            let (in_s, in_t) = (bernstein(s), bernstein(t));
            let mut sum = 0.0;
            for (row, in_s) in coefficients.iter().zip(in_s) {
                sum += row.iter().zip(in_t).map(|(c, in_t)| c * in_s * in_t).sum::<f64>();
            }
            assert!((sum - q.length_squared()).abs() <= 1e-12, "{sum} at ({s}, {t})");
        }
    }

    /// The mean of |Q|² with the densities 1, 1 + σ/2 and 1 + τ/2, of terms that are orthogonal or not.
    #[test]
    fn the_mean_square_is_the_integral() {
        let [zero, x, y] = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let nothing = Quadratic { value: zero, s: zero, t: zero, ss: zero, st: zero, tt: zero };
        // The means of σ, σ² and σ⁴ are 0, 1/3 and 1/5; with the density 1 + σ/2 that of σ is 1/6.
        let cases = [
            (Quadratic { value: x, s: y, ..nothing }, [4.0 / 3.0; 3]),
            (Quadratic { value: x, t: y, ..nothing }, [4.0 / 3.0; 3]),
            (Quadratic { value: x, s: x, ..nothing }, [4.0 / 3.0, 5.0 / 3.0, 4.0 / 3.0]),
            (Quadratic { value: x, t: x, ..nothing }, [4.0 / 3.0, 4.0 / 3.0, 5.0 / 3.0]),
            (Quadratic { value: x, ss: x, ..nothing }, [1.0 + 1.0 / 3.0 + 0.05; 3]),
            (Quadratic { value: x, st: y, ..nothing }, [1.0 + 1.0 / 9.0; 3]),
            (Quadratic { value: x, tt: y, ..nothing }, [1.05; 3]),
        ];
        for (quadratic, expected) in cases {
            let found = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5]]
                .map(|tilt| mean_of_biquartic(&quadratic.length_squared(), tilt));
            let is_near = |index: usize| (found[index] - expected[index]).abs() < 1e-14;
            assert!((0..3).all(is_near), "{found:?} {expected:?} of {quadratic:?}");
        }
    }
}
