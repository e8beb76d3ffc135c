//! Exact sums and products of two float64 numbers, in integers.

use std::ops::{Add, Mul};

/// The number mantissa · 2^exponent.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Exact {
    mantissa: i128,
    exponent: i32,
}

impl From<f64> for Exact {
    /// A finite number, from its bits.
    fn from(value: f64) -> Self {
        assert!(value.is_finite());
        let bits = value.to_bits();
        let fraction = i128::from(bits & ((1 << 52) - 1));
        let biased = i32::try_from(bits >> 52 & 0x7ff).unwrap();
        // Subnormal numbers have the least normal exponent, and no leading one.
        let (magnitude, biased) = if biased == 0 { (fraction, 1) } else { (fraction + (1 << 52), biased) };
        let mantissa = if value.is_sign_negative() { -magnitude } else { magnitude };
        Self { mantissa, exponent: biased - 1075 }.reduced()
    }
}

impl Exact {
    /// The same number with an odd mantissa, or 0.
    fn reduced(self) -> Self {
        if self.mantissa == 0 {
            return Self { mantissa: 0, exponent: 0 };
        }
        let zeros = self.mantissa.trailing_zeros();
        Self { mantissa: self.mantissa >> zeros, exponent: self.exponent + i32::try_from(zeros).unwrap() }
    }

    /// The bits of the whole part, which order numbers of one sign that differ in it.
    fn size(self) -> i32 {
        128 - i32::try_from(self.mantissa.unsigned_abs().leading_zeros()).unwrap() + self.exponent
    }

    /// self <= other.
    pub(crate) fn is_at_most(self, other: Self) -> bool {
        let (sign, other_sign) = (self.mantissa.signum(), other.mantissa.signum());
        if sign != other_sign || sign == 0 {
            return sign <= other_sign;
        }
        if self.size() != other.size() {
            return (self.size() < other.size()) == (sign > 0);
        }
        // Of one size, exponents differ by less than the bits of a mantissa.
        let least = self.exponent.min(other.exponent);
        self.shifted(least) <= other.shifted(least)
    }

    /// The mantissa at a smaller exponent.
    fn shifted(self, exponent: i32) -> i128 {
        let shifted = self.mantissa << (self.exponent - exponent);
        assert_eq!(shifted >> (self.exponent - exponent), self.mantissa, "no bit is lost");
        shifted
    }
}

impl Mul for Exact {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let mantissa = self.mantissa.checked_mul(other.mantissa).unwrap();
        let exponent = [self.exponent, other.exponent].iter().sum();
        Self { mantissa, exponent }.reduced()
    }
}

impl Add for Exact {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if self.mantissa == 0 || other.mantissa == 0 {
            return if self.mantissa == 0 { other } else { self };
        }
        let exponent = self.exponent.min(other.exponent);
        Self { mantissa: self.shifted(exponent) + other.shifted(exponent), exponent }.reduced()
    }
}
