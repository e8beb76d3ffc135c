//! Tests of nets, of their restrictions and of the bounds on their differences.
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use super::super::super::orientation::Orientation;
use super::*;
use crate::bezier::Patch;
use crate::certified::reparametrization::Reparametrization;
use crate::certified::rounding::UNIT_ROUNDOFF;
use crate::certified::sheets::Chart;
use crate::certified::testing::{Surfaces, clamped};
use crate::flatness::Flatness;
use crate::model::SurfaceArrays;
use crate::rounding::lower_min;
use glam::DVec2;

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
        let largest = bounds.into_iter().flatten().fold(f64::INFINITY, lower_min);
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
            let lemma = 2.0 * UNIT_ROUNDOFF * ((terms + 16.0) * radius.hypot(shift.length()) + restriction);
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
            lengths[side] = upper_max(lengths[side], point.length());
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

/// Pieces of nets of any weights and degrees, relative to different origins: their bounds hold at
/// random points, and are attained by a net against itself, moved.
#[test]
fn differences_of_restricted_nets_are_bounded() {
    let random = &mut fastrand::Rng::with_seed(7);
    for case in 0..300 {
        let degree = [random.usize(1..6), random.usize(1..6)];
        let ends = [(); 4].map(|()| [random.f64(), random.f64()]);
        let origins = [(); 2].map(|()| DVec3::from_array([0; 3].map(|_| random.f64())));
        let of_lines: Vec<f64> = (0..6).map(|_| 0.5 + random.f64()).collect();
        let mut controls = || -> Vec<DVec4> {
            let count = (degree[0] + 1) * (degree[1] + 1);
            let place = |index: usize| [index / (degree[1] + 1), index % (degree[1] + 1)];
            let mut control = |index: usize| {
                let [i, j] = place(index);
                let weight = [3.0, of_lines[i], of_lines[j], 0.5 + random.f64()][case % 4];
                weight * DVec4::new(random.f64(), random.f64(), random.f64(), 1.0)
            };
            (0..count).map(&mut control).collect()
        };
        let nets = [controls(), controls()];
        let piece = |side: usize, ends: [[f64; 2]; 2], origin: DVec3| {
            let mut net = Net::whole(degree, nets[side].clone(), origin);
            for (axis, ends) in Axis::BOTH.into_iter().zip(ends) {
                let mut restricted = Net::default();
                let raised = degree[axis] + case % 2;
                restricted.restrict(&net, axis, &Restriction::new(degree[axis], raised, ends));
                net = restricted;
            }
            net
        };
        let [x, y] = [piece(0, [ends[0], ends[1]], origins[0]), piece(1, [ends[2], ends[3]], origins[1])];
        let bound = x.max_difference(&y, f64::INFINITY).unwrap();
        let at = |side: usize, ends: [[f64; 2]; 2], place: [f64; 2]| {
            let place = [0, 1].map(|i| (1.0 - place[i]) * ends[i][0] + place[i] * ends[i][1]);
            Patch::whole(degree, origins[side], &nets[side]).point(place)
        };
        for _ in 0..30 {
            let place = [random.f64(), random.f64()];
            let [on_x, on_y] = [at(0, [ends[0], ends[1]], place), at(1, [ends[2], ends[3]], place)];
            assert!(on_x.distance(on_y) <= bound, "{} {bound} case {case}", on_x.distance(on_y));
        }
        let moved = piece(0, [ends[0], ends[1]], origins[1]);
        let (truth, bound) = (origins[0].distance(origins[1]), x.max_difference(&moved, 4.0).unwrap());
        assert!((truth..truth + 1e-11).contains(&bound), "{truth} {bound} case {case}");
    }
}

/// Weights of a line that differ from its first one by the spread that is stated differ, after a
/// restriction, from the first one then by nearly twice as much, and by no more than is stated.
#[test]
fn a_restriction_doubles_the_spread_of_weights() {
    const SPREAD: f64 = 5e-13;
    const DEGREE: usize = 15;
    let weight = |i: usize| match i {
        0 => 1.0,
        _ if i <= DEGREE / 2 => 1.0 + SPREAD,
        _ => 1.0 - SPREAD,
    };
    // Weights differ across the lines, so that the net is no polynomial.
    let controls =
        (0..=DEGREE).flat_map(|i| [1.0, 2.0].map(|scale| DVec4::new(0.0, 0.0, 0.0, scale * weight(i))));
    let whole = Net::whole([DEGREE, 1], controls.collect(), DVec3::ZERO);
    let mut piece = Net::default();
    piece.restrict(&whole, Axis::U, &Restriction::new(DEGREE, DEGREE, [0.3, 0.7]));
    let first = piece.controls[0].w;
    let spread = piece.controls.iter().step_by(2).map(|control| (control.w / first - 1.0).abs());
    let spread = spread.fold(0.0, upper_max);
    let stated = piece.line_spreads[0].unwrap();
    assert!(spread > 1.5 * SPREAD && spread <= stated, "{spread} {stated}");
}

/// Lemmas R6 and R11 for a piece of a bilinear patch against itself, moved by a length h: 16 roundings
/// for each degree and 6 for each elevation, 4 for the origins, and those of the products.
#[test]
fn the_bound_of_a_restricted_net_adds_its_rounding() {
    let points = [[-1.0, -2.0], [-1.0, 2.0], [1.0, -2.0], [1.0, 2.0]];
    let (radius, height) = (5.0_f64.sqrt(), 0.5);
    for (weights, terms, elevation) in
        [([1.0; 4], 1.0, 0), ([1.0; 4], 1.0, 2), ([1.0, 2.0, 2.0, 2.0], 4.0, 0)]
    {
        let control = |([x, y], w): ([f64; 2], f64)| w * DVec4::new(x, y, 0.0, 1.0);
        let controls: Vec<DVec4> = points.into_iter().zip(weights).map(control).collect();
        let restriction = Restriction::new(1, 1 + elevation, [0.25, 0.75]);
        let [x, y] = [0.0, height].map(|z| {
            let whole = Net::whole([1, 1], controls.clone(), DVec3::new(0.0, 0.0, z));
            let mut piece = Net::default();
            piece.restrict(&whole, Axis::V, &restriction);
            piece
        });
        let found = x.max_difference(&y, 1.0).unwrap();
        let of_points = 16.0 * 2.0 + 6.0 * elevation as f64 + 8.0;
        let of_products = terms + 16.0 + 4.0;
        let lemma = 2.0 * radius * (of_points + of_products) + height * (2.0 * of_products + 8.0);
        let part = (found - height) / (lemma * UNIT_ROUNDOFF);
        assert!((1.0..=1.03).contains(&part), "{part} of the lemma, {terms} terms");
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

/// A net of equal points. One weight is greater by `spread`.
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

/// The rounding of nets 1e6 from the origin is in the bound: 10 roundings of either radius.
#[test]
fn the_rounding_of_nets_far_away_is_added() {
    const HEIGHT: f64 = 1e-6;
    let knots = clamped(1, &[]);
    let square = SurfaceArrays {
        degree: [1, 1],
        counts: [2, 2],
        knots: [knots.clone(), knots],
        control_points: [0.0, 1.0].map(|x| [0.0, 1.0].map(|y| [x, y, 0.0, 1.0])).concat(),
    };
    let b = Surfaces::new(vec![square], Flatness::None);
    let chart = Chart::new(b.sheets(), 0, [0.5; 2]);
    let orientation = Orientation::new(&Reparametrization { p: DVec2::X, q: DVec2::Y });
    let sliding = Sliding::new(&chart, [0, 0], [[0.25, 0.75]; 2], orientation);
    let net = |offset: DVec3| {
        let corners = [[0.25, 0.25], [0.25, 0.75], [0.75, 0.25], [0.75, 0.75]];
        let controls = corners.map(|[x, y]| (DVec3::new(x, y, 0.0) + offset).extend(1.0));
        Net::new([1, 1], controls.to_vec(), DVec3::new(1e6, 0.0, 0.0), 1.0)
    };
    let [x, y] = [DVec3::new(0.1, 0.0, HEIGHT), DVec3::ZERO].map(net);
    let bound = x.max_distance(&y, 1e-5, || Some(&sliding)).unwrap_or(f64::INFINITY);
    let lost = 20.0 * UNIT_ROUNDOFF * 1e6;
    assert!((HEIGHT + lost..HEIGHT + 100.0 * lost).contains(&bound), "{bound:e}");
}
