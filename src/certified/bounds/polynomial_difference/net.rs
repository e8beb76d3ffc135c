//! The difference of two patches as a rational function.

use super::difference::{Difference, MAX_WEIGHT_SPREAD, weight_spread};
use super::sliding::Sliding;
use crate::axis::Axis;
use crate::bezier::{Restriction, power_of_two_below, squares};
use crate::certified::rounding::gamma;
use crate::rounding::upper_max;
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
pub(super) struct Net {
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

    /// Takes the net of a whole patch, relative to its own centre, of which pieces are compared.
    ///
    /// Its radius and the spreads of its weights are bounds on those of all pieces, and its error that
    /// of any restriction inside [0, 1] along both axes.
    pub(super) fn whole(degree: [usize; 2], mut controls: Vec<DVec4>, origin: DVec3) -> Self {
        let heaviest = heaviest(&controls);
        let lightest = controls.iter().fold(f64::INFINITY, |lightest, control| lightest.min(control.w));
        // Weights of 1, the most common ones, need no scale.
        if [lightest, heaviest] != [1.0; 2] {
            let scale = power_of_two_below(heaviest.max(f64::MIN_POSITIVE)).recip();
            for control in &mut controls {
                *control *= scale;
            }
        }
        let weight_spread = (heaviest - lightest) / lightest;
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

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::Patch;
    use crate::certified::rounding::UNIT_ROUNDOFF;

    /// All forms, of elevated polynomials, of products along one axis and along both, bound the
    /// difference at random points and are attained where one net is the other one moved.
    #[test]
    fn differences_of_nets_of_any_degrees_are_bounded() {
        let random = &mut fastrand::Rng::with_seed(5);
        for case in 0..400 {
            let mut net = || {
                let degree = [random.usize(1..6), random.usize(1..6)];
                let count = (degree[0] + 1) * (degree[1] + 1);
                let mut number = || random.f64() - 0.5;
                let weights: Vec<f64> = (0..count).map(|_| 1.0 + number()).collect();
                let controls: Vec<DVec4> = (0..count)
                    .map(|index| {
                        let [i, j] = [index / (degree[1] + 1), index % (degree[1] + 1)];
                        let weight = weights[[index, 0, i, j][case % 4]];
                        weight * DVec4::new(number(), number(), number(), 1.0)
                    })
                    .collect();
                (degree, controls)
            };
            let [x, y] = [net(), net()];
            let of = |(degree, controls): &([usize; 2], Vec<DVec4>), shift: DVec3| {
                Net::new(*degree, controls.clone(), shift, 1.0)
            };
            let patch = |(degree, controls): &'_ ([usize; 2], Vec<DVec4>)| {
                let (degree, controls) = (*degree, controls.clone());
                move |place: [f64; 2]| Patch::whole(degree, DVec3::ZERO, &controls).point(place)
            };
            let [on_x, on_y] = [patch(&x), patch(&y)];
            let bounds = [f64::INFINITY, 1e-3]
                .map(|threshold| of(&x, DVec3::ZERO).max_difference(&of(&y, DVec3::ZERO), threshold));
            let largest = bounds.into_iter().flatten().fold(f64::INFINITY, f64::min);
            for _ in 0..50 {
                let place = [random.f64(), random.f64()];
                let distance = on_x(place).distance(on_y(place));
                assert!(distance <= largest, "{distance} {largest}");
            }
            let shift = DVec3::new(3.0, 0.0, 4.0);
            for threshold in [5.1, 5.0 * (1.0 - 1e-6)] {
                let moved = of(&x, DVec3::ZERO).max_difference(&of(&x, shift), threshold);
                assert!(moved.is_none_or(|bound| (5.0..5.0 + 1e-11).contains(&bound)), "{moved:?}");
                assert_eq!(moved.is_none(), threshold < 5.0);
            }
        }
    }

    /// Lemmas R6, R10 and R11 for a patch against itself: the difference is 0, and the
    /// bound is the rounding alone. With equal weights a coefficient is one difference, the sum of two
    /// products where they are equal along one axis, else of four.
    #[test]
    fn the_bound_of_equal_nets_is_their_rounding() {
        let radius = 5.0_f64.sqrt();
        let weights = [[1.0; 4], [1.0, 2.0, 1.0, 2.0], [1.0, 1.0, 2.0, 2.0], [1.0, 2.0, 2.0, 2.0]];
        for (weights, terms) in weights.into_iter().zip([1.0, 2.0, 2.0, 4.0]) {
            let ratio = weights[3];
            let corners = [[-1.0, -2.0], [-1.0, 2.0], [1.0, -2.0], [1.0, 2.0]];
            let control = |([x, y], w): ([f64; 2], f64)| DVec4::new(w * x, w * y, 0.0, w);
            let controls: Vec<DVec4> = corners.into_iter().zip(weights).map(control).collect();
            for (shift, growth) in [(0.0, 1.0), (0.0, 1.5), (8.0, 1.0)] {
                let shift = DVec3::new(0.0, 0.0, shift);
                let net = || Net::new([1, 1], controls.clone(), shift, growth);
                let spread = if growth > 1.0 { growth * ratio } else { 1.0 };
                let restriction = (16.0 * 2.0 * spread + 8.0) * radius + 4.0 * shift.length();
                let lemma =
                    2.0 * UNIT_ROUNDOFF * ((terms + 16.0) * radius.hypot(shift.length()) + restriction);
                for threshold in [0.0, 1.0] {
                    let found = net().max_difference(&net(), threshold).unwrap();
                    assert!(lemma <= found && found <= 1.02 * lemma, "{found:e}, {lemma:e}, shift {shift}");
                }
            }
        }
    }

    /// The same for rational patches of degrees (7, 7) against themselves, moved: the distance is
    /// that of the motion at equal parameters, and all roundings add to it. A threshold just
    /// above the distance is not reached by the coefficients' lengths.
    #[test]
    fn the_bound_of_a_moved_net_adds_its_rounding() {
        for ratio in [2.0, 1.5] {
            check_a_moved_net(ratio);
        }
    }

    fn check_a_moved_net(ratio: f64) {
        let (mut controls, mut lengths) = ([Vec::new(), Vec::new()], [0.0_f64; 2]);
        for index in 0..64 {
            let w = if (index / 8 + index) % 2 == 0 { 1.0 } else { ratio };
            let point = DVec3::new(f64::from(index / 8), f64::from(index % 8), 0.0) / 8.0;
            for (side, z) in [0.0, 1.0].into_iter().enumerate() {
                let point = point + z * DVec3::Z;
                controls[side].push((w * point).extend(w));
                lengths[side] = lengths[side].max(point.length());
            }
        }
        let [x, y] = controls.map(|controls| Net::new([7, 7], controls, DVec3::ZERO, 1.0));
        // 64 products and 16; 120 squares, of degree 14, and 19; the restriction's 16 · 14 + 8.
        let [products, squares, restriction] = [64.0 + 16.0, 120.0 + 19.0, 232.0];
        let of_points = (products + restriction) * (lengths[0] + lengths[1]);
        for (threshold, roundings) in [(1.0 + 1e-14, products + squares), (2.0, products + 8.0)] {
            let found = x.max_difference(&y, threshold).unwrap();
            let part = (found - 1.0) / (UNIT_ROUNDOFF * (roundings + of_points));
            // The products that are bounded are off by some roundings themselves.
            assert!((0.99..=1.05).contains(&part), "{part} of the lemma, threshold {threshold}");
        }
    }

    /// What lemmas R6 and R11 take of one net, relative to its weights: its largest point, about its
    /// centre and about the origin, and the spread of its weights.
    #[test]
    fn a_net_is_measured_by_its_points() {
        let weights = [4.0, 1.0, 2.0, 2.0];
        let points = [DVec3::ZERO, DVec3::new(3.0, 4.0, 0.0), DVec3::ZERO, DVec3::ZERO];
        let controls = points.iter().zip(weights).map(|(point, w)| (w * *point).extend(w)).collect();
        let net = Net::new([1, 1], controls, DVec3::new(0.0, 0.0, 12.0), 1.0);
        assert_eq!([net.radius, net.weight_spread], [13.0, 3.0]);
        assert_eq!(net.point_error, gamma((16.0 * 2.0 + 8.0) * 5.0 + 4.0 * 12.0));
    }

    /// A net of equal points, of which one weight is greater by `spread`.
    fn point_net(degree: [usize; 2], distance: f64, spread: f64) -> Net {
        let mut controls = vec![DVec4::new(distance, 0.0, 0.0, 1.0); (degree[0] + 1) * (degree[1] + 1)];
        controls[0] *= 1.0 + spread;
        Net::new(degree, controls, DVec3::ZERO, 1.0)
    }

    /// The terms and the error of lemma R11: an elevation takes three roundings, and weights that
    /// are taken as equal twice their spread; a product of nets has a term for each pair of
    /// controls that it sums.
    #[test]
    fn differences_have_the_terms_of_the_lemma() {
        let spread = 2.0_f64.powi(-41);
        let (x, y) = (point_net([1, 2], 4.0, spread), point_net([3, 1], 16.0, 0.5 * spread));
        let polynomial = Difference::new(&x, &y);
        assert_eq!((polynomial.degree, polynomial.product_terms), ([3, 2], 1 + 3 * (2 + 1)));
        assert_eq!(polynomial.error, 2.0 * (4.0 + 8.0) * spread);
        let rational = Difference::new(&point_net([2, 3], 1.0, 1.0), &point_net([4, 1], 1.0, 0.0));
        assert_eq!((rational.degree, rational.product_terms), ([6, 4], 3 * 2));
        assert_eq!(rational.error, 0.0);
        // That error is more than all roundings.
        let bound = point_net([1, 1], 4.0, spread).max_difference(&point_net([1, 1], 4.0, spread), 1.0);
        let part = bound.unwrap() / (16.0 * spread);
        assert!((1.0..1.1).contains(&part), "{part}");
    }

    /// Lemma R11 with roundings that are large, to see each of them.
    #[test]
    fn both_bounds_of_a_difference_are_those_of_the_lemma() {
        assert_eq!(square_terms([14, 14]), 120.0);
        assert_eq!(square_terms([6, 2]), 12.0);
        // 1.25 · 4 and 8 roundings of it.
        let excess = (bound_by_lengths(4.0, 0.25) - 5.0) / (5.0 * UNIT_ROUNDOFF);
        assert!((7.0..=9.0).contains(&excess), "{excess}");
        // (1 + 1/2) √((1 + 1/4) 8 + 1/4 · 24²) = 3/2 √154
        assert_eq!(bound_by_squares(8.0, 24.0, 0.5, 0.25), 1.5 * 154.0_f64.sqrt());
    }

    /// Beyond its edges a rational patch may have weights that are not positive: no bound.
    #[test]
    fn a_weight_that_is_not_positive_gives_no_bound() {
        for least in [0.0, -0.5] {
            let weights = [1.0, 1.0, 1.0, least];
            let net = |weights: [f64; 4]| {
                let controls = weights.map(|w| DVec4::new(1.0, 0.0, 0.0, w)).to_vec();
                Net::new([1, 1], controls, DVec3::ZERO, 1.25)
            };
            for [x, y] in [[weights, weights], [weights, [1.0; 4]], [[1.0; 4], weights]] {
                assert_eq!(net(x).max_difference(&net(y), f64::INFINITY), None);
            }
        }
    }
}
