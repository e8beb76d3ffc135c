//! Rational Bézier curves in the parameter plane.

use crate::approximation::bernstein::binomial;
use glam::{DVec2, DVec3};

/// A rational Bézier curve with homogeneous controls `(w u, w v, w)`, w > 0.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Curve {
    /// Degree + 1 controls.
    pub(super) controls: Vec<DVec3>,
}

/// The number of halvings after which the isolation of roots stops: intervals are then
/// as short as the roundings of their ends.
const MAX_ROOT_DEPTH: usize = 48;

/// The number of steps of bisection and the secant method for one root.
const MAX_ROOT_STEPS: usize = 160;

/// The number of steps in which the bracket of a root must shrink to a quarter.
const STEPS_OF_A_QUARTER: usize = 3;

impl Curve {
    /// Makes the straight line between two points.
    pub(super) fn line(from: DVec2, to: DVec2) -> Self {
        Self { controls: vec![from.extend(1.0), to.extend(1.0)] }
    }

    pub(super) fn degree(&self) -> usize {
        self.controls.len() - 1
    }

    /// Returns whether all weights are equal.
    pub(super) fn is_polynomial(&self) -> bool {
        self.controls.iter().all(|control| control.z == self.controls[0].z)
    }

    /// Returns the homogeneous point at t. O(degree²).
    pub(super) fn at(&self, t: f64) -> DVec3 {
        casteljau(&self.controls, t)
    }

    /// Returns the point at t. O(degree²).
    pub(super) fn point(&self, t: f64) -> DVec2 {
        divided(self.at(t))
    }

    pub(super) fn start(&self) -> DVec2 {
        divided(self.controls[0])
    }

    pub(super) fn end(&self) -> DVec2 {
        divided(self.controls[self.degree()])
    }

    /// Returns the part over [from, to]. O(degree³).
    pub(super) fn restricted(&self, from: f64, to: f64) -> Self {
        if from == 0.0 && to == 1.0 {
            return self.clone();
        }
        Self { controls: restricted(&self.controls, [from, to]) }
    }

    pub(super) fn reversed(&self) -> Self {
        Self { controls: self.controls.iter().rev().copied().collect() }
    }

    /// Returns the box of the controls' positions, which contains the curve.
    pub(super) fn hull(&self) -> [DVec2; 2] {
        let start = self.start();
        self.controls.iter().fold([start, start], |[low, high], &control| {
            let point = divided(control);
            [low.min(point), high.max(point)]
        })
    }

    /// Returns the parameters in (0, 1) at which `normal · (u, v) = offset`, increasing.
    pub(super) fn crossings(&self, normal: DVec2, offset: f64) -> Vec<f64> {
        let form = normal.extend(-offset);
        roots(&self.controls.iter().map(|control| control.dot(form)).collect::<Vec<_>>())
    }

    /// Returns the Bernstein coefficients, of degree 2 degree - 2 or degree - 1 for equal
    /// weights, of a positive multiple of the derivative of v.
    ///
    /// The numerator of `(y/w)'` is `y'w - yw'`, whose coefficient of `t^k` in the scaled
    /// Bernstein basis is a sum over i < j, i + j = k + 1, of multiples of
    /// `y_j w_i - y_i w_j` (Sederberg and Wang, *Rational hodographs*, CAGD 4 (1987)).
    pub(super) fn rise(&self) -> Vec<f64> {
        self.derivative(1)
    }

    /// Returns the same for coordinate `axis` of (u, v).
    pub(super) fn derivative(&self, axis: usize) -> Vec<f64> {
        self.differences(axis, |high, low| high - low)
    }

    /// Returns upper bounds on the terms of the coefficients of [`Curve::derivative`].
    pub(super) fn derivative_size(&self, axis: usize) -> Vec<f64> {
        self.differences(axis, |high, low| high.abs() + low.abs())
    }

    fn differences(&self, axis: usize, difference: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let degree = self.degree();
        if self.is_polynomial() {
            return self.controls.windows(2).map(|pair| difference(pair[1][axis], pair[0][axis])).collect();
        }
        (0..=2 * degree - 2)
            .map(|k| {
                let mut sum = 0.0;
                for i in 0..=(k / 2).min(degree) {
                    let j = k + 1 - i;
                    if j <= degree && i < j {
                        let (low, high) = (self.controls[i], self.controls[j]);
                        let binomials = binomial(degree, i) * binomial(degree, j);
                        let term = difference(high[axis] * low.z, low[axis] * high.z);
                        sum += (j - i) as f64 * binomials * term;
                    }
                }
                sum / binomial(2 * degree - 2, k)
            })
            .collect()
    }

    /// Returns the parameter in [0, 1] at which a curve of increasing v has this v.
    pub(super) fn solve(&self, v: f64) -> f64 {
        if self.degree() == 1 && self.is_polynomial() {
            let (low, high) = (self.start().y, self.end().y);
            return ((v - low) / (high - low)).clamp(0.0, 1.0);
        }
        let coefficients: Vec<f64> = self.controls.iter().map(|control| control.y - v * control.z).collect();
        if coefficients[0] >= 0.0 {
            return 0.0;
        }
        if coefficients[self.degree()] <= 0.0 {
            return 1.0;
        }
        bracketed_root(&coefficients, [0.0, 1.0])
    }
}

/// Returns the Bernstein coefficients of the product of two polynomials.
pub(super) fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    let (m, n) = (a.len() - 1, b.len() - 1);
    let mut sums = vec![0.0; m + n + 1];
    for (i, &left) in a.iter().enumerate() {
        for (j, &right) in b.iter().enumerate() {
            sums[i + j] += binomial(m, i) * left * binomial(n, j) * right;
        }
    }
    for (k, sum) in sums.iter_mut().enumerate() {
        *sum /= binomial(m + n, k);
    }
    sums
}

pub(super) fn divided(homogeneous: DVec3) -> DVec2 {
    homogeneous.truncate() / homogeneous.z
}

/// A value that de Casteljau's algorithm takes means of.
pub(super) trait Point:
    Copy + std::ops::Add<Output = Self> + std::ops::Mul<f64, Output = Self>
{
}

impl<T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>> Point for T {}

/// Evaluates a Bézier curve by de Casteljau's algorithm. O(degree²).
pub(super) fn casteljau<T: Point>(controls: &[T], t: f64) -> T {
    // Loops of a known length are unrolled: a quarter of a part's cut is this.
    match controls.len() {
        2 => of_length::<T, 2>(controls, t),
        3 => of_length::<T, 3>(controls, t),
        4 => of_length::<T, 4>(controls, t),
        5 => of_length::<T, 5>(controls, t),
        6 => of_length::<T, 6>(controls, t),
        7 => of_length::<T, 7>(controls, t),
        8 => of_length::<T, 8>(controls, t),
        9 => of_length::<T, 9>(controls, t),
        10 => of_length::<T, 10>(controls, t),
        count => {
            let mut line = [controls[0]; MAX_CONTROLS];
            let line = &mut line[..count];
            line.copy_from_slice(controls);
            for last in (1..count).rev() {
                step(&mut line[..=last], t);
            }
            line[0]
        }
    }
}

/// Evaluates a curve of N controls.
fn of_length<T: Point, const N: usize>(controls: &[T], t: f64) -> T {
    let mut line: [T; N] = std::array::from_fn(|index| controls[index]);
    for last in (1..N).rev() {
        for index in 0..last {
            line[index] = line[index] * (1.0 - t) + line[index + 1] * t;
        }
    }
    line[0]
}

/// Takes one step of de Casteljau's algorithm, which leaves the last entry unused.
fn step<T: Point>(line: &mut [T], t: f64) {
    for index in 0..line.len() - 1 {
        line[index] = line[index] * (1.0 - t) + line[index + 1] * t;
    }
}

/// Returns the controls of a Bézier curve's part over [from, to]: control k is the blossom at
/// `to`, k times, and at `from` otherwise. O(degree³).
pub(super) fn restricted<T: Point>(controls: &[T], [from, to]: [f64; 2]) -> Vec<T> {
    let mut line = controls.to_vec();
    let mut part = Vec::with_capacity(controls.len());
    loop {
        part.push(casteljau(&line, from));
        if line.len() == 1 {
            return part;
        }
        step(&mut line, to);
        line.pop();
    }
}

/// The largest number of controls of a curve, or of the derivative of one.
const MAX_CONTROLS: usize = 2 * crate::limits::MAX_DEGREE + 2;

/// Returns the roots in (0, 1) of a polynomial with these Bernstein coefficients,
/// increasing. Roots of even order may be missing or be given twice.
pub(super) fn roots(coefficients: &[f64]) -> Vec<f64> {
    let mut found = Vec::new();
    isolate(coefficients, [0.0, 1.0], 0, &mut found);
    found.retain(|&root| root > 0.0 && root < 1.0);
    found
}

/// Returns the Bernstein coefficients over the two halves of [0, 1], by averages.
pub(super) fn halves<T>(coefficients: &[T]) -> [Vec<T>; 2]
where
    T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
{
    let mut right = coefficients.to_vec();
    let mut left = vec![coefficients[0]];
    for remaining in (1..coefficients.len()).rev() {
        for index in 0..remaining {
            right[index] = (right[index] + right[index + 1]) * 0.5;
        }
        left.push(right[0]);
    }
    [left, right]
}

/// Appends the roots over `interval`, by Descartes' rule of signs and halving.
fn isolate(coefficients: &[f64], interval: [f64; 2], depth: usize, found: &mut Vec<f64>) {
    let signs = coefficients.iter().filter(|&&value| value != 0.0).map(|value| *value > 0.0);
    let mut previous = None;
    let changes = signs.fold(0, |changes, sign| {
        let change = previous.is_some_and(|other| other != sign);
        previous = Some(sign);
        changes + usize::from(change)
    });
    let last = coefficients.len() - 1;
    if changes == 0 {
        // A root at the interval's start counts with the interval before it.
        if coefficients[last] == 0.0 && previous.is_some() {
            found.push(interval[1]);
        }
        return;
    }
    let [low, high] = interval;
    if changes == 1 && coefficients[0] != 0.0 && coefficients[last] != 0.0 {
        let local = bracketed_root(coefficients, [0.0, 1.0]);
        found.push((1.0 - local) * low + local * high);
        return;
    }
    if depth == MAX_ROOT_DEPTH {
        found.push(0.5 * (low + high));
        return;
    }
    let [left, right] = halves(coefficients);
    let middle = 0.5 * (low + high);
    isolate(&left, [low, middle], depth + 1, found);
    isolate(&right, [middle, high], depth + 1, found);
}

/// Returns the root in a bracket at whose ends the polynomial has different signs, by
/// the secant method safeguarded by bisection.
fn bracketed_root(coefficients: &[f64], [mut low, mut high]: [f64; 2]) -> f64 {
    let rising = casteljau(coefficients, high) > 0.0;
    let value = |t: f64| if rising { casteljau(coefficients, t) } else { -casteljau(coefficients, t) };
    let (mut at_low, mut at_high) = (value(low), value(high));
    let mut moved_low = None;
    let mut width = high - low;
    for step in 0..MAX_ROOT_STEPS {
        let secant = low - at_low * (high - low) / (at_high - at_low);
        let middle = 0.5 * (low + high);
        // Next to a stationary point secants shrink the bracket by little.
        let is_slow = step % STEPS_OF_A_QUARTER == 2 && high - low > 0.25 * width;
        if step % STEPS_OF_A_QUARTER == 2 {
            width = high - low;
        }
        let t = if !is_slow && secant > low && secant < high { secant } else { middle };
        let at_t = value(t);
        if at_t == 0.0 || t <= low || t >= high {
            return t;
        }
        // The Illinois rule: the value at an end that stays twice is halved.
        if at_t < 0.0 {
            (low, at_low) = (t, at_t);
            if moved_low == Some(true) {
                at_high *= 0.5;
            }
            moved_low = Some(true);
        } else {
            (high, at_high) = (t, at_t);
            if moved_low == Some(false) {
                at_low *= 0.5;
            }
            moved_low = Some(false);
        }
    }
    0.5 * (low + high)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn roots_of_a_quintic() {
        // (t - 0.1)(t - 0.2)(t - 0.7)(t - 0.9)(t + 1) sampled to Bernstein form by products of linear factors.
        let mut product = vec![1.0];
        for root in [0.1, 0.2, 0.7, 0.9, -1.0] {
            let degree = product.len() as f64;
            let (low, high) = (-root, 1.0 - root);
            let at = |i: usize| product.get(i).copied().unwrap_or(0.0);
            product = (0..=product.len())
                .map(|i| {
                    let share = i as f64 / degree;
                    (1.0 - share) * low * at(i) + if i > 0 { share * high * at(i - 1) } else { 0.0 }
                })
                .collect();
        }
        let found = roots(&product);
        assert_eq!(found.len(), 4, "{found:?}");
        for (found, expected) in found.iter().zip([0.1, 0.2, 0.7, 0.9]) {
            assert!((found - expected).abs() < 1e-13, "{found}");
        }
    }

    #[test]
    fn the_rise_of_a_quarter_circle_has_one_sign() {
        let w = std::f64::consts::FRAC_1_SQRT_2;
        let quarter = Curve {
            controls: vec![DVec3::new(1.0, 0.0, 1.0), DVec3::new(w, w, w), DVec3::new(0.0, 1.0, 1.0)],
        };
        assert!(quarter.rise().iter().all(|&value| value >= 0.0));
        let t = quarter.solve(0.6);
        assert!((quarter.point(t) - DVec2::new(0.8, 0.6)).length() < 1e-14);
        let part = quarter.restricted(0.25, t);
        assert!((part.end() - DVec2::new(0.8, 0.6)).length() < 1e-14);
    }
}
