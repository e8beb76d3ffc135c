//! Cells that the border of a part of B runs around: at poles, at ends and at their corners.

use super::super::around::upper_bound as surrounded;
use super::over_faces::{cut_all, face};
use super::*;
use crate::certified::nearest::{Foot, NearestPoint};
use crate::certified::testing::{Surfaces, clamped, patch, through};
use crate::certified::{Cell, Pair};
use crate::flatness::Flatness;
use crate::model::{NurbsSurface, RigidTransform, SurfaceArrays};
use crate::param_box::ParamBox;
use crate::shapes::operations::{part, transformed};
use crate::shapes::{disc, sphere};
use glam::DQuat;

/// How far cells go beyond an end.
const BEYOND: f64 = 1e-3;

/// The bound of a whole patch, from a start for the foot of its centre.
fn bound(a: &Surfaces, b: &Surfaces, flat: u32, start: [f64; 2], threshold: f64) -> Option<f64> {
    let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
    let nearest = NearestPoint::new(pair.b);
    let context = CellContext::new(&pair, &nearest, Cell::whole(0), &Foot::start(flat, start));
    let foot = context.foot();
    surrounded(&context, (Chart::new(b.sheets(), foot.patch, foot.parameters), None), threshold)
}

/// A disc whose pole is at v = 0.
fn polar_disc() -> SurfaceArrays {
    let discs = [true, false].map(|upward| disc(1.0, 0.0, upward).unwrap().into_arrays());
    discs.into_iter().find(|disc| disc.control_points[0][..3] == [0.0; 3]).unwrap()
}

fn of(arrays: SurfaceArrays) -> Surfaces {
    Surfaces::new(vec![arrays], Flatness::None)
}

/// A turned square of this size at a height.
fn square(center: [f64; 2], size: f64, height: f64) -> Surfaces {
    patch(through(|s, t| {
        let [x, y] = [size * (s - 0.5), size * (t - 0.5)];
        let [cos, sin] = [0.7_f64.cos(), 0.7_f64.sin()];
        DVec3::new(center[0] + cos * x - sin * y, center[1] + sin * x + cos * y, height)
    }))
}

/// A square over a disc of polar parameters is at its height: over the pole, beside it, and where the angle is wide.
#[test]
fn a_square_over_a_pole_is_at_its_height() {
    let b = of(polar_disc());
    for height in [0.0, 1e-6, -1e-3_f64] {
        for center in [[0.0, 0.0], [0.03, 0.02], [0.08, -0.05], [0.2, 0.1]] {
            let bound = bound(&square(center, 0.1, height), &b, 0, [0.3, 0.2], 1.0).unwrap();
            let truth = height.abs();
            assert!(
                (truth..=truth * (1.0 + 1e-9) + 1e-13).contains(&bound),
                "{bound:e} of {height:e} at {center:?}"
            );
        }
    }
}

/// A part of a turned sphere over a pole is at no distance from the sphere.
#[test]
fn a_turned_sphere_is_at_no_distance_at_the_pole() {
    let whole = sphere(DVec3::ZERO, 1.0).unwrap();
    let b = Surfaces::of(&whole);
    let turn = RigidTransform::new(DQuat::from_rotation_y(-1.56), DVec3::ZERO).unwrap();
    let turned = transformed(&whole, &turn).unwrap();
    let a = part(&turned.surfaces()[0], ParamBox::new([0.0, 0.015], [0.485, 0.51])).unwrap();
    let bound = bound(&of(a.into_arrays()), &b, 1, [0.8, 0.9], 1e-9).unwrap();
    assert!(bound <= 1e-12, "{bound:e}");
}

/// A square whose corners lie beyond the disc is not surrounded by it.
#[test]
fn a_square_that_reaches_beyond_the_disc_is_not_surrounded() {
    let b = of(polar_disc());
    assert_eq!(bound(&square([0.0, 0.0], 3.0, 0.0), &b, 0, [0.3, 0.2], 10.0), None);
    assert_eq!(bound(&square([0.0, 0.0], 2.0, 0.0), &b, 0, [0.3, 0.2], 10.0), None);
}

/// The end's control points may be apart at a pole by a billionth of its patches' size, and the bound allows for it.
#[test]
fn a_pole_that_is_no_point_counts_with_its_size() {
    let with = |size: f64| {
        let mut arrays = polar_disc();
        let columns = arrays.counts[1];
        arrays.control_points[2 * columns][0] += size;
        of(arrays)
    };
    let a = square([0.0, 0.0], 0.1, 0.0);
    let near = bound(&a, &with(1e-10), 0, [0.3, 0.2], 1.0).unwrap();
    assert!((1e-10..=1e-9).contains(&near), "{near:e}");
    assert_eq!(bound(&a, &with(1e-6), 0, [0.3, 0.2], 1.0), None);
}

/// Half a disc has an end that is a point, and is not closed around it.
#[test]
fn a_half_disc_has_no_pole() {
    let whole = NurbsSurface::new(0, polar_disc()).unwrap();
    let half = of(part(&whole, ParamBox::new([0.0, 0.5], [0.0, 1.0])).unwrap().into_arrays());
    let poles = |b: &Surfaces| Chart::new(b.sheets(), 0, [0.5; 2]).poles().count();
    assert_eq!([poles(&of(whole.into_arrays())), poles(&half)], [1, 0]);
    assert_eq!(bound(&square([0.0, 0.0], 0.1, 0.0), &half, 0, [0.3, 0.2], 10.0), None);
}

/// A cell that goes beyond an end is at that length, also where B's derivative vanishes along the end.
#[test]
fn a_cell_beyond_an_end_is_at_the_overshoot() {
    for axis in 0..2 {
        for end in [0.0, 1.0] {
            for is_singular in [false, true] {
                let across = |x: f64| {
                    let inwards = if end == 0.0 { x } else { 1.0 - x };
                    let square = inwards * inwards;
                    let place = if is_singular { square } else { inwards };
                    if end == 0.0 { place } else { 1.0 - place }
                };
                let b = patch(through(|s, t| {
                    if axis == 0 { DVec3::new(across(s), t, 0.0) } else { DVec3::new(s, across(t), 0.0) }
                }));
                let a = through(|s, t| {
                    let mut point = [0.4 + 0.1 * s, 0.4 + 0.1 * t];
                    let inwards = 0.1 * [s, t][axis] - BEYOND;
                    point[axis] = if end == 0.0 { inwards } else { 1.0 - inwards };
                    DVec3::new(point[0], point[1], 0.0)
                });
                let bound = bound(&patch(a), &b, 0, [0.5; 2], 2.0 * BEYOND).unwrap();
                let case = format!("{bound:e} at {end} of {axis}, singular {is_singular}");
                assert!((BEYOND..=BEYOND * (1.0 + 1e-6)).contains(&bound), "{case}");
            }
        }
    }
}

/// Over a round end the farthest corner counts.
#[test]
fn a_cell_beyond_a_round_end_is_at_its_farthest_corner() {
    let b = of(polar_disc());
    for angle in [0.0, 0.3, 1.5] {
        let a = patch(through(|s, t| {
            let [x, y] = [0.95 + (0.05 + BEYOND) * s, 0.04 * (t - 0.5)];
            DQuat::from_rotation_z(angle) * DVec3::new(x, y, 0.0)
        }));
        let truth = (1.0 + BEYOND).hypot(0.02) - 1.0;
        let bound = bound(&a, &b, 0, [angle / 1.6, 0.95], 2.0 * truth).unwrap();
        assert!((truth..=1.1 * truth).contains(&bound), "{bound:e} {truth:e} at {angle}");
    }
}

/// At a corner both ends count, as if one was left after the other.
#[test]
fn a_cell_beyond_a_corner_is_at_no_more_than_both_overshoots() {
    let b = patch(through(|s, t| DVec3::new(s, t, 0.0)));
    for [x, y] in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
        let beyond = |end: f64, s: f64| {
            let inwards = 0.1 * s - BEYOND;
            if end == 0.0 { inwards } else { 1.0 - inwards }
        };
        let a = patch(through(|s, t| DVec3::new(beyond(x, s), beyond(y, t), 0.0)));
        let bound = bound(&a, &b, 0, [0.5; 2], 4.0 * BEYOND).unwrap();
        let truth = std::f64::consts::SQRT_2 * BEYOND;
        assert!((truth..=2.001 * BEYOND).contains(&bound), "{bound:e} at {x} {y}");
    }
}

/// A cell that goes beyond an end by more than the threshold has no bound.
#[test]
fn a_cell_beyond_the_threshold_has_no_bound() {
    let b = patch(through(|s, t| DVec3::new(s, t, 0.0)));
    let a = patch(through(|s, t| DVec3::new(0.1 * s - BEYOND, 0.4 + 0.1 * t, 0.0)));
    assert!(bound(&a, &b, 0, [0.5; 2], 1.01 * BEYOND).is_some());
    assert_eq!(bound(&a, &b, 0, [0.5; 2], 0.99 * BEYOND), None);
}

/// The bound about a place of B, whether or not that is the nearest.
fn bound_about(a: &Surfaces, b: &Surfaces, place: [f64; 2], threshold: f64) -> Option<f64> {
    let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
    let nearest = NearestPoint::new(pair.b);
    let context = CellContext::new(&pair, &nearest, Cell::whole(0), &Foot::start(0, place));
    surrounded(&context, (Chart::new(b.sheets(), 0, place), None), threshold)
}

/// Beyond a fold nothing is surrounded, although all sides of the box are elsewhere.
#[test]
fn a_cell_beyond_a_fold_is_not_surrounded() {
    let b = patch(through(|s, t| DVec3::new((2.0 * s - 1.0).powi(2), t, 0.0)));
    let cell = |x: f64| patch(through(|s, t| DVec3::new(x + 0.01 * s, 0.45 + 0.1 * t, 0.0)));
    assert!(bound_about(&cell(0.03), &b, [0.6, 0.5], 1.0).is_some());
    assert_eq!(bound_about(&cell(-0.02), &b, [0.6, 0.5], 1.0), None);
}

/// The part around a pole is as large as it is, and not as it would be if it went on as at the pole.
#[test]
fn a_square_beyond_a_slowing_disc_is_not_surrounded() {
    let SurfaceArrays { knots: [around, _], counts: [rows, _], control_points, .. } = polar_disc();
    // The radius v - v² / 2.
    let middles = control_points.chunks_exact(2).flat_map(|row| {
        let [pole, rim] = [row[0], row[1]];
        let half = [0.5 * rim[0], 0.5 * rim[1], 0.0, rim[3]];
        [pole, half, half]
    });
    let b = of(SurfaceArrays {
        degree: [2, 2],
        knots: [around, clamped(2, &[])],
        counts: [rows, 3],
        control_points: middles.collect(),
    });
    assert!(bound(&square([0.0, 0.0], 0.2, 0.0), &b, 0, [0.3, 0.2], 1.0).is_some());
    assert_eq!(bound(&square([0.0, 0.0], 0.85, 0.0), &b, 0, [0.3, 0.2], 1.0), None);
}

/// Where an end bulges out less than a function is needed for, its innermost point counts.
#[test]
fn the_innermost_point_of_an_end_counts() {
    const BULGE: f64 = 2e-5;
    let b = patch(through(|s, t| DVec3::new(s * (1.0 + BULGE * 4.0 * t * (1.0 - t)), t, 0.0)));
    let a = patch(through(|s, t| DVec3::new(0.9 + (0.1 + BEYOND) * s, 0.001 + 0.998 * t, 0.0)));
    let bound = bound(&a, &b, 0, [0.5; 2], 2.0 * BEYOND).unwrap();
    assert!((BEYOND..=BEYOND + 2.0 * BULGE).contains(&bound), "{bound:e}");
}

/// Over a jump within an end the jump counts beyond that end and in the step back.
#[test]
fn a_jump_counts_twice_beyond_an_end() {
    let with = |jump: f64| {
        let columns = (0..6).flat_map(|i| (0..3).map(move |j| [i, j]));
        let control = |[i, j]: [usize; 2]| {
            let x = 0.25 * (i - i / 3) as f64;
            [x, 0.5 * j as f64 + if i < 3 { 0.0 } else { jump }, 0.0, 1.0]
        };
        let b = of(SurfaceArrays {
            degree: [2, 2],
            knots: [clamped(2, &[0.5; 3]), clamped(2, &[])],
            counts: [6, 3],
            control_points: columns.map(control).collect(),
        });
        let a = patch(through(|s, t| DVec3::new(0.45 + 0.1 * s, 0.9 + (0.1 + BEYOND) * t, 0.0)));
        bound(&a, &b, 0, [0.9, 0.9], 2.0 * BEYOND).unwrap()
    };
    let jump = 1e-10;
    let more = with(-jump) - with(0.0);
    // With the end itself, which is lower there.
    assert!((2.99 * jump..=4.0 * jump).contains(&more), "{more:e}");
}

/// No bound above the threshold is returned: the excess over an end holds only for points within the threshold.
#[test]
fn a_cell_above_and_beyond_has_no_bound_over_the_threshold() {
    let b = patch(through(|s, t| DVec3::new(s, t, 0.0)));
    let a = patch(through(|s, t| DVec3::new(0.1 * s - BEYOND, 0.4 + 0.1 * t, BEYOND)));
    assert!(bound(&a, &b, 0, [0.5; 2], 2.1 * BEYOND).is_some());
    assert_eq!(bound(&a, &b, 0, [0.5; 2], 1.9 * BEYOND), None);
}

/// The bound of a trimmed face needs the part to be in it, and has the error of its points.
#[test]
fn a_part_of_a_face_is_within_its_loops() {
    let bound_of = |low: f64, error: f64, center: [f64; 2]| {
        let outer = [[0.0, low], [1.0, low], [1.0, 0.9], [0.0, 0.9]];
        let cut = cut_all(vec![face(polar_disc(), &[&outer])]);
        let mut face = cut.faces.chart(&Chart::new(cut.pieces.sheets(), 0, [0.5; 2])).unwrap();
        face.point_error += error;
        let (a, b) = (square(center, 0.1, 1e-3), of(polar_disc()));
        let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
        let nearest = NearestPoint::new(pair.b);
        let context = CellContext::new(&pair, &nearest, Cell::whole(0), &Foot::start(0, [0.1, 0.3]));
        let chart = face.chart.moved([0, 0], face.chart.parameters);
        surrounded(&context, (chart, Some(face)), 1.0)
    };
    let exact = bound_of(0.0, 0.0, [0.0; 2]).unwrap();
    assert!((exact - 1e-3).abs() <= 1e-9, "{exact:e}");
    assert!((bound_of(0.0, 1e-4, [0.0; 2]).unwrap() - exact - 1e-4).abs() <= 1e-12);
    // The pole is beyond the inner loop.
    assert_eq!(bound_of(0.05, 0.0, [0.0; 2]), None);
}

/// A face holds what is around a pole up to its loop, and nothing if its loop leaves the pole out.
#[test]
fn a_face_holds_what_is_around_a_pole_up_to_its_loop() {
    let between = |low: f64, high: f64| {
        let outer = [[0.0, low], [1.0, low], [1.0, high], [0.0, high]];
        cut_all(vec![face(polar_disc(), &[&outer])])
    };
    let holds = |low: f64, high: f64, extent: f64| {
        let cut = between(low, high);
        let piece = Chart::new(cut.pieces.sheets(), 0, [0.5; 2]);
        let face = cut.faces.chart(&piece).unwrap();
        let pole = face.chart.poles().next().unwrap();
        face.holds_around(&pole, extent)
    };
    assert!(holds(0.0, 0.9, 0.85) && !holds(0.0, 0.9, 0.95));
    assert!(!holds(0.1, 1.0, 0.05) && !holds(0.1, 1.0, 0.5));
}
