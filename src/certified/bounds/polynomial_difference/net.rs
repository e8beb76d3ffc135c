//! The difference of two patches as a rational function.

use crate::bezier::{power_of_two_below, relative, scaled, squares, unscale};
use crate::certified::rounding::gamma;
use crate::rounding::upper_max;
use glam::{DVec3, DVec4, Vec4Swizzles};

/// Roundings of a coefficient of `X v - Y w` besides one for each of its
/// products, and of a square besides one for each (lemmas R10, R11); both with
/// the 6 that binomials of more than 54 are off.
const PRODUCT_ROUNDINGS: f64 = 16.0;
const SQUARE_ROUNDINGS: f64 = 19.0;

/// A homogeneous control net, t fastest.
pub(super) struct Net {
    degree: [usize; 2],
    controls: Vec<DVec4>,
    /// The rounding error of its points: restriction and change of origin.
    point_error: f64,
}

impl Net {
    /// Takes a restricted net relative to another point. The weights are scaled
    /// by a power of two, which is exact, so that the largest is about 1.
    ///
    /// `growth` bounds the sum of the absolute coefficients of a restriction
    /// beyond [0, 1], 1 inside (lemma R6).
    pub(super) fn new(degree: [usize; 2], controls: &[DVec4], shift: DVec3, growth: f64) -> Self {
        let heaviest = controls.iter().fold(0.0_f64, |heaviest, control| heaviest.max(control.w));
        let scale = power_of_two_below(heaviest.max(f64::MIN_POSITIVE)).recip();
        let controls: Vec<DVec4> = controls.iter().map(|&control| scale * control).collect();
        let (mut radius, mut lightest) = (0.0_f64, f64::INFINITY);
        for control in &controls {
            radius = upper_max(radius, control.xyz().length() / control.w);
            lightest = lightest.min(control.w);
        }
        let spread = if growth > 1.0 { growth * scale * heaviest / lightest } else { 1.0 };
        let restriction = 16.0 * (degree[0] + degree[1]) as f64 * spread + 8.0;
        let point_error = gamma(restriction * radius + 4.0 * shift.length());
        Self { degree, controls: relative(&controls, shift), point_error }
    }

    /// An upper bound on the distance between points of equal parameters, by
    /// lemma R11; `None` where a weight is not positive or a number overflows.
    pub(super) fn max_difference(&self, other: &Self) -> Option<f64> {
        let ([p, q], [m, n]) = (self.degree, other.degree);
        let (degree, columns) = ([p + m, q + n], q + n + 1);
        // `X v - Y w` and `w v`.
        let mut quotient = vec![DVec4::ZERO; (p + m + 1) * columns];
        let (of_x, of_y) = (scaled(self.degree, &self.controls), scaled(other.degree, &other.controls));
        for (a, x) in of_x.iter().enumerate() {
            let (i, j) = (a / (q + 1), a % (q + 1));
            for (b, y) in of_y.iter().enumerate() {
                let (k, l) = (b / (n + 1), b % (n + 1));
                let product = (y.w * x.xyz() - x.w * y.xyz()).extend(x.w * y.w);
                quotient[(i + k) * columns + j + l] += product;
            }
        }
        unscale(degree, &mut quotient);
        let length = |control: &DVec4| control.xyz().length() / control.w;
        let longest = quotient.iter().map(length).fold(0.0, upper_max);
        let largest = squares(degree, &quotient)
            .into_iter()
            .map(|(length_squared, weight_squared)| length_squared / weight_squared)
            .fold(0.0, upper_max);
        let product_terms = ((p.min(m) + 1) * (q.min(n) + 1)) as f64;
        let square_terms = ((degree[0] / 2 + 1) * (degree[1] + 1)) as f64;
        let of_products = gamma(product_terms + PRODUCT_ROUNDINGS);
        let of_squares = gamma(square_terms + SQUARE_ROUNDINGS);
        let under_root = (1.0 + of_squares) * largest + of_squares * longest * longest;
        let bound = (1.0 + of_products) * under_root.sqrt()
            + of_products * (self.radius() + other.radius())
            + self.point_error
            + other.point_error;
        (self.is_positive() && other.is_positive() && bound < f64::INFINITY).then_some(bound)
    }

    /// The largest distance of a control point from the origin.
    fn radius(&self) -> f64 {
        self.controls.iter().map(|control| control.xyz().length() / control.w).fold(0.0, upper_max)
    }

    fn is_positive(&self) -> bool {
        self.controls.iter().all(|control| control.w > 0.0)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::certified::rounding::UNIT_ROUNDOFF;

    /// Lemmas R6, R10 and R11 for a patch against itself: the difference is 0, and the
    /// bound is the rounding alone.
    #[test]
    fn the_bound_of_equal_nets_is_their_rounding() {
        let controls = [[-1.0, -2.0], [-1.0, 2.0], [1.0, -2.0], [1.0, 2.0]];
        let controls = controls.map(|[x, y]| DVec4::new(x, y, 0.0, 1.0));
        let radius = 5.0_f64.sqrt();
        for (shift, growth, [p, q]) in [(0.0, 1.0, [1, 1]), (0.0, 1.5, [1, 1]), (8.0, 1.0, [1, 1])] {
            let shift = DVec3::new(0.0, 0.0, shift);
            let net = || Net::new([p, q], &controls, shift, growth);
            let found = net().max_difference(&net()).unwrap();
            let spread = if growth > 1.0 { growth } else { 1.0 };
            let restriction = (16.0 * (p + q) as f64 * spread + 8.0) * radius + 4.0 * shift.length();
            let products = (p + 1) as f64 * (q + 1) as f64 + 16.0;
            let lengths = radius.hypot(shift.length());
            let lemma = 2.0 * UNIT_ROUNDOFF * (products * lengths + restriction);
            assert!(lemma <= found && found <= 1.02 * lemma, "{found:e} and {lemma:e}, shift {shift}");
        }
    }
}
