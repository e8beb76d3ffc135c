//! Taylor coefficients over intervals, which bound the error of a fit.

use std::ops::{Add, Mul, Sub};

/// A closed interval. Rounding is not part of it: the bounds made of it are inflated once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Interval {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Interval {
    pub(super) const EMPTY: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    pub(super) fn point(value: f64) -> Self {
        Self { low: value, high: value }
    }

    pub(super) fn with(self, value: f64) -> Self {
        Self { low: self.low.min(value), high: self.high.max(value) }
    }

    fn scaled(self, factor: f64) -> Self {
        Self::EMPTY.with(factor * self.low).with(factor * self.high)
    }

    /// Returns the quotient by an interval that does not contain 0.
    fn quotient(self, divisor: Self) -> Self {
        self * Self::EMPTY.with(1.0 / divisor.low).with(1.0 / divisor.high)
    }

    /// Returns the largest absolute value; NaN counts as +∞.
    pub(super) fn size(self) -> f64 {
        let size = self.low.abs().max(self.high.abs());
        if self.low.is_nan() || self.high.is_nan() { f64::INFINITY } else { size }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { low: self.low + other.low, high: self.high + other.high }
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { low: self.low - other.high, high: self.high - other.low }
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let [a, b, c, d] =
            [self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high];
        Self::EMPTY.with(a).with(b).with(c).with(d)
    }
}

/// The number of Taylor coefficients: a quintic's error is bounded by the sixth.
pub(super) const ORDER: usize = 7;

/// The coefficients `f^(k) / k!` at one parameter, or intervals that contain those at all
/// parameters of a range.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jet(pub(super) [Interval; ORDER]);

impl Jet {
    /// Returns the quotient of two functions, from `numerator = quotient · denominator`.
    pub(super) fn quotient(&self, denominator: &Self) -> Self {
        let mut quotient = [Interval::point(0.0); ORDER];
        for k in 0..ORDER {
            let known = (0..k).fold(self.0[k], |sum, j| sum - quotient[j] * denominator.0[k - j]);
            quotient[k] = known.quotient(denominator.0[0]);
        }
        Self(quotient)
    }

    /// Returns `middle + scale tan((x - middle) / 2)`, or with tanh: y = tan z and y = tanh z
    /// satisfy `y' = (1 ± y²) z'`, so `k y_k = Σ j z_j (1 ± y²)_{k-j}`.
    pub(super) fn half_tangent(&self, middle: f64, scale: f64, hyperbolic: bool) -> Self {
        let mut z = self.0.map(|coefficient| coefficient.scaled(0.5));
        z[0] = (self.0[0] - Interval::point(middle)).scaled(0.5);
        let function = if hyperbolic { f64::tanh } else { f64::tan };
        let sign = if hyperbolic { -1.0 } else { 1.0 };
        let mut y = [Interval::point(0.0); ORDER];
        // Both functions are increasing on the range of a piece.
        y[0] = Interval { low: function(z[0].low), high: function(z[0].high) };
        let mut slope = [Interval::point(0.0); ORDER];
        for k in 0..ORDER {
            if k > 0 {
                let sum =
                    (1..=k).fold(Interval::point(0.0), |sum, j| sum + z[j].scaled(j as f64) * slope[k - j]);
                y[k] = sum.scaled(1.0 / k as f64);
            }
            let square = (0..=k).fold(Interval::point(0.0), |sum, j| sum + y[j] * y[k - j]);
            slope[k] = square.scaled(sign) + Interval::point(if k == 0 { 1.0 } else { 0.0 });
        }
        let mut image = y.map(|coefficient| coefficient.scaled(scale));
        image[0] = image[0] + Interval::point(middle);
        Self(image)
    }
}
