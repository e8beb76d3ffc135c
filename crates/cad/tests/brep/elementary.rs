//! Planes, cylinders, cones, spheres and tori.

use crate::area::{area, loop_points, surface_points};
use crate::support::writers::brep::{BrepText, circle, line, minus, plus, rectangle};
use crate::{area_of, assert_near, read, region};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const PLANE: &str = "1 1 2 3 0 0 1 1 0 0 0 1 0";
/// The accuracy of gaps, relative to the edge.
const GAP_RESOLUTION: f64 = 1e-10;

const CYLINDER: &str = "2 0 0 0 0 0 1 1 0 0 0 1 0 20";

#[test]
fn a_plate_with_a_bore_keeps_both_loops_exact() {
    let bore = circle([50.0, 30.0], 10.0, -1.0);
    let (model, report) = region(PLANE, &[rectangle([0.0, 0.0], [100.0, 60.0]), bore]);
    assert_eq!((report.trims, report.exact, report.fitted), (5, 5, 0));
    assert!(report.gap < 1e-14, "{}", report.gap);
    assert_near(area_of(&model), 6000.0 - 100.0 * PI, 1e-13);
    let face = model.faces().next().unwrap();
    assert_eq!(face.kind(), Some("plane"));
    for (index, [x, y, z]) in loop_points(&face) {
        assert_near(z, 3.0, 1e-15);
        if index == 1 {
            assert_near((x - 51.0).hypot(y - 32.0), 10.0, 1e-14);
        }
    }
}

#[test]
fn loops_of_the_wrong_orientation_are_reversed() {
    // Both loops run the other way round.
    let outer = rectangle([0.0, 0.0], [100.0, 60.0]);
    let reversed: Vec<_> = [[0.0, 0.0], [0.0, 60.0], [100.0, 60.0], [100.0, 0.0]].to_vec();
    let clockwise = crate::support::writers::brep::polygon(&reversed);
    for loops in [
        vec![clockwise.clone(), circle([50.0, 30.0], 10.0, 1.0)],
        vec![clockwise, circle([50.0, 30.0], 10.0, -1.0)],
        vec![circle([50.0, 30.0], 10.0, 1.0), outer],
    ] {
        assert_near(area_of(&region(PLANE, &loops).0), 6000.0 - 100.0 * PI, 1e-13);
    }
}

#[test]
fn a_cylinder_with_a_seam_is_the_rectangle_of_a_turn() {
    let mut text = BrepText::new();
    let surface = text.surface(CYLINDER);
    let [low, high] = [0.0, 100.0].map(|z| {
        let curve = text.curve(format!("2 0 0 {z:?} 0 0 1 1 0 0 0 1 0 20"));
        let p_curve = text.p_curve(format!("1 0 {z:?} 1 0"));
        let vertex = text.vertex([20.0, 0.0, z]);
        let entries = [format!("1 {curve} 0 0 {TAU:?}"), format!("2 {p_curve} {surface} 0 0 {TAU:?}")];
        (text.edge(&entries, [vertex, vertex]), vertex)
    });
    let seam_curve = text.curve("1 20 0 0 0 0 1");
    // The seam's curve of a forward use is at u = 2π, that of a reversed one at 0.
    let [at_end, at_start] = [TAU, 0.0].map(|u| text.p_curve(format!("1 {u:?} 0 0 1")));
    let entries = [
        format!("1 {seam_curve} 0 0 100"),
        format!("3 {at_end} {at_start}CN {surface} 0 0 100"),
        format!("4 CN {surface} 0 {surface} 0"),
    ];
    let seam = text.edge(&entries, [low.1, high.1]);
    let wire = text.wire(&[plus(low.0), plus(seam), minus(high.0), minus(seam)]);
    let face = text.face(surface, &[wire]);
    let (model, report) = read(&text, face);
    assert_eq!((report.trims, report.exact), (4, 4));
    assert!(report.gap < GAP_RESOLUTION * 100.0, "{}", report.gap);
    assert_near(area_of(&model), 4000.0 * PI, 1e-12);
    let face = model.faces().next().unwrap();
    let edges: Vec<_> = face.to_arrays().trim.unwrap()[0].iter().map(|curve| curve.edge).collect();
    assert!(edges[1].is_some() && edges[1] == edges[3] && edges[0] != edges[2]);
    for [x, y, _] in surface_points(&face) {
        assert_near(x.hypot(y), 20.0, 1e-15);
    }
}

/// Cylinders without a seam: two circles as loops.
#[test]
fn rings_are_cut_along_a_parameter_line() {
    for start in [0.0, 2.5, -9.0] {
        for turns in [[1.0, -1.0], [-1.0, 1.0]] {
            let ring = |u: f64, v: f64, turn: f64| vec![(format!("1 {u:?} {v:?} {turn:?} 0"), [0.0, TAU])];
            let rings = [ring(start, 5.0, turns[0]), ring(0.7, 55.0, turns[1])];
            let (model, _) = region(CYLINDER, &rings);
            assert_near(area_of(&model), TAU * 20.0 * 50.0, 1e-12);
        }
    }
    // On a torus both regions between two rings exist: the material is on the left.
    let torus = "5 0 0 0 0 0 1 1 0 0 0 1 0 10 3";
    let between = |first: f64, second: f64| {
        let ring = |v: f64, turn: f64| vec![(format!("1 0 {v:?} {turn:?} 0"), [0.0, TAU])];
        area_of(&region(torus, &[ring(first, 1.0), ring(second, -1.0)]).0)
    };
    // The integral of 3 (10 + 3 cos v) over the part of the tube, times a turn.
    let expected = |a: f64, b: f64| TAU * 3.0 * (10.0 * (b - a) + 3.0 * (b.sin() - a.sin()));
    assert_near(between(0.5, 1.5), expected(0.5, 1.5), 1e-11);
    assert_near(between(1.5, 0.5), expected(1.5, 0.5 + TAU), 1e-11);
    // Around the tube, along v: the material of the ring in negative direction lies at larger u.
    let ring = |u: f64, turn: f64| vec![(format!("1 {u:?} 0 0 {turn:?}"), [0.0, TAU])];
    let (model, _) = region(torus, &[ring(1.0, -1.0), ring(2.0, 1.0)]);
    assert_near(area_of(&model), TAU * 3.0 * 10.0, 1e-11);
}

#[test]
fn a_ball_cut_by_a_plane_has_its_pole() {
    let sphere = "4 0 0 0 0 0 1 1 0 0 0 1 0 10";
    let latitude = 0.6_f64.asin();
    // As OpenCASCADE writes it: circle, seam, degenerate pole, seam.
    let loops = [rectangle([0.0, -FRAC_PI_2], [TAU, latitude])];
    let (model, report) = region(sphere, &loops);
    assert_eq!((report.trims, report.exact), (4, 4));
    assert_near(area_of(&model), TAU * 10.0 * 16.0, 1e-11);
    // Without seam and pole: one circle, with the material on its left.
    for (turn, height) in [(-1.0, 16.0), (1.0, 4.0)] {
        let ring = vec![(format!("1 0.3 {latitude:?} {turn:?} 0"), [0.0, TAU])];
        assert_near(area_of(&region(sphere, &[ring]).0), TAU * 10.0 * height, 1e-11);
    }
}

#[test]
fn a_hole_in_a_closed_surface_gets_an_outer_loop() {
    let torus = "5 0 0 0 0 0 1 1 0 0 0 1 0 10 3";
    let whole = 4.0 * PI * PI * 30.0;
    let hole = |turn: f64| region(torus, &[circle([0.1, 0.2], 0.5, turn)]);
    let (disc, report) = hole(1.0);
    assert_eq!((report.trims, report.fitted), (1, 1));
    assert!(report.gap > 0.0 && report.gap < 1e-7, "{}", report.gap);
    let (holed, report) = hole(-1.0);
    assert_eq!((report.trims, report.fitted), (5, 1));
    // The integral of 3 (10 + 3 cos v) over the disc: 30 π r² + 9 ∫ cos v, the latter
    // 2π r J1(r) cos 0.2 with J1(1/2) = 0.24226845767487...
    let expected = 30.0 * PI * 0.25 + 9.0 * TAU * 0.5 * 0.242_268_457_674_873_9 * 0.2_f64.cos();
    assert_near(area_of(&disc), expected, 1e-8);
    assert_near(area_of(&holed), whole - expected, 1e-8);
}

#[test]
fn a_cone_ends_in_its_apex() {
    let half_angle: f64 = 0.5;
    let cone = format!("3 0 0 0 0 0 1 1 0 0 0 1 0\n4 {half_angle:?}");
    let apex = -4.0 / half_angle.sin();
    let slant = -apex;
    let (model, _) = region(&cone, &[rectangle([0.0, apex], [TAU, 0.0])]);
    assert_near(area_of(&model), PI * 4.0 * slant, 1e-11);
    let lowest = surface_points(&model.faces().next().unwrap()).into_iter().map(|p| p[2]).fold(0.0, f64::min);
    assert_near(lowest, -4.0 / half_angle.tan(), 1e-14);
    // One ring, in either direction: only one side is bounded.
    for turn in [1.0, -1.0] {
        let ring = vec![(format!("1 0 0 {turn:?} 0"), [0.0, TAU])];
        assert_near(area_of(&region(&cone, &[ring]).0), PI * 4.0 * slant, 1e-11);
    }
}

#[test]
fn a_loop_on_a_torus_may_lie_beyond_the_period() {
    let torus = "5 0 0 0 0 0 1 1 0 0 0 1 0 10 3";
    let part = |shift: [f64; 2]| {
        let [u, v] = shift.map(|turns: f64| turns * TAU);
        area_of(&region(torus, &[rectangle([u - 1.0, v + 2.0], [u + 1.0, v + 4.0])]).0)
    };
    let expected = 2.0 * 3.0 * (20.0 + 3.0 * (4.0_f64.sin() - 2.0_f64.sin()));
    for shift in [[0.0, 0.0], [1.0, 0.0], [-1.0, 2.0]] {
        assert_near(part(shift), expected, 1e-11);
    }
}

/// A loop over the seam whose second half the file places a period away.
#[test]
fn curves_are_moved_by_whole_periods() {
    let loops = [vec![
        line([TAU - 0.5, 0.0], [TAU, 0.0]),
        line([0.0, 0.0], [0.5, 0.0]),
        line([0.5, 0.0], [0.5, 7.0]),
        line([0.5, 7.0], [0.0, 7.0]),
        line([TAU, 7.0], [TAU - 0.5, 7.0]),
        line([TAU - 0.5, 7.0], [TAU - 0.5, 0.0]),
    ]];
    assert_near(area_of(&region(CYLINDER, &loops).0), 20.0 * 7.0, 1e-12);
    // The same curves out of order.
    let mut shuffled = loops[0].clone();
    shuffled.swap(1, 4);
    shuffled.swap(2, 5);
    assert_near(area_of(&region(CYLINDER, &[shuffled]).0), 20.0 * 7.0, 1e-12);
}

/// A fillet of radius 5 along an edge, and its corner, a part of a torus.
#[test]
fn fillets_are_parts_of_cylinders_and_tori() {
    let cylinder = "2 0 0 5 1 0 0 0 1 0 0 0 1 5";
    let (model, report) = region(cylinder, &[rectangle([0.0, 0.0], [FRAC_PI_2, 80.0])]);
    assert_eq!(report.fitted, 0);
    assert_near(area_of(&model), FRAC_PI_2 * 5.0 * 80.0, 1e-13);
    let torus = "5 0 0 0 0 0 1 1 0 0 0 1 0 20 5";
    let (model, _) = region(torus, &[rectangle([0.0, 0.0], [FRAC_PI_2, FRAC_PI_2])]);
    assert_near(area_of(&model), FRAC_PI_2 * 5.0 * (20.0 * FRAC_PI_2 + 5.0), 1e-12);
}

/// A line in the parameters of a cylinder that is no parameter line: half a turn of a helix.
#[test]
fn a_helix_is_fitted_with_a_bound() {
    let loops = [vec![
        line([0.0, 0.0], [PI, 0.0]),
        line([PI, 0.0], [PI, 10.0]),
        line([PI, 10.0], [0.0, 3.0]),
        line([0.0, 3.0], [0.0, 0.0]),
    ]];
    let (model, report) = region(CYLINDER, &loops);
    assert_eq!((report.exact, report.fitted), (3, 1));
    let size = 60.0;
    assert!(report.gap > 0.0 && report.gap < 2e-9 * size, "{}", report.gap);
    assert_near(area_of(&model), 20.0 * PI * 6.5, 1e-8);
    // Every point of the fit is within the gap of the helix.
    let face = model.faces().next().unwrap();
    for (_, [x, y, z]) in loop_points(&face) {
        let angle = y.atan2(x).rem_euclid(TAU);
        if z > 1e-6 && (angle - PI).abs() > 1e-6 && angle.abs() > 1e-6 && angle < 4.0 {
            let off = z - (3.0 + 7.0 * angle / PI);
            assert!(off.abs() <= report.gap, "{off} {}", report.gap);
        }
    }
}

#[test]
fn left_handed_frames_keep_their_points() {
    // The frame is not right-handed: y = (0, -1, 0).
    let (model, _) = region("2 0 0 0 0 0 1 1 0 0 0 -1 0 2", &[rectangle([0.0, 0.0], [1.0, 3.0])]);
    assert_near(area_of(&model), 6.0, 1e-13);
    assert!(surface_points(&model.faces().next().unwrap()).iter().all(|point| point[1] <= 0.0));
}

#[test]
fn a_plane_without_curves_takes_the_images_of_its_edges() {
    let mut text = BrepText::new();
    let surface = text.surface(PLANE);
    let hole = text.curve("3 51 32 3.001 0 0 1 1 0 0 0 1 0 10 5");
    let square = [[1.0, 2.0], [101.0, 2.0], [101.0, 62.0], [1.0, 62.0]];
    let vertices = square.map(|[x, y]| text.vertex([x, y, 3.0]));
    let mut edges = Vec::new();
    for index in 0..4 {
        let ([x0, y0], [x1, y1]) = (square[index], square[(index + 1) % 4]);
        let length = f64::hypot(x1 - x0, y1 - y0);
        let curve =
            text.curve(format!("1 {x0:?} {y0:?} 3 {:?} {:?} 0", (x1 - x0) / length, (y1 - y0) / length));
        let vertices = [vertices[index], vertices[(index + 1) % 4]];
        edges.push(plus(text.edge(&[format!("1 {curve} 0 0 {length:?}")], vertices)));
    }
    let vertex = text.vertex([61.0, 32.0, 3.0]);
    let ellipse = text.edge(&[format!("1 {hole} 0 0 {TAU:?}")], [vertex, vertex]);
    let wires = [text.wire(&edges), text.wire(&[minus(ellipse)])];
    let face = text.face(surface, &wires);
    let (model, report) = read(&text, face);
    assert_eq!((report.exact, report.fitted), (5, 0));
    // The ellipse lies 0.001 above the plane.
    assert_near(report.gap, 0.001, 1e-12);
    assert_near(area(&model.faces().next().unwrap()), 6000.0 - 50.0 * PI, 1e-12);
}

/// A cylinder, the cap of a sphere and a cone with edges in space alone.
#[test]
fn parameter_lines_are_made_from_edges_in_space() {
    let mut text = BrepText::new();
    let surface = text.surface(CYLINDER);
    let [low, high] = [0.0, 100.0].map(|z| {
        let curve = text.curve(format!("2 0 0 {z:?} 0 0 1 0 1 0 -1 0 0 20"));
        let vertex = text.vertex([0.0, 20.0, z]);
        (text.edge(&[format!("1 {curve} 0 0 {TAU:?}")], [vertex, vertex]), vertex)
    });
    let line = text.curve("1 0 20 0 0 0 1");
    let seam = text.edge(&[format!("1 {line} 0 0 100")], [low.1, high.1]);
    let with_seam = text.wire(&[plus(low.0), plus(seam), minus(high.0), minus(seam)]);
    let rings = [text.wire(&[plus(low.0)]), text.wire(&[minus(high.0)])];
    let seamed = text.face(surface, &[with_seam]);
    let ringed = text.face(surface, &rings);
    let shell = text.shape("Sh\n", &[plus(seamed), plus(ringed)]);
    let (model, report) = read(&text, shell);
    assert_eq!(report.fitted, 0);
    assert!(report.gap < GAP_RESOLUTION * 100.0, "{}", report.gap);
    for face in model.faces() {
        assert_near(area(&face), 4000.0 * PI, 1e-12);
    }
    // A quarter of a spherical cap, through the pole.
    let mut text = BrepText::new();
    let surface = text.surface("4 0 0 0 0 0 1 1 0 0 0 1 0 10");
    let [east, north, pole] = [[8.0, 0.0, 6.0], [0.0, 8.0, 6.0], [0.0, 0.0, 10.0]].map(|p| text.vertex(p));
    let latitude = text.curve("2 0 0 6 0 0 1 1 0 0 0 1 0 8");
    let up = text.curve("2 0 0 0 1 0 0 0 1 0 0 0 1 10");
    let down = text.curve("2 0 0 0 0 -1 0 1 0 0 0 0 1 10");
    let start = 0.6_f64.asin();
    let edges = [
        plus(text.edge(&[format!("1 {latitude} 0 0 {FRAC_PI_2:?}")], [east, north])),
        plus(text.edge(&[format!("1 {up} 0 {start:?} {FRAC_PI_2:?}")], [north, pole])),
        minus(text.edge(&[format!("1 {down} 0 {start:?} {FRAC_PI_2:?}")], [east, pole])),
    ];
    let wire = text.wire(&edges);
    let face = text.face(surface, &[wire]);
    let (model, report) = read(&text, face);
    // The pole is a segment of the parameters that no edge of the file is.
    assert_eq!((report.trims, report.fitted), (4, 0));
    assert_near(area_of(&model), FRAC_PI_2 * 10.0 * 4.0, 1e-11);
}
