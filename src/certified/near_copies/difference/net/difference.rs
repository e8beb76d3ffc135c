//! The difference of two nets as a quotient of Bernstein polynomials.

use super::Net;
use crate::axis::Axis;
use crate::bezier::{binomials, scaled, unscale};
use crate::rounding::upper_max;
use glam::{DVec3, DVec4, Vec4Swizzles};
use std::borrow::Cow;

/// The largest spread of weights at which they are taken as equal: some times what rounding
/// makes of equal weights.
pub(super) const MAX_WEIGHT_SPREAD: f64 = 1e-12;

/// Roundings of a coefficient by one elevation of the degree.
const ELEVATION_ROUNDINGS: usize = 3;

/// Roundings of a coefficient by the change from one net's origin to the other's.
const SHIFT_ROUNDINGS: usize = 4;

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
        let mut difference = Self::about_origins(x, y);
        let shift = x.origin - y.origin;
        if shift != DVec3::ZERO {
            for control in &mut difference.quotient {
                *control = (control.xyz() + control.w * shift).extend(control.w);
            }
            difference.product_terms += SHIFT_ROUNDINGS;
        }
        difference
    }

    /// The difference of the nets' points relative to the origin of either.
    fn about_origins(x: &Net, y: &Net) -> Self {
        if x.is_polynomial() && y.is_polynomial() {
            return Self::of_polynomials(x, y);
        }
        for axis in Axis::BOTH {
            if let (Some(of_x), Some(of_y)) = (x.line_spreads[axis], y.line_spreads[axis]) {
                return Self::of_lines(x, y, axis, [of_x, of_y]);
            }
        }
        Self::of_products(x, y)
    }

    /// The difference of nets whose weights all count as 1.
    fn of_polynomials(x: &Net, y: &Net) -> Self {
        let degree = Axis::BOTH.map(|axis| x.degree[axis].max(y.degree[axis]));
        let [of_x, of_y] = [x, y].map(|net| {
            let controls = elevated(Cow::Borrowed(&net.controls), net.degree, Axis::V, degree[1]);
            elevated(controls, [net.degree[0], degree[1]], Axis::U, degree[0])
        });
        Self {
            degree,
            quotient: of_x.iter().zip(&*of_y).map(|(x, y)| (x.xyz() - y.xyz()).extend(1.0)).collect(),
            product_terms: 1 + Axis::BOTH.map(|axis| elevation_roundings(x, y, axis)).iter().sum::<usize>(),
            error: weight_error(x, y, [x.weight_spread, y.weight_spread]),
        }
    }

    /// With weights that are equal along `axis` and taken as those of the first controls, so
    /// that they are polynomials in the other parameter alone.
    fn of_lines(x: &Net, y: &Net, axis: Axis, spreads: [f64; 2]) -> Self {
        let along = x.degree[axis].max(y.degree[axis]);
        let [p, m] = [x, y].map(|net| net.degree[axis.other()]);
        let [of_x, of_y] = [x, y].map(|net| {
            let controls = Cow::Borrowed(net.controls.as_slice());
            elevated(controls, net.degree, axis, along)
        });
        // The steps between the lines along the axis, with their number, and between their controls.
        let steps = |lines: usize| match axis {
            Axis::U => [1, lines],
            Axis::V => [along + 1, 1],
        };
        let [[from_x, along_x], [from_y, along_y], [from_sum, along_sum]] =
            [p + 1, m + 1, p + m + 1].map(steps);
        let mut quotient = vec![DVec4::ZERO; (p + m + 1) * (along + 1)];
        let [of_p, of_m, of_sum] = [p, m, p + m].map(binomials);
        for i in 0..=p {
            let w = of_x[i * from_x].w;
            for k in 0..=m {
                let v = of_y[k * from_y].w;
                let factor = of_p[i] * of_m[k] / of_sum[i + k];
                let (by_x, by_y) = (factor * v, factor * w);
                for place in 0..=along {
                    // With the first weight of the line of x and 0 for that of y, the last is `w v`.
                    let x = of_x[i * from_x + place * along_x].xyz().extend(w);
                    let y = of_y[k * from_y + place * along_y].xyz().extend(0.0);
                    quotient[(i + k) * from_sum + place * along_sum] += by_x * x - by_y * y;
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
        let product_terms = (p.min(m) + 1) * (q.min(n) + 1);
        let normalized = |net: &Net| if net.is_polynomial() { net.weight_spread } else { 0.0 };
        Self { degree, quotient, product_terms, error: weight_error(x, y, [normalized(x), normalized(y)]) }
    }
}

/// The degrees of two nets after the elevations that their difference takes.
pub(in super::super) fn elevated_degrees(x: &Net, y: &Net) -> [[usize; 2]; 2] {
    let are_polynomials = x.is_polynomial() && y.is_polynomial();
    let mut degrees = [x.degree, y.degree];
    for axis in Axis::BOTH {
        let are_equal = [x, y].iter().all(|net| net.line_spreads[axis].is_some());
        if are_equal {
            let larger = x.degree[axis].max(y.degree[axis]);
            for degree in &mut degrees {
                degree[axis] = larger;
            }
            if !are_polynomials {
                break;
            }
        }
    }
    degrees
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
pub(super) fn weight_spread(net: &Net, axis: Axis) -> Option<f64> {
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
fn elevated(mut controls: Cow<'_, [DVec4]>, degree: [usize; 2], axis: Axis, to: usize) -> Cow<'_, [DVec4]> {
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
        controls = Cow::Owned(raised);
    }
    controls
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::bezier::Patch;

    /// A net of these degrees whose weights are equal along an axis, relative to the origin.
    fn net(random: &mut fastrand::Rng, degree: [usize; 2], axis: Axis) -> Net {
        let weights: Vec<f64> = (0..=degree[axis.other()]).map(|_| 0.5 + random.f64()).collect();
        let controls = (0..(degree[0] + 1) * (degree[1] + 1)).map(|index| {
            let place = [index / (degree[1] + 1), index % (degree[1] + 1)];
            let point = DVec3::from_array([0; 3].map(|_| random.f64() - 0.5));
            weights[place[axis.other().index()]] * point.extend(1.0)
        });
        Net::new(degree, controls.collect(), DVec3::ZERO, 1.0)
    }

    /// Lemma R11 by lines: the polynomials are those of the difference, their degree is the larger
    /// one along the axis and the sum across it, and a coefficient has no more terms than stated.
    #[test]
    fn a_difference_by_lines_is_that_of_the_points() {
        let random = &mut fastrand::Rng::with_seed(19);
        for case in 0..40 {
            let axis = Axis::BOTH[case % 2];
            let [x, y] = [0; 2].map(|_| {
                let degree = [random.usize(1..5), random.usize(1..5)];
                net(random, degree, axis)
            });
            let difference = Difference::of_lines(&x, &y, axis, [0.0; 2]);
            let (along, across) = (axis.index(), axis.other().index());
            let mut degree = [0; 2];
            degree[along] = x.degree[along].max(y.degree[along]);
            degree[across] = x.degree[across] + y.degree[across];
            assert_eq!(difference.degree, degree);
            let elevations = x.degree[along].abs_diff(y.degree[along]);
            let terms = x.degree[across].min(y.degree[across]) + 1 + 3 * elevations;
            assert_eq!(difference.product_terms, terms);
            for _ in 0..10 {
                let place = [random.f64(), random.f64()];
                let [of_x, of_y] =
                    [&x, &y].map(|net| Patch::whole(net.degree, DVec3::ZERO, &net.controls).point(place));
                let found = Patch::whole(difference.degree, DVec3::ZERO, &difference.quotient).point(place);
                assert!(found.distance(of_x - of_y) <= 1e-13, "{found} {}", of_x - of_y);
            }
        }
    }

    /// Weights that are apart by 2^-42 of the first, in units of any size; not by more than 1e-12.
    #[test]
    fn the_spread_of_weights_is_relative() {
        for scale in [1.0, 4.0, 0.125] {
            let spread = |part: f64| {
                let weights = [1.0, 1.0 - part, 1.0 + 0.5 * part, 1.0];
                let controls: Vec<DVec4> =
                    weights.iter().map(|weight| DVec3::ZERO.extend(scale * weight)).collect();
                let mut net = Net::new([1, 1], controls.clone(), DVec3::ZERO, 1.0);
                net.controls = controls;
                Axis::BOTH.map(|axis| weight_spread(&net, axis))
            };
            let part = 2.0_f64.powi(-42);
            let [along_s, along_t] = spread(part);
            assert!(along_s.is_some_and(|along_s| (along_s / part - 1.0).abs() < 1e-9), "{along_s:?}");
            assert_eq!(along_t, Some(part));
            assert_eq!(spread(1e-11), [None, None]);
        }
    }
}
