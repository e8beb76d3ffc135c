//! Edges without a curve in the parameters: plane sections, and projections with a fit.

use crate::area::{area, loop_points};
use crate::support::writers::brep::{BrepText, line, minus, plus};
use crate::{area_of, assert_near, read};
use nurbs_hausdorff::{Model, ReadReport};
use nurbs_hausdorff_cad::from_brep;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const CYLINDER: &str = "2 0 0 0 0 0 1 1 0 0 0 1 0 20";

/// A face of closed edges, each a loop of its own, used forward or in reverse.
fn of_rings(surface: &str, rings: &[(String, bool)]) -> (Model, ReadReport) {
    let mut text = BrepText::new();
    let surface = text.surface(surface);
    let mut wires = Vec::new();
    for (curve, forward) in rings {
        let curve = text.curve(curve.clone());
        let vertex = text.vertex([0.0; 3]);
        let edge = text.edge(&[format!("1 {curve} 0 0 {TAU:?}")], [vertex, vertex]);
        wires.push(text.wire(&[if *forward { plus(edge) } else { minus(edge) }]));
    }
    let face = text.face(surface, &wires);
    read(&text, face)
}

/// The section of a cylinder of radius r about z by the plane z = a + b x, counter-clockwise.
fn ellipse(r: f64, a: f64, b: f64) -> String {
    let slant = b.hypot(1.0);
    let [x, z] = [1.0 / slant, b / slant];
    format!("3 0 0 {a:?} {:?} 0 {x:?} {x:?} 0 {z:?} 0 1 0\n{:?} {r:?}", -z, r * slant)
}

/// Asserts that the gap is proven, and no more than the rounding that its bound contains: at
/// coordinates up to 100, a few hundred roundings.
fn assert_exact(report: &ReadReport) {
    assert!(report.gap_proven);
    assert!(report.gap < 5e-11, "{}", report.gap);
}

#[test]
fn plane_sections_of_a_cylinder_are_exact() {
    // Heights from x to 60 + x / 2, on average 60.
    let rings = [(ellipse(20.0, 0.0, 1.0), true), (ellipse(20.0, 60.0, 0.5), false)];
    let (model, report) = of_rings(CYLINDER, &rings);
    assert_eq!((report.exact, report.fitted), (4, 0));
    assert_exact(&report);
    let face = model.faces().next().unwrap();
    assert_near(area(&face), TAU * 20.0 * 60.0, 1e-12);
    let cuts: Vec<_> =
        loop_points(&face).into_iter().map(|(_, [x, _, z])| (z - x, z - 60.0 - x / 2.0)).collect();
    let on_cut = cuts.iter().filter(|(low, high)| low.abs() < 1e-12 || high.abs() < 1e-12).count();
    // All points but those inside of the two walls along the ring's cut.
    assert!(on_cut >= cuts.len() - 14, "{on_cut} of {}", cuts.len());
}

/// Two half ellipses in the planes z = ± x: a quarter of the common part of two equal
/// cylinders, of area 4 r².
#[test]
fn the_common_part_of_two_cylinders_is_exact() {
    let mut text = BrepText::new();
    let surface = text.surface(CYLINDER);
    let ends = [[0.0, -20.0, 0.0], [0.0, 20.0, 0.0]].map(|point| text.vertex(point));
    let edges = [-1.0, 1.0].map(|slope| {
        let curve = text.curve(ellipse(20.0, 0.0, slope));
        text.edge(&[format!("1 {curve} 0 {:?} {FRAC_PI_2:?}", -FRAC_PI_2)], ends)
    });
    let wire = text.wire(&[plus(edges[0]), minus(edges[1])]);
    let face = text.face(surface, &[wire]);
    let (model, report) = read(&text, face);
    assert_eq!((report.exact, report.fitted), (2, 0));
    assert_near(area_of(&model), 4.0 * 400.0, 1e-12);
}

/// The cone x² + y² = (k z)² above the plane z = a + b x, seen along z, is an ellipse of area
/// π (k a)² (1 - (k b)²)^(-3/2).
#[test]
fn plane_sections_of_a_cone_are_exact() {
    let (k, a, b) = (0.5_f64, 40.0, 0.3);
    let shrink = 1.0 - (k * b).powi(2);
    let [x_axis, y_axis] = [k * a / shrink, k * a / shrink.sqrt()];
    let x = k * k * a * b / shrink;
    let slant = b.hypot(1.0);
    let conic = format!(
        "3 {x:?} 0 {:?} {:?} 0 {:?} {:?} 0 {:?} 0 1 0\n{:?} {y_axis:?}",
        a + b * x,
        -b / slant,
        1.0 / slant,
        1.0 / slant,
        b / slant,
        x_axis * slant
    );
    // The apex in the origin: the surface's origin is at z = 10, of radius 5.
    let half_angle = k.atan();
    let cone = format!("3 0 0 10 0 0 1 1 0 0 0 1 0\n5 {half_angle:?}");
    let (model, report) = of_rings(&cone, &[(conic, false)]);
    assert_eq!(report.fitted, 0);
    assert_exact(&report);
    assert_near(area_of(&model), PI * x_axis * y_axis / half_angle.sin(), 1e-12);
}

/// An extruded parabola cut by a plane: x from 0 to 2, y = x² / 4, z from 0 to 1 + x.
#[test]
fn plane_sections_of_extruded_conics_are_exact() {
    let mut text = BrepText::new();
    // The parabola (t² / 4, t, 0), y = t; the plane is z = 1 + y.
    let surface = text.surface("6 0 0 1\n4 0 0 0 0 0 1 1 0 0 0 1 0 1");
    let points = [[0.0, 0.0, 0.0], [1.0, 2.0, 0.0], [1.0, 2.0, 3.0], [0.0, 0.0, 1.0]];
    let corners = points.map(|point| text.vertex(point));
    let foot = text.curve("4 0 0 0 0 0 1 1 0 0 0 1 0 1");
    // (t² / 4, t, 1 + t): the axis of the parabola is x, the tangent at its vertex (0, 1, 1).
    let root = 0.5_f64.sqrt();
    // With focal length f = 2 and s = √2 t: s² / 8 = t² / 4.
    let top = text.curve(format!("4 0 0 1 0 {:?} {root:?} 1 0 0 0 {root:?} {root:?} 2", -root));
    let sides = [[1.0, 2.0], [0.0, 0.0]].map(|[x, y]| text.curve(format!("1 {x:?} {y:?} 0 0 0 1")));
    let edges = [
        plus(text.edge(&[format!("1 {foot} 0 0 2")], [corners[0], corners[1]])),
        plus(text.edge(&[format!("1 {} 0 0 3", sides[0])], [corners[1], corners[2]])),
        minus(text.edge(&[format!("1 {top} 0 0 {:?}", 8.0_f64.sqrt())], [corners[3], corners[2]])),
        minus(text.edge(&[format!("1 {} 0 0 1", sides[1])], [corners[0], corners[3]])),
    ];
    let wire = text.wire(&edges);
    let face = text.face(surface, &[wire]);
    let (model, report) = read(&text, face);
    assert_eq!((report.exact, report.fitted), (4, 0));
    assert_exact(&report);
    // ∫ (1 + t) √(1 + t²/4) dt over [0, 2].
    let expected = 2.0_f64.sqrt() + 1.0_f64.asinh() + 4.0 / 3.0 * (2.0 * 2.0_f64.sqrt() - 1.0);
    assert_near(area_of(&model), expected, 1e-9);
}

/// A curve of the file that is 0.05 off the ellipse of its edge gives way to the section.
#[test]
fn the_section_that_is_an_edge_replaces_a_curve_that_misses_it() {
    let mut text = BrepText::new();
    let surface = text.surface(CYLINDER);
    let (first, last) = (-1.0_f64, 1.0_f64);
    let height = |u: f64| 60.0 + 10.0 * u.cos();
    let corner = |u: f64, z: f64| [20.0 * u.cos(), 20.0 * u.sin(), z];
    let corners =
        [corner(first, 0.0), corner(last, 0.0), corner(last, height(last)), corner(first, height(first))];
    let corners = corners.map(|point| text.vertex(point));
    let mut straight = |from: [f64; 2], to: [f64; 2], vertices: [usize; 2]| {
        let (entry, [start, end]) = line(from, to);
        let p_curve = text.p_curve(entry);
        plus(text.edge(&[format!("2 {p_curve} {surface} 0 {start:?} {end:?}")], vertices))
    };
    let foot = straight([first, 0.0], [last, 0.0], [corners[0], corners[1]]);
    let right = straight([last, 0.0], [last, height(last)], [corners[1], corners[2]]);
    let left = straight([first, height(first)], [first, 0.0], [corners[3], corners[0]]);
    let top = text.curve(ellipse(20.0, 60.0, 0.5));
    // A parabola through the ends and about the middle of the cosine.
    let middle = 2.0 * (height(0.0) + 0.05) - height(first);
    let p_curve =
        text.p_curve(format!("6 0 2 {first:?} {:?} 0 {middle:?} {last:?} {:?}", height(first), height(last)));
    let entries = [format!("1 {top} 0 {first:?} {last:?}"), format!("2 {p_curve} {surface} 0 0 1")];
    let top = minus(text.edge(&entries, [corners[3], corners[2]]));
    let wire = text.wire(&[foot, right, top, left]);
    let face = text.face(surface, &[wire]);
    let (model, report) = read(&text, face);
    assert_eq!((report.exact, report.fitted), (4, 0));
    assert_exact(&report);
    assert_near(area_of(&model), 20.0 * (120.0 + 20.0 * 1.0_f64.sin()), 1e-12);
}

/// A circle about an axis that is not the sphere's: its cap has the area 2π R h.
#[test]
fn a_circle_on_a_sphere_is_fitted() {
    let [nx, nz] = [0.6, 0.8];
    let circle =
        |x: f64, z: f64, r: f64| format!("2 {x:?} 0 {z:?} {nx:?} 0 {nz:?} {nz:?} 0 {:?} 0 1 0 {r:?}", -nx);
    // The plane is 9.5 from the centre, and leaves out the pole.
    let cap = [(circle(9.5 * nx, 9.5 * nz, 9.75_f64.sqrt()), true)];
    let (model, report) = of_rings("4 0 0 0 0 0 1 1 0 0 0 1 0 10", &cap);
    assert_eq!((report.exact, report.fitted), (0, 1));
    assert!(report.gap > 0.0 && report.gap < 1e-6, "{}", report.gap);
    assert_near(area_of(&model), TAU * 10.0 * 0.5, 1e-6);
    let off = |[x, _, z]: [f64; 3]| (x * nx + z * nz - 9.5).abs();
    let farthest =
        loop_points(&model.faces().next().unwrap()).into_iter().map(|(_, p)| off(p)).fold(0.0, f64::max);
    assert!(farthest <= report.gap, "{farthest} {}", report.gap);
    // Around the pole the circle is a ring.
    let around = [(circle(2.0 * nx, 2.0 * nz, 96.0_f64.sqrt()), true)];
    let (model, report) = of_rings("4 0 0 0 0 0 1 1 0 0 0 1 0 10", &around);
    assert_eq!(report.fitted, 1);
    assert_near(area_of(&model), TAU * 10.0 * 8.0, 1e-6);
}

/// The plane z = 0 as a Bézier surface (4u + u², 4v + uv, 0), with a circle cut from it.
#[test]
fn an_edge_on_a_spline_is_fitted() {
    let surface = "8 0 0 2 1 0 0 0 0 4 0 2 0 0 2 4.5 0 5 0 0 5 5 0";
    let circle = "2 2.5 2 0 0 0 1 1 0 0 0 1 0 1.2".to_owned();
    let (model, report) = of_rings(surface, &[(circle, true)]);
    assert_eq!((report.exact, report.fitted), (0, 1));
    assert!(report.gap > 0.0 && report.gap < 2e-7, "{}", report.gap);
    assert_near(area_of(&model), PI * 1.44, 1e-7);
}

/// A closed surface that is not periodic, with both ends and its seam as edges in space.
#[test]
fn a_seam_without_curves_is_on_both_sides() {
    // A square tube with round corners: closed in u, quadratic, extruded along z.
    let around = [
        [2.0, 0.0],
        [2.0, 2.0],
        [0.0, 2.0],
        [-2.0, 2.0],
        [-2.0, 0.0],
        [-2.0, -2.0],
        [0.0, -2.0],
        [2.0, -2.0],
        [2.0, 0.0],
    ];
    let poles: String = around.iter().map(|[x, y]| format!("{x:?} {y:?} 0 {x:?} {y:?} 3\n")).collect();
    let knots = "0 3 1 2 2 2 3 2 4 3";
    let surface = format!("9 0 0 0 0 2 1 9 2 5 2 {poles} {knots} 0 2 1 2");
    let mut text = BrepText::new();
    let surface = text.surface(surface);
    let rings = [0.0, 3.0].map(|z| {
        let poles: String = around.iter().map(|[x, y]| format!("{x:?} {y:?} {z:?} ")).collect();
        let curve = text.curve(format!("7 0 0 2 9 5 {poles} {knots}"));
        let vertex = text.vertex([2.0, 0.0, z]);
        (text.edge(&[format!("1 {curve} 0 0 4")], [vertex, vertex]), vertex)
    });
    let seam = text.curve("1 2 0 0 0 0 1");
    let seam = text.edge(&[format!("1 {seam} 0 0 3")], [rings[0].1, rings[1].1]);
    let wire = text.wire(&[plus(rings[0].0), plus(seam), minus(rings[1].0), minus(seam)]);
    let face = text.face(surface, &[wire]);
    let (model, report) = read(&text, face);
    assert_eq!((report.exact, report.fitted), (4, 0));
    // Each quarter is a parabola of control points (2, 0), (2, 2), (0, 2): its speed is
    // 4 √((1 - t)² + t²), of length 2 + √2 asinh 1.
    let length = 4.0 * (2.0 + 2.0_f64.sqrt() * 1.0_f64.asinh());
    assert_near(area_of(&model), 3.0 * length, 1e-9);
}

#[test]
fn an_edge_off_its_surface_is_reported() {
    let mut text = BrepText::new();
    let surface = text.surface(CYLINDER);
    let curve = text.curve("2 0 0 5 0 0 1 1 0 0 0 1 0 25");
    let vertex = text.vertex([25.0, 0.0, 5.0]);
    let edge = text.edge(&[format!("1 {curve} 0 0 {TAU:?}")], [vertex, vertex]);
    let wire = text.wire(&[plus(edge)]);
    let face = text.face(surface, &[wire]);
    let error = from_brep(&text.text(plus(face))).unwrap_err();
    assert!(error.to_string().contains("from the surface"), "{error}");
}

/// The top ring of a cylinder in two arcs, whose seam has curves and stands last in the wire:
/// at the seam's vertex the walk may go on along the ring or down the seam.
#[test]
fn a_loop_is_put_together_from_its_circuits() {
    for order in [[0, 1, 2, 3, 4], [1, 0, 2, 3, 4], [3, 1, 0, 4, 2], [4, 0, 2, 1, 3]] {
        let mut text = BrepText::new();
        let surface = text.surface(CYLINDER);
        let [low, high, back] =
            [[20.0, 0.0, 0.0], [20.0, 0.0, 30.0], [-20.0, 0.0, 30.0]].map(|p| text.vertex(p));
        let [foot, top] = [0.0, 30.0].map(|z| text.curve(format!("2 0 0 {z:?} 0 0 1 1 0 0 0 1 0 20")));
        let [at_end, at_start] = [TAU, 0.0].map(|u| text.p_curve(format!("1 {u:?} 0 0 1")));
        let seam = text.edge(&[format!("3 {at_end} {at_start}CN {surface} 0 0 30")], [low, high]);
        let ring = text.edge(&[format!("1 {foot} 0 0 {TAU:?}")], [low, low]);
        let first = text.edge(&[format!("1 {top} 0 0 {PI:?}")], [high, back]);
        let second = text.edge(&[format!("1 {top} 0 {PI:?} {TAU:?}")], [back, high]);
        let edges = [minus(second), minus(first), plus(seam), plus(ring), minus(seam)];
        let wire = text.wire(&order.map(|index| edges[index]));
        let face = text.face(surface, &[wire]);
        let (model, report) = read(&text, face);
        assert_eq!((report.exact, report.fitted), (5, 0), "{order:?}");
        assert_near(area_of(&model), TAU * 20.0 * 30.0, 1e-12);
    }
}
