//! The difference of two nets as a quotient of Bernstein polynomials.

use super::net::Net;
use crate::axis::Axis;
use crate::bezier::{binomials, scaled, unscale};
use crate::rounding::upper_max;
use glam::{DVec4, Vec4Swizzles};

/// The largest spread of weights at which they are taken as equal: some times what rounding
/// makes of equal weights.
const MAX_WEIGHT_SPREAD: f64 = 1e-12;

/// Roundings of a coefficient by one elevation of the degree.
const ELEVATION_ROUNDINGS: usize = 3;

/// The difference of the functions of two nets.
pub(super) struct Difference {
    pub(super) degree: [usize; 2],
    /// Its homogeneous coefficients: `X v - Y w` and `w v`, or the differences of points and 1.
    pub(super) quotient: Vec<DVec4>,
    /// The number of products that a coefficient sums, and of roundings by elevations.
    pub(super) product_terms: usize,
    /// The error besides rounding, where weights are taken as equal.
    pub(super) error: f64,
}

impl Difference {
    /// The form of the lowest degrees: of polynomials where all weights of either net are
    /// equal, with products along one axis where they are equal along the other, else with
    /// products along both. O(p q m n).
    pub(super) fn new(x: &Net, y: &Net) -> Self {
        let spreads = [x.weight_spread, y.weight_spread];
        if spreads.iter().all(|spread| *spread <= MAX_WEIGHT_SPREAD) {
            return Self::of_polynomials(x, y, spreads);
        }
        for axis in Axis::BOTH {
            if let Some(of_x) = weight_spread(x, axis)
                && let Some(of_y) = weight_spread(y, axis)
            {
                return Self::of_lines(x, y, axis, [of_x, of_y]);
            }
        }
        Self::of_products(x, y)
    }

    fn of_polynomials(x: &Net, y: &Net, spreads: [f64; 2]) -> Self {
        let [u, v] = Axis::BOTH.map(|axis| x.degree[axis].max(y.degree[axis]));
        let [of_x, of_y] = [x, y].map(|net| {
            let points = net.controls.iter().map(|control| *control / control.w).collect();
            let points = elevated(points, net.degree, Axis::V, v);
            elevated(points, [net.degree[0], v], Axis::U, u)
        });
        Self {
            degree: [u, v],
            quotient: of_x.iter().zip(&of_y).map(|(x, y)| (x.xyz() - y.xyz()).extend(1.0)).collect(),
            product_terms: 1 + Axis::BOTH.map(|axis| elevation_roundings(x, y, axis)).iter().sum::<usize>(),
            error: weight_error(x, y, spreads),
        }
    }

    /// With weights that are equal along `axis` and taken as those of the first controls, so
    /// that they are polynomials in the other parameter alone.
    fn of_lines(x: &Net, y: &Net, axis: Axis, spreads: [f64; 2]) -> Self {
        let along = x.degree[axis].max(y.degree[axis]);
        let [p, m] = [x, y].map(|net| net.degree[axis.other()]);
        let [of_x, of_y] = [x, y].map(|net| elevated(net.controls.clone(), net.degree, axis, along));
        // A control by its line along the axis, of so many lines, and its place there.
        let at = |line: usize, lines: usize, place: usize| match axis {
            Axis::U => place * lines + line,
            Axis::V => line * (along + 1) + place,
        };
        let mut quotient = vec![DVec4::ZERO; (p + m + 1) * (along + 1)];
        let [of_p, of_m, of_sum] = [p, m, p + m].map(binomials);
        for i in 0..=p {
            for k in 0..=m {
                let [w, v] = [of_x[at(i, p + 1, 0)].w, of_y[at(k, m + 1, 0)].w];
                let factor = of_p[i] * of_m[k] / of_sum[i + k];
                let (by_x, by_y) = (factor * v, factor * w);
                for place in 0..=along {
                    let (x, y) = (of_x[at(i, p + 1, place)], of_y[at(k, m + 1, place)]);
                    let product = by_x * x.xyz() - by_y * y.xyz();
                    quotient[at(i + k, p + m + 1, place)] += product.extend(by_x * w);
                }
            }
        }
        let mut degree = [along; 2];
        degree[axis.other()] = p + m;
        let product_terms = p.min(m) + 1 + elevation_roundings(x, y, axis);
        Self { degree, quotient, product_terms, error: weight_error(x, y, spreads) }
    }

    fn of_products(x: &Net, y: &Net) -> Self {
        let ([p, q], [m, n]) = (x.degree, y.degree);
        let (degree, columns) = ([p + m, q + n], q + n + 1);
        let mut quotient = vec![DVec4::ZERO; (p + m + 1) * columns];
        let (of_x, of_y) = (scaled(x.degree, &x.controls), scaled(y.degree, &y.controls));
        // Of `v X - w Y` with 0 for the weight of Y, the last component is `w v`.
        let of_y: Vec<(DVec4, f64)> = of_y.iter().map(|y| (y.xyz().extend(0.0), y.w)).collect();
        for (i, row_of_x) in of_x.chunks_exact(q + 1).enumerate() {
            for (k, row_of_y) in of_y.chunks_exact(n + 1).enumerate() {
                let sums = &mut quotient[(i + k) * columns..][..columns];
                for (j, &x) in row_of_x.iter().enumerate() {
                    for (sum, &(y, v)) in sums[j..].iter_mut().zip(row_of_y) {
                        *sum += v * x - x.w * y;
                    }
                }
            }
        }
        unscale(degree, &mut quotient);
        Self { degree, quotient, product_terms: (p.min(m) + 1) * (q.min(n) + 1), error: 0.0 }
    }
}

/// The lines of controls along an axis: their number, the step from one to the next, the number
/// of controls on each, and the step between these.
fn lines_along([rows, columns]: [usize; 2], axis: Axis) -> [usize; 4] {
    match axis {
        Axis::U => [columns, 1, rows, columns],
        Axis::V => [rows, columns, columns, 1],
    }
}

/// The largest distance of a weight from the first one of its line, relative to that; `None` where
/// the weights along the axis do not count as equal.
fn weight_spread(net: &Net, axis: Axis) -> Option<f64> {
    let [lines, stride, count, step] = lines_along(net.degree.map(|degree| degree + 1), axis);
    let mut largest = 0.0_f64;
    for line in 0..lines {
        let first = net.controls[line * stride].w;
        for index in 1..count {
            let spread = (net.controls[line * stride + index * step].w - first).abs() / first;
            if !(0.0..=MAX_WEIGHT_SPREAD).contains(&spread) {
                return None;
            }
            largest = upper_max(largest, spread);
        }
    }
    Some(largest)
}

/// The largest move of two nets where weights that differ by these spreads are taken as equal.
fn weight_error(x: &Net, y: &Net, [of_x, of_y]: [f64; 2]) -> f64 {
    2.0 * (of_x * x.radius + of_y * y.radius)
}

/// The roundings of the elevation of one of two nets to the larger degree along an axis.
fn elevation_roundings(x: &Net, y: &Net, axis: Axis) -> usize {
    ELEVATION_ROUNDINGS * x.degree[axis].abs_diff(y.degree[axis])
}

/// The controls for a degree along an axis that is not lower than their own.
fn elevated(mut controls: Vec<DVec4>, degree: [usize; 2], axis: Axis, to: usize) -> Vec<DVec4> {
    for from in degree[axis]..to {
        let mut counts = degree.map(|degree| degree + 1);
        counts[axis] = from + 1;
        let [lines, stride, _, step] = lines_along(counts, axis);
        counts[axis] = from + 2;
        let [_, raised_stride, count, raised_step] = lines_along(counts, axis);
        let mut raised = vec![DVec4::ZERO; lines * count];
        for line in 0..lines {
            let at = |index: usize| controls[line * stride + index * step];
            for index in 0..count {
                let share = |part: usize| part as f64 / (from + 1) as f64;
                raised[line * raised_stride + index * raised_step] = if index == 0 {
                    at(0)
                } else if index == from + 1 {
                    at(from)
                } else {
                    share(index) * at(index - 1) + share(from + 1 - index) * at(index)
                };
            }
        }
        controls = raised;
    }
    controls
}
