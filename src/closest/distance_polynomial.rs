//! Lower bounds on the distance from a point to a patch, from the Bernstein
//! form of the squared distance.

use super::CriticalPoint;
use crate::axis::Axis;
use crate::bezier::{relative, squares};
use crate::rounding::{gamma, lower_min, upper_max};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// The roundings of a quotient of coefficients, beside two for every product that
/// one sums (lemma R10 of docs/rounding.md).
const OTHER_ROUNDINGS: usize = 21;

/// The squared distance from a point to a patch as a quotient of Bernstein
/// polynomials of degree (2p, 2q): with `Y = X - w target`, `|Y|² / w²`.
#[derive(Debug)]
pub struct SquaredDistance {
    degree: [usize; 2],
    /// The coefficients of numerator and denominator, t fastest.
    coefficients: Vec<(f64, f64)>,
    /// An upper bound on the rounding error of a coefficient, relative to the largest.
    unit: f64,
    /// An upper bound on the numerator's coefficients.
    largest: f64,
}

impl SquaredDistance {
    /// Returns the squared distance from `target` to the patch of these degrees
    /// and homogeneous controls; both are relative to the same point. O(p² q²).
    #[must_use]
    pub fn new(degree: [usize; 2], controls: &[DVec4], target: DVec3) -> Self {
        let [p, q] = degree;
        let products = (p / 2 + 1) * (q + 1);
        let relative = relative(controls, target);
        let coefficients = squares(degree, &relative);
        let largest = relative.iter().fold(0.0, |largest, y| upper_max(largest, y.xyz().length_squared()));
        let unit = gamma((2 * products + OTHER_ROUNDINGS) as f64);
        Self { degree: [2 * p, 2 * q], coefficients, unit, largest }
    }

    /// Returns a lower bound on the squared distance from the target to the
    /// patch, with rounding subtracted; 0 where a coefficient overflowed.
    ///
    /// The denominator's coefficients are positive, so the quotient is at least
    /// the smallest quotient of corresponding coefficients. The gap falls with
    /// the square of the patch's size, and is zero where the distance is
    /// constant, as from the axis of a cylinder. O(p q).
    #[must_use]
    pub fn lower_bound(&self) -> f64 {
        let rounding = self.unit * self.largest;
        let quotients =
            self.coefficients.iter().map(|&(numerator, denominator)| (numerator - rounding) / denominator);
        quotients.fold(f64::INFINITY, lower_min).max(0.0)
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
    /// `P >= w² g·δ + ½ m_ss δ_s² - m_st |δ_s δ_t| + ½ m_tt δ_t²`,
    ///
    /// whose last three terms have a least value for such steps; and
    /// `|Y|² / w² = λ + P / w²`.
    ///
    /// The computed λ is off by Δλ at most, which adds `Δλ (w² + ∇w²·δ)` to P and its
    /// linear part, and the gradient by its own error (docs/rounding.md, section 6.6).
    #[must_use]
    pub fn lower_bound_about(&self, known: &CriticalPoint) -> f64 {
        let [ss, tt, st] = self.second_differences(known.distance_squared);
        let (mut lightest, mut heaviest) = (f64::INFINITY, 0.0_f64);
        for &(_, denominator) in &self.coefficients {
            (lightest, heaviest) = (lower_min(lightest, denominator), upper_max(heaviest, denominator));
        }
        let rounding = self.unit * (self.largest + known.distance_squared * heaviest);
        let value_error = known.distance_error * (heaviest + self.denominator_change(heaviest));
        let [p, q] = self.degree.map(|degree| degree as f64);
        let (ss, tt) = (p * (p - 1.0) * (ss - 4.0 * rounding), q * (q - 1.0) * (tt - 4.0 * rounding));
        let st = p * q * (st + 4.0 * rounding);
        let quadratic = least_form(ss, st, tt);
        let linear = |axis: usize| {
            let (gradient, parameter) = (known.gradient[axis], known.parameters[axis]);
            (-gradient * parameter).min(gradient * (1.0 - parameter)) - known.gradient_error[axis]
        };
        let excess = (heaviest * (linear(0) + linear(1)) + quadratic - rounding - value_error) / lightest;
        // `max` raises NaN, which bounds nothing, to 0 as well.
        (known.distance_squared + excess).max(0.0).min(known.distance_squared)
    }

    /// Returns the least second differences of `|Y|² - value w²` along s and along t, and the largest
    /// absolute value of the mixed ones. O(p q).
    fn second_differences(&self, value: f64) -> [f64; 3] {
        let [p, q] = self.degree;
        let columns = q + 1;
        let at = |i: usize, j: usize| {
            let (numerator, denominator) = self.coefficients[i * columns + j];
            numerator - value * denominator
        };
        let (mut ss, mut tt, mut st) = (f64::INFINITY, f64::INFINITY, 0.0_f64);
        for i in 0..=p {
            for j in 0..=q {
                if i + 2 <= p {
                    ss = lower_min(ss, at(i + 2, j) - 2.0 * at(i + 1, j) + at(i, j));
                }
                if j + 2 <= q {
                    tt = lower_min(tt, at(i, j + 2) - 2.0 * at(i, j + 1) + at(i, j));
                }
                if i < p && j < q {
                    st = upper_max(st, (at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j)).abs());
                }
            }
        }
        [ss, tt, st]
    }

    /// Returns the axis along which `|Y|² - λ w²` is more curved, by its second differences:
    /// halving the patch along it takes more off the gaps of both lower bounds. O(p q).
    #[must_use]
    pub(super) fn curved_axis(&self, lambda: f64) -> Axis {
        let columns = self.degree[1] + 1;
        let at = |index: usize| {
            let (numerator, denominator) = self.coefficients[index];
            numerator - lambda * denominator
        };
        let curved =
            |first: usize, step: usize| (at(first + 2 * step) - 2.0 * at(first + step) + at(first)).abs();
        let mut largest = [0.0_f64; 2];
        for index in 0..self.coefficients.len() {
            if index + 2 * columns < self.coefficients.len() {
                largest[0] = upper_max(largest[0], curved(index, columns));
            }
            if index % columns + 2 < columns {
                largest[1] = upper_max(largest[1], curved(index, 1));
            }
        }
        Axis::of_larger([0, 1].map(|axis| {
            let degree = self.degree[axis] as f64;
            degree * (degree - 1.0) * largest[axis]
        }))
    }

    /// Returns an upper bound on `|∇w²·δ|` for steps δ of at most 1 along each axis,
    /// from differences of coefficients. Every coefficient is at most `heaviest`. O(p q).
    fn denominator_change(&self, heaviest: f64) -> f64 {
        let columns = self.degree[1] + 1;
        let mut steps = [0.0_f64; 2];
        for (index, &(_, denominator)) in self.coefficients.iter().enumerate() {
            let step = |next: usize| (self.coefficients[next].1 - denominator).abs();
            if index + columns < self.coefficients.len() {
                steps[0] = upper_max(steps[0], step(index + columns));
            }
            if (index + 1) % columns != 0 {
                steps[1] = upper_max(steps[1], step(index + 1));
            }
        }
        let rounding = 2.0 * self.unit * heaviest;
        (0..2).map(|axis| self.degree[axis] as f64 * (steps[axis] + rounding)).sum()
    }
}

/// Returns the least value of `½ a x² - b x y + ½ c y²` for x and y in [0, 1], with b >= 0.
///
/// As the form is homogeneous, a negative least value is attained where x or y is 1, for
/// (x, y) may be scaled up until one of them is. There it is a parabola in the other.
fn least_form(a: f64, b: f64, c: f64) -> f64 {
    let at_end = |whole: f64, part: f64| {
        if part > b { 0.5 * (whole - b * (b / part)) } else { 0.5 * (whole + part) - b }
    };
    lower_min(lower_min(0.0, at_end(a, c)), at_end(c, a))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// The least value on a grid that has all the places where it is attained.
    #[test]
    fn the_least_value_of_a_form_is_that_of_a_grid() {
        let places: Vec<f64> = (0..=12).map(|place| f64::from(place) / 12.0).collect();
        for a in -4..=6 {
            for (b, c) in (0..=4).flat_map(|b| [-3, 0, 4, 6].map(|c| (b, c))) {
                let [a, b, c] = [a, b, c].map(f64::from);
                let form = |x: f64, y: f64| 0.5 * a * x * x - b * x * y + 0.5 * c * y * y;
                // On the edges it is least at their ends or at b/a and b/c, nearly all of them on the grid.
                let inner = [b / a, b / c].into_iter().filter(|place| (0.0..=1.0).contains(place));
                let places: Vec<f64> = places.iter().copied().chain(inner).collect();
                let values = places.iter().flat_map(|&x| places.iter().map(move |&y| form(x, y)));
                let least = values.fold(f64::INFINITY, f64::min);
                assert!((least_form(a, b, c) - least).abs() <= 1e-15 * 16.0, "{a} {b} {c}: {least}");
            }
        }
        assert_eq!(least_form(f64::NEG_INFINITY, f64::INFINITY, 1.0), f64::NEG_INFINITY);
        assert_eq!(least_form(f64::NAN, 1.0, 1.0), f64::NEG_INFINITY);
        assert_eq!(least_form(1.0, 1.0, f64::NAN), f64::NEG_INFINITY);
    }

    /// A patch that is one point at distance 1, of degrees (2, 2) and weights 1, 2 and 4
    /// along s: `P = |Y|² - w²` and its derivatives are 0, so that the bound is 1 less the
    /// allowances of docs/rounding.md, section 6.6.
    #[test]
    fn the_bound_about_a_point_subtracts_every_allowance() {
        // Weights that are all halved give the same quotients.
        for scale in [1.0, 0.5] {
            let mut controls = Vec::new();
            for w in [1.0, 2.0, 4.0] {
                controls.extend([(scale * w * DVec3::X).extend(scale * w); 3]);
            }
            check_allowances(&SquaredDistance::new([2, 2], &controls, DVec3::ZERO));
        }
    }

    fn check_allowances(form: &SquaredDistance) {
        // 3 products of (2/2 + 1)(2 + 1) = 6, and the largest coefficient of w² is 16.
        let (unit, heaviest) = (gamma(2.0 * 6.0 + 21.0), 16.0);
        let known = CriticalPoint { parameters: [0.5; 2], distance_squared: 1.0, ..CriticalPoint::default() };
        let lost = |known: &CriticalPoint| 1.0 - form.lower_bound_about(known);
        // Coefficients are off by r = unit (16 + 16): P itself by r, its second derivatives
        // by 4 · 3 · 4 r each, where half counts, and the mixed one by 4 · 4 · 4 r.
        let rounding = unit * (heaviest + heaviest);
        let lemma = (1.0 + 24.0 + 24.0 + 64.0) * rounding;
        assert!((lost(&known) / lemma - 1.0).abs() <= 1e-3, "{:e} and {lemma:e}", lost(&known));
        // Weights 1, 2, 4 squared have the coefficients 1, 2, 4, 8, 16: ∇w² is at most 4 · 8.
        let error = 2.0_f64.powi(-12);
        let cases = [
            (CriticalPoint { distance_error: error, ..known }, error * (heaviest + 32.0)),
            (CriticalPoint { gradient_error: [error, 0.0], ..known }, error * heaviest),
            (CriticalPoint { gradient_error: [0.0, error], ..known }, error * heaviest),
            (CriticalPoint { gradient: [error, 0.0], ..known }, 0.5 * error * heaviest),
            (CriticalPoint { gradient: [0.0, -error], ..known }, 0.5 * error * heaviest),
        ];
        for (known, lemma) in cases {
            assert!((lost(&known) / lemma - 1.0).abs() <= 1e-6, "{} and {lemma}: {known:?}", lost(&known));
        }
        // Where w is constant, ∇w² is the rounding of its differences alone.
        let constant = SquaredDistance::new([2, 2], &[DVec3::X.extend(1.0); 9], DVec3::ZERO);
        let change = constant.denominator_change(4.0) / (2.0 * 4.0 * 2.0 * unit * 4.0);
        assert!((0.999..=1.1).contains(&change), "{change}");
    }

    /// About a maximum of the distance, the parabola y = 1 - x² from the origin, the bound
    /// follows the curvature down, in units of any size.
    #[test]
    fn the_bound_about_a_maximum_follows_the_curvature() {
        let half = 0.25;
        let bounds = [1.0, 4.0].map(|size: f64| {
            let points = [[-half, 1.0 - half * half], [0.0, 1.0 + half * half], [half, 1.0 - half * half]];
            let control = |[x, y]: [f64; 2]| DVec4::new(size * x, size * y, 0.0, 1.0);
            let controls: Vec<DVec4> = points.into_iter().flat_map(|point| [control(point); 2]).collect();
            let form = SquaredDistance::new([2, 1], &controls, DVec3::ZERO);
            let distance_squared = size * size;
            let known = CriticalPoint { parameters: [0.5; 2], distance_squared, ..CriticalPoint::default() };
            form.lower_bound_about(&known) / distance_squared
        });
        let least = 1.0 - half * half + half.powi(4);
        assert!(0.5 < bounds[0] && bounds[0] <= least, "{bounds:?}, {least}");
        assert!((bounds[0] - bounds[1]).abs() <= 1e-12, "{bounds:?}");
    }

    /// A plane patch 1e70 wide, one unit below the target, with weights so large
    /// that the squared numerators overflow: the distance is 1 nevertheless.
    #[test]
    fn coefficients_that_overflow_bound_nothing() {
        const WEIGHT: f64 = 1e100;
        let corners = [[-1e70, -1e70], [-1e70, 1e70], [1e70, -1e70], [1e70, 1e70]];
        let controls = corners.map(|[x, y]| (WEIGHT * DVec3::new(x, y, -1.0)).extend(WEIGHT));
        let form = SquaredDistance::new([1, 1], &controls, DVec3::ZERO);
        let known = CriticalPoint { parameters: [0.5; 2], distance_squared: 1.0, ..CriticalPoint::default() };
        assert!(form.lower_bound() <= 1.0 && form.lower_bound_about(&known) <= 1.0, "{form:?}");
    }

    /// The second differences are those of their definition, along each axis and mixed, with the
    /// extreme anywhere.
    #[test]
    fn second_differences_are_the_extremes() {
        let random = &mut fastrand::Rng::with_seed(11);
        for _ in 0..200 {
            let [p, q] = [2 * random.usize(1..3), 2 * random.usize(1..4)];
            let mut number = || f64::from(random.i32(-8..9));
            let coefficients: Vec<(f64, f64)> =
                (0..(p + 1) * (q + 1)).map(|_| (number(), number())).collect();
            let rows: Vec<Vec<f64>> = coefficients
                .chunks(q + 1)
                .map(|row| row.iter().map(|(numerator, denominator)| numerator - 3.0 * denominator).collect())
                .collect();
            let columns: Vec<Vec<f64>> = (0..=q).map(|j| rows.iter().map(|row| row[j]).collect()).collect();
            let differences =
                |line: &[f64]| line.windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<_>>();
            let least = |lines: &[Vec<f64>]| {
                let second = lines.iter().flat_map(|line| differences(&differences(line)));
                second.fold(f64::INFINITY, f64::min)
            };
            let by_rows: Vec<Vec<f64>> = rows.iter().map(|row| differences(row)).collect();
            let mixed = by_rows.windows(2).flat_map(|pair| {
                pair[0].iter().zip(&pair[1]).map(|(a, b)| (b - a).abs()).collect::<Vec<_>>()
            });
            let expected = [least(&columns), least(&rows), mixed.fold(0.0, f64::max)];
            let form = SquaredDistance { degree: [p, q], coefficients, unit: 0.0, largest: 0.0 };
            assert_eq!(form.second_differences(3.0), expected);
        }
    }

    /// ∇w² along t, of weights that vary along t alone.
    #[test]
    fn the_denominator_changes_along_both_axes() {
        let along_t: Vec<DVec4> =
            [1.0, 2.0, 4.0].repeat(3).into_iter().map(|w| (w * DVec3::X).extend(w)).collect();
        let form = SquaredDistance::new([2, 2], &along_t, DVec3::ZERO);
        // Coefficients 1, 2, 4, 8, 16 of degree 4.
        assert!((form.denominator_change(16.0) / 32.0 - 1.0).abs() <= 1e-12);
    }
}
