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
    /// The point as computed.
    pub point: DVec3,
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
    /// With e the error of the residual r (lemma R5 of docs/rounding.md) and δ that of
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
            error_of_gradient(length, error, derivative, derivative_error)
        });
        Self {
            parameters,
            point: jet.point,
            distance_squared,
            distance_error: error_of_square(length, error) + gamma(10.0) * distance_squared,
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

/// An upper bound on the error of `|r|²` where r has this length and error.
fn error_of_square(length: f64, error: f64) -> f64 {
    error * (2.0 * length + 2.0 * error)
}

/// An upper bound on the error of 2 r·x where r has this length and error, and x these.
fn error_of_gradient(length: f64, error: f64, derivative: f64, derivative_error: f64) -> f64 {
    2.0 * (error * (derivative + 4.0 * derivative_error) + length * derivative_error)
        + gamma(24.0) * (length + error) * derivative
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::rounding::UNIT_ROUNDOFF;

    /// Lemmas R5 and R7 and section 6.6 of docs/rounding.md, with every term of about the
    /// same size as the others in one of the cases: a plane patch of degrees (2, 1), half
    /// sides `size` and weights that double along s, seen from `height` over its middle.
    #[test]
    fn errors_are_those_of_the_lemmas() {
        for (size, height, away, scale) in
            [(1.0, 1.0, 0.0, 1.0), (8.0, 0.125, 0.0, 0.25), (0.25, 4.0, 0.0, 8.0), (0.5, 0.25, 100.0, 1.0)]
        {
            let mut controls = Vec::new();
            for (x, w) in [(-1.0, scale), (0.0, 2.0 * scale), (1.0, 4.0 * scale)] {
                for y in [-1.0, 1.0] {
                    controls.push((w * size * DVec3::new(x, y, 0.0)).extend(w));
                }
            }
            let center = DVec3::new(away, 0.0, 0.0);
            let patch = Patch::whole([2, 1], center, &controls);
            let target = center + DVec3::new(0.0, 0.0, height);
            let parameters = [0.25, 0.75];
            let found = CriticalPoint::new(&patch, target, parameters);
            let jet = patch.jet(parameters);
            let (radius, length) = (size * 2.0_f64.sqrt(), (jet.point - target).length());
            let of_point = 32.0 * radius + away + target.length() + jet.point.length();
            let of_derivatives = [2.0, 1.0].map(|degree| 78.0 * 4.0 * degree * 4.0 * radius);
            let lemma = |axis: usize| {
                let derivative = [jet.s, jet.t][axis].length();
                2.0 * (of_point * derivative + length * of_derivatives[axis]) + 24.0 * length * derivative
            };
            for (axis, derivative) in [jet.s, jet.t].into_iter().enumerate() {
                let slope = 2.0 * (jet.point - target).dot(derivative);
                assert!((found.gradient[axis] - slope).abs() <= 1e-12 * length * derivative.length());
            }
            let cases = [
                (found.distance_error, 2.0 * of_point * length + 10.0 * length * length),
                (found.gradient_error[0], lemma(0)),
                (found.gradient_error[1], lemma(1)),
            ];
            for (found, lemma) in cases {
                let part = found / (UNIT_ROUNDOFF * lemma);
                assert!((0.999..=1.02).contains(&part), "{part} of the lemma, size {size}, height {height}");
            }
        }
    }

    /// The products of errors, which are far below the rounding of the rest.
    #[test]
    fn products_of_errors_are_added() {
        // 2 |r| e + e² <= 2 e (|r| + e)
        assert_eq!(error_of_square(3.0, 0.5), 0.5 * 7.0);
        // 2 (e (|x| + 4 δ) + |r| δ), and 24 roundings of (|r| + e) |x|.
        let rounding = (error_of_gradient(3.0, 0.5, 8.0, 0.25) - 10.5) / (UNIT_ROUNDOFF * 3.5 * 8.0);
        assert!((23.0..=25.0).contains(&rounding), "{rounding}");
    }

    /// The same point in the parameters of a piece, whose unit step is a fraction of the patch's.
    #[test]
    fn a_piece_has_the_derivatives_by_its_own_parameters() {
        let known = CriticalPoint {
            parameters: [0.5, 0.75],
            gradient: [3.0, 5.0],
            gradient_error: [0.25, 1.5],
            ..CriticalPoint::default()
        };
        let local = known.on_piece([0.25, 0.5], [0.5, 0.25]);
        assert_eq!(local.parameters, [0.5, 1.0]);
        assert_eq!(local.gradient, [1.5, 1.25]);
        assert_eq!(local.gradient_error, [0.125, 0.375]);
    }
}
