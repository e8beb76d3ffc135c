//! Loops: joints, gaps, edges and what makes a face unreadable.

use crate::support::writers::brep::{BrepText, circle, line, minus, plus, polygon, rectangle};
use crate::{area_of, assert_near, read, region};
use nurbs_hausdorff_cad::from_brep;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const PLANE: &str = "1 0 0 0 0 0 1 1 0 0 0 1 0";

#[test]
fn joints_meet_in_equal_floats_and_lines_stay_parameter_lines() {
    // Ends that miss each other by 1e-8 of the box.
    let off = 1e-8;
    let loops = [vec![
        line([0.0, 0.0], [1.0, 0.0]),
        line([1.0, off], [1.0, 1.0]),
        line([1.0 - off, 1.0], [0.0, 1.0]),
        line([0.0, 1.0], [0.0, -off]),
    ]];
    let (model, report) = region(PLANE, &loops);
    assert!(report.gap > 0.0 && report.gap <= 2.0 * off, "{}", report.gap);
    let face = model.faces().next().unwrap().to_arrays();
    let curves = &face.trim.unwrap()[0];
    for (index, curve) in curves.iter().enumerate() {
        let next = &curves[(index + 1) % 4];
        assert_eq!(curve.control_points[1][..2], next.control_points[0][..2]);
        let axis = 1 - index % 2;
        assert_eq!(curve.control_points[0][axis], curve.control_points[1][axis]);
    }
}

/// Parameter lines that are nearly one are made one, and the gap says by how much they were moved.
#[test]
fn what_alignment_moves_is_in_the_gap() {
    let off = 5e-10;
    let loops = [vec![
        line([0.0, 0.0], [0.5, 0.0]),
        line([0.5, off], [1.0, off]),
        line([1.0, off], [1.0, 1.0]),
        line([1.0, 1.0], [0.0, 1.0]),
        line([0.0, 1.0], [0.0, 0.0]),
    ]];
    let (model, report) = region(PLANE, &loops);
    let curves = model.faces().next().unwrap().to_arrays().trim.unwrap().remove(0);
    assert_eq!(curves[0].control_points[0][1], curves[1].control_points[0][1]);
    assert!(report.gap_proven && report.gap >= off && report.gap < 1.01 * off, "{:e}", report.gap);
}

/// The end of an edge on a sphere lies 0.1 beside that of the next at the pole: the segment between them,
/// which no edge of the file is, stands for one point.
#[test]
fn a_segment_along_a_pole_has_a_proven_gap() {
    let sphere = "4 0 0 0 0 0 1 1 0 0 0 1 0 2";
    let (_, report) = region(
        sphere,
        &[vec![
            line([0.0, 0.0], [1.0, 0.0]),
            line([1.0, 0.0], [1.1, FRAC_PI_2]),
            line([1.0, FRAC_PI_2], [0.0, FRAC_PI_2]),
            line([0.0, FRAC_PI_2], [0.0, 0.0]),
        ]],
    );
    assert_eq!(report.trims, 5);
    assert!(report.gap_proven && report.gap < 1e-8, "{report:?}");
}

#[test]
fn a_loop_that_is_open_beyond_the_tolerance_is_skipped_and_reported() {
    let mut text = BrepText::new();
    let plane = text.surface(PLANE);
    let good = text.region(plane, &[rectangle([0.0, 0.0], [1.0, 1.0])]);
    let open = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])[..3].to_vec();
    let bad = text.region(plane, std::slice::from_ref(&open));
    let crossing = text.region(plane, &[polygon(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.5]])]);
    let shell = text.shape("Sh\n", &[plus(bad), plus(good), plus(crossing)]);
    let (model, report) = from_brep(&text.text(plus(shell))).unwrap();
    assert_eq!((model.faces().len(), report.faces, report.trims), (1, 1, 4));
    let skipped: Vec<_> = report.skipped.iter().map(|skipped| (skipped.face.clone(), skipped.code)).collect();
    assert_eq!(skipped, [(0.into(), "BREP_LOOP_OPEN"), (2.into(), "TRIM_LOOPS_CROSS")]);
    assert!(report.skipped[0].why.contains("open by 1.00,"), "{}", report.skipped[0].why);
    assert_eq!(model.faces().next().unwrap().name(), Some("face 1"));
    // Nothing is left.
    let mut text = BrepText::new();
    let plane = text.surface(PLANE);
    let face = text.region(plane, &[open]);
    let error = from_brep(&text.text(plus(face))).unwrap_err();
    assert_eq!(error.code(), "BREP_UNREADABLE");
}

/// A ring between two circles, each one rational piece of degree 5, and thinner than an octagon in either
/// is off it: the inner one is a hole whichever way it runs.
#[test]
fn a_thin_ring_between_single_curves_has_its_hole() {
    // J. J. Chou, Higher order Bézier circles, Computer-Aided Design 27(4) (1995).
    let circle = |radius: f64, turn: f64| {
        let points = [[1.0, 0.0], [1.0, 4.0], [-3.0, 2.0], [-3.0, -2.0], [1.0, -4.0], [1.0, 0.0]];
        let poles: String = points
            .iter()
            .enumerate()
            .map(|(k, [x, y])| {
                let weight = if k % 5 == 0 { 1.0 } else { 0.2 };
                format!("{:?} {:?} {weight:?} ", radius * x, turn * radius * y)
            })
            .collect();
        vec![(format!("7 1 0 5 6 2 {poles} 0 6 1 6"), [0.0, 1.0])]
    };
    for turn in [1.0, -1.0] {
        let (model, report) = region(PLANE, &[circle(10.0, 1.0), circle(9.6, turn)]);
        assert_near(area_of(&model), PI * (100.0 - 9.6 * 9.6), 1e-6);
        assert_eq!(report.skipped, []);
    }
}

/// The gap of a curve that lies 0.01 or 0.25 beside its edge.
#[test]
fn gaps_are_those_of_the_edges_in_space() {
    for (surface, height) in [(PLANE, 0.01), ("2 0 0 0 0 0 1 1 0 0 0 1 0 1", 0.25)] {
        let mut text = BrepText::new();
        let surface = text.surface(surface);
        let vertices = [[0.0; 3]; 4].map(|point| text.vertex(point));
        let mut edges = Vec::new();
        for (index, (entry, [first, last])) in rectangle([0.0, 0.0], [1.0, 2.0]).into_iter().enumerate() {
            let p_curve = text.p_curve(entry);
            let mut entries = vec![format!("2 {p_curve} {surface} 0 {first:?} {last:?}")];
            // The edge at u = 1.
            if index == 1 {
                let (sin, cos) = 1.0_f64.sin_cos();
                let curve = match height {
                    0.01 => text.curve("1 1 0 0.01 0 1 0"),
                    _ => text.curve(format!("1 {:?} {:?} 0 0 0 1", 1.25 * cos, 1.25 * sin)),
                };
                entries.push(format!("1 {curve} 0 0 2"));
            }
            edges.push(plus(text.edge(&entries, [vertices[index], vertices[(index + 1) % 4]])));
        }
        let wire = text.wire(&edges);
        let face = text.face(surface, &[wire]);
        let (_, report) = read(&text, face);
        assert!((height..1.1 * height).contains(&report.gap), "{}", report.gap);
    }
}

/// The gap of a face whose first curve and its edge are these, over [0, 1], from [0, 0] to the
/// start of the next of the curves.
fn gap_of(surface: &str, curve: String, edge: String, others: &[String]) -> f64 {
    let mut text = BrepText::new();
    let surface = text.surface(surface);
    let vertices: Vec<usize> = (0..=others.len()).map(|_| text.vertex([0.0; 3])).collect();
    let mut edges = Vec::new();
    for (index, entry) in std::iter::once(&curve).chain(others).enumerate() {
        let p_curve = text.p_curve(entry);
        let mut entries = vec![format!("2 {p_curve} {surface} 0 0 1")];
        if index == 0 {
            let space = text.curve(&edge);
            entries.push(format!("1 {space} 0 0 1"));
        }
        let ends = [vertices[index], vertices[(index + 1) % vertices.len()]];
        edges.push(plus(text.edge(&entries, ends)));
    }
    let wire = text.wire(&edges);
    let face = text.face(surface, &[wire]);
    read(&text, face).1.gap
}

/// A cubic spline along v = 0 but for one control point, between the 8th and the 9th of
/// sixteen equal parts, whose basis function has its largest value of 2/3 there.
#[test]
fn a_bump_between_samples_is_within_the_gap() {
    let inner = [0.505, 0.515, 0.525, 0.535, 0.545];
    let knots = [&[0.0; 4], inner.as_slice(), &[1.0; 4]].concat();
    let poles: String = (0..9)
        .map(|i| {
            let x: f64 = knots[i + 1..i + 4].iter().sum::<f64>() / 3.0;
            format!(" {x:?} {:?}", if i == 4 { -0.03 } else { 0.0 })
        })
        .collect();
    let pairs: String = inner.map(|knot| format!(" {knot:?} 1")).concat();
    let curve = format!("7 0 0 3 9 7{poles} 0 4{pairs} 1 4");
    // An edge along the plane's u axis.
    let others = ["1 1 0 0 1", "1 1 1 -1 0", "1 0 1 0 -1"].map(str::to_owned);
    let gap = gap_of(PLANE, curve, "1 0 0 0 1 0 0".to_owned(), &others);
    assert!((0.02..0.022).contains(&gap), "{gap}");
}

/// A parameter line whose parameter is the square of that of its circle: only nearest points
/// are 0.3 apart.
#[test]
fn a_gap_does_not_depend_on_the_parameters() {
    let curve = "6 0 2 0 0 0.25 0 1 0".to_owned();
    let edge = "2 0 0 0 0 0 1 1 0 0 0 1 0 20.3".to_owned();
    let others = ["1 1 0 0 1", "1 1 1 -1 0", "1 0 1 0 -1"].map(str::to_owned);
    let gap = gap_of("2 0 0 0 0 0 1 1 0 0 0 1 0 20", curve, edge, &others);
    assert!((0.3..0.33).contains(&gap), "{gap}");
}

#[test]
fn a_face_without_loops_is_its_whole_surface() {
    let whole = |surface: &str| {
        let mut text = BrepText::new();
        let surface = text.surface(surface);
        let face = text.face(surface, &[]);
        read(&text, face).0
    };
    let sphere = whole("4 0 0 0 0 0 1 1 0 0 0 1 0 10");
    assert!(sphere.faces().next().unwrap().trim().is_none());
    assert_near(area_of(&sphere), 2.0 * TAU * 100.0, 1e-11);
    assert_near(area_of(&whole("10 0 1 0 5\n2 0 0 0 0 0 1 1 0 0 0 1 0 20")), 100.0, 1e-12);
    let mut text = BrepText::new();
    let plane = text.surface(PLANE);
    let face = text.face(plane, &[]);
    let error = from_brep(&text.text(plus(face))).unwrap_err();
    assert!(error.to_string().contains("no bounds"), "{error}");
}

/// Internal edges and vertices bound nothing.
#[test]
fn internal_edges_are_left_out() {
    let mut text = BrepText::new();
    let plane = text.surface(PLANE);
    let mut edges = Vec::new();
    let ends = text.vertex([0.0; 3]);
    for (entry, [first, last]) in rectangle([0.0, 0.0], [4.0, 4.0]) {
        let p_curve = text.p_curve(entry);
        edges.push(plus(text.edge(&[format!("2 {p_curve} {plane} 0 {first:?} {last:?}")], [ends, ends])));
    }
    let inner = text.p_curve("1 1 1 1 0");
    let inner = text.edge(&[format!("2 {inner} {plane} 0 0 1")], [ends, ends]);
    edges.insert(2, crate::support::writers::brep::Child { shape: inner, sign: 'i', location: 0 });
    let wire = text.wire(&edges);
    let inner_wire = text.wire(&[plus(inner)]);
    let face = text.shape(
        format!("Fa\n0  1e-07 {plane} 0\n2 1\n"),
        &[plus(wire), crate::support::writers::brep::Child { shape: inner_wire, sign: 'e', location: 0 }],
    );
    let (model, report) = read(&text, face);
    assert_eq!(report.trims, 4);
    assert_near(area_of(&model), 16.0, 1e-14);
}

/// A wire used in reverse turns the directions of all its edges.
#[test]
fn directions_of_edges_and_wires_multiply() {
    let mut text = BrepText::new();
    let surface = text.surface("4 0 0 0 0 0 1 1 0 0 0 1 0 10");
    let poles = [-FRAC_PI_2, FRAC_PI_2].map(|v| {
        let p_curve = text.p_curve(format!("1 0 {v:?} 1 0"));
        let vertex = text.vertex([0.0, 0.0, 10.0 * v.sin()]);
        (text.degenerate(&[format!("2 {p_curve} {surface} 0 0 {TAU:?}")], vertex), vertex)
    });
    let [at_end, at_start] = [TAU, 0.0].map(|u| text.p_curve(format!("1 {u:?} 0 0 1")));
    let entry = format!("3 {at_end} {at_start}CN {surface} 0 {:?} {FRAC_PI_2:?}", -FRAC_PI_2);
    let seam = text.edge(&[entry], [poles[0].1, poles[1].1]);
    let wire = text.wire(&[plus(poles[0].0), plus(seam), minus(poles[1].0), minus(seam)]);
    let turned = text.wire(&[plus(seam), plus(poles[1].0), minus(seam), minus(poles[0].0)]);
    let forward = text.face(surface, &[wire]);
    let reversed = text.shape(format!("Fa\n0  1e-07 {surface} 0\n"), &[minus(turned)]);
    let shell = text.shape("Sh\n", &[plus(forward), minus(reversed)]);
    let (model, report) = read(&text, shell);
    assert_eq!((report.trims, report.exact), (8, 8));
    for (face, expected) in model.faces().zip([false, true]) {
        assert_eq!(face.is_reversed(), expected);
        assert_near(crate::area::area(&face), 2.0 * TAU * 100.0, 1e-11);
    }
}

/// A square whose sides end 0.01 beside a corner: within the tolerance of that vertex.
#[test]
fn the_tolerance_of_a_vertex_closes_a_loop() {
    let off = 0.01;
    for (surface, tolerance) in [(PLANE, 0.006), ("2 0 0 0 0 0 1 1 0 0 0 1 0 1", 0.006), (PLANE, 0.004)] {
        let mut text = BrepText::new();
        let surface = text.surface(surface);
        let corners = [[0.0; 3]; 4].map(|point| text.loose_vertex(point, tolerance));
        let ends = [
            [[0.0, 0.0], [1.0 - off, 0.0]],
            [[1.0, 0.0], [1.0, 1.0]],
            [[1.0, 1.0], [0.0, 1.0]],
            [[0.0, 1.0], [0.0, 0.0]],
        ];
        let edges = [0, 1, 2, 3].map(|index| {
            let (entry, [first, last]) = line(ends[index][0], ends[index][1]);
            let p_curve = text.p_curve(entry);
            let entries = [format!("2 {p_curve} {surface} 0 {first:?} {last:?}")];
            plus(text.edge(&entries, [corners[index], corners[(index + 1) % 4]]))
        });
        let wire = text.wire(&edges);
        let face = text.face(surface, &[wire]);
        let read = from_brep(&text.text(plus(face)));
        if tolerance < off / 2.0 {
            assert!(read.unwrap_err().to_string().contains("expected at most 0.00800"));
            continue;
        }
        let (model, report) = read.unwrap();
        // A segment along the missing part, or an end moved by half of it.
        assert!(report.gap > 0.4 * off && report.gap <= 1.001 * off, "{}", report.gap);
        assert_near(area_of(&model), 1.0, 1e-12);
    }
}

/// A disc with a hole that touches its boundary in the point at which both circles begin, and one
/// that nearly does: which of them lies in the other is not seen there.
#[test]
fn a_hole_that_touches_the_outer_loop_where_both_begin_is_a_hole() {
    for radius in [3.447_254_171_715_894, 0.5, 9.0] {
        for gap in [0.0, 1e-9] {
            for turns in [[1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
                let hole = circle([10.0 - radius - gap, 0.0], radius, turns[1]);
                let mut loops = [circle([0.0, 0.0], 10.0, turns[0]), hole];
                for _ in 0..2 {
                    loops.reverse();
                    let (model, report) = region(PLANE, &loops);
                    assert!(report.skipped.is_empty(), "{:?}", report.skipped);
                    let expected = PI * (100.0 - radius * radius);
                    assert_near(area_of(&model), expected, 1e-9);
                }
            }
        }
    }
}
