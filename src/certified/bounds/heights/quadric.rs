//! The values of a quadratic function on pieces of patches.
//!
//! With a piece's homogeneous controls (X, w) relative to b, `f(b + Y) = n·Y + Y·M Y` is
//! `X·(M X + w n) / w²`: its values lie between the least and the largest quotient of the Bernstein
//! coefficients of both.

use crate::axis::Axis;
use crate::bezier::dot_products;
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
    degree: [usize; 2],
    /// Homogeneous, relative to the point.
    controls: Vec<DVec4>,
    /// The largest distance of a control point from the point.
    pub(super) radius: f64,
    /// The rounding error of its points.
    error: f64,
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

    /// The range of a linear function of its points.
    pub(super) fn range(&self, row: DVec3) -> [f64; 2] {
        let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
        for control in &self.controls {
            let value = row.dot(control.xyz()) / control.w;
            (least, largest) = (lower_min(least, value), upper_max(largest, value));
        }
        let error = row.length() * (self.error + gamma(LINEAR_ROUNDINGS) * self.radius);
        [least - error, largest + error]
    }

    /// The range of a quadratic function of its points. O(p² q²).
    pub(super) fn range_of(&self, quadric: &Quadric) -> [f64; 2] {
        let Quadric { normal, form } = *quadric;
        let right: Vec<DVec4> = self
            .controls
            .iter()
            .map(|control| (form * control.xyz() + control.w * normal).extend(control.w))
            .collect();
        let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
        for (value, weight) in dot_products(self.degree, &self.controls, &right) {
            let value = value / weight;
            (least, largest) = (lower_min(least, value), upper_max(largest, value));
        }
        let size = quadric.size();
        let terms = normal.length() * self.radius + size * self.radius * self.radius;
        let slope = normal.length() + 2.0 * size * self.radius;
        let roundings = 2 * (self.controls.len() + COEFFICIENT_ROUNDINGS);
        let error = slope * self.error + gamma(roundings as f64) * terms;
        [least - error, largest + error]
    }

    /// The range of `y - row·Y` over the piece, y the parameter along an axis that is `ends` at its start
    /// and its end.
    ///
    /// With the degree p along the axis, the values are convex combinations of
    /// `((p + 1 - k) (e - row·Y_k) w_k + k (f - row·Y_{k-1}) w_{k-1}) / ((p + 1 - k) w_k + k w_{k-1})`.
    pub(super) fn lag(&self, axis: Axis, ends: [f64; 2], row: DVec3) -> [f64; 2] {
        let [rows, columns] = self.degree.map(|degree| degree + 1);
        let (lines, between, step) = match axis {
            Axis::U => (columns, 1, columns),
            Axis::V => (rows, columns, 1),
        };
        let order = self.degree[axis.index()] + 1;
        let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
        for line in 0..lines {
            let term = |k: usize, share: usize, end: f64| {
                let control = self.controls[line * between + k * step];
                let share = share as f64;
                (share * (end * control.w - row.dot(control.xyz())), share * control.w)
            };
            for k in 0..=order {
                let first = if k < order { term(k, order - k, ends[0]) } else { (0.0, 0.0) };
                let second = if k > 0 { term(k - 1, k, ends[1]) } else { (0.0, 0.0) };
                let value = (first.0 + second.0) / (first.1 + second.1);
                (least, largest) = (lower_min(least, value), upper_max(largest, value));
            }
        }
        let size = ends[0].abs() + ends[1].abs() + row.length() * self.radius;
        let error = row.length() * self.error + gamma(LINEAR_ROUNDINGS) * size;
        [least - error, largest + error]
    }

    /// Its corner points, relative to the point.
    pub(super) fn corners(&self) -> [DVec3; 4] {
        let columns = self.degree[1];
        let last = self.controls.len() - 1;
        [0, columns, last - columns, last].map(|index| {
            let control = self.controls[index];
            control.xyz() / control.w
        })
    }
}

/// The function `n·Y + Y·M Y`, M symmetric.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quadric {
    pub(super) normal: DVec3,
    pub(super) form: DMat3,
}

impl Quadric {
    /// The Frobenius norm of M, an upper bound on its operator norm and on that of its absolute values.
    pub(super) fn size(&self) -> f64 {
        let [x, y, z] = [self.form.x_axis, self.form.y_axis, self.form.z_axis].map(DVec3::length_squared);
        (1.0 + gamma(16.0)) * (x + y + z).sqrt()
    }

    /// The value at a point.
    pub(super) fn value(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + point.dot(self.form * point)
    }

    /// The same function with `(n·Y) (c·Y)` added.
    pub(super) fn tilted(&self, c: DVec3) -> Self {
        Self { form: self.form + symmetric_product(self.normal, c), ..*self }
    }
}

/// The symmetric matrix S with `Y·S Y = (a·Y) (b·Y)`.
pub(super) fn symmetric_product(a: DVec3, b: DVec3) -> DMat3 {
    let columns = [0, 1, 2].map(|axis| 0.5 * (b[axis] * a + a[axis] * b));
    DMat3::from_cols(columns[0], columns[1], columns[2])
}
