//! Polynomials in Bernstein form: binomials, and elevation of the degree.

use glam::{DVec3, DVec4};

/// A value that linear combinations are formed of.
pub trait Linear: Copy + std::ops::Add<Output = Self> + std::ops::Mul<f64, Output = Self> {
    /// The value 0.
    const ZERO: Self;
}

impl Linear for f64 {
    const ZERO: Self = 0.0;
}

impl Linear for DVec3 {
    const ZERO: Self = Self::ZERO;
}

impl Linear for DVec4 {
    const ZERO: Self = Self::ZERO;
}

/// Returns `C(n, k)`, exact for n up to 30.
pub fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |value, i| value * (n - i) as f64 / (i + 1) as f64)
}

/// Returns the Bernstein coefficients of the same polynomial in a degree at least as high.
///
/// A coefficient of degree n + 1 is the mean of two neighbours of degree n: `P'_i = i / (n + 1)
/// P_(i-1) + (1 - i / (n + 1)) P_i` (Piegl and Tiller, *The NURBS Book*, 5.5). O(degree²).
pub fn elevated<T: Linear>(mut coefficients: Vec<T>, degree: usize) -> Vec<T> {
    while coefficients.len() <= degree {
        let count = coefficients.len();
        let at = |index: usize| coefficients.get(index).copied().unwrap_or(T::ZERO);
        let mean = |index: usize| {
            let share = index as f64 / count as f64;
            let before = if index == 0 { T::ZERO } else { at(index - 1) };
            before * share + at(index) * (1.0 - share)
        };
        coefficients = (0..=count).map(mean).collect();
    }
    coefficients
}
