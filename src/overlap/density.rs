//! How much the density of a piece's cone varies over the piece.

use crate::rounding::{UNIT_ROUNDOFF, gamma, lower_min, upper_max};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// More than the roundings of sums of products of positive bounds, relative to them.
const BOUND_ROUNDINGS: f64 = 64.0;

/// The roundings of a difference of differences of controls, in units of the largest control.
const DIFFERENCE_ROUNDINGS: f64 = 8.0;

/// Upper bounds on the sizes of the vector and of the weight of a homogeneous derivative.
#[derive(Debug, Clone, Copy)]
struct Size {
    vector: f64,
    weight: f64,
}

/// Bounds on the derivatives of a piece, for parameters in [0, 1].
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes {
    /// Upper bounds on the lengths of the derivatives of the point.
    pub(super) point: [f64; 2],
    /// Upper bounds on the lengths of the derivatives of x_s × x_t.
    pub(super) normal: [f64; 2],
}

impl Slopes {
    /// Returns the bounds for homogeneous control points relative to a centre near the piece.
    ///
    /// With the homogeneous point (X, w) the vector x_s × x_t is N/w³ for N = w X_s × X_t − w_t X_s × X − w_s X × X_t,
    /// and N_s = w (X_ss × X_t + X_s × X_st) − w_st X_s × X − w_t X_ss × X − w_ss X × X_t − w_s X × X_st, as w_s X_s × X_t
    /// cancels. Derivatives are bounded by differences of control points. O(p q).
    pub(super) fn new([p, q]: [usize; 2], controls: &[DVec4]) -> Self {
        let own = Size::of(controls, 1.0);
        let least_weight = controls.iter().map(|control| control.w).fold(f64::INFINITY, lower_min);
        let grid = Grid { counts: [p + 1, q + 1], controls: controls.to_vec() };
        let (of_s, of_t) = (grid.differences(0), grid.differences(1));
        let [p, q] = [p, q].map(|degree| degree as f64);
        let size = |grid: &Grid, factor: f64| {
            let Size { vector, weight } = Size::of(&grid.controls, factor);
            let error = factor * DIFFERENCE_ROUNDINGS * UNIT_ROUNDOFF;
            Size { vector: vector + error * own.vector, weight: weight + error * own.weight }
        };
        let first = [size(&of_s, p), size(&of_t, q)];
        let mixed = size(&of_s.differences(1), p * q);
        let second = [size(&of_s.differences(0), p * (p - 1.0)), size(&of_t.differences(1), q * (q - 1.0))];
        let cube = least_weight * least_weight * least_weight;
        let [s, t] = first;
        let numerator =
            own.weight * s.vector * t.vector + (t.weight * s.vector + s.weight * t.vector) * own.vector;
        let normal = [0, 1].map(|axis: usize| {
            let (along, across, twice) = (first[axis], first[1 - axis], second[axis]);
            let slope = own.weight * (twice.vector * across.vector + along.vector * mixed.vector)
                + own.vector
                    * (mixed.weight * along.vector
                        + across.weight * twice.vector
                        + twice.weight * across.vector
                        + along.weight * mixed.vector);
            let quotient = slope / cube + 3.0 * along.weight * numerator / (cube * least_weight);
            quotient * (1.0 + gamma(BOUND_ROUNDINGS))
        });
        let point = first.map(|along| {
            let slope = along.vector + own.vector / least_weight * along.weight;
            slope / least_weight * (1.0 + gamma(BOUND_ROUNDINGS))
        });
        Self { point, normal }
    }

    /// Returns an upper bound on the distance of the density (x − origin)·(x_s × x_t) / 3 from its mean, for points
    /// within `radius` of the origin.
    ///
    /// A derivative of x is at right angles to x_s × x_t, so that the density's is (x − origin)·(x_s × x_t)' / 3. The
    /// mean of |s − s'| over s' is at most ½.
    pub(super) fn variation(&self, radius: f64) -> f64 {
        0.5 * (self.normal[0] + self.normal[1]) * radius / 3.0 * (1.0 + gamma(BOUND_ROUNDINGS))
    }

    /// Returns an upper bound on the length of the border of a convex part of the parameters' square.
    pub(super) fn border(&self) -> f64 {
        2.0 * (self.point[0] + self.point[1]) * (1.0 + gamma(BOUND_ROUNDINGS))
    }
}

impl Size {
    fn of(controls: &[DVec4], factor: f64) -> Self {
        let largest = |size: &dyn Fn(&DVec4) -> f64| controls.iter().map(size).fold(0.0, upper_max) * factor;
        Self {
            vector: largest(&|control| DVec3::length(control.xyz())),
            weight: largest(&|control| control.w.abs()),
        }
    }
}

/// Control points or differences of them, the second parameter's fastest.
struct Grid {
    counts: [usize; 2],
    controls: Vec<DVec4>,
}

impl Grid {
    /// Returns the differences of neighbours along an axis; none where there is one.
    fn differences(&self, axis: usize) -> Self {
        let [_, columns] = self.counts;
        let step = if axis == 0 { columns } else { 1 };
        let mut counts = self.counts;
        counts[axis] = counts[axis].saturating_sub(1);
        let places = (0..counts[0]).flat_map(|i| (0..counts[1]).map(move |j| i * columns + j));
        let controls = places.map(|place| self.controls[place + step] - self.controls[place]).collect();
        Self { counts, controls }
    }
}
