//! Surfaces on which the bounds over seams are attained or nearly so: a
//! remainder or a jump that is less than its lemma states is found out.

use super::{CellContext, DifferenceOverKnotLines, Taylor, TaylorAcrossSeams, UpperBound, least};
use crate::certified::nearest::{Foot, NearestPoint};
use crate::certified::sheets::{Chart, Over};
use crate::certified::testing::{Surfaces, clamped, closed};
use crate::certified::{Cell, Pair};
use crate::flatness::Flatness;
use crate::model::{RigidTransform, SurfaceArrays};
use glam::DVec3;

/// The bound of a cell of A's first patch with the foot on a patch of B.
fn evaluate(
    bound: &dyn UpperBound,
    a: &Surfaces,
    b: &Surfaces,
    cell: Cell,
    patch: u32,
    threshold: f64,
) -> Option<f64> {
    let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
    let nearest = NearestPoint::new(pair.b);
    let mut context = CellContext::new(&pair, &nearest, cell, &Foot::start(patch, [0.5; 2]));
    bound.evaluate(&mut context, threshold)
}

/// The least of Taylor's bounds in one patch and over its seams, with the foot on B's first patch.
fn over_seams(a: &Surfaces, b: &Surfaces, threshold: f64) -> f64 {
    let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
    let nearest = NearestPoint::new(pair.b);
    let mut context = CellContext::new(&pair, &nearest, Cell::whole(0), &Foot::start(0, [0.5; 2]));
    least(&[&Taylor, &TaylorAcrossSeams], &mut context, threshold).upper
}

/// The Bernstein or B-spline coefficients of a cubic of parameter x over knots, from its
/// blossom: of x, and of `(x - k)_+^power` for a knot k of multiplicity `4 - power`.
fn coefficients(knots: &[f64], k: f64, power: usize) -> Vec<[f64; 2]> {
    knots[1..knots.len() - 1]
        .windows(3)
        .map(|t| {
            let [x, y, z] = [t[0] - k, t[1] - k, t[2] - k];
            let blossom = match power {
                2 => (x * y + y * z + z * x) / 3.0,
                _ => x * y * z,
            };
            [(t[0] + t[1] + t[2]) / 3.0, if t[0] >= k { blossom } else { 0.0 }]
        })
        .collect()
}

/// The graph `height + factor (s - k)_+^power` over the unit square, with the
/// roles of s and t exchanged where `axis` is 1.
fn ramp(axis: usize, height: f64, factor: f64, k: f64, power: usize) -> SurfaceArrays {
    let knots = clamped(3, &vec![k; 4 - power]);
    let values = coefficients(&knots, k, power);
    let point = |[along, rise]: [f64; 2], across: f64| {
        let place = if axis == 0 { [along, across] } else { [across, along] };
        [place[0], place[1], height + factor * rise, 1.0]
    };
    let count = values.len();
    let flat = clamped(1, &[]);
    let (degree, counts, knots, control_points) = if axis == 0 {
        let points = values.iter().flat_map(|&value| [0.0, 1.0].map(|across| point(value, across)));
        ([3, 1], [count, 2], [knots, flat], points.collect())
    } else {
        let points = [0.0, 1.0]
            .into_iter()
            .flat_map(|across| values.iter().map(move |&value| point(value, across)).collect::<Vec<_>>());
        ([1, 3], [2, count], [flat, knots], points.collect())
    };
    SurfaceArrays { degree, knots, counts, control_points }
}

/// The unit square at height 0, or a part of it.
fn square(s: [f64; 2], t: [f64; 2]) -> SurfaceArrays {
    let points = s.map(|x| t.map(|y| [x, y, 0.0, 1.0]));
    SurfaceArrays {
        degree: [1, 1],
        knots: [clamped(1, &[]), clamped(1, &[])],
        counts: [2, 2],
        control_points: points.concat(),
    }
}

/// Asserts that a bound is neither below a distance nor above it by more than a part.
#[track_caller]
fn assert_attained(bound: f64, distance: f64, excess: f64) {
    // The slope moves the foot a little and takes less than that off the distance.
    assert!(bound >= distance * (1.0 - 1e-6), "{bound} is below {distance}");
    assert!(bound <= distance * (1.0 + excess), "{bound} is far above {distance}");
}

/// From a foot at the seam the surface rises by the jump of the third or the second
/// derivative alone, and it is all that the expansion of the patch before it leaves.
#[test]
fn jumps_beyond_a_seam_are_attained() {
    const HEIGHT: f64 = 1e-6;
    const FACTOR: f64 = 1e-4;
    for axis in [0, 1] {
        for power in [2, 3] {
            let b = Surfaces::new(vec![ramp(axis, HEIGHT, FACTOR, 0.5, power)], Flatness::None);
            let a = Surfaces::new(vec![square([0.0, 1.0], [0.0, 1.0])], Flatness::None);
            let truth = HEIGHT + FACTOR * 0.5_f64.powi(power as i32);
            for threshold in [truth * 1.01, truth * 0.99, 2.0 * HEIGHT] {
                let bound = over_seams(&a, &b, threshold);
                assert_attained(bound, truth, 1e-5);
            }
        }
    }
}

/// The same with the foot a fifth of the way before the seam: of the remainder
/// `ω ℓ` counts for a second derivative, and all of ℓ for a third.
#[test]
fn jumps_at_a_distance_are_bounded_by_the_reach_beyond() {
    const FACTOR: f64 = 1e-4;
    let a = Surfaces::new(vec![square([0.0, 0.8], [0.0, 1.0])], Flatness::None);
    for (power, excess) in [(2, 1e-3), (3, 1.5)] {
        let b = Surfaces::new(vec![ramp(0, 1e-7, FACTOR, 0.5, power)], Flatness::None);
        let truth = 1e-7 + FACTOR * 0.3_f64.powi(power as i32);
        let bound = over_seams(&a, &b, truth);
        assert_attained(bound, truth, excess);
    }
}

/// Cut along the knots of B, the difference is that of its coefficients.
#[test]
fn the_difference_over_knots_is_attained() {
    for axis in [0, 1] {
        for power in [2, 3] {
            let b = Surfaces::new(vec![ramp(axis, 1e-5, 1e-4, 0.3, power)], Flatness::None);
            let a = Surfaces::new(vec![square([0.0, 1.0], [0.0, 1.0])], Flatness::None);
            let truth = 1e-5 + 1e-4 * 0.7_f64.powi(power as i32);
            let bound = evaluate(&DifferenceOverKnotLines, &a, &b, Cell::whole(0), 1, truth * 1.001);
            assert_attained(bound.unwrap(), truth, 1e-5);
            let below = evaluate(&DifferenceOverKnotLines, &a, &b, Cell::whole(0), 1, truth * 0.999);
            assert!(below.is_none_or(|bound| bound >= truth * (1.0 - 1e-6)), "{below:?}");
        }
    }
}

/// The bound is that of the farthest piece, wherever it is among the pieces: a bilinear patch that
/// rises at one corner, over a plane with two inner knots along each axis.
#[test]
fn the_farthest_of_all_pieces_is_bounded() {
    let places = [0.0, 0.3, 0.6, 1.0];
    let plane = SurfaceArrays {
        degree: [1, 1],
        knots: [clamped(1, &places[1..3]), clamped(1, &places[1..3])],
        counts: [4, 4],
        control_points: places.iter().flat_map(|&x| places.map(|y| [x, y, 0.0, 1.0])).collect(),
    };
    let b = Surfaces::new(vec![plane], Flatness::None);
    for corner in 0..4 {
        let mut patch = square([0.0, 1.0], [0.0, 1.0]);
        for (index, point) in patch.control_points.iter_mut().enumerate() {
            point[2] = if index == corner { 1e-4 } else { 1e-5 };
        }
        let a = Surfaces::new(vec![patch], Flatness::None);
        let bound = evaluate(&DifferenceOverKnotLines, &a, &b, Cell::whole(0), 4, 1.001e-4);
        assert_attained(bound.unwrap(), 1e-4, 1e-5);
    }
}

/// Where one surface of B ends, the rest of the cell is mapped to the next one.
#[test]
fn the_difference_runs_over_several_surfaces() {
    let raised = |mut surface: SurfaceArrays, height: f64| {
        surface.control_points.iter_mut().for_each(|point| point[2] = height);
        surface
    };
    let squares = [
        raised(square([-0.5, 0.4], [-0.5, 0.7]), 1e-3),
        raised(square([0.4, 1.5], [-0.5, 0.7]), 2e-3),
        raised(square([-0.5, 1.5], [0.7, 1.5]), 3e-3),
    ];
    let a = Surfaces::new(vec![square([0.0, 1.0], [0.0, 1.0])], Flatness::None);
    let b = Surfaces::new(squares.to_vec(), Flatness::None);
    let bound = evaluate(&DifferenceOverKnotLines, &a, &b, Cell::whole(0), 1, 4e-3);
    assert_attained(bound.unwrap(), 3e-3, 1e-5);
    // Without the last surface a part of A is far from B.
    let b = Surfaces::new(squares[..2].to_vec(), Flatness::None);
    assert_eq!(evaluate(&DifferenceOverKnotLines, &a, &b, Cell::whole(0), 1, 4e-3), None);
}

/// The surface is within the lemma's bound of the expansion at any point, also
/// across the closing seam, over seams of C² and of C¹, polynomial and rational.
#[test]
fn the_remainder_holds_over_seams() {
    let random = &mut fastrand::Rng::with_seed(7);
    let mut crossed = 0;
    for rational in [false, true] {
        let mut arrays = closed(100, rational);
        for multiplicity in [1, 2] {
            if multiplicity == 2 {
                // A double knot along v, with one more row of control points.
                arrays.knots[1].insert(5, 0.25);
                arrays.counts[1] += 1;
                let columns = arrays.counts[1];
                for row in (0..arrays.counts[0]).rev() {
                    let copy = arrays.control_points[row * (columns - 1) + 2];
                    let next = arrays.control_points[row * (columns - 1) + 3];
                    let middle = [0, 1, 2, 3].map(|k| 0.4 * copy[k] + 0.6 * next[k]);
                    arrays.control_points.insert(row * (columns - 1) + 3, middle);
                }
            }
            let b = Surfaces::new(vec![arrays.clone()], Flatness::Loose);
            for _ in 0..4000 {
                let flat = random.u32(0..b.places.count() as u32);
                let chart = Chart::new(b.sheets(), flat, [random.f64(), random.f64()]);
                let extent = [random.f64() * 2.0, random.f64() * 2.0];
                let reach = chart.reach(extent);
                let limited = [0, 1].map(|axis| {
                    let [low, high] = reach.domain[axis];
                    let at = chart.parameters[axis];
                    extent[axis].min(at - low).min(high - at).max(0.0)
                });
                let bound = chart.remainder(
                    &reach,
                    limited,
                    [Over::Patches, Over::Parts, Over::Boxes][random.usize(0..3)],
                );
                let step = [0, 1].map(|axis| limited[axis] * (2.0 * random.f64() - 1.0));
                let jet = chart.jet();
                let [h, k] = step;
                let expansion = jet.point
                    + h * jet.s
                    + k * jet.t
                    + 0.5 * h * h * jet.ss
                    + h * k * jet.st
                    + 0.5 * k * k * jet.tt;
                let to = [0, 1].map(|axis| chart.parameters[axis] + step[axis]);
                crossed += usize::from(to.iter().any(|parameter| !(0.0..=1.0).contains(parameter)));
                let error = point(&chart, to).distance(expansion);
                assert!(error <= bound + 1e-12, "{error} exceeds {bound}: {:?}, {step:?}", chart.parameters);
            }
        }
    }
    assert!(crossed > 4000, "{crossed} steps crossed a seam");
}

/// The point of a chart's surface at parameters of any patch.
fn point(chart: &Chart<'_>, parameters: [f64; 2]) -> DVec3 {
    use crate::axis::Axis;
    let located = Axis::BOTH.map(|axis| {
        let parameter = parameters[axis.index()];
        let mut offset = 0;
        while parameter < chart.line(axis, offset) {
            offset -= 1;
        }
        while parameter > chart.line(axis, offset + 1) {
            offset += 1;
        }
        (offset, ((parameter - chart.line(axis, offset)) / chart.width(axis, offset)).clamp(0.0, 1.0))
    });
    let [(row, s), (column, t)] = located;
    chart.neighbour([row, column]).point([s, t])
}
