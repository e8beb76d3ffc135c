//! Volumes and moments up to second order about a point, with bounds on their errors.

use crate::interval::Interval;
use crate::rounding::{UNIT_ROUNDOFF, gamma};
use glam::DVec3;

/// The number of moments: 1; x, y, z; x², y², z²; xy, yz, zx.
pub(super) const COUNT: usize = 10;

/// The roundings of an error bound, which is a sum of terms of one sign, relative to it.
const BOUND_ROUNDINGS: f64 = 64.0;

/// More than what underflow takes off the values of one part.
const UNDERFLOW: f64 = f64::MIN_POSITIVE;

/// The integrals of the monomials up to degree 2 over a set, relative to an origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Moments {
    pub(super) values: [f64; COUNT],
    pub(super) errors: [f64; COUNT],
}

/// Returns the degree of a monomial.
pub(super) fn order(index: usize) -> i32 {
    [0, 1, 1, 1, 2, 2, 2, 2, 2, 2][index]
}

/// Returns the monomials at a point.
pub(super) fn monomials(DVec3 { x, y, z }: DVec3) -> [f64; COUNT] {
    [1.0, x, y, z, x * x, y * y, z * z, x * y, y * z, z * x]
}

impl Moments {
    /// The moments of the empty set.
    pub(crate) const ZERO: Self = Self { values: [0.0; COUNT], errors: [0.0; COUNT] };

    /// Adds those of another set, times −1 where it is `negative`. The rounding of the sum is added to the
    /// errors.
    pub(crate) fn add(&mut self, other: &Self, negative: bool) {
        let sign = if negative { -1.0 } else { 1.0 };
        for index in 0..COUNT {
            let sum = self.values[index] + sign * other.values[index];
            let more = other.errors[index] + UNIT_ROUNDOFF * sum.abs() + UNDERFLOW;
            self.values[index] = sum;
            self.errors[index] = (self.errors[index] + more) * (1.0 + gamma(2.0));
        }
    }

    /// Returns the moments of a set that is the same or its negative: it is not known which.
    pub(crate) fn of_either_sign(&self) -> Self {
        let errors =
            std::array::from_fn(|index| (self.values[index].abs() + self.errors[index]) * (1.0 + gamma(2.0)));
        Self { values: [0.0; COUNT], errors }
    }

    /// Adds what a surface that is left out of the boundary, of at most this area and within `radius` of the
    /// origin, may contribute: lemma V3 of docs/facts.md.
    pub(crate) fn add_surface(&mut self, area: f64, radius: f64) {
        for index in 0..COUNT {
            let degree = order(index);
            let bound = radius.powi(degree + 1) / f64::from(3 + degree) * area;
            self.errors[index] += bound * (1.0 + gamma(BOUND_ROUNDINGS));
        }
    }

    /// Adds what a surface that is moved by at most `distance` sweeps, of at most this area and within `radius`
    /// of the origin.
    pub(crate) fn add_layer(&mut self, distance: f64, area: f64, radius: f64) {
        for index in 0..COUNT {
            let bound = radius.powi(order(index)) * distance * area;
            self.errors[index] += bound * (1.0 + gamma(BOUND_ROUNDINGS));
        }
    }

    /// Returns the moments as intervals.
    pub(crate) fn intervals(&self) -> IntervalMoments {
        std::array::from_fn(|index| Interval::about(self.values[index], self.errors[index]))
    }

    /// Returns the volume.
    pub(crate) fn volume(&self) -> Interval {
        Interval::about(self.values[0], self.errors[0])
    }
}

/// The moments of a set as intervals.
pub(crate) type IntervalMoments = [Interval; COUNT];

/// The pairs of axes of the moments of second order.
const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [1, 2], [2, 0]];

/// Returns the moments about another origin, from which the one so far is at `offset`.
pub(crate) fn shifted(moments: &IntervalMoments, offset: [Interval; 3]) -> IntervalMoments {
    let [volume, x, y, z, ..] = *moments;
    let first = [x, y, z];
    let mut shifted = *moments;
    for axis in 0..3 {
        shifted[1 + axis] = first[axis] + offset[axis] * volume;
    }
    for (index, [i, j]) in PAIRS.into_iter().enumerate() {
        let mixed = offset[i] * first[j] + offset[j] * first[i];
        shifted[4 + index] = moments[4 + index] + mixed + offset[i] * offset[j] * volume;
    }
    shifted
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// The first of some numbers is the least that the lemma allows, and no more than rounding below the second.
    fn assert_attained(found: f64, exact: f64) {
        assert!(found >= exact && found <= exact * (1.0 + 1e-12), "{found} {exact}");
    }

    /// Lemma V3, attained by a small cap of a ball about the origin: x·n is the radius, and a coordinate may be.
    #[test]
    fn a_surface_that_is_left_out_counts_as_the_cone_over_it() {
        let (area, radius) = (0.01, 3.0);
        let mut moments = Moments::ZERO;
        moments.add_surface(area, radius);
        for index in 0..COUNT {
            let exact = [area * 3.0 / 3.0, area * 9.0 / 4.0, area * 27.0 / 5.0][order(index) as usize];
            assert_attained(moments.errors[index], exact);
        }
        moments.add_surface(area, radius);
        assert_attained(moments.errors[0], 2.0 * area);
    }

    /// The same of a thin layer: its volume, times the radius to the power of the moment's degree.
    #[test]
    fn a_layer_counts_as_its_volume() {
        let (distance, area, radius) = (1e-3, 2.0, 3.0);
        let mut moments = Moments::ZERO;
        moments.add_layer(distance, area, radius);
        for index in 0..COUNT {
            assert_attained(moments.errors[index], [0.002, 0.006, 0.018][order(index) as usize]);
        }
    }

    /// The moments of [0, 1]³ about its corner and about a place with other coordinates along each axis, by
    /// ∫ (x + a) (y + b) = 1/4 + (a + b)/2 + a b and the like.
    #[test]
    fn moments_about_another_origin_are_those_of_the_moved_set() {
        let [half, third, quarter] = [0.5, 1.0 / 3.0, 0.25];
        let cube = [1.0, half, half, half, third, third, third, quarter, quarter, quarter];
        let [a, b, c] = [1.0, 2.0, 4.0];
        let mixed = |a: f64, b: f64| quarter + (a + b) / 2.0 + a * b;
        let square = |a: f64| third + a + a * a;
        let expected = [
            1.0,
            half + a,
            half + b,
            half + c,
            square(a),
            square(b),
            square(c),
            mixed(a, b),
            mixed(b, c),
            mixed(c, a),
        ];
        let intervals = cube.map(|moment| Interval::about(moment, 1e-14));
        let found = shifted(&intervals, [a, b, c].map(Interval::exactly));
        for (interval, exact) in found.iter().zip(expected) {
            assert!(interval.contains(exact) && interval.width() < 1e-12, "{interval:?} {exact}");
        }
    }
}
