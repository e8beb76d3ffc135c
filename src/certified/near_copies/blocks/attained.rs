//! Blocks of patches whose bounds are attained or nearly so, and random blocks.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use crate::certified::audit::Lemmas;
use crate::certified::bounds::block;
use crate::certified::nearest::{Foot, NearestPoint};
use crate::certified::testing::{Surfaces, clamped, closed, whole_block};
use crate::certified::{Block, Pair};
use crate::flatness::Flatness;
use crate::model::{RigidTransform, SurfaceArrays};
use glam::DVec3;

/// The number of spans of a sheet along each axis.
const SPANS: [usize; 2] = [5, 4];

/// A bicubic sheet over the unit square with these heights of control points, i along u.
fn sheet(height: impl Fn(usize, usize) -> f64) -> SurfaceArrays {
    let knots =
        SPANS.map(|spans| clamped(3, &(1..spans).map(|line| line as f64 / spans as f64).collect::<Vec<_>>()));
    // The Greville abscissae, so that x = u and y = v.
    let places = [0, 1].map(|axis| {
        let inner = &knots[axis][1..knots[axis].len() - 1];
        inner.windows(3).map(|window| window.iter().sum::<f64>() / 3.0).collect::<Vec<_>>()
    });
    let counts = [places[0].len(), places[1].len()];
    let point = |i: usize, j: usize| [places[0][i], places[1][j], height(i, j), 1.0];
    let control_points = (0..counts[0]).flat_map(|i| (0..counts[1]).map(move |j| (i, j)));
    SurfaceArrays {
        degree: [3, 3],
        counts,
        control_points: control_points.map(|(i, j)| point(i, j)).collect(),
        knots,
    }
}

/// A part of the plane z = 0 in which the unit square lies, with one inner knot along each
/// axis; along its first parameter runs y if `swapped`, and both are reversed if `reversed`.
fn plane(swapped: bool, reversed: bool) -> SurfaceArrays {
    let ends = if reversed { [1.5, 0.37, -0.5] } else { [-0.5, 0.37, 1.5] };
    let knots = clamped(1, &[if reversed { 1.0 - 0.435 } else { 0.435 }]);
    let point =
        |first: f64, second: f64| if swapped { [second, first, 0.0, 1.0] } else { [first, second, 0.0, 1.0] };
    SurfaceArrays {
        degree: [1, 1],
        counts: [3, 3],
        control_points: ends.iter().flat_map(|&first| ends.map(|second| point(first, second))).collect(),
        knots: [knots.clone(), knots],
    }
}

fn pair<'a>(a: &'a Surfaces, b: &'a Surfaces) -> Pair<'a> {
    Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY }
}

/// The sheet, and the same with weights that differ by so little that it hardly moves along x and y: it
/// is rational, so that its patches are compared piece by piece.
fn by_splines_and_by_pieces(arrays: &SurfaceArrays) -> [SurfaceArrays; 2] {
    const WEIGHT_SPREAD: f64 = 1e-9;
    let mut rational = arrays.clone();
    for point in rational.control_points.iter_mut().step_by(2) {
        point[3] += WEIGHT_SPREAD;
    }
    [arrays.clone(), rational]
}

/// The height of level sheets over the plane.
const HEIGHT: f64 = 1e-3;

/// Checks that all patches of a level sheet are decided by a threshold just above its height, in
/// every orientation of the plane, and none by one just below.
fn check_level(arrays: &SurfaceArrays) {
    let orientations = [(false, false), (true, false), (false, true), (true, true)];
    let sheets = by_splines_and_by_pieces(arrays);
    for ((swapped, reversed), sheet) in
        orientations.into_iter().flat_map(|at| sheets.each_ref().map(|sheet| (at, sheet)))
    {
        let a = Surfaces::new(vec![sheet.clone()], Flatness::None);
        let b = Surfaces::new(vec![plane(swapped, reversed)], Flatness::Loose);
        let pair = pair(&a, &b);
        let nearest = NearestPoint::new(pair.b);
        let bound = |threshold: f64| {
            block(
                &pair,
                a.sheets(),
                &nearest,
                &whole_block(&a),
                &Foot::start(0, [0.5; 2]),
                threshold,
                Lemmas::default(),
            )
        };
        let decided = bound(HEIGHT * (1.0 + 1e-9));
        assert!(decided.undecided.iter().all(|undecided| !undecided), "{swapped} {reversed}");
        assert!((HEIGHT..HEIGHT * (1.0 + 1e-9)).contains(&decided.decided), "{}", decided.decided);
        assert!(bound(HEIGHT * (1.0 - 1e-9)).undecided.iter().all(|undecided| *undecided));
    }
}

/// Over a plane, the distance of a patch is the largest height in it. Patches are decided just
/// where that is at most the threshold: exactly so for a height that is the same everywhere.
#[test]
fn a_level_sheet_is_decided_at_its_height() {
    check_level(&sheet(|_, _| HEIGHT));
}

/// The same for a sheet whose parameters are uneven by more than its height: its feet
/// slide along the plane.
#[test]
fn a_level_sheet_of_uneven_parameters_is_decided_at_its_height() {
    let random = &mut fastrand::Rng::with_seed(3);
    let mut arrays = sheet(|_, _| HEIGHT);
    for point in &mut arrays.control_points {
        point[0] += 20.0 * HEIGHT * (random.f64() - 0.5);
        point[1] += 20.0 * HEIGHT * (random.f64() - 0.5);
    }
    check_level(&arrays);
}

/// The patches that are left are those that rise above the threshold: one control point
/// raises the four by four patches around it.
#[test]
fn patches_above_the_threshold_are_left() {
    let heights = |i: usize, j: usize| if [i, j] == [0, 0] { 1e-3 } else { 1e-5 };
    for sheet in by_splines_and_by_pieces(&sheet(heights)) {
        let a = Surfaces::new(vec![sheet], Flatness::None);
        let b = Surfaces::new(vec![plane(false, false)], Flatness::Loose);
        let pair = pair(&a, &b);
        let nearest = NearestPoint::new(pair.b);
        for (threshold, left) in [(2e-5, 1), (1.01e-3, 0)] {
            let bound = block(
                &pair,
                a.sheets(),
                &nearest,
                &whole_block(&a),
                &Foot::start(0, [0.5; 2]),
                threshold,
                Lemmas::default(),
            );
            // The corner's basis function is that of the first span alone.
            let undecided: Vec<usize> = bound
                .undecided
                .iter()
                .enumerate()
                .filter(|(_, undecided)| **undecided)
                .map(|(k, _)| k)
                .collect();
            assert_eq!(undecided, (0..left).collect::<Vec<_>>());
            assert!(bound.decided >= if left == 0 { 1e-3 } else { 1e-5 });
        }
    }
}

/// The bound of a patch is that of its farthest piece, wherever it is: a tilted sheet over a plane
/// whose two inner knots both cross the patch.
#[test]
fn the_farthest_piece_of_a_patch_is_bounded() {
    for tilt in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
        let height = |x: f64, y: f64| 2e-3 + 1e-3 * (tilt[0] * (x - 0.3) + tilt[1] * (y - 0.375));
        let mut arrays = sheet(|_, _| 0.0);
        arrays.control_points.iter_mut().for_each(|point| point[2] = height(point[0], point[1]));
        for sheet in by_splines_and_by_pieces(&arrays) {
            let a = Surfaces::new(vec![sheet], Flatness::None);
            let b = Surfaces::new(vec![plane(false, false)], Flatness::Loose);
            let pair = pair(&a, &b);
            let nearest = NearestPoint::new(pair.b);
            let patch = Block { surface: 0, rows: [1, 2], columns: [1, 2] };
            let bound = block(
                &pair,
                a.sheets(),
                &nearest,
                &patch,
                &Foot::start(0, [0.5; 2]),
                3e-3,
                Lemmas::default(),
            );
            // The patch over [0.2, 0.4] x [0.25, 0.5].
            let highest = 2e-3 + 1e-3 * (0.1 + 0.125);
            assert_eq!(bound.undecided, [false]);
            // Weights move the sheet by less than 1e-9 of its height.
            let range = highest * (1.0 - 1e-9)..highest * (1.0 + 1e-5);
            assert!(range.contains(&bound.decided), "{tilt:?}: {}", bound.decided);
        }
    }
}

/// Of the patches that are left the one that rises highest gives the farthest sample, which is as far
/// as it is high; where all are decided it is the sample in the middle.
#[test]
fn the_highest_patch_gives_the_farthest_sample() {
    for highest in [[0, 0], [7, 6]] {
        let height = |i: usize, j: usize| match [i, j] {
            place if place == highest => 2e-3,
            [0, 0] | [7, 6] => 1e-3,
            _ => 1e-5,
        };
        for sheet in by_splines_and_by_pieces(&sheet(height)) {
            let a = Surfaces::new(vec![sheet], Flatness::None);
            let b = Surfaces::new(vec![plane(true, false)], Flatness::Loose);
            let pair = pair(&a, &b);
            let nearest = NearestPoint::new(pair.b);
            let bound = |threshold: f64| {
                block(
                    &pair,
                    a.sheets(),
                    &nearest,
                    &whole_block(&a),
                    &Foot::start(0, [0.5; 2]),
                    threshold,
                    Lemmas::default(),
                )
            };
            let farthest = bound(2e-5).farthest;
            assert_eq!(farthest.patch, if highest == [0, 0] { 0 } else { 19 });
            let height = pair.point_of_a(farthest.patch, farthest.parameters).z;
            assert!((farthest.foot.distance() - height).abs() <= 1e-15 && height > 2e-5, "{height}");
            let decided = bound(3e-3);
            assert!(decided.undecided.iter().all(|undecided| !undecided));
            assert_eq!(decided.farthest, decided.sample);
        }
    }
}

/// A ribbon over a plane that turns back and forth again: the image of a span that runs against
/// the sample's has no parts, and its patch is left.
#[test]
fn a_patch_without_parts_is_left() {
    const HEIGHT: f64 = 1e-3;
    let rows = [0.0, 0.5, 0.25, 1.0];
    for transposed in [false, true] {
        let point = |x: f64, y: f64| if transposed { [y, x, HEIGHT, 1.0] } else { [x, y, HEIGHT, 1.0] };
        let along = (clamped(1, &[1.0 / 3.0, 2.0 / 3.0]), rows.len());
        let across = (clamped(1, &[]), 2);
        let [(knots_u, count_u), (knots_v, count_v)] =
            if transposed { [across, along] } else { [along, across] };
        let control_points = if transposed {
            [0.0, 1.0].iter().flat_map(|&y| rows.map(|x| point(x, y))).collect()
        } else {
            rows.iter().flat_map(|&x| [0.0, 1.0].map(|y| point(x, y))).collect()
        };
        let ribbon = SurfaceArrays {
            degree: [1, 1],
            knots: [knots_u, knots_v],
            counts: [count_u, count_v],
            control_points,
        };
        let a = Surfaces::new(vec![ribbon], Flatness::None);
        let b = Surfaces::new(vec![plane(false, false)], Flatness::Loose);
        let pair = pair(&a, &b);
        let nearest = NearestPoint::new(pair.b);
        let bound = block(
            &pair,
            a.sheets(),
            &nearest,
            &whole_block(&a),
            &Foot::start(0, [0.5; 2]),
            2.0 * HEIGHT,
            Lemmas::default(),
        );
        assert_eq!(bound.undecided, [true, false, true], "{transposed}");
    }
}

/// No point of a patch that is decided is farther from B than the bound: closed surfaces
/// and their copies that begin at another row, with control points moved by a little.
#[test]
fn the_bound_holds_on_random_copies() {
    let random = &mut fastrand::Rng::with_seed(16);
    let (mut decided, mut undecided) = (0, 0);
    for seed in 0..24 {
        let arrays = closed(100 * seed, seed % 2 == 1);
        let mut copy = arrays.clone();
        let size = 10.0_f64.powf(-1.0 - 6.0 * random.f64());
        let [around, columns] = [arrays.counts[0] - 3, arrays.counts[1]];
        let start = random.usize(0..around);
        let moves: Vec<f64> = (0..around * columns).map(|_| size * (random.f64() - 0.5)).collect();
        for row in 0..arrays.counts[0] {
            for column in 0..columns {
                let from = (row + start) % around * columns + column;
                let mut point = arrays.control_points[from];
                point[row % 3] += moves[from];
                copy.control_points[row * columns + column] = point;
            }
        }
        // The last three rows are the first ones.
        for k in 0..3 * columns {
            copy.control_points[around * columns + k] = copy.control_points[k];
        }
        let a = Surfaces::new(vec![arrays], Flatness::Loose);
        let b = Surfaces::new(vec![copy], Flatness::Loose);
        let pair = pair(&a, &b);
        let nearest = NearestPoint::new(pair.b);
        let whole = whole_block(&a);
        let threshold = size * random.f64();
        let bound = block(
            &pair,
            a.sheets(),
            &nearest,
            &whole,
            &Foot::start(0, [0.5; 2]),
            threshold,
            Lemmas::default(),
        );
        assert!(bound.decided <= threshold);
        for (index, is_undecided) in bound.undecided.iter().enumerate() {
            if *is_undecided {
                undecided += 1;
                continue;
            }
            decided += 1;
            let patch = a.sheets().bezier.patches.patch(index);
            for _ in 0..5 {
                let point: DVec3 = patch.point([random.f64(), random.f64()]);
                let foot = nearest.nearest(point, bound.sample.foot, 0.0);
                let foot = nearest.certified(point, foot, 1e-12);
                assert!(foot.distance() <= bound.decided + 1e-11, "{} {}", foot.distance(), bound.decided);
            }
        }
    }
    assert!(decided > 60 && undecided > 60, "{decided} {undecided}");
}
