//! Functions on a piece of a patch, by their Bernstein coefficients.
//!
//! With the homogeneous coordinates (X, w) of a piece relative to a point, `f(Y) = l·Y + Y·M Y` is
//! `X·(M X + w l) / w²`, and with `C[Y, Y, Y]` a quotient by w³: the values lie between the least and the
//! largest quotient of the Bernstein coefficients of both.

use super::quadric::{Cubic, Quadric};
use crate::axis::Axis;
use crate::bezier::{bernstein, dot_products, scaled, triple_products};
use crate::certified::rounding::gamma;
use crate::rounding::{lower_min, upper_max};
use glam::{DMat3, DVec3, DVec4, Vec4Swizzles};

/// Roundings of a control restricted to a piece, for each degree (lemma R6), and of its shift.
const RESTRICTION_ROUNDINGS: f64 = 16.0;
const SHIFT_ROUNDINGS: f64 = 8.0;

/// Roundings of a quotient of coefficients besides one for each of the products that it sums, for
/// either of both (lemma R17).
const COEFFICIENT_ROUNDINGS: usize = 32;

/// Roundings of a linear function of a control point, relative to the sizes of its terms.
const LINEAR_ROUNDINGS: f64 = 16.0;

/// A piece of a patch about a point.
pub(super) struct Piece {
    pub(super) degree: [usize; 2],
    /// Homogeneous, relative to the point.
    controls: Vec<DVec4>,
    /// The largest distance of a control point from the point.
    pub(super) radius: f64,
    /// The rounding error of its points.
    pub(super) error: f64,
}

/// A function on a piece as a quotient of Bernstein polynomials, t fastest.
pub(super) struct Values {
    pub(super) degree: [usize; 2],
    /// The coefficients of both.
    pub(super) coefficients: Vec<(f64, f64)>,
    /// A bound on the sum of the sizes of the function's terms.
    pub(super) size: f64,
    /// The error of a quotient of coefficients.
    pub(super) error: f64,
}

impl Piece {
    /// Takes the controls of a patch restricted to a piece; the point is at `shift` from the patch's
    /// centre, and no control point of the patch is farther than `patch_radius` from that centre.
    pub(super) fn new(degree: [usize; 2], mut controls: Vec<DVec4>, shift: DVec3, patch_radius: f64) -> Self {
        let mut radius = 0.0_f64;
        for control in &mut controls {
            *control = (control.xyz() - control.w * shift).extend(control.w);
            radius = upper_max(radius, control.xyz().length() / control.w);
        }
        let restriction = RESTRICTION_ROUNDINGS * (degree[0] + degree[1]) as f64 + SHIFT_ROUNDINGS;
        let error = gamma(restriction * patch_radius + SHIFT_ROUNDINGS * shift.length());
        Self { degree, controls, radius: radius + error, error }
    }

    /// A quadratic function on it. O(p q) where it is linear, else O(p² q²).
    pub(super) fn values(&self, quadric: &Quadric) -> Values {
        let linear = quadric.linear;
        if quadric.is_linear() {
            let length = linear.length();
            let value = |control: &DVec4| (linear.dot(control.xyz()), control.w);
            let size = length * self.radius;
            let error = length * self.error + gamma(LINEAR_ROUNDINGS) * size;
            let coefficients = self.controls.iter().map(value).collect();
            return Values { degree: self.degree, coefficients, size, error };
        }
        self.quadratic_values(quadric)
    }

    /// The same as a quotient of twice the degrees. O(p² q²).
    pub(super) fn quadratic_values(&self, quadric: &Quadric) -> Values {
        let Quadric { linear, form } = *quadric;
        let length = linear.length();
        let right: Vec<DVec4> = self
            .controls
            .iter()
            .map(|control| (form * control.xyz() + control.w * linear).extend(control.w))
            .collect();
        let coefficients = dot_products(self.degree, &self.controls, &right);
        let norm = quadric.size();
        let size = length * self.radius + norm * self.radius * self.radius;
        let slope = length + 2.0 * norm * self.radius;
        let roundings = 2 * (self.controls.len() + COEFFICIENT_ROUNDINGS);
        let error = slope * self.error + gamma(roundings as f64) * size;
        Values { degree: self.degree.map(|degree| 2 * degree), coefficients, size, error }
    }

    /// A cubic function on it. O(p² q²), some five times as long as for a quadratic one.
    pub(super) fn values_of_cubic(&self, cubic: &Cubic) -> Values {
        let Cubic { quadric: Quadric { linear, form }, forms } = cubic;
        let controls = scaled(self.degree, &self.controls);
        // X·(w² l + w M X + C[X, X, ·]) as the sum over the products of three controls.
        let left: Vec<DMat3> =
            controls.iter().map(|x| *form * x.w + forms[0] * x.x + forms[1] * x.y + forms[2] * x.z).collect();
        let inner = |first: usize, second: usize| {
            let (x, y) = (controls[first], controls[second]);
            (left[first] * y.xyz() + x.w * y.w * *linear).extend(x.w * y.w)
        };
        let coefficients = triple_products(self.degree, &controls, inner);
        let [length, norm, third] = [linear.length(), cubic.quadric.size(), cubic.size()];
        let radius = self.radius;
        let size = radius * (length + radius * (norm + radius * third));
        let slope = length + radius * (2.0 * norm + 3.0 * radius * third);
        let roundings = 2 * (2 * self.controls.len() + COEFFICIENT_ROUNDINGS);
        let error = slope * self.error + gamma(roundings as f64) * size;
        Values { degree: self.degree.map(|degree| 3 * degree), coefficients, size, error }
    }

    /// The curve at the start (`end` 0) or the end (1) of an axis.
    pub(super) fn side(&self, axis: Axis, end: usize) -> Self {
        let [rows, columns] = self.degree.map(|degree| degree + 1);
        let mut degree = self.degree;
        degree[axis.index()] = 0;
        let controls = match axis {
            Axis::U => self.controls[end * (rows - 1) * columns..][..columns].to_vec(),
            Axis::V => self.controls.iter().skip(end * (columns - 1)).step_by(columns).copied().collect(),
        };
        Self { degree, controls, ..*self }
    }

    /// The range of a function of third order on it.
    pub(super) fn range(&self, function: &Cubic) -> [f64; 2] {
        if function.size() == 0.0 { self.values(&function.quadric) } else { self.values_of_cubic(function) }
            .range()
    }

    /// Returns points on a grid with these numbers of lines along both axes. A single line is at the start.
    pub(super) fn samples(&self, counts: [usize; 2]) -> Vec<DVec3> {
        let places = |axis: usize| -> Vec<_> {
            let spaces = counts[axis].saturating_sub(1).max(1) as f64;
            (0..counts[axis]).map(|line| bernstein(self.degree[axis], line as f64 / spaces)).collect()
        };
        let (in_s, in_t) = (places(0), places(1));
        let columns = self.degree[1] + 1;
        let mut samples = Vec::with_capacity(counts[0] * counts[1]);
        for s in &in_s {
            let mut line = vec![DVec4::ZERO; columns];
            for (row, share) in self.controls.chunks_exact(columns).zip(s) {
                for (sum, control) in line.iter_mut().zip(row) {
                    *sum += *share * *control;
                }
            }
            for t in &in_t {
                let sum =
                    line.iter().zip(t).fold(DVec4::ZERO, |sum, (control, share)| sum + *share * *control);
                samples.push(sum.xyz() / sum.w);
            }
        }
        samples
    }
}

impl Values {
    /// The range of the function.
    pub(super) fn range(&self) -> [f64; 2] {
        let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
        for (value, weight) in &self.coefficients {
            let value = value / weight;
            (least, largest) = (lower_min(least, value), upper_max(largest, value));
        }
        [least - self.error, largest + self.error]
    }

    /// The range of `y - f` over the piece, y the parameter along an axis that is `ends` at its start
    /// and its end.
    ///
    /// With the coefficients (v_k, w_k) along the axis, of degree p, the values are convex combinations of
    /// `((p + 1 - k) (e w_k - v_k) + k (f w_{k-1} - v_{k-1})) / ((p + 1 - k) w_k + k w_{k-1})`.
    pub(super) fn lag(&self, axis: Axis, ends: [f64; 2]) -> [f64; 2] {
        let [rows, columns] = self.degree.map(|degree| degree + 1);
        let (lines, between, step) = match axis {
            Axis::U => (columns, 1, columns),
            Axis::V => (rows, columns, 1),
        };
        let order = self.degree[axis.index()] + 1;
        let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
        for line in 0..lines {
            let term = |k: usize, share: usize, end: f64| {
                let (value, weight) = self.coefficients[line * between + k * step];
                let share = share as f64;
                (share * (end * weight - value), share * weight)
            };
            for k in 0..=order {
                let first = if k < order { term(k, order - k, ends[0]) } else { (0.0, 0.0) };
                let second = if k > 0 { term(k - 1, k, ends[1]) } else { (0.0, 0.0) };
                let value = (first.0 + second.0) / (first.1 + second.1);
                (least, largest) = (lower_min(least, value), upper_max(largest, value));
            }
        }
        let size = ends[0].abs() + ends[1].abs() + self.size;
        let error = self.error + gamma(LINEAR_ROUNDINGS) * size;
        [least - error, largest + error]
    }
}
