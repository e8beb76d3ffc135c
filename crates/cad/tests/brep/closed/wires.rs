//! Wires of the seams of whole surfaces, in all orders.

use super::{Seams, TORUS, TORUS_AREA, orders};
use crate::support::writers::brep::{BrepText, minus, plus};
use crate::{area_of, assert_near, read};
use nurbs_hausdorff::Model;
use nurbs_hausdorff::internals::engine::{DistanceOptions, Engine, PreparedModel};
use std::f64::consts::{PI, TAU};

/// The seams of the torus that begins at the angle v of its tube.
fn torus_seams(v: f64) -> Seams {
    let (sin, cos) = v.sin_cos();
    let ring = format!("2 0 0 {:?} 0 0 1 1 0 0 0 1 0 {:?}", 4.0 * sin, 15.0 + 4.0 * cos);
    // The circle of the tube at u = 0, from v on.
    let tube = format!("2 15 0 0 0 -1 0 {cos:?} 0 {sin:?} {:?} 0 {cos:?} 4", -sin);
    Seams { along: [ring, tube], start: [0.0, v], periods: [TAU, TAU] }
}

/// The models of the seams' wire in all orders.
fn wholes(surface: &str, seams: &Seams, curves: bool, space: bool) -> Vec<Model> {
    let mut text = BrepText::new();
    let surface = text.surface(surface);
    let [a, b] = seams.edges(&mut text, surface, curves, space);
    let wires = orders(&[plus(a), plus(b), minus(a), minus(b)]);
    let whole = |wire: &Vec<_>| {
        let mut text = text.clone();
        let wire = text.wire(wire);
        let face = text.face(surface, &[wire]);
        let (model, report) = read(&text, face);
        assert_eq!(report.notes, []);
        model
    };
    wires.iter().map(whole).collect()
}

/// `BRepPrimAPI_MakeTorus` begins at v = 0, and the revolution of a circle where that does.
#[test]
fn a_torus_is_whole_in_every_order_of_its_wire() {
    for v in [0.0, 1.5 * PI] {
        for (curves, space) in [(true, true), (true, false), (false, true)] {
            for model in wholes(TORUS, &torus_seams(v), curves, space) {
                assert_near(area_of(&model), TORUS_AREA, 1e-11);
            }
        }
    }
}

/// Seams whose two curves are exchanged, as no loop counter-clockwise passes them.
#[test]
fn a_torus_is_whole_with_exchanged_sides_of_its_seams() {
    let mut text = BrepText::new();
    let surface = text.surface(TORUS);
    let vertex = text.vertex([19.0, 0.0, 0.0]);
    let lines = [["1 0 0 1 0", "1 0 {TAU} 1 0"], ["1 {TAU} 0 0 1", "1 0 0 0 1"]];
    let edges = lines.map(|[near, far]| {
        let [far, near] = [far, near].map(|line| text.p_curve(line.replace("{TAU}", &format!("{TAU:?}"))));
        text.edge(&[format!("3 {far} {near}CN {surface} 0 0 {TAU:?}")], [vertex, vertex])
    });
    for wire in orders(&[plus(edges[0]), plus(edges[1]), minus(edges[0]), minus(edges[1])]) {
        let mut text = text.clone();
        let wire = text.wire(&wire);
        let face = text.face(surface, &[wire]);
        assert_near(area_of(&read(&text, face).0), TORUS_AREA, 1e-11);
    }
}

/// A spindle, whose tube passes the axis: ∫ |R + r cos v| r dv over both turns.
#[test]
fn a_spindle_torus_is_whole() {
    let (major, minor) = (3.0_f64, 5.0_f64);
    let seams = Seams { along: Default::default(), start: [0.0; 2], periods: [TAU; 2] };
    let root = (minor * minor - major * major).sqrt();
    let angle = (-major / minor).acos();
    let expected = 2.0 * TAU * minor * (2.0 * (major * angle + root) - PI * major);
    for model in wholes(&format!("5 0 0 0 0 0 1 1 0 0 0 1 0 {major:?} {minor:?}"), &seams, true, false) {
        // The quadrature of the area loses digits where the density vanishes, at the axis.
        assert_near(area_of(&model), expected, 2e-3);
    }
    // A horn touches the axis, and its density changes no sign.
    for model in wholes("5 0 0 0 0 0 1 1 0 0 0 1 0 5 5", &seams, true, false) {
        assert_near(area_of(&model), TAU * TAU * 25.0, 1e-11);
    }
}

/// A revolved ellipse that is trimmed to its period, and so not periodic: by Guldin's rule its area
/// is that of the ellipse's length times the way of its centre.
#[test]
fn a_revolved_closed_profile_is_whole() {
    let ellipse = "3 15 0 0 0 -1 0 0 0 -1 1 0 0 4 2";
    let surface = format!("7 0 0 0 0 0 1\n8 0 {TAU:?}\n{ellipse}");
    let seams = Seams {
        along: ["2 0 0 -4 0 0 1 1 0 0 0 1 0 15".to_owned(), ellipse.to_owned()],
        start: [0.0; 2],
        periods: [TAU; 2],
    };
    // The perimeter by the mean of the speed over its period, which converges geometrically.
    let speed =
        |i: u32| (4.0 * (TAU * f64::from(i) / 256.0).sin()).hypot(2.0 * (TAU * f64::from(i) / 256.0).cos());
    let length = (0..256).map(speed).sum::<f64>() * TAU / 256.0;
    for space in [true, false] {
        for model in wholes(&surface, &seams, true, space) {
            assert_near(area_of(&model), TAU * 15.0 * length, 1e-6);
        }
    }
}

/// A frame of square section around a square hole, as a bilinear surface periodic, or only closed,
/// in both directions: sides 2 * 8 and 2 * 4 high and long, and two rings of 64 - 16.
#[test]
fn splines_closed_both_ways_are_whole() {
    let corner = |i: usize, j: usize| {
        let [x, y] = [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]][i % 4];
        let [radius, z] = [[4.0, -1.0], [4.0, 1.0], [2.0, 1.0], [2.0, -1.0]][j % 4];
        format!("{:?} {:?} {z:?}", x * radius, y * radius)
    };
    for periodic in [true, false] {
        let count = if periodic { 4 } else { 5 };
        let poles: String =
            (0..count).flat_map(|i| (0..count).map(move |j| format!("{} ", corner(i, j)))).collect();
        let ends = if periodic { 1 } else { 2 };
        let knots = format!("0 {ends} 1 1 2 1 3 1 4 {ends}");
        let flag = u8::from(periodic);
        let surface = format!("9 0 0 {flag} {flag} 1 1 {count} {count} 5 5 {poles} {knots} {knots}");
        let seams = Seams { along: Default::default(), start: [0.0; 2], periods: [4.0; 2] };
        for model in wholes(&surface, &seams, true, false) {
            assert_near(area_of(&model), 4.0 * 2.0 * (8.0 + 4.0) + 2.0 * (64.0 - 16.0), 1e-12);
        }
    }
}

/// The ball of radius 1 about the centre of the torus is farthest from it at its poles.
#[test]
fn the_distance_of_a_ball_to_a_torus_is_that_of_its_poles() {
    let mut text = BrepText::new();
    let surface = text.surface("4 0 0 0 0 0 1 1 0 0 0 1 0 1");
    let ball = text.face(surface, &[]);
    let ball = PreparedModel::new(&read(&text, ball).0).unwrap();
    let engine = Engine::cpu();
    let options = DistanceOptions { relative_tolerance: Some(1e-6), ..DistanceOptions::default() };
    let expected = (15.0_f64 * 15.0 + 1.0).sqrt() - 4.0;
    let torus = wholes(TORUS, &torus_seams(0.0), true, true);
    for model in [&torus[0], &torus[14]] {
        let torus = PreparedModel::new(model).unwrap();
        let result = engine.distance(&ball, &torus, &options).wait().unwrap();
        assert!(result.converged && result.lower <= expected && expected <= result.upper, "{result:?}");
    }
}
