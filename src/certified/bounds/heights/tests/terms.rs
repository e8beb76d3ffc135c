//! Each term of the lemmas, against what it states.

use super::over_faces::flat_side;
use super::*;
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::certified::faces::FaceRim;
use crate::certified::testing::{Surfaces, closed, patch, through};
use crate::flatness::Flatness;
use crate::model::trim::RimSide;
use glam::{DMat3, DVec4};

/// A random point of [-½, ½]³.
fn vector(random: &mut fastrand::Rng) -> DVec3 {
    DVec3::from_array([0; 3].map(|_| random.f64() - 0.5))
}

/// A random rational patch of these degrees.
fn controls(random: &mut fastrand::Rng, [p, q]: [usize; 2]) -> Vec<DVec4> {
    (0..(p + 1) * (q + 1)).map(|_| (0.5 + random.f64()) * vector(random).extend(1.0)).collect()
}

fn quadric(random: &mut fastrand::Rng) -> Quadric {
    let mut function = Cubic::of(Quadric::of_plane(vector(random)));
    for _ in 0..3 {
        function.add_product(random.f64() - 0.5, vector(random), vector(random));
    }
    function.quadric
}

fn cubic(random: &mut fastrand::Rng) -> Cubic {
    let mut function = Cubic::of(quadric(random));
    for _ in 0..4 {
        function.add_triple_product(random.f64() - 0.5, vector(random), vector(random), vector(random));
    }
    function
}

/// The value of a function at a point.
fn value(function: &Cubic, y: DVec3) -> f64 {
    let Quadric { linear, form } = function.quadric;
    let third: f64 = (0..3).map(|axis| y[axis] * y.dot(function.forms[axis] * y)).sum();
    linear.dot(y) + y.dot(form * y) + third
}

/// A function's quotient at a place, and its range.
fn of_values(values: &Values, place: [f64; 2]) -> f64 {
    let controls: Vec<DVec4> =
        values.coefficients.iter().map(|&(value, weight)| DVec4::new(value, 0.0, 0.0, weight)).collect();
    Patch::whole(values.degree, DVec3::ZERO, &controls).point(place).x
}

/// Products of linear functions are the functions that are stored.
#[test]
fn products_are_those_of_their_factors() {
    let random = &mut fastrand::Rng::with_seed(1);
    for _ in 0..20 {
        let [a, b, c, y] = [0; 4].map(|_| vector(random));
        let mut function = Cubic::of(Quadric::of_plane(DVec3::ZERO));
        function.add_product(2.0, a, b);
        function.add_triple_product(3.0, a, b, c);
        let expected = 2.0 * a.dot(y) * b.dot(y) + 3.0 * a.dot(y) * b.dot(y) * c.dot(y);
        assert!((value(&function, y) - expected).abs() < 1e-14);
        for (row, form) in function.forms.iter().enumerate() {
            for other in 0..3 {
                let is_symmetric = (form.col(other) - function.forms[other].col(row)).length() < 1e-15;
                assert!(is_symmetric, "{row} {other}");
            }
        }
    }
}

/// The coefficients are those of the function on the piece, about the point, with weights; the range is theirs.
#[test]
fn coefficients_are_those_of_the_function() {
    let random = &mut fastrand::Rng::with_seed(2);
    for degree in [[1, 1], [1, 3], [2, 2], [3, 2], [4, 1]] {
        for _ in 0..5 {
            let (shift, net, function) = (vector(random), controls(random, degree), cubic(random));
            let own = Patch::whole(degree, DVec3::ZERO, &net);
            let piece = Piece::new(degree, net.clone(), shift, 2.0);
            let linear = Cubic::of(Quadric::of_plane(function.quadric.linear));
            let cases = [
                (piece.values(&linear.quadric), linear),
                (piece.values(&function.quadric), Cubic::of(function.quadric)),
                (piece.values_of_cubic(&function), function),
            ];
            for (values, function) in &cases {
                let [low, high] = values.range();
                for _ in 0..20 {
                    let place = [random.f64(), random.f64()];
                    let expected = value(function, own.point(place) - shift);
                    let found = of_values(values, place);
                    assert!((found - expected).abs() < 1e-13, "{found} {expected} of {degree:?}");
                    assert!((low..=high).contains(&expected));
                }
                let quotients = values.coefficients.iter().map(|(value, weight)| value / weight);
                let [least, largest] = quotients
                    .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, largest], x| {
                        [least.min(x), largest.max(x)]
                    });
                assert_eq!([low, high], [least - values.error, largest + values.error]);
            }
            for (index, sample) in piece.samples([POINTS_ALONG; 2]).into_iter().enumerate() {
                let place = [index / POINTS_ALONG, index % POINTS_ALONG].map(|line| line as f64 * 0.25);
                assert!(sample.distance(own.point(place) - shift) < 1e-14);
            }
        }
    }
}

/// The errors and sizes are those of lemma R17.
#[test]
fn errors_are_those_of_the_lemma() {
    let random = &mut fastrand::Rng::with_seed(3);
    let (degree, shift, patch_radius) = ([2, 3], vector(random), 1.5);
    let net = controls(random, degree);
    let farthest =
        net.iter().map(|control| (control.xyz() / control.w - shift).length()).fold(0.0, upper_max);
    let piece = Piece::new(degree, net, shift, patch_radius);
    let error = gamma((16.0 * 5.0 + 8.0) * patch_radius + 8.0 * shift.length());
    assert_eq!(piece.error, error);
    let radius = farthest + error;
    assert!((piece.radius - radius).abs() < 1e-15);
    let radius = piece.radius;
    let function = cubic(random);
    let (l, m, c) = (function.quadric.linear.length(), function.quadric.size(), function.size());
    let close =
        |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found:e} {expected:e}");
    let linear = piece.values(&Quadric::of_plane(function.quadric.linear));
    close(linear.size, l * radius);
    close(linear.error, l * error + gamma(16.0) * l * radius);
    let second = piece.values(&function.quadric);
    close(second.size, l * radius + m * radius * radius);
    close(second.error, (l + 2.0 * m * radius) * error + gamma(2.0 * (12.0 + 32.0)) * second.size);
    let third = piece.values_of_cubic(&function);
    let size = l * radius + m * radius * radius + c * radius.powi(3);
    close(third.size, size);
    let slope = l + 2.0 * m * radius + 3.0 * c * radius * radius;
    close(third.error, slope * error + gamma(2.0 * (24.0 + 32.0)) * size);
    // Norms: of all entries, and of those along a vector.
    let squares: f64 = (0..9).map(|index| function.quadric.form.col(index / 3)[index % 3].powi(2)).sum();
    close(m, squares.sqrt());
    let n = vector(random);
    let along = function.forms[0] * n.x + function.forms[1] * n.y + function.forms[2] * n.z;
    let squares: f64 = (0..9).map(|index| along.col(index / 3)[index % 3].powi(2)).sum();
    close(function.size_along(n), squares.sqrt());
}

/// No value of a parameter less a function is outside its range, along either axis, and the range is attained
/// where it is that of the ends.
#[test]
fn lags_contain_the_differences() {
    let random = &mut fastrand::Rng::with_seed(4);
    for axis in Axis::BOTH {
        for case in 0..40 {
            let degree = [1 + case % 3, 1 + case / 3 % 3];
            let (net, function) = (controls(random, degree), quadric(random));
            let own = Patch::whole(degree, DVec3::ZERO, &net);
            let piece = Piece::new(degree, net.clone(), DVec3::ZERO, 2.0);
            let ends = [random.f64() - 0.5, random.f64() - 0.5];
            for function in [function, Quadric::of_plane(function.linear)] {
                let values = piece.values(&function);
                let [low, high] = values.lag(axis, ends);
                let differences = (0..200).map(|_| {
                    let place = [random.f64(), random.f64()];
                    let along = place[axis.index()];
                    let parameter = (1.0 - along) * ends[0] + along * ends[1];
                    parameter - value(&Cubic::of(function), own.point(place))
                });
                let corners = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]].map(|place| {
                    ends[place[axis.index()] as usize] - value(&Cubic::of(function), own.point(place))
                });
                for difference in differences.collect::<Vec<_>>().into_iter().chain(corners) {
                    assert!((low..=high).contains(&difference), "{difference} in {low} {high}");
                }
            }
            // Of a linear function on a bilinear piece without weights the ends are at corners.
            let flat: Vec<DVec4> = (0..4).map(|_| vector(random).extend(1.0)).collect();
            let values = Piece::new([1, 1], flat.clone(), DVec3::ZERO, 1.0)
                .values(&Quadric::of_plane(function.linear));
            let corner = |index: usize| {
                let end = ends[if axis == Axis::U { index / 2 } else { index % 2 }];
                end - function.linear.dot(flat[index].xyz())
            };
            let corners = [0, 1, 2, 3].map(corner);
            let [low, high] = values.lag(axis, ends);
            let largest = corners.into_iter().fold(f64::NEG_INFINITY, upper_max);
            let least = corners.into_iter().fold(f64::INFINITY, lower_min);
            let error = values.error + gamma(16.0) * (ends[0].abs() + ends[1].abs() + values.size);
            assert!((high - (largest + error)).abs() < 1e-15 && (low - (least - error)).abs() < 1e-15);
            assert!(high > largest && low < least);
        }
    }
}

/// A piece of A about the foot in the middle of a patch, and the patch over it.
pub(super) fn with_over(b: &Surfaces, check: impl FnOnce(CellComparison<'_>)) {
    let frame = Frame::new(Chart::new(b.sheets(), 0, [0.4, 0.6])).unwrap();
    let a = through(|s, t| frame.jet.point + 0.05 * DVec3::new(s - 0.5, t - 0.4, 0.1 * s * t));
    let a = Piece::new([2, 2], a.to_vec(), frame.jet.point, 1.0);
    let (image, linear) = frame.image(&a).unwrap();
    check(CellComparison { frame, face: None, a, image, linear });
}

pub(super) fn curved() -> Surfaces {
    patch(through(|s, t| DVec3::new(s + 0.1 * s * t, t - 0.1 * s * s, 0.2 * s * t + 0.1 * s * s)))
}

/// Every term of lemma 3.17: the difference, the overhang, the turns of the function, also by its tilt, and
/// of the parameters, and the frame's skewness.
#[test]
fn the_bound_has_every_term_of_the_lemma() {
    with_over(&curved(), |mut over| {
        let (own_skew, mut placement) = (over.frame.skew, over.linear);
        for overhang in [[0.0; 2], [1e-3, 0.0], [0.0, 2e-3]] {
            for (bend, skew) in [(0.0, own_skew), (0.05, own_skew), (0.0, 1e-3), (0.05, 1e-3)] {
                over.frame.skew = skew;
                let (frame, a, image) = (&over.frame, &over.a, &over.image);
                let [first, second] = frame.tangents.map(DVec3::normalize);
                placement.overhang = overhang;
                placement.functions[0].form = DMat3::IDENTITY * bend;
                placement.functions[1].form = DMat3::IDENTITY * (2.0 * bend);
                let mut function =
                    Cubic::of(Quadric::of_plane(frame.normal + 0.01 * first + 0.02 * frame.normal));
                function.add_product(0.3, frame.normal, second);
                function.add_product(0.4, first, first);
                function.add_triple_product(0.5, frame.normal, first, second);
                let bound = over.bound_by(&placement, &of_cell(&function, a));
                let [low, high] = a.values_of_cubic(&function).range();
                let ranges = image.parts.iter().map(|part| part.piece.values_of_cubic(&function).range());
                let difference = ranges
                    .map(|[least, largest]| upper_max(largest - low, high - least))
                    .fold(0.0, upper_max);
                let radius = image.parts.iter().map(|part| part.piece.radius).fold(0.0, upper_max);
                let (r, n) = (a.radius + radius, frame.normal);
                let tilt = function.quadric.linear - n;
                let turn = tilt.length() + function.quadric.size() * r + function.size() * r * r;
                let of_normal = n.dot(tilt).abs()
                    + (function.quadric.form * n).length() * r
                    + function.size_along(n) * r * r;
                let lengths = frame.tangents.map(DVec3::length);
                let length = lengths[0] * overhang[0] + lengths[1] * overhang[1];
                let bending = 3.0_f64.sqrt() * bend * r * (lengths[0] + 2.0 * lengths[1]);
                let (nu, shrunk) = (frame.skew, 1.0 - of_normal);
                let height = (difference + (nu + turn) * length) / shrunk;
                let rest = 1.0 - bending - nu - (nu * (1.0 + bending) + turn * (bending + nu)) / shrunk;
                let expected = (height + length) / rest;
                assert!((bound / expected - 1.0).abs() < 1e-9, "{bound:e} {expected:e} {overhang:?} {bend}");
                assert!(bound > expected, "The rounding of the turns is left out.");
            }
        }
    });
}

/// Every term of the lemma on overhangs (3.18), for a cell of one point, and the rounding of its sum.
#[test]
fn an_overhang_has_every_term_of_the_lemma() {
    let random = &mut fastrand::Rng::with_seed(319);
    with_over(&curved(), |mut over| {
        let mut placement = over.linear;
        let of_b = over.reach() - over.a.radius;
        for case in 0..40 {
            let point = vector(random);
            over.a = Piece::new([1, 1], vec![point.extend(1.0); 4], DVec3::ZERO, 0.0);
            placement.functions = [0; 2].map(|_| quadric(random));
            placement.lag = [0; 2].map(|_| random.f64());
            placement.overhang = [0; 2].map(|_| random.f64());
            let frame = &over.frame;
            placement.feet = frame.chart.parameters.map(|at| [at - random.f64(), at + random.f64()]);
            over.linear.lag_of_b = [0; 2].map(|_| random.f64());
            let threshold = random.f64();
            let [axis, other] = if case % 2 == 0 { [0, 1] } else { [1, 0] };
            let (is_upwards, rate) = (case % 4 < 2, 0.5 + random.f64());
            let coefficients = [0; 5].map(|_| random.f64() - 0.5);
            let axes = [axis, other];
            let side = RimSide { axis: Axis::BOTH[axis], is_upwards, coefficients, rate, slope: 0.0 };
            let found = rim::overhang(&over, &placement, &side, threshold).highest();
            let [a, b, c, d, f] = coefficients;
            let [g_v, g_u] = axes.map(|axis| value(&Cubic::of(placement.functions[axis]), point));
            let [y_reach, x_reach] = axes.map(|axis| {
                let [low, high] = placement.feet[axis].map(|end| (end - frame.chart.parameters[axis]).abs());
                low.max(high)
            });
            let [y, x] = axes.map(|axis| frame.inverse[axis].dot(point));
            let height = if is_upwards { g_v } else { -g_v } - b * g_u - c * x * x - d * x * y - f * y * y;
            let [y_lag, x_lag] = axes.map(|axis| {
                let turn = placement.functions[axis].size() * (point.length() + of_b) * threshold;
                over.linear.lag_of_b[axis] + placement.overhang[axis] + turn
            });
            let [b, c, d, f] = [b, c, d, f].map(f64::abs);
            let lags = placement.lag[axis]
                + b * placement.lag[other]
                + c * x_lag * (2.0 * x_reach + x_lag)
                + d * (x_lag * y_reach + (x_reach + x_lag) * y_lag)
                + f * y_lag * (2.0 * y_reach + y_lag);
            let expected = (height - a + lags) / rate;
            assert!((found - expected).abs() < 1e-12, "{found} {expected} of case {case}");
            let of_sides = a.abs() + x_reach * (b + x_reach * c + y_reach * d) + y_reach * y_reach * f;
            let sizes = (of_sides + height.abs() + lags) / rate;
            let least = 0.75 * gamma(32.0) * sizes;
            assert!(found - expected > least, "{:e} {least:e} of case {case}", found - expected);
        }
    });
}

/// Steps along both axes must end in the rim's box: by the ends of the range of feet on the inner side of each side.
#[test]
fn steps_beyond_the_box_of_a_rim_are_refused() {
    for axis in 0..2 {
        for is_upwards in [true, false] {
            let side = |axis: usize| RimSide { is_upwards, ..flat_side(Axis::BOTH[axis]) };
            let rim = FaceRim { sides: vec![side(0), side(1)], parameters: [[0.0, 1.0]; 2] };
            let mut feet = [[0.5, 0.5]; 2];
            feet[axis] = if is_upwards { [0.25, 1.0] } else { [0.0, 0.75] };
            let stays = |length: f64| {
                let mut steps = [0.125; 2];
                steps[axis] = length;
                rim::stays_in_box(&rim, feet, steps)
            };
            assert!(stays(0.25) && !stays(0.2500001), "{axis} {is_upwards}");
            // Along one axis the side that it leads to is within the rim.
            let one = FaceRim { sides: vec![side(axis)], ..rim.clone() };
            let mut steps = [0.0; 2];
            steps[axis] = 0.5;
            assert!(rim::stays_in_box(&one, feet, steps), "{axis} {is_upwards}");
        }
    }
}

/// Where the function turns too far there is no bound.
#[test]
fn a_function_that_turns_too_far_bounds_nothing() {
    with_over(&curved(), |over| {
        let (frame, a, image) = (&over.frame, &over.a, &over.image);
        let first = frame.tangents[0].normalize();
        let bound = |share: f64, x: DVec3| {
            let mut function = Cubic::of(Quadric::of_plane(frame.normal));
            function.add_product(share, x, first);
            over.bound_by(&over.linear, &of_cell(&function, a))
        };
        let reach = a.radius + image.parts.iter().map(|part| part.piece.radius).fold(0.0, upper_max);
        assert!(bound(0.99 / reach, first).is_finite());
        assert!(bound(1.01 / reach, first).is_infinite());
        // |M n| is half the factor.
        assert!(bound(0.98 / reach, frame.normal).is_finite());
        assert!(bound(1.02 / reach, frame.normal).is_infinite());
    });
}

/// Fixed points are in the ranges found, by both kinds of functions: over the knot lines of closed surfaces with and
/// without weights, for points of all pieces.
#[test]
fn placements_contain_the_parameters_of_feet() {
    let random = &mut fastrand::Rng::with_seed(5);
    let (mut many, mut cases) = (0, 0);
    for case in 0..30 {
        let b = Surfaces::new(vec![closed(900 + case, case % 2 == 1)], Flatness::None);
        let flat = random.u32(0..b.places.count() as u32);
        let chart = Chart::new(b.sheets(), flat, [random.f64(), random.f64()]);
        let frame = Frame::new(chart).unwrap();
        let size = 0.2 + 0.4 * random.f64();
        let [s, t] = frame.tangents;
        let a = through(|x, y| frame.jet.point + size * ((x - 0.5) * s + (y - 0.5) * t));
        let a = Piece::new([2, 2], a.to_vec(), frame.jet.point, 10.0);
        let Some((image, linear)) = frame.image(&a) else { continue };
        many += usize::from(image.parts.len() > 1);
        for placement in [frame.closer_placement(&a, &image), linear] {
            for axis in 0..2 {
                // For each point y of B, y - β differs from g by the lag at most.
                for part in &image.parts {
                    for (index, sample) in part.piece.samples([POINTS_ALONG; 2]).into_iter().enumerate() {
                        let line = [index / POINTS_ALONG, index % POINTS_ALONG][axis] as f64 * 0.25;
                        let [start, end] = part.places[axis];
                        let y = (1.0 - line) * start + line * end;
                        let g = value(&Cubic::of(placement.functions[axis]), sample);
                        assert!((y - g).abs() <= placement.lag[axis], "{y} {g} {}", placement.lag[axis]);
                        cases += 1;
                        // And the foot of a point of A with the same g is in the range of feet.
                        let [low, high] = a.values(&placement.functions[axis]).range();
                        if (low..=high).contains(&g) {
                            let [first, last] = placement.feet[axis];
                            let at = frame.chart.parameters[axis] + y;
                            assert!((first - 1e-7..=last + 1e-7).contains(&at), "{at} {first} {last}");
                        }
                    }
                }
            }
        }
    }
    assert!(many > 10 && cases > 1000, "{many} {cases}");
}

/// What F is beyond an end of the box, for points of B there, is at most what an offset says, and as much for one of them
/// where the function is linear and the end is straight.
#[test]
fn offsets_contain_what_is_beyond_the_ends() {
    let random = &mut fastrand::Rng::with_seed(6);
    let (mut beyond, mut attained) = (0, 0);
    for case in 0..30 {
        let b = Surfaces::new(vec![closed(950 + case, case % 2 == 1)], Flatness::None);
        let flat = random.u32(0..b.places.count() as u32);
        let frame =
            Frame::new(Chart::new(b.sheets(), flat, [random.f64(), 0.8 * random.f64().round()])).unwrap();
        let [s, t] = frame.tangents;
        let a = through(|x, y| frame.jet.point + 0.3 * ((x - 0.5) * s + (y - 0.5) * t));
        let a = Piece::new([2, 2], a.to_vec(), frame.jet.point, 10.0);
        let Some((image, linear)) = frame.image(&a) else { continue };
        for placement in [frame.closer_placement(&a, &image), linear] {
            for axis in 0..2 {
                let g = Cubic::of(placement.functions[axis]);
                let [low, high] = a.values(&placement.functions[axis]).range();
                let offsets = placement.offsets[axis];
                // With the whole range of the function on the cell.
                let of_range = [offsets[0] - low, offsets[1] + high];
                for end in 0..2 {
                    assert!((placement.overhang_at_ends[axis][end] - of_range[end]).abs() < 1e-12);
                    let mut farthest = f64::NEG_INFINITY;
                    for curve in image.end(Axis::BOTH[axis], end) {
                        let counts = curve.degree.map(|degree| if degree == 0 { 1 } else { 9 });
                        for y in curve.samples(counts) {
                            for x in a.samples([POINTS_ALONG; 2]) {
                                let sign = [-1.0, 1.0][end];
                                let f = sign * (value(&g, x) - value(&g, y));
                                let offset = offsets[end] + sign * value(&g, x);
                                assert!(f <= offset, "{f} {offset} of {case}");
                                farthest = upper_max(farthest, f - offset);
                                beyond += usize::from(f > 0.0);
                            }
                        }
                    }
                    attained += usize::from(farthest > -1e-12);
                }
            }
        }
    }
    assert!(beyond > 1000 && attained > 3, "{beyond} {attained}");
}

/// Over a rim a bound counts only within what the threshold leaves, as the lags of linear functions hold for feet
/// within it.
#[test]
fn a_drift_counts_only_within_the_threshold() {
    const HEIGHT: f64 = 1e-3;
    with_over(&patch(through(|s, t| DVec3::new(s, t, 0.0))), |mut over| {
        let raised = through(|s, t| over.frame.jet.point + DVec3::new(0.1 * s, 0.1 * t, HEIGHT));
        over.a = Piece::new([2, 2], raised.to_vec(), over.frame.jet.point, 1.0);
        let (image, linear) = over.frame.image(&over.a).unwrap();
        (over.image, over.linear) = (image, linear);
        let bound = |drift: Option<f64>| over.upper_bound(&over.linear, drift, 1.25 * HEIGHT);
        assert!(bound(None).is_some_and(|bound| (HEIGHT..=HEIGHT * 1.01).contains(&bound)));
        assert!(bound(Some(0.2 * HEIGHT)).is_some_and(|bound| bound >= 1.2 * HEIGHT));
        assert!(bound(Some(0.3 * HEIGHT)).is_none());
    });
}

/// Jumps of points count in the overhang and in the ranges of feet, by the function's slope.
#[test]
fn gaps_widen_a_placement() {
    with_over(&curved(), |over| {
        let CellComparison { frame, a, mut image, linear, .. } = over;
        let a = &a;
        let closer = frame.closer_placement(a, &image);
        image.gap = 1e-3;
        let radius = image.parts.iter().map(|part| part.piece.radius).fold(0.0, upper_max);
        for before in [linear, closer] {
            let after = frame.placement(a, &image, before.functions);
            for axis in 0..2 {
                let function = &before.functions[axis];
                let step = 1e-3 * (function.linear.length() + 2.0 * function.size() * radius);
                let close = |found: f64, expected: f64| {
                    assert!((found - expected).abs() < 1e-12, "{found} {expected}")
                };
                close(after.overhang[axis], before.overhang[axis] + step);
                close(after.lag[axis], before.lag[axis] + step);
                close(after.feet[axis][0], before.feet[axis][0] - step);
                close(after.feet[axis][1], before.feet[axis][1] + step);
            }
        }
    });
}

/// A fit is the height less functions of the terms: what is left at the points is its spread, and it vanishes on
/// a surface of third order.
#[test]
fn a_fit_of_third_order_vanishes_on_such_a_surface() {
    let b = curved();
    let frame = Frame::new(Chart::new(b.sheets(), 0, [0.4, 0.6])).unwrap();
    let [x, y] = [frame.tangents[0].normalize(), frame.normal.cross(frame.tangents[0].normalize())];
    let height = |u: f64, v: f64| 0.3 * u * u - 0.2 * u * v + 0.5 * u * v * v - 0.4 * v.powi(3);
    let samples: Vec<DVec3> = (0..25)
        .map(|index| [index / 5, index % 5].map(|line| 0.1 * (line as f64 - 2.0)))
        .map(|[u, v]| u * x + v * y + height(u, v) * frame.normal)
        .collect();
    let mut fit = Fit::new(frame.normal, frame.tangents[0], &samples).unwrap();
    let mut spreads = Vec::new();
    for terms in ORDERS {
        fit.add(terms, 1e-14);
        let function = fit.function();
        let values: Vec<f64> = samples.iter().map(|sample| value(&function, *sample)).collect();
        let largest = values.iter().copied().fold(f64::NEG_INFINITY, upper_max);
        let least = values.iter().copied().fold(f64::INFINITY, lower_min);
        assert!((0.5 * (largest - least) - fit.spread()).abs() < 1e-14);
        spreads.push(fit.spread());
    }
    assert!(spreads[0] > 1e-4 && spreads[2] < 1e-13, "{spreads:?}");
}
