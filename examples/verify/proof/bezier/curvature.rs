//! Bounds of the first and second derivatives of rational Bézier patches.

use super::net::{Homogeneous, Net, project};
use crate::proof::interval::Interval;
use crate::proof::vector::{Vector, difference, exactly, middle, norm};

/// Upper bounds of the norms of a patch's first and second derivatives over its domain [0, 1]².
#[derive(Debug, Clone, Copy)]
pub(crate) struct SecondDerivatives {
    /// Of the derivatives along u and along v.
    pub(crate) first: [f64; 2],
    /// Of the derivatives along u twice and along v twice.
    pub(crate) pure: [f64; 2],
    /// Of the mixed derivative.
    pub(crate) mixed: f64,
}

/// Upper bounds of the size of the numerator's derivative and of the weight's.
#[derive(Clone, Copy)]
struct Sizes {
    numerator: Interval,
    weight: Interval,
}

impl SecondDerivatives {
    /// With f = X / w, X measured from a point near the patch so that |f| <= F is small:
    ///
    /// - f_s = (X_s - f w_s) / w,
    /// - f_ss = (X_ss - 2 f_s w_s - f w_ss) / w,
    /// - f_st = (X_st - f_s w_t - f_t w_s - f w_st) / w.
    ///
    /// The control points of the derivatives of X and w are multiples of differences of theirs and
    /// bound them by the hull property, as the control points of f do F and the least weight w.
    /// Infinite where a weight may not be positive. O(size of the net).
    pub(crate) fn of(net: &Net) -> Self {
        let center = exactly(middle(&project(&net.points[net.points.len() / 2])));
        let shifted: Vec<Homogeneous> = net
            .points
            .iter()
            .map(|&[x, y, z, w]| [x - center[0] * w, y - center[1] * w, z - center[2] * w, w])
            .collect();
        let least = net.points.iter().map(|point| point[3]).reduce(|a, b| a.hull(b));
        let weight = Interval::point(least.map_or(0.0, |weight| weight.lo));
        if weight.lo <= 0.0 {
            return Self { first: [f64::INFINITY; 2], pure: [f64::INFINITY; 2], mixed: f64::INFINITY };
        }
        let size = largest(net.hull_points().map(|point| norm(&difference(&point, &center))));
        let patch = Differences { degree: net.degree, points: shifted };
        let along = [patch.along(0), patch.along(1)];
        let first = [0, 1].map(|axis| {
            let sizes = along[axis].sizes();
            (sizes, (sizes.numerator + size * sizes.weight) / weight)
        });
        let pure = [0, 1].map(|axis| {
            let Sizes { numerator, weight: bend } = along[axis].along(axis).sizes();
            let (sizes, slope) = first[axis];
            (numerator + TWO * slope * sizes.weight + size * bend) / weight
        });
        let mixed = along[0].along(1).sizes();
        let cross = first[0].1 * first[1].0.weight + first[1].1 * first[0].0.weight;
        let mixed = (mixed.numerator + cross + size * mixed.weight) / weight;
        Self { first: first.map(|(_, slope)| slope.hi), pure: pure.map(|bound| bound.hi), mixed: mixed.hi }
    }
}

const TWO: Interval = Interval { lo: 2.0, hi: 2.0 };

/// The control net of a derivative of X and w.
struct Differences {
    degree: [usize; 2],
    points: Vec<Homogeneous>,
}

impl Differences {
    /// The derivative along an axis: degree times the differences of neighbours; none are left of degree 0.
    fn along(&self, axis: usize) -> Self {
        let mut degree = self.degree;
        let columns = self.degree[1] + 1;
        if degree[axis] == 0 {
            return Self { degree, points: vec![[Interval::ZERO; 4]; self.points.len()] };
        }
        degree[axis] -= 1;
        let factor = Interval::point(self.degree[axis] as f64);
        let step = if axis == 0 { columns } else { 1 };
        let mut points = Vec::with_capacity(self.points.len());
        for i in 0..=degree[0] {
            for j in 0..=degree[1] {
                let index = i * columns + j;
                let [from, to] = [&self.points[index], &self.points[index + step]];
                points.push(std::array::from_fn(|k| factor * (to[k] - from[k])));
            }
        }
        Self { degree, points }
    }

    fn sizes(&self) -> Sizes {
        let vector = |point: &Homogeneous| -> Vector { [point[0], point[1], point[2]] };
        Sizes {
            numerator: largest(self.points.iter().map(|point| norm(&vector(point)))),
            weight: largest(self.points.iter().map(|point| point[3])),
        }
    }
}

/// The largest absolute value of all.
fn largest(values: impl Iterator<Item = Interval>) -> Interval {
    values.fold(Interval::ZERO, |largest, value| largest.hull(Interval::point(value.magnitude()))).top()
}

impl Interval {
    /// The interval of the upper end alone.
    fn top(self) -> Self {
        Self::point(self.hi)
    }
}
