//! Holes in closed surfaces, and loops that cover more than the surface.

use super::{TORUS, TORUS_AREA, torus_area};
use crate::support::writers::brep::{BrepText, polygon, rectangle};
use crate::{area_of, assert_near, region};
use nurbs_hausdorff::internals::engine::PreparedModel;
use nurbs_hausdorff_cad::from_brep;
use std::f64::consts::{PI, TAU};

type Loop = Vec<(String, [f64; 2])>;

const CYLINDER: &str = "2 0 0 0 0 0 1 1 0 0 0 1 0 20";
const SPHERE: &str = "4 0 0 0 0 0 1 1 0 0 0 1 0 10";

/// A rectangle, clockwise.
fn hole([u0, v0]: [f64; 2], [u1, v1]: [f64; 2]) -> Loop {
    polygon(&[[u0, v0], [u0, v1], [u1, v1], [u1, v0]])
}

/// The code of the fault for which a region is skipped.
#[track_caller]
fn refused(surface: &str, loops: &[Loop]) -> String {
    let mut text = BrepText::new();
    let surface = text.surface(surface);
    let plane = text.surface("1 0 0 0 0 0 1 1 0 0 0 1 0");
    let faces = [text.region(surface, loops), text.region(plane, &[rectangle([0.0, 0.0], [1.0, 1.0])])];
    let shell = text.shape("Sh\n", &faces.map(crate::support::writers::brep::plus));
    let (model, report) = from_brep(&text.text(crate::support::writers::brep::plus(shell))).unwrap();
    assert_eq!(model.faces().len(), 1);
    report.skipped[0].code.to_owned()
}

/// Holes that miss the seams, stated in any period.
#[test]
fn holes_in_a_torus_are_cut_out_wherever_the_file_places_them() {
    let whole = rectangle([0.0, 0.0], [TAU, TAU]);
    let ([low, high], other) = ([[1.0, 2.0], [2.5, 3.0]], [[4.0, 4.8], [4.5, 6.0]]);
    let expected = TORUS_AREA - torus_area(low, high) - torus_area(other[0], other[1]);
    for (du, dv) in [(0.0, 0.0), (TAU, 0.0), (0.0, -TAU), (-2.0 * TAU, 3.0 * TAU)] {
        let moved = |[u, v]: [f64; 2]| [u + du, v + dv];
        let loops = [whole.clone(), hole(moved(low), moved(high)), hole(other[0], other[1])];
        assert_near(area_of(&region(TORUS, &loops).0), expected, 1e-11);
    }
}

/// Without seams the directions of the loops alone tell the side.
#[test]
fn a_lone_loop_on_a_torus_bounds_the_region_on_its_left() {
    let (low, high) = ([1.0, 2.0], [2.5, 3.0]);
    let inside = torus_area(low, high);
    // The same as a revolved circle that is trimmed to its period, and so not periodic.
    let revolved = format!("7 0 0 0 0 0 1\n8 0 {TAU:?}\n2 15 0 0 0 -1 0 1 0 0 0 0 1 4");
    for surface in [TORUS, &revolved] {
        assert_near(area_of(&region(surface, &[rectangle(low, high)]).0), inside, 1e-11);
        assert_near(area_of(&region(surface, &[hole(low, high)]).0), TORUS_AREA - inside, 1e-11);
    }
    let both = [rectangle(low, high), hole([4.0, 4.5], [4.5, 6.0])];
    assert_eq!(refused(TORUS, &both), "BREP_LOOP_DIRECTIONS");
}

/// The places next to the largest hole of two others lie on both sides of it, more than a period
/// apart: the surface is cut in a gap that all of them leave.
#[test]
fn holes_that_lie_around_a_closed_surface_do_not_meet_its_cut() {
    let holes = [[[1.8, 1.8], [2.6, 2.8]], [[4.9, 4.9], [5.4, 5.3]], [[5.1, 5.5], [5.6, 5.8]]];
    let area = |[low, high]: [[f64; 2]; 2]| torus_area(low, high);
    let expected = TORUS_AREA - holes.map(area).iter().sum::<f64>();
    let exchanged = holes.map(|corners| corners.map(|[u, v]| [v, u]));
    let expected_exchanged = TORUS_AREA - exchanged.map(area).iter().sum::<f64>();
    for (holes, expected) in [(holes, expected), (exchanged, expected_exchanged)] {
        let loops = holes.map(|[low, high]| hole(low, high));
        let (model, report) = region(TORUS, &loops);
        assert_eq!(report.skipped, []);
        let area = PreparedModel::new(&model).unwrap().area();
        assert!(area.lower <= expected && expected <= area.upper, "{area:?} {expected}");
    }
}

/// A strip that winds twice around a cylinder, with a hole in its first turn, whose place in
/// the second one is nearer to the middle of the strip's box.
#[test]
fn a_hole_lies_in_the_turn_of_a_strip_that_contains_it() {
    let strip = polygon(&[[0.0, 0.0], [4.0 * PI, 40.0], [4.0 * PI, 50.0], [0.0, 10.0]]);
    let expected = 20.0 * (4.0 * PI * 10.0 - 0.2 * 0.5);
    for turn in [-1.0, 0.0, 1.0, 2.0] {
        let u = 0.8 * PI + turn * TAU;
        let loops = [strip.clone(), hole([u - 0.1, 13.0], [u + 0.1, 13.5])];
        assert_near(area_of(&region(CYLINDER, &loops).0), expected, 1e-11);
    }
    // A strip twice around lies on itself, so that the hole has two places.
    let twice = rectangle([0.0, 0.0], [2.0 * TAU, 10.0]);
    assert_eq!(refused(CYLINDER, &[twice, hole([1.0, 2.0], [2.0, 3.0])]), "BREP_LOOP_SHIFTS");
}

#[test]
fn loops_that_cover_more_than_a_closed_surface_are_refused() {
    let twice = rectangle([0.0, 0.0], [TAU, 2.0 * TAU]);
    assert_eq!(refused(TORUS, &[twice]), "BREP_LOOP_NO_ORDER");
    // Each region is smaller than the sphere, and they are beside each other in the parameters.
    let first = polygon(&[[0.0, -1.5], [12.0, -1.5], [12.0, -1.45], [4.0, -1.45], [4.0, 1.5], [0.0, 1.5]]);
    let second = rectangle([4.1, -1.4], [8.0, 1.5]);
    assert_near(
        area_of(&region(SPHERE, std::slice::from_ref(&second)).0),
        390.0 * (1.5_f64.sin() + 1.4_f64.sin()),
        1e-10,
    );
    assert_eq!(refused(SPHERE, &[first, second]), "BREP_COVERED_TWICE");
}
