//! What every search states: an interval that contains a number, whether a limit on it is decided, and why the search
//! ended.

mod limit;
mod stop;

pub(crate) use limit::Limit;
pub use stop::Stop;

use serde::Serialize;
use std::fmt::{Display, Formatter};
use std::ops::{Add, Mul, Neg, Sub};

/// An interval that contains a number: `lower <= number <= upper`.
///
/// Sums, differences and products contain those of all numbers of the operands, rounding included.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Interval {
    /// A lower bound.
    pub lower: f64,
    /// An upper bound.
    pub upper: f64,
}

impl Interval {
    /// The interval of all numbers, which bounds nothing.
    pub(crate) const ALL: Self = Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };

    /// The interval of the numbers that are within `error` of `value`; NaN bounds nothing.
    #[must_use]
    pub fn about(value: f64, error: f64) -> Self {
        Self::outward(value - error, value + error)
    }

    /// The interval of one number.
    #[must_use]
    pub fn exactly(value: f64) -> Self {
        Self { lower: value, upper: value }
    }

    /// The interval between two bounds that were rounded once each.
    fn outward(lower: f64, upper: f64) -> Self {
        if lower <= upper { Self { lower: lower.next_down(), upper: upper.next_up() } } else { Self::ALL }
    }

    /// Returns the number in the middle; for an interval without bounds it is not finite.
    #[must_use]
    pub fn middle(&self) -> f64 {
        0.5 * self.lower + 0.5 * self.upper
    }

    /// Returns an upper bound on the width.
    #[must_use]
    pub fn width(&self) -> f64 {
        (self.upper - self.lower).next_up()
    }

    /// Returns an upper bound on the distance of the numbers from the middle.
    #[must_use]
    pub fn radius(&self) -> f64 {
        let middle = self.middle();
        let [below, above] = [middle - self.lower, self.upper - middle];
        if below > above { below.next_up() } else { above.next_up() }
    }

    /// Returns whether a number is in the interval.
    #[must_use]
    pub fn contains(&self, number: f64) -> bool {
        self.lower <= number && number <= self.upper
    }

    /// Returns whether all numbers are below all of the other interval, or none is; `None` where that is
    /// not decided.
    #[must_use]
    pub fn is_below(&self, other: &Self) -> Option<bool> {
        if self.upper < other.lower {
            Some(true)
        } else if self.lower >= other.upper {
            Some(false)
        } else {
            None
        }
    }

    /// Returns the interval of the quotients by a number that is not 0; all numbers where the divisor may be.
    #[must_use]
    pub fn over(self, divisor: Self) -> Self {
        if !(divisor.lower > 0.0) && !(divisor.upper < 0.0) {
            return Self::ALL;
        }
        let quotients = [
            self.lower / divisor.lower,
            self.lower / divisor.upper,
            self.upper / divisor.lower,
            self.upper / divisor.upper,
        ];
        Self::hull(quotients)
    }

    /// The interval about four numbers that were rounded once each; NaN bounds nothing.
    fn hull(numbers: [f64; 4]) -> Self {
        let (mut lower, mut upper) = (numbers[0], numbers[0]);
        for number in numbers {
            if number.is_nan() {
                return Self::ALL;
            }
            if number < lower {
                lower = number;
            }
            if number > upper {
                upper = number;
            }
        }
        Self::outward(lower, upper)
    }

    /// Returns the interval of the larger of two numbers.
    pub(crate) fn larger(self, other: Self) -> Self {
        Self {
            lower: if other.lower > self.lower { other.lower } else { self.lower },
            upper: if other.upper > self.upper { other.upper } else { self.upper },
        }
    }

    /// Returns the interval of the smaller of two numbers.
    pub(crate) fn smaller(self, other: Self) -> Self {
        -(-self).larger(-other)
    }

    /// Returns the interval of the absolute values.
    pub(crate) fn absolute(self) -> Self {
        self.larger(-self).not_negative()
    }

    /// Returns the interval of the roots of numbers that are not negative.
    pub(crate) fn root(self) -> Self {
        let Self { lower, upper } = self.not_negative();
        Self { lower: lower.sqrt().next_down(), upper: upper.sqrt().next_up() }.not_negative()
    }

    /// Returns the numbers that both intervals contain, of which there must be one.
    pub(crate) fn within(self, other: Self) -> Self {
        Self {
            lower: if other.lower > self.lower { other.lower } else { self.lower },
            upper: if other.upper < self.upper { other.upper } else { self.upper },
        }
    }

    /// Returns the numbers of the interval from `least` to `most`, of which there must be one.
    pub(crate) fn clamped(self, least: f64, most: f64) -> Self {
        let within = |bound: f64| {
            if bound < least {
                least
            } else if bound > most {
                most
            } else {
                bound
            }
        };
        Self { lower: within(self.lower), upper: within(self.upper) }
    }

    /// Returns the numbers of the interval that are not negative, of which there must be one.
    pub(crate) fn not_negative(self) -> Self {
        let raised = |bound: f64| if bound < 0.0 { 0.0 } else { bound };
        Self { lower: raised(self.lower), upper: raised(self.upper) }
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::outward(self.lower + other.lower, self.upper + other.upper)
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::outward(self.lower - other.upper, self.upper - other.lower)
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { lower: -self.upper, upper: -self.lower }
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::hull([
            self.lower * other.lower,
            self.lower * other.upper,
            self.upper * other.lower,
            self.upper * other.upper,
        ])
    }
}

impl Mul<f64> for Interval {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        self * Self::exactly(factor)
    }
}

/// The digits of the radius in texts.
const RADIUS_DIGITS: usize = 0;

/// The digits of a number of float64 behind its first one.
const MAX_DIGITS: f64 = 16.0;

/// Numbers below this that need more decimals than [`MAX_DECIMALS`] are written with an exponent.
const LEAST_PLAIN: f64 = 1e-5;
const MAX_DECIMALS: f64 = 17.0;

/// The decimals of the least number that is written without one, and of 0.
const MAX_PLAIN: f64 = 21.0;

/// Returns the number with one digit more than an error of this size leaves certain.
fn written(number: f64, error: f64) -> String {
    let size = number.abs().log10().floor();
    let certain = 1.0 - error.log10().floor();
    let decimals = if certain < MAX_DIGITS - size { certain } else { MAX_DIGITS - size };
    if decimals > MAX_DECIMALS && number.abs() < LEAST_PLAIN && number != 0.0 {
        let digits = (size + decimals).max(0.0) as usize;
        return format!("{number:.digits$e}");
    }
    let decimals = decimals.clamp(0.0, MAX_PLAIN) as usize;
    let written = format!("{number:.decimals$}");
    // Without the sign of a 0.
    match written.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|byte| matches!(byte, b'0' | b'.')) => digits.to_owned(),
        _ => written,
    }
}

impl Display for Interval {
    /// Writes the middle with the digits that are certain, and the radius: `360.00000 ± 2e-7`.
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        let (middle, radius) = (self.middle(), self.radius());
        if !radius.is_finite() {
            return write!(formatter, "unknown");
        }
        // The middle as written is off by at most half of the radius, which is rounded up.
        let written = written(middle, radius);
        let off = written.parse::<f64>().map_or(0.0, |written| (written - middle).abs());
        // The number in the text is not one of float64, and so off by as much as that rounds it.
        let unit = if radius > 0.0 { f64::EPSILON * middle.abs() } else { 0.0 };
        let radius = (radius + off + unit).next_up();
        let size = 10.0_f64.powf(radius.log10().floor());
        let rounded = (radius / size).ceil() * size * (1.0 + 2.0 * f64::EPSILON);
        write!(formatter, "{written} ± {rounded:.RADIUS_DIGITS$e}")
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn results_contain_those_of_all_numbers() {
        let [a, b] = [Interval { lower: -1.0, upper: 2.0 }, Interval { lower: 3.0, upper: 5.0 }];
        let holds = |found: Interval, lower: f64, upper: f64| {
            assert!(found.lower <= lower && upper <= found.upper && found.width() < upper - lower + 1e-14);
        };
        holds(a + b, 2.0, 7.0);
        holds(a - b, -6.0, -1.0);
        holds(a * b, -5.0, 10.0);
        holds(a.over(b), -1.0 / 3.0, 2.0 / 3.0);
        assert_eq!(b.over(a), Interval::ALL);
        assert_eq!(Interval::about(f64::NAN, 1.0), Interval::ALL);
        assert_eq!(Interval::about(1.0, f64::NAN), Interval::ALL);
    }

    #[test]
    fn maps_of_intervals_hold_the_images_of_their_numbers() {
        let of = |lower: f64, upper: f64| Interval { lower, upper };
        assert_eq!(of(-3.0, 2.0).absolute(), of(0.0, 3.0));
        assert_eq!(of(-3.0, -2.0).absolute(), of(2.0, 3.0));
        assert_eq!(of(1.0, 4.0).smaller(of(2.0, 3.0)), of(1.0, 3.0));
        assert_eq!(of(1.0, 4.0).within(of(2.0, 5.0)), of(2.0, 4.0));
        assert!(of(2.0, 2.0).root().contains(std::f64::consts::SQRT_2));
        let root = of(2.0, 9.0).root();
        assert!(root.lower * root.lower < 2.0 && root.upper * root.upper > 9.0, "{root:?}");
        assert_eq!(of(0.0, 0.0).root().lower, 0.0);
        assert_eq!(Interval::ALL.absolute(), of(0.0, f64::INFINITY));
    }

    #[test]
    fn what_intervals_do_not_decide_is_none() {
        let of = |lower: f64, upper: f64| Interval { lower, upper };
        assert_eq!(of(0.0, 1.0).is_below(&of(2.0, 3.0)), Some(true));
        assert_eq!(of(2.0, 3.0).is_below(&of(0.0, 2.0)), Some(false));
        assert_eq!(of(0.0, 2.0).is_below(&of(1.0, 3.0)), None);
    }

    #[test]
    fn texts_have_the_digits_that_are_certain() {
        assert_eq!(Interval::about(360.0, 1.5e-7).to_string(), "360.00000000 ± 2e-7");
        assert_eq!(Interval::about(-12.34567, 0.04).to_string(), "-12.346 ± 5e-2");
        assert_eq!(Interval::ALL.to_string(), "unknown");
        assert_eq!(Interval::about(6e-27, 6.5e-33).to_string(), "6.0000000e-27 ± 7e-33");
        assert_eq!(Interval::about(-3e-7, 2e-20).to_string(), "-3.00000000000000e-7 ± 3e-20");
        assert_eq!(Interval::about(0.0, 2e-9).to_string(), "0.0000000000 ± 3e-9");
        assert_eq!(Interval::about(-1e-30, 2e-9).to_string(), "0.0000000000 ± 3e-9");
    }

    /// Of numbers of many sizes, in an order that repeats.
    #[test]
    fn texts_hold_the_interval() {
        let mut random = fastrand::Rng::with_seed(11);
        for _ in 0..5_000 {
            let middle = 10.0_f64.powf(60.0 * random.f64() - 50.0) * if random.bool() { 1.0 } else { -1.0 };
            let interval = Interval::about(middle, middle.abs() * 10.0_f64.powf(-18.0 * random.f64()));
            let text = interval.to_string();
            let numbers: Vec<f64> = text.split(" ± ").filter_map(|word| word.parse().ok()).collect();
            let [number, radius] = numbers[..] else { panic!("{text}") };
            let room = f64::EPSILON * (number.abs() + radius);
            assert!(number - radius <= interval.lower + room, "{text} {interval:?}");
            assert!(number + radius >= interval.upper - room, "{text} {interval:?}");
            assert!(
                radius < 3.0 * interval.radius() + 4.0 * f64::EPSILON * middle.abs(),
                "{text} {interval:?}"
            );
        }
    }
}
