//! Surfaces on which bounds of derivatives and of distances are attained or
//! nearly so: a bound that is less strict than stated is false on these.

use glam::{DVec3, DVec4};
use nurbs_hausdorff::ParamBox;
use nurbs_hausdorff::internals::bezier::{DerivativeBounds, LocalDerivativeBounds, Patch};
use nurbs_hausdorff::internals::closest::{CriticalPoint, SquaredDistance};

/// The rounding of bounds on derivatives over a whole patch, relative to the bound.
const ROUNDING: f64 = 1e-11;

/// The same over a part of a patch, where it includes the error of the cutting.
const PART_ROUNDING: f64 = 1e-7;

fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
}

/// The Bernstein coefficients of `x^power`, or of `(1 - x)^power`.
fn monomial(power: usize, degree: usize, mirrored: bool) -> Vec<f64> {
    let coefficient = |i: usize| if i < power { 0.0 } else { binomial(i, power) / binomial(degree, power) };
    (0..=degree).map(|i| coefficient(if mirrored { degree - i } else { i })).collect()
}

/// The controls (0, 0, s^a t^b) of these degrees, mirrored or not.
fn heights([a, b]: [usize; 2], [p, q]: [usize; 2], mirrored: bool) -> Vec<DVec4> {
    let in_t = monomial(b, q, mirrored);
    let row = |s: f64| in_t.iter().map(move |t| DVec4::new(0.0, 0.0, s * t, 1.0)).collect::<Vec<_>>();
    monomial(a, p, mirrored).into_iter().flat_map(row).collect()
}

/// The controls of degree 4 along this axis and 1 along the other, with x the
/// other parameter: no edge is a point, towards which parts would be narrower.
fn spread(mut controls: Vec<DVec4>, axis: usize) -> Vec<DVec4> {
    for (index, control) in controls.iter_mut().enumerate() {
        control.x = if axis == 0 { index % 2 } else { index / 5 } as f64;
    }
    controls
}

fn patch(degree: [usize; 2], controls: &[DVec4]) -> Patch<'_> {
    let rational = controls.iter().any(|control| control.w != controls[0].w);
    Patch { surface: 0, degree, domain: ParamBox::UNIT, center: DVec3::ZERO, controls, rational }
}

/// The bound on the derivative of order (a, b).
fn bound_of_order(bounds: &DerivativeBounds, [a, b]: [usize; 2]) -> f64 {
    match a + b {
        0 => bounds.radius,
        1 => bounds.first[b],
        2 => bounds.second[b],
        _ => bounds.third[b],
    }
}

#[track_caller]
fn assert_attained(bound: f64, derivative: f64, rounding: f64) {
    assert!((derivative..=derivative * (1.0 + rounding)).contains(&bound), "{bound}, not {derivative}");
}

/// `s^a t^b` has the derivative a! b! of order (a, b) everywhere, in any degrees.
#[test]
fn constant_derivatives_are_their_bounds() {
    let orders = (0..=3).flat_map(|a| (0..=3 - a).map(move |b| [a, b]));
    for [a, b] in orders.filter(|[a, b]| a + b > 0) {
        for degree in [[a.max(1), b.max(1)], [3, 3], [5, 4]] {
            let controls = heights([a, b], degree, false);
            let factorials: usize = (1..=a).chain(1..=b).product();
            let bounds = patch(degree, &controls).derivative_bounds();
            let bound = bound_of_order(&bounds, [a, b]);
            assert_attained(bound * (1.0 + ROUNDING), factorials as f64, 2.0 * ROUNDING);
        }
    }
}

/// The points -1, 1, 1, -1 with weights 1, 3, 3, 1. At the first corner all
/// terms of the quotient rule have the same sign and every factor is the largest
/// of the patch: with `X_s = 4`, `X_st = -8`, `w_s = 2` and `w_st = -4`,
/// `x_s = X_s - w_s x = 6`, `x_ss = -2 w_s x_s = -24`, `x_sss = -3 w_s x_ss = 144`,
/// `x_st = X_st - w_s x_t - w_t x_s - w_st x = -8 - 12 - 12 - 4 = -36`, and
/// `x_sst = -2 w_s x_st - w_t x_ss - 2 w_st x_s = 144 + 48 + 48 = 240`.
#[test]
fn the_quotient_rule_is_attained() {
    for scale in [1.0, 0.125, 16.0] {
        let controls = [[-1.0, 1.0], [1.0, 3.0], [1.0, 3.0], [-1.0, 1.0]]
            .map(|[x, w]| scale * DVec4::new(w * x, 0.0, 0.0, w));
        let bounds = patch([1, 1], &controls).derivative_bounds();
        let orders = [
            ([0, 0], 1.0),
            ([1, 0], 6.0),
            ([0, 1], 6.0),
            ([2, 0], 24.0),
            ([1, 1], 36.0),
            ([0, 2], 24.0),
            ([3, 0], 144.0),
            ([2, 1], 240.0),
            ([1, 2], 240.0),
            ([0, 3], 144.0),
        ];
        for (order, derivative) in orders {
            assert_attained(bound_of_order(&bounds, order), derivative, ROUNDING);
        }
    }
}

/// The third derivative of s^4 is 24 s: over a box, at least that at its end, and
/// at most that at the end of the last quarter that the box touches.
#[test]
fn bounds_over_parts_are_attained_at_their_ends() {
    for axis in [0, 1] {
        let (powers, degree) = if axis == 0 { ([4, 0], [4, 1]) } else { ([0, 4], [1, 4]) };
        let controls = spread(heights(powers, degree, false), axis);
        let patch = patch(degree, &controls);
        let local = LocalDerivativeBounds::new(ParamBox::UNIT);
        for (low, high, end) in [
            (0.5, 0.75, 0.75),
            (0.6, 0.74, 0.75),
            (0.6, 0.8, 1.0),
            (0.1, 0.2, 0.25),
            (0.2, 0.26, 0.5),
            (0.25, 0.5, 0.5),
            (0.9, 1.0, 1.0),
            (1.0, 1.0, 1.0),
            (0.1, 0.9, 1.0),
        ] {
            let corner = |value: f64| if axis == 0 { [value, 0.25] } else { [0.25, value] };
            let bounds = local.over(&patch, corner(low), corner(high));
            let bound = bounds.third[3 * axis];
            assert!(bound >= 24.0 * high, "[{low}, {high}]: {bound}");
            assert!(bound <= 24.0 * end * (1.0 + PART_ROUNDING), "[{low}, {high}]: {bound}");
        }
    }
}

/// The third derivative of (1 - s)^4 is the largest at the start of the extension.
#[test]
fn bounds_beyond_an_edge_are_attained() {
    const BEYOND: f64 = 0.125;
    for axis in [0, 1] {
        let (powers, degree) = if axis == 0 { ([4, 0], [4, 1]) } else { ([0, 4], [1, 4]) };
        let controls = spread(heights(powers, degree, true), axis);
        let patch = patch(degree, &controls);
        let mut extension = ParamBox::UNIT;
        extension[axis][0] = -BEYOND;
        let local = LocalDerivativeBounds::new(extension);
        let [mut low, high] = [[0.25; 2]; 2];
        low[axis] = -BEYOND;
        // A box too wide for bounds over parts, and one that is not.
        let extended = *local.about(&patch, low, high);
        assert_attained(extended.third[3 * axis], 24.0 * (1.0 + BEYOND), PART_ROUNDING);
        assert_eq!(local.over(&patch, low, high), extended);
        let mut near = high;
        near[axis] = 0.05;
        assert_attained(local.over(&patch, low, near).third[3 * axis], 24.0 * (1.0 + BEYOND), PART_ROUNDING);
    }
}

/// All of a patch at the distance 5, with equal and with different weights: the
/// rounding is subtracted, so the bound is strictly below.
#[test]
fn a_constant_distance_is_nearly_attained() {
    for weights in [[1.0; 4], [1.0, 3.0, 3.0, 1.0], [0.5, 0.25, 8.0, 1.0]] {
        let controls = weights.map(|w| w * DVec4::new(3.0, 4.0, 0.0, 1.0));
        let form = SquaredDistance::new([1, 1], &controls, DVec3::ZERO);
        let known =
            CriticalPoint { parameters: [0.5; 2], distance_squared: 25.0, ..CriticalPoint::default() };
        for bound in [form.lower_bound(), form.lower_bound_about(&known)] {
            assert!(bound < 25.0 && bound > 25.0 * (1.0 - 1e-9), "{weights:?}: {bound}");
        }
    }
}

/// The nearest point is a corner, whose coefficient is the smallest.
#[test]
fn the_distance_of_a_corner_is_nearly_attained() {
    for corner in 0..4 {
        let mut controls = [DVec4::new(0.0, 0.0, 2.0, 1.0); 4];
        controls[corner].z = 1.0;
        for weight in [1.0, 4.0, 0.25] {
            let mut weighted = controls;
            weighted[corner] *= weight;
            let bound = SquaredDistance::new([1, 1], &weighted, DVec3::ZERO).lower_bound();
            // The coefficients next to the corner's are those of the product 1 · 2.
            assert!(bound < 1.0 && bound > 1.0 - 1e-12, "{bound}");
        }
    }
}

/// `1 - k m(s, t)` with m from 0 to 1, from where it is 0: the expansion's
/// linear or quadratic term is attained up to k².
#[test]
fn the_expansion_of_the_squared_distance_is_nearly_attained() {
    const K: f64 = 1e-3;
    let truth = (1.0 - K) * (1.0 - K);
    for (powers, mirrored) in [[1, 0], [0, 1], [2, 0], [0, 2], [1, 1]]
        .into_iter()
        .flat_map(|powers| [(powers, false), (powers, true)])
    {
        let degree = powers.map(|power: usize| power.max(1));
        let controls: Vec<DVec4> = heights(powers, degree, mirrored)
            .iter()
            .map(|control| DVec4::new(0.0, 0.0, 1.0 - K * control.z, 1.0))
            .collect();
        let sign = if mirrored { 1.0 } else { -1.0 };
        let gradient = |axis: usize| {
            let linear = powers[axis] == 1 && powers[1 - axis] == 0;
            if linear { sign * 2.0 * K } else { 0.0 }
        };
        let known = CriticalPoint {
            parameters: if mirrored { [1.0; 2] } else { [0.0; 2] },
            distance_squared: 1.0,
            gradient: [gradient(0), gradient(1)],
            ..CriticalPoint::default()
        };
        let bound = SquaredDistance::new(degree, &controls, DVec3::ZERO).lower_bound_about(&known);
        assert!(bound <= truth, "{powers:?}: {bound} is above {truth}");
        assert!(bound >= truth - 4.0 * K * K, "{powers:?}: {bound} is far below {truth}");
    }
}

/// A rational line towards the target, from its heaviest to its lightest point:
/// with w = 1 - s/2 and distance 1 at s = 0 the slope is -c there, and the
/// distance at s = 1 is 1 - c.
#[test]
fn the_expansion_of_a_rational_distance_holds() {
    const C: f64 = 1e-3;
    for axis in [0, 1] {
        let (start, end) = (DVec4::new(0.0, 0.0, 1.0, 1.0), 0.5 * DVec4::new(0.0, 0.0, 1.0 - C, 1.0));
        let controls = if axis == 0 { [start, start, end, end] } else { [start, end, start, end] };
        let mut gradient = [0.0; 2];
        gradient[axis] = -C;
        let known = CriticalPoint {
            parameters: [0.0; 2],
            distance_squared: 1.0,
            gradient,
            ..CriticalPoint::default()
        };
        let bound = SquaredDistance::new([1, 1], &controls, DVec3::ZERO).lower_bound_about(&known);
        let truth = (1.0 - C) * (1.0 - C);
        assert!(bound <= truth && bound >= 1.0 - 4.0 * C - 1e-9, "{bound}, not {truth}");
    }
}

/// A plane below the target, whose squared distance is convex about its foot.
#[test]
fn a_convex_squared_distance_has_no_gap() {
    let controls =
        [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]].map(|[x, y]| DVec4::new(x, y, 1.0, 1.0));
    let form = SquaredDistance::new([1, 1], &controls, DVec3::ZERO);
    let known = CriticalPoint { parameters: [0.5; 2], distance_squared: 1.0, ..CriticalPoint::default() };
    let bound = form.lower_bound_about(&known);
    assert!(bound < 1.0 && bound > 1.0 - 1e-12, "{bound}");
}

/// The saddle z = 1 - k s t over the plane x = l s, y = 0 from the origin, whose squared distance
/// is 1 + l² s² - 2 k s t + k² s² t². Of the first three terms the least value for s, t in [0, 1] is
/// at t = 1 and s = k/l², or at s = 1 where k exceeds l²; the last is at most k². From a corner, with
/// either parameter in the place of the other.
#[test]
fn the_least_value_of_the_quadratic_form_is_nearly_attained() {
    const K: f64 = 1e-3;
    for (leg, swapped) in
        [0.0, 0.01, 0.02, 0.05, 0.1, 1.0].into_iter().flat_map(|leg| [(leg, false), (leg, true)])
    {
        let control = |s: f64, t: f64| DVec4::new(leg * s, 0.0, 1.0 - K * s * t, 1.0);
        let controls = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]
            .map(|[s, t]| if swapped { control(t, s) } else { control(s, t) });
        let known = CriticalPoint { distance_squared: 1.0, ..CriticalPoint::default() };
        let form = SquaredDistance::new([1, 1], &controls, DVec3::ZERO);
        let least = |s: f64| leg * leg * s * s - 2.0 * K * s;
        let bound = form.lower_bound_about(&known);
        let truth = 1.0 + if K < leg * leg { least(K / (leg * leg)) } else { least(1.0) };
        assert!(bound <= truth + K * K, "{leg}: {bound} is above {truth}");
        assert!(bound >= truth - 4.0 * K * K, "{leg}: {bound} is far below {truth}");
    }
}
