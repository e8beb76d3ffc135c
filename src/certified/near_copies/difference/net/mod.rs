//! The difference of two patches as a rational function.

mod difference;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;

pub(super) use difference::elevated_degrees;

use super::super::sliding::Sliding;
use crate::axis::Axis;
use crate::bezier::{Restriction, power_of_two_below, squares};
use crate::certified::rounding::gamma;
use crate::rounding::upper_max;
use difference::{Difference, MAX_WEIGHT_SPREAD, weight_spread};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// Roundings of a coefficient of `X v - Y w` besides one for each of its
/// products, and of a square besides one for each (lemmas R10, R11); both with
/// the 6 that binomials of more than 54 are off.
const PRODUCT_ROUNDINGS: f64 = 16.0;
const SQUARE_ROUNDINGS: f64 = 19.0;

/// Roundings of the length of a coefficient of `X v - Y w` over that of `w v`.
const LENGTH_ROUNDINGS: f64 = 8.0;

/// The largest coefficient, relative to the threshold, at which the squares of lengths are
/// tried: they bring little more than a turn of the difference over the piece.
const MAX_EXCESS: f64 = 2.0;

/// Roundings of a point by a restriction along an axis, for each degree, and by each elevation of the
/// degree that goes with it (lemma R6, twice its numbers by lemma R1).
const RESTRICTION_ROUNDINGS: f64 = 16.0;
const ELEVATION_ROUNDINGS: f64 = 6.0;

/// Sum of the absolute coefficients of a restriction that goes beyond the patch
/// in its extension, at most (lemma R6).
pub(super) const EXTENSION_GROWTH: f64 = 46.0;

/// The number of products that a coefficient of a square sums, of a polynomial of these degrees.
fn square_terms([p, q]: [usize; 2]) -> f64 {
    ((p / 2 + 1) * (q + 1)) as f64
}

/// The bound of lemma R11 by the longest coefficient, whose products are off by this part.
fn bound_by_lengths(longest: f64, of_products: f64) -> f64 {
    (1.0 + of_products) * (1.0 + gamma(LENGTH_ROUNDINGS)) * longest
}

/// The bound of lemma R11 by the largest coefficient of the squared length.
fn bound_by_squares(largest: f64, longest: f64, of_products: f64, of_squares: f64) -> f64 {
    let under_root = (1.0 + of_squares) * largest + of_squares * longest * longest;
    (1.0 + of_products) * under_root.sqrt()
}

/// The largest length of a point with these homogeneous coordinates, with weights of 1 where they are
/// those of a polynomial.
fn longest(controls: &[DVec4], is_polynomial: bool) -> f64 {
    let squared = |control: &DVec4| control.xyz().length_squared();
    let largest = if is_polynomial {
        controls.iter().map(squared).fold(0.0, upper_max)
    } else {
        controls.iter().map(|control| squared(control) / (control.w * control.w)).fold(0.0, upper_max)
    };
    largest.sqrt()
}

/// The largest weight.
fn heaviest(controls: &[DVec4]) -> f64 {
    controls.iter().fold(0.0_f64, |heaviest, control| heaviest.max(control.w))
}

/// A homogeneous control net, t fastest.
#[derive(Default)]
pub(in crate::certified::near_copies) struct Net {
    pub(super) degree: [usize; 2],
    /// Relative to the origin; with weights of 1 where these count as equal.
    pub(super) controls: Vec<DVec4>,
    /// The point that the controls are relative to.
    pub(super) origin: DVec3,
    /// How far, relative to the smallest weight, the weights are from each other.
    pub(super) weight_spread: f64,
    /// How far the weights of each line along an axis are from its first, relative to that; `None`
    /// where they do not count as equal.
    pub(super) line_spreads: [Option<f64>; 2],
    /// The largest distance of a control point from the origin.
    pub(super) radius: f64,
    /// The rounding error of its points: restriction and change of origin.
    point_error: f64,
}

impl Net {
    /// Takes a restriction of a patch relative to another point. The weights are scaled
    /// by a power of two, which is exact, so that the largest is about 1.
    ///
    /// `growth` bounds the sum of the absolute coefficients of a restriction
    /// beyond [0, 1], 1 inside (lemma R6).
    pub(super) fn new(degree: [usize; 2], mut controls: Vec<DVec4>, shift: DVec3, growth: f64) -> Self {
        let heaviest = heaviest(&controls);
        let scale = power_of_two_below(heaviest.max(f64::MIN_POSITIVE)).recip();
        let (mut about_center, mut radius, mut lightest) = (0.0_f64, 0.0_f64, f64::INFINITY);
        for control in &mut controls {
            *control *= scale;
            lightest = lightest.min(control.w);
            let inverse = control.w.recip();
            about_center = upper_max(about_center, control.xyz().length() * inverse);
            *control = (control.xyz() - control.w * shift).extend(control.w);
            radius = upper_max(radius, control.xyz().length() * inverse);
        }
        let spread = if growth > 1.0 { growth * scale * heaviest / lightest } else { 1.0 };
        let restriction = RESTRICTION_ROUNDINGS * (degree[0] + degree[1]) as f64 * spread + 8.0;
        let point_error = gamma(restriction * about_center + 4.0 * shift.length());
        let weight_spread = (scale * heaviest - lightest) / lightest;
        let mut net = Self { degree, controls, weight_spread, radius, point_error, ..Self::default() };
        net.classify_weights();
        net
    }

    /// Takes the net of a whole patch, relative to its own centre. Its pieces are compared.
    ///
    /// Its radius and the spreads of its weights are bounds on those of all pieces, and its error that
    /// of any restriction inside [0, 1] along both axes.
    pub(super) fn whole(degree: [usize; 2], mut controls: Vec<DVec4>, origin: DVec3) -> Self {
        // Weights of 1, the most common ones, need no scale.
        let mut weight_spread = 0.0;
        if controls.iter().any(|control| control.w != 1.0) {
            let heaviest = heaviest(&controls);
            let lightest = controls.iter().fold(f64::INFINITY, |lightest, control| lightest.min(control.w));
            weight_spread = (heaviest - lightest) / lightest;
            let scale = power_of_two_below(heaviest.max(f64::MIN_POSITIVE)).recip();
            for control in &mut controls {
                *control *= scale;
            }
        }
        let mut net = Self { degree, controls, origin, weight_spread, ..Self::default() };
        net.classify_weights();
        net.radius = longest(&net.controls, net.is_polynomial());
        let restriction = RESTRICTION_ROUNDINGS * (degree[0] + degree[1]) as f64 + 8.0;
        net.point_error = gamma(restriction * net.radius);
        net
    }

    /// Finds along which axes weights count as equal, and sets them to 1 where all do.
    fn classify_weights(&mut self) {
        if self.is_polynomial() {
            for control in self.controls.iter_mut().filter(|control| control.w != 1.0) {
                *control = (control.xyz() / control.w).extend(1.0);
            }
            self.line_spreads = [Some(self.weight_spread); 2];
        } else {
            self.line_spreads = Axis::BOTH.map(|axis| weight_spread(self, axis));
        }
    }

    /// Whether the weights are positive and count as equal.
    pub(super) fn is_polynomial(&self) -> bool {
        (0.0..=MAX_WEIGHT_SPREAD).contains(&self.weight_spread)
    }

    /// Becomes the restriction of another net, of a whole patch, along an axis.
    pub(super) fn restrict(&mut self, net: &Self, axis: Axis, restriction: &Restriction) {
        self.degree = restriction.apply(axis, net.degree, &net.controls, &mut self.controls);
        self.origin = net.origin;
        self.weight_spread = net.weight_spread;
        self.line_spreads = net.line_spreads;
        // The first weight of a line is another one, as far from that of the whole line at most.
        if !net.is_polynomial() {
            self.line_spreads[axis] = net.line_spreads[axis].map(|spread| 2.0 * spread);
        }
        self.radius = net.radius;
        let elevation = ELEVATION_ROUNDINGS * restriction.elevation() as f64;
        self.point_error = net.point_error + gamma(elevation * net.radius);
    }

    /// An upper bound on the distance between points of equal parameters, by
    /// lemma R11: the bound by the coefficients' lengths where that is at most the
    /// threshold, else the closer one by those of the squared length. `None` where a weight
    /// is not positive or a number overflows, and where the threshold is out of reach: where
    /// corners are farther apart, or the lengths far exceed it.
    pub(super) fn max_difference(&self, other: &Self, threshold: f64) -> Option<f64> {
        self.max_distance(other, threshold, || None)
    }

    /// As [`Net::max_difference`], or with other feet on B that `sliding` gives where those of
    /// equal parameters do not suffice.
    pub(super) fn max_distance<'a, 'b: 'a>(
        &self,
        other: &Self,
        threshold: f64,
        sliding: impl Fn() -> Option<&'a Sliding<'b>>,
    ) -> Option<f64> {
        let shift = self.origin - other.origin;
        let [corners, others] = [self, other].map(Net::corners);
        for (corner, other) in corners.iter().zip(&others) {
            let difference = *corner - *other + shift;
            if difference.length() > threshold && !(sliding()?.residual(difference).length() <= threshold) {
                return None;
            }
        }
        if !self.is_positive() || !other.is_positive() {
            return None;
        }
        let Difference { degree, quotient, product_terms, error } = Difference::new(self, other);
        let longest = longest(&quotient, self.is_polynomial() && other.is_polynomial());
        let of_products = gamma(product_terms as f64 + PRODUCT_ROUNDINGS);
        let rounding = of_products * (self.radius + other.radius + shift.length())
            + self.point_error
            + other.point_error
            + error;
        let bound = bound_by_lengths(longest, of_products) + rounding;
        let is_finite = bound < f64::INFINITY;
        if bound <= threshold || !is_finite {
            return is_finite.then_some(bound);
        }
        if let Some(sliding) = sliding() {
            // The quotient is off by its part of all of the difference, not only of the residual.
            let lost = rounding + of_products * longest;
            if let Some(bound) = sliding.upper_bound(degree, &quotient, threshold - lost) {
                return Some(bound + lost);
            }
        }
        if longest > MAX_EXCESS * threshold {
            return None;
        }
        let largest = squares(degree, &quotient)
            .into_iter()
            .map(|(length_squared, weight_squared)| length_squared / weight_squared)
            .fold(0.0, upper_max);
        let of_squares = gamma(square_terms(degree) + SQUARE_ROUNDINGS);
        let bound = bound_by_squares(largest, longest, of_products, of_squares) + rounding;
        (bound < f64::INFINITY).then_some(bound)
    }

    /// The points at the corners.
    fn corners(&self) -> [DVec3; 4] {
        let [last_row, last_column] = [self.degree[0] * (self.degree[1] + 1), self.degree[1]];
        [0, last_column, last_row, last_row + last_column].map(|corner| {
            let control = self.controls[corner];
            control.xyz() / control.w
        })
    }

    fn is_positive(&self) -> bool {
        self.is_polynomial() || self.controls.iter().all(|control| control.w > 0.0)
    }
}
