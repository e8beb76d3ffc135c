//! Allowances of the lemmas that are as small as rounding, or that need several patches of B.

use super::super::faces::FaceOver;
use super::over_faces::{cut_all, face, flat_side, plane, plate};
use super::terms::{curved, with_over};
use super::*;
use crate::axis::Axis;
use crate::bezier::extract;
use crate::certified::faces::{FaceChart, FaceRim};
use crate::certified::rounding::UNIT_ROUNDOFF;
use crate::certified::testing::{Surfaces, clamped, closed, patch, through};
use crate::flatness::Flatness;
use crate::model::trim::RimSide;
use crate::model::{Model, SurfaceArrays};
use glam::DMat3;

fn assert_close(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found:e} {expected:e}");
}

/// ν is the norm of I − T P − n nᵀ, both tangents' parts along n and 64 roundings of the terms of such a product.
#[test]
fn skewness_is_that_of_the_frame() {
    let random = &mut fastrand::Rng::with_seed(3171);
    let (mut off, mut along) = (0, [0; 2]);
    for _ in 0..20 {
        let mut vector = || DVec3::from_array([0; 3].map(|_| random.f64() - 0.5));
        let (p, q) = (vector(), 10.0 * vector());
        let b = patch(through(|s, t| s * p + t * q + 0.1 * s * t * p.cross(q)));
        let frame = Frame::new(Chart::new(b.sheets(), 0, [0.3, 0.7])).unwrap();
        let n = frame.normal;
        let columns = |x: DVec3, y: DVec3| DMat3::from_cols(x * y.x, x * y.y, x * y.z);
        let rest = DMat3::IDENTITY
            - 0.5 * (columns(n, n) + columns(n, n).transpose())
            - columns(frame.tangents[0], frame.inverse[0])
            - columns(frame.tangents[1], frame.inverse[1]);
        let norm = (0..9).map(|index| rest.col(index / 3)[index % 3].powi(2)).sum::<f64>().sqrt();
        let parts = frame.tangents.map(|tangent| n.dot(tangent).abs() / tangent.length());
        let sizes = 1.0
            + frame.tangents[0].length() * frame.inverse[0].length()
            + frame.tangents[1].length() * frame.inverse[1].length();
        assert_close(frame.skew, norm + parts[0] + parts[1] + gamma(64.0 * sizes), 2e-5);
        off += usize::from(norm > 1e-4 * frame.skew);
        along = [0, 1].map(|axis| along[axis] + usize::from(parts[axis] > 1e-4 * frame.skew));
    }
    assert!(off > 5 && along[0] > 5 && along[1] > 5, "{off} {along:?}");
}

/// The rounding of the lines of B's patches is added to the lag of B at both of its ends.
#[test]
fn the_rounding_of_lines_widens_a_placement() {
    const ERRORS: [f64; 2] = [5e-4, 1e-3];
    with_over(&curved(), |over| {
        let CellComparison { frame, a, mut image, linear, .. } = over;
        for before in [linear, frame.closer_placement(&a, &image)] {
            image.parts[0].errors = ERRORS;
            let after = frame.placement(&a, &image, before.functions);
            image.parts[0].errors = [0.0; 2];
            for (axis, error) in ERRORS.into_iter().enumerate() {
                for end in 0..2 {
                    assert_close(after.offsets[axis][end] - before.offsets[axis][end], error, 1e-9);
                    let sign = [-1.0, 1.0][end];
                    assert_close(after.feet[axis][end] - before.feet[axis][end], sign * error, 1e-9);
                }
                assert_close(after.lag_of_b[axis] - before.lag_of_b[axis], error, 1e-9);
            }
        }
    });
}

/// The error of a part of B is that of the lines on both of its sides.
#[test]
fn the_rounding_of_a_part_is_that_of_both_lines() {
    let b = Surfaces::new(vec![closed(900, false)], Flatness::None);
    for flat in 0..b.places.count() as u32 {
        let frame = Frame::new(Chart::new(b.sheets(), flat, [0.5; 2])).unwrap();
        let (image, _) = over_several(&frame);
        let chart = &frame.chart;
        for part in &image.parts {
            for axis in Axis::BOTH {
                let index = axis.index();
                let middle = chart.parameters[index] + 0.5 * (part.places[index][0] + part.places[index][1]);
                let start = |line: isize| chart.parameter(axis, line, 0.0);
                let line = (-8..8).find(|&line| start(line) <= middle && middle < start(line + 1)).unwrap();
                let error = [line, line + 1]
                    .map(|line| if line == 0 || line == 1 { 0.0 } else { chart.line_error(axis, line) });
                assert_eq!(part.errors[index], error[0] + error[1]);
            }
        }
    }
}

/// The image of a piece that is large against B's patches, with the piece.
fn over_several(frame: &Frame<'_>) -> (Image, Piece) {
    let [s, t] = frame.tangents;
    let a = through(|x, y| frame.jet.point + 1.1 * ((x - 0.5) * s + (y - 0.5) * t));
    let a = Piece::new([2, 2], a.to_vec(), frame.jet.point, 10.0);
    let (image, _) = frame.image(&a).unwrap();
    assert!(image.parts.len() > 2, "{}", image.parts.len());
    (image, a)
}

/// A box within B is left by the rounding of places alone: γ₃₂ of 1 and of the distances of both ends.
#[test]
fn the_rounding_of_places_widens_a_placement() {
    with_over(&curved(), |over| {
        let CellComparison { frame, a, image, linear, .. } = over;
        for placement in [linear, frame.closer_placement(&a, &image)] {
            for axis in 0..2 {
                let [start, end] = image.ends[axis];
                let margin = gamma(32.0) * (1.0 + (end - start));
                assert!(placement.overhang_at_ends[axis].iter().all(|beyond| *beyond < 0.0));
                assert_close(placement.overhang[axis], margin, 1e-9);
                assert_close(placement.lag[axis] - placement.lag_of_b[axis], margin, 0.1);
                let [low, high] = a.values(&placement.functions[axis]).range();
                let [first, last] = placement.offsets[axis];
                assert_close(start + low - first - placement.feet[axis][0], margin, 0.2);
                assert_close(placement.feet[axis][1] - (end + high + last), margin, 0.2);
            }
        }
    });
}

/// Of several pieces of B the one farthest from the foot counts, whichever it is.
#[test]
fn the_largest_radius_of_several_pieces_counts() {
    const RADIUS: f64 = 8.0;
    const GAP: f64 = 1e-3;
    let b = Surfaces::new(vec![closed(900, false)], Flatness::None);
    let frame = Frame::new(Chart::new(b.sheets(), 0, [0.5; 2])).unwrap();
    let (mut image, a) = over_several(&frame);
    let functions = frame.closer_placement(&a, &image).functions;
    image.gap = GAP;
    let linear = frame.placement(&a, &image, frame.inverse.map(Quadric::of_plane));
    let own = a.radius;
    let mut over = CellComparison { frame, face: None, a, image, linear };
    for farthest in 0..over.image.parts.len() {
        for (index, part) in over.image.parts.iter_mut().enumerate() {
            part.piece.radius = if index == farthest { RADIUS } else { 1.0 };
        }
        assert_close(over.reach(), RADIUS + own, 1e-12);
        let placement = over.frame.placement(&over.a, &over.image, functions);
        for (axis, function) in functions.iter().enumerate() {
            let slope = function.linear.length() + 2.0 * function.size() * RADIUS;
            let [first, last] = placement.overhang_at_ends[axis];
            assert_close(placement.overhang[axis] - first.max(last).max(0.0), slope * GAP, 1e-9);
        }
    }
}

/// A plane of two patches along x, with lengths along x and a gap between them, or the same along y.
fn two_patches(lengths: [f64; 2], gap: f64, transposed: bool) -> Surfaces {
    let [first, second] = lengths;
    let places = [[0.0, 0.0], [first, 0.0], [first, gap], [first + second, gap]];
    let rows: Vec<[[f64; 4]; 2]> = places.map(|[x, z]| [0.0, 1.0].map(|y| [x, y, z, 1.0])).to_vec();
    let columns = || [0, 1].map(|side| rows.iter().map(|row| row[side]).collect::<Vec<_>>()).concat();
    let swapped = || columns().into_iter().map(|[x, y, z, w]| [y, x, z, w]).collect();
    let (degree, knots) = ([1, 1], [clamped(1, &[0.5, 0.5]), clamped(1, &[])]);
    let arrays = if transposed {
        let [along, across] = knots;
        SurfaceArrays { degree, counts: [2, 4], knots: [across, along], control_points: swapped() }
    } else {
        SurfaceArrays { degree, counts: [4, 2], knots, control_points: rows.concat() }
    };
    Surfaces::new(vec![arrays], Flatness::None)
}

/// A drift is as fast as the fastest patch that its box touches, on either side, and has the gaps between them; a
/// box that leaves the surface has none.
#[test]
fn a_drift_has_the_speed_and_the_gap_of_every_patch() {
    const GAP: f64 = 2e-10;
    const STEPS: [f64; 2] = [1e-6, 3e-6];
    for transposed in [false, true] {
        for lengths in [[0.5, 2.0], [2.0, 0.5]] {
            for own in 0..2 {
                let b = two_patches(lengths, GAP, transposed);
                let frame = Frame::new(Chart::new(b.sheets(), own as u32, [0.5; 2])).unwrap();
                let middle = frame.jet.point;
                let a = through(|s, t| middle + 5.0 * DVec3::new(s - 0.5, t - 0.5, 0.0));
                let a = Piece::new([2, 2], a.to_vec(), middle, 1.0);
                let (image, _) = frame.image(&a).unwrap();
                let drift = |along: [f64; 2], across: [f64; 2]| {
                    let (parameters, steps) = if transposed {
                        ([across, along], [STEPS[1], STEPS[0]])
                    } else {
                        ([along, across], STEPS)
                    };
                    frame.drift(&image, parameters, steps)
                };
                // From the chart's patch towards the other one.
                let towards = |end: f64| if own == 0 { [0.25, end] } else { [1.0 - end, 0.75] };
                let within = [0.25, 0.75];
                let alone = STEPS[0] * lengths[own] + STEPS[1];
                assert_close(drift(towards(0.75), within).unwrap(), alone, 1e-7);
                let both = STEPS[0] * 2.0 + STEPS[1] + GAP;
                assert_close(drift(towards(1.25), within).unwrap(), both, 1e-7);
                // The ends of the box are rounded by γ₃₂ (1 + ½), which is 48 roundings; the line is 40 roundings away.
                let at_line = towards(1.0 - 40.0 * UNIT_ROUNDOFF);
                assert_close(drift(at_line, within).unwrap(), both, 1e-7);
                assert!(drift(towards(2.001), within).is_none() && drift(towards(2.0), within).is_some());
                assert!(drift(towards(-0.001), within).is_some());
                let beyond = if own == 0 { [-0.001, 0.75] } else { [0.25, 1.001] };
                assert!(drift(beyond, within).is_none());
                assert!(drift(within, [-0.001, 0.75]).is_none() && drift(within, [0.25, 1.001]).is_none());
            }
        }
    }
}

/// The error of a face's points is that of its surface, and is added to the bound.
#[test]
fn the_error_of_a_faces_points_is_added() {
    const HEIGHT: f64 = 1e-3;
    let plate = plate();
    let face = || plate.faces.chart(&Chart::new(plate.pieces.sheets(), 0, [0.5; 2])).unwrap();
    let error = extract(&Model::from_arrays(None, vec![plane()]).unwrap()).point_error.after(0);
    assert!(error > 0.0);
    assert_eq!(face().point_error, error);
    for error in [0.0, 0.25] {
        let mut face = face();
        face.point_error = error;
        let frame = Frame::new(face.chart).unwrap();
        let raised = through(|s, t| frame.jet.point + DVec3::new(HEIGHT * s, HEIGHT * t, HEIGHT));
        let a = Piece::new([2, 2], raised.to_vec(), frame.jet.point, 1.0);
        let (image, linear) = frame.image(&a).unwrap();
        let cell = CellComparison { frame, face: Some(face), a, image, linear };
        let bound = FaceOver::new(cell, 1.0).upper_bound(1.0).unwrap();
        assert_close(bound, HEIGHT + error, 1e-9);
    }
}

/// Δ is that of all pieces of B, in whatever order they are.
#[test]
fn every_piece_counts_in_the_difference() {
    let b = Surfaces::new(vec![closed(900, false)], Flatness::None);
    let frame = Frame::new(Chart::new(b.sheets(), 0, [0.5; 2])).unwrap();
    let (image, a) = over_several(&frame);
    let linear = frame.placement(&a, &image, frame.inverse.map(Quadric::of_plane));
    let mut over = CellComparison { frame, face: None, a, image, linear };
    let plane = Cubic::of(Quadric::of_plane(over.frame.normal));
    let first = over.bound_by(&over.linear, &of_cell(&plane, &over.a));
    assert!(first.is_finite());
    for _ in 0..over.image.parts.len() {
        over.image.parts.rotate_left(1);
        assert_close(over.bound_by(&over.linear, &of_cell(&plane, &over.a)), first, 1e-12);
    }
}

/// The lag of B has 16 roundings of each of its terms: both parameters and the function.
#[test]
fn a_lag_has_the_rounding_of_every_term() {
    for (ends, size) in [([8.0, 0.0], 0.0), ([0.0, 8.0], 0.0), ([0.0, 0.0], 8.0)] {
        for axis in Axis::BOTH {
            let values = Values { degree: [1, 1], coefficients: vec![(0.0, 1.0); 4], size, error: 0.0 };
            assert_close(values.lag(axis, ends)[0], -8.0 * gamma(16.0), 1e-9);
        }
    }
}

/// An overhang has 32 roundings of each of its terms: the side's five, and the function's on the cell.
#[test]
fn an_overhang_has_the_rounding_of_every_term() {
    const REACH: f64 = 0.5;
    with_over(&curved(), |mut over| {
        let mut placement = over.linear;
        let at = over.frame.chart.parameters;
        placement.feet = at.map(|at| [at - REACH, at + REACH]);
        [placement.lag, placement.overhang, over.linear.lag_of_b] = [[0.0; 2]; 3];
        for (x, coefficients, sizes) in [
            (0.0, [1.0, 0.0, 0.0, 0.0, 0.0], 1.0),
            (0.0, [0.0, 8.0, 0.0, 0.0, 0.0], 8.0 * REACH),
            (0.0, [0.0, 0.0, 8.0, 0.0, 0.0], 8.0 * REACH * REACH),
            (0.0, [0.0, 0.0, 0.0, 8.0, 0.0], 8.0 * REACH * REACH),
            (0.0, [0.0, 0.0, 0.0, 0.0, 8.0], 8.0 * REACH * REACH),
            (8.0, [0.0; 5], 8.0),
        ] {
            over.a = Piece::new([1, 1], vec![(x * DVec3::X).extend(1.0); 4], DVec3::ZERO, 0.0);
            over.frame.inverse = [if x > 0.0 { DVec3::X } else { DVec3::ZERO }; 2];
            placement.functions = over.frame.inverse.map(Quadric::of_plane);
            let side = RimSide { axis: Axis::V, is_upwards: true, coefficients, rate: 1.0, slope: 0.0 };
            let constant = rim::overhang(&over, &placement, &side, 1.0).constant;
            assert_close(constant + coefficients[0], gamma(32.0) * sizes, 0.1);
        }
    });
}

/// Overhangs of two sides are larger by 128 roundings before the steps are made of them.
#[test]
fn steps_along_both_axes_have_their_rounding() {
    let side = |axis: Axis, slope: f64| RimSide { slope, ..flat_side(axis) };
    let ([s, t], [x, y]) = ([3.0, 0.25], [1.0, 2.0]);
    let [along_u, along_v] = rim::steps(&[side(Axis::U, s), side(Axis::V, t)], &[x, y]);
    let rounding = gamma(128.0) * (1.0 + s) * (1.0 + t) * (x + y);
    assert_close(along_u * (1.0 - s * t) - (x + s * y), (1.0 + s) * rounding, 0.05);
    assert_close(along_v * (1.0 - s * t) - (y + t * x), (1.0 + t) * rounding, 0.05);
}

/// Points that are within a side count as on it: no step is made shorter by that.
#[test]
fn a_point_within_a_side_is_no_negative_overhang() {
    with_over(&curved(), |over| {
        let side = |axis: Axis| RimSide { slope: 0.5, ..flat_side(axis) };
        let rim = FaceRim { sides: Axis::BOTH.map(side).to_vec(), parameters: [[0.3, 0.7]; 2] };
        let mut placement = over.linear;
        placement.feet = [[0.45, 0.55]; 2];
        let drift = |overhangs: [f64; 2]| rim::drift(&over, &placement, &rim, &overhangs, 1.0).unwrap();
        let on_it = drift([1e-3, 0.0]);
        assert_eq!(drift([1e-3, -1e-3]), on_it);
        assert_eq!(drift([1e-3, -1.0]), on_it);
        assert_eq!(drift([-1e-3, 1e-3]), drift([0.0, 1e-3]));
    });
}

/// A conic of the face's parameters is one of the chart's, by the widths of the chart's patch.
#[test]
fn a_rim_is_in_the_parameters_of_the_chart() {
    // A parabola, and an ellipse.
    for weight in [1.0, 0.9] {
        rim_of_a_top(weight);
    }
}

/// Of a face with one side that is no line, with the middle weight of that.
fn rim_of_a_top(weight: f64) {
    let value = |u: f64| 0.5 + 0.1 * u + 0.2 * u * u;
    let slope = |u: f64| 0.1 + 0.4 * u;
    let [us, vs] = [[-1.0, -0.5, 1.0], [-1.0, 0.2, 1.0]];
    let surface = SurfaceArrays {
        degree: [1, 1],
        knots: [us, vs].map(|[low, line, high]| vec![low, low, line, high, high]),
        counts: [3, 3],
        control_points: us.map(|x| vs.map(|y| [x, y, 0.0, 1.0])).concat(),
    };
    let left = [-0.6, value(-0.6)];
    let right = [0.6, value(0.6)];
    let mut arrays = face(surface, &[&[[-0.6, -0.6], [0.6, -0.6], right, left]]);
    let top = &mut arrays.trim.as_mut().unwrap()[0][2];
    top.degree = 2;
    top.knots = vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
    top.control_points.insert(1, [0.0, right[1] - 0.6 * slope(0.6), weight]);
    let controls = top.control_points.clone();
    let b = cut_all(vec![arrays]);
    let of = |flat: u32| b.faces.chart(&Chart::new(b.pieces.sheets(), flat, [0.5; 2])).unwrap();
    let is_in_patch = |face: &FaceChart<'_>| {
        let [u, v] = face.chart.surface_parameters();
        u > us[1] && v > vs[1]
    };
    let mut face = (0..b.pieces.places.count() as u32).map(of).find(is_in_patch).unwrap();
    // The patch is 1.5 by 0.8 long.
    let [u, v] = [0.1, 0.45];
    let at = [(u - us[1]) / 1.5, (v - vs[1]) / 0.8];
    face.chart = face.chart.moved([0, 0], at);
    let box_ = [[0.3, 0.5], [0.25, 0.45]];
    let rim = face.rims(box_).into_iter().find(|rim| rim.sides.len() == 1).unwrap();
    let side = rim.sides[0];
    assert!(side.axis == Axis::V && side.is_upwards);
    // Points of the loop are on the conic.
    let mut on_it = 0;
    for step in 0..=100 {
        let t = f64::from(step) / 100.0;
        let shares = [(1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t) * weight, t * t];
        let sum = |axis: usize| (0..3).map(|k| shares[k] * controls[k][axis]).sum::<f64>();
        let [u, v] = [0, 1].map(|axis| sum(axis) / shares.iter().sum::<f64>());
        let [u, v] = [(u - us[1]) / 1.5, (v - vs[1]) / 0.8];
        if (0..2).all(|axis| (rim.parameters[axis][0]..=rim.parameters[axis][1]).contains(&[u, v][axis])) {
            let ([x, y], [a, b, c, d, f]) = ([u - at[0], v - at[1]], side.coefficients);
            let excess = y - a - x * (b + c * x + d * y) - f * y * y;
            assert!(excess.abs() < 1e-9, "{excess:e} at {t} of {weight}");
            on_it += 1;
        }
    }
    assert!(on_it > 10, "{on_it}");
    if weight == 1.0 {
        let expected = [(value(u) - v) / 0.8, slope(u) * 1.5 / 0.8, 0.2 * 1.5 * 1.5 / 0.8, 0.0, 0.0];
        for (found, expected) in side.coefficients.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{found:e} {expected:e}");
        }
        assert_close(side.slope * side.rate, expected[1] + 2.0 * expected[2] * (0.5 - at[0]), 1e-6);
    }
    for (found, expected) in rim.parameters[0].into_iter().zip(box_[0]) {
        assert_close(found, expected, 1e-6);
    }
    assert!(rim.parameters[1][0] < box_[1][0]);
    assert_close(rim.parameters[1][1], box_[1][1], 1e-6);
}
