//! Intervals of float64 numbers with outward rounding.
//!
//! IEEE 754 rounds the exact result x of +, -, *, / and the square root to the nearest float64
//! number r, so x lies between the neighbours of r: `r.next_down() <= x <= r.next_up()`, also where
//! r underflows to 0 or overflows to an infinity. Every operation therefore steps its lower end one
//! number down and its upper end one number up. `tests/verify` compares each operation with exact
//! results in integers.
//!
//! No crate of interval arithmetic fits: `inari` compiles only where the whole build is for
//! processors with AVX and FMA (`RUSTFLAGS`), `honestintervals` links MPFR and does not round float64
//! ends outward, `intervallum` has integers only.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The real numbers from `lo` to `hi`, both included where finite. Neither end is NaN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interval {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
}

impl Interval {
    pub(crate) const ZERO: Self = Self { lo: 0.0, hi: 0.0 };
    pub(crate) const ONE: Self = Self { lo: 1.0, hi: 1.0 };
    /// Every real number: the result where nothing better is known.
    pub(crate) const ENTIRE: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

    /// The number itself; [`Self::ENTIRE`] for NaN.
    pub(crate) fn point(value: f64) -> Self {
        Self::ends(value, value)
    }

    /// The interval between two ends; [`Self::ENTIRE`] if either is NaN.
    fn ends(lo: f64, hi: f64) -> Self {
        if lo.is_nan() || hi.is_nan() { Self::ENTIRE } else { Self { lo, hi } }
    }

    /// The interval around the rounded ends of an exact result.
    fn outward(lo: f64, hi: f64) -> Self {
        Self::ends(lo.next_down(), hi.next_up())
    }

    /// A number inside, about the middle; NaN for an unbounded interval.
    pub(crate) fn mid(self) -> f64 {
        0.5 * self.lo + 0.5 * self.hi
    }

    /// The largest absolute value.
    pub(crate) fn magnitude(self) -> f64 {
        larger(self.lo.abs(), self.hi.abs())
    }

    /// The squares.
    pub(crate) fn square(self) -> Self {
        let [lo, hi] = [self.lo * self.lo, self.hi * self.hi];
        let least = if self.lo <= 0.0 && self.hi >= 0.0 { 0.0 } else { smaller(lo, hi).next_down() };
        Self::ends(least, larger(lo, hi).next_up())
    }

    /// The square roots of the numbers that are not negative.
    pub(crate) fn sqrt(self) -> Self {
        Self::ends(
            larger(0.0, larger(0.0, self.lo).sqrt().next_down()),
            larger(0.0, self.hi).sqrt().next_up(),
        )
    }

    /// The numbers of this interval that lie in [0, 1], for values known to lie there.
    pub(crate) fn in_unit(self) -> Self {
        Self { lo: self.lo.clamp(0.0, 1.0), hi: self.hi.clamp(0.0, 1.0) }
    }

    /// The smallest interval that contains both.
    pub(crate) fn hull(self, other: Self) -> Self {
        Self { lo: smaller(self.lo, other.lo), hi: larger(self.hi, other.hi) }
    }
}

/// The smaller of two numbers that are not NaN.
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger of two numbers that are not NaN.
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The interval around four products or quotients of ends; [`Interval::ENTIRE`] if one is NaN,
/// as 0 times an infinity is.
fn around(values: [f64; 4]) -> Interval {
    if values.iter().any(|value| value.is_nan()) {
        return Interval::ENTIRE;
    }
    let [a, b, c, d] = values;
    let lo = smaller(smaller(a, b), smaller(c, d));
    let hi = larger(larger(a, b), larger(c, d));
    Interval::outward(lo, hi)
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::outward(self.lo + other.lo, self.hi + other.hi)
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::outward(self.lo - other.hi, self.hi - other.lo)
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        around([self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi])
    }
}

impl Div for Interval {
    type Output = Self;

    /// [`Interval::ENTIRE`] where the divisor contains 0.
    fn div(self, other: Self) -> Self {
        if other.lo <= 0.0 && other.hi >= 0.0 {
            return Self::ENTIRE;
        }
        around([self.lo / other.lo, self.lo / other.hi, self.hi / other.lo, self.hi / other.hi])
    }
}
