//! A point of a patch about which the squared distance is expanded.

use crate::bezier::Patch;
use crate::rounding::{gamma, upper_max};
use glam::{DVec3, Vec4Swizzles};

/// A point of a patch at which the squared distance and its gradient are known up
/// to errors.
#[derive(Debug, Clone, Copy, Default)]
pub struct CriticalPoint {
    /// (s, t) in [0, 1]².
    pub parameters: [f64; 2],
    /// The squared distance as computed.
    pub distance_squared: f64,
    /// An upper bound on its error.
    pub distance_error: f64,
    /// Its derivatives by s and t as computed.
    pub gradient: [f64; 2],
    /// Upper bounds on their errors.
    pub gradient_error: [f64; 2],
}

impl CriticalPoint {
    /// Returns the point of `patch` with these parameters, seen from `target`.
    ///
    /// With e the error of the residual r (lemma R5 of docs/method.md) and δ that of
    /// a derivative x_s (lemma R7), the gradient 2 r·x_s is off by at most
    /// `2 (e |x_s| + |r| δ + e δ)` and `|r|²` by `2 |r| e + e²`, for exact r and x_s;
    /// the computed ones differ from these by e and δ. The rest are the roundings of
    /// the products, and of the sums in which they occur in
    /// [`SquaredDistance::lower_bound_about`](super::SquaredDistance::lower_bound_about).
    /// O(p q).
    #[must_use]
    pub fn new(patch: &Patch<'_>, target: DVec3, parameters: [f64; 2]) -> Self {
        let jet = patch.jet(parameters);
        let residual = jet.point - target;
        let (length, distance_squared) = (residual.length(), residual.length_squared());
        let (mut radius, mut lightest, mut heaviest) = (0.0_f64, f64::INFINITY, 0.0_f64);
        for control in patch.controls {
            radius = upper_max(radius, control.xyz().length() / control.w);
            (lightest, heaviest) = (lightest.min(control.w), heaviest.max(control.w));
        }
        let degrees = (patch.degree[0] + patch.degree[1]) as f64;
        let error = gamma(8.0 * degrees + 8.0) * radius
            + gamma(1.0) * (patch.center.length() + target.length() + jet.point.length());
        let derivative_roundings = gamma(4.0 * (4.0 * degrees + 6.0) + 6.0);
        let gradient_error = [0, 1].map(|axis| {
            let derivative = [jet.s, jet.t][axis].length();
            let derivative_error =
                derivative_roundings * 4.0 * patch.degree[axis] as f64 * (heaviest / lightest) * radius;
            2.0 * (error * (derivative + 4.0 * derivative_error) + length * derivative_error)
                + gamma(24.0) * (length + error) * derivative
        });
        Self {
            parameters,
            distance_squared,
            distance_error: error * (2.0 * length + 2.0 * error) + gamma(10.0) * distance_squared,
            gradient: [2.0 * residual.dot(jet.s), 2.0 * residual.dot(jet.t)],
            gradient_error,
        }
    }

    /// Returns the same point in the parameters of a piece of the patch, which
    /// begins at `start` and has these side lengths.
    pub(super) fn on_piece(self, start: [f64; 2], lengths: [f64; 2]) -> Self {
        Self {
            parameters: [0, 1].map(|axis| (self.parameters[axis] - start[axis]) / lengths[axis]),
            gradient: [0, 1].map(|axis| lengths[axis] * self.gradient[axis]),
            gradient_error: [0, 1].map(|axis| lengths[axis] * self.gradient_error[axis]),
            ..self
        }
    }
}
