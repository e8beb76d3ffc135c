//! B-splines, also in complex instances, and curves with several pieces.

use crate::support::writers::step::{Id, StepText};
use crate::{areas, assert_near, face};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A list of lists, or of one list, of numbers of instances or weights.
fn nested(rows: &[Vec<String>]) -> String {
    let rows: Vec<String> = rows.iter().map(|row| format!("({})", row.join(","))).collect();
    format!("({})", rows.join(","))
}

fn segment(text: &mut StepText, from: ([f64; 3], Id), to: ([f64; 3], Id)) -> Id {
    let along = [0, 1, 2].map(|axis| to.0[axis] - from.0[axis]);
    let line = text.line(from.0, along);
    text.edge(line, [from.1, to.1], true)
}

/// The square [0, 4]² as a B-spline of degree 2 x 1, whose parameter u is not x.
fn bent_square(text: &mut StepText) -> Id {
    let columns = [0.0, 1.0, 4.0];
    let rows: Vec<Vec<String>> = columns
        .iter()
        .map(|&x| [0.0, 4.0].map(|y| format!("#{}", text.point([x, y, 0.0]))).to_vec())
        .collect();
    let poles = nested(&rows);
    text.add(format!(
        "B_SPLINE_SURFACE_WITH_KNOTS('',2,1,{poles},.UNSPECIFIED.,.F.,.F.,.F.,(3,3),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.)"
    ))
}

#[test]
fn a_spline_face_has_its_hole() {
    let mut text = StepText::new();
    let surface = bent_square(&mut text);
    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]];
    let corners = corners.map(|corner| (corner, text.vertex(corner)));
    let sides: Vec<(Id, bool)> =
        (0..4).map(|index| (segment(&mut text, corners[index], corners[(index + 1) % 4]), true)).collect();
    let placement = text.placement([2.0, 2.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let circle = text.circle(placement, 1.5);
    let vertex = text.vertex([3.5, 2.0, 0.0]);
    let hole = text.edge(circle, [vertex, vertex], true);
    let loops = [text.edge_loop(&sides), text.edge_loop(&[(hole, false)])];
    let plate = text.face(&loops, surface, true);
    let (model, report) = face(text, plate);
    // The hole is fitted to 1e-8 of its size.
    assert_near(areas(&model)[0], 16.0 - PI * 2.25, 1e-7);
    assert_eq!((report.exact, report.fitted), (4, 1));
    assert!(report.gap < 1e-7, "{}", report.gap);
}

/// Points and weights of a quarter of a circle of radius r.
fn quarter(r: f64) -> [([f64; 2], f64); 3] {
    [([r, 0.0], 1.0), ([r, r], 0.5_f64.sqrt()), ([0.0, r], 1.0)]
}

/// The complex instance of a rational B-spline that is a quarter of a cylinder.
#[test]
fn a_rational_surface_is_a_complex_instance() {
    let mut text = StepText::new();
    let arc = quarter(2.0);
    let points: Vec<Vec<String>> = arc
        .iter()
        .map(|([x, y], _)| [0.0, 5.0].map(|z| format!("#{}", text.point([*x, *y, z]))).to_vec())
        .collect();
    let weights: Vec<Vec<String>> = arc.iter().map(|(_, weight)| vec![format!("{weight:?}"); 2]).collect();
    let surface = text.add(format!(
        "(BOUNDED_SURFACE()B_SPLINE_SURFACE(2,1,{},.UNSPECIFIED.,.F.,.F.,.F.)\
         B_SPLINE_SURFACE_WITH_KNOTS((3,3),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.)\
         GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE({})REPRESENTATION_ITEM('')SURFACE())",
        nested(&points),
        nested(&weights)
    ));
    let corners = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 2.0, 5.0], [2.0, 0.0, 5.0]];
    let corners = corners.map(|corner| (corner, text.vertex(corner)));
    let mut arc = |height: f64, ends: [usize; 2]| {
        let placement = text.placement([0.0, 0.0, height], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let circle = text.circle(placement, 2.0);
        text.edge(circle, ends.map(|end| corners[end].1), true)
    };
    let (low, high) = (arc(0.0, [0, 1]), arc(5.0, [3, 2]));
    let sides = [segment(&mut text, corners[1], corners[2]), segment(&mut text, corners[3], corners[0])];
    let path = text.edge_loop(&[(low, true), (sides[0], true), (high, false), (sides[1], true)]);
    let part = text.face(&[path], surface, true);
    let (model, report) = face(text, part);
    assert_near(areas(&model)[0], FRAC_PI_2 * 2.0 * 5.0, 1e-9);
    assert_eq!(report.fitted, 0);
}

/// The points of a whole circle of radius r as a B-spline of degree 2 in four pieces.
fn whole_circle(r: f64) -> Vec<([f64; 2], f64)> {
    let side = 0.5_f64.sqrt();
    let around = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]];
    let weighted = |(index, [x, y]): (usize, [i32; 2])| {
        ([r * f64::from(x), r * f64::from(y)], if index % 2 == 1 { side } else { 1.0 })
    };
    around.into_iter().enumerate().map(weighted).collect()
}

fn rational_circle(text: &mut StepText, r: f64, height: f64) -> Id {
    let circle = whole_circle(r);
    let points: Vec<String> =
        circle.iter().map(|([x, y], _)| format!("#{}", text.point([*x, *y, height]))).collect();
    let weights: Vec<String> = circle.iter().map(|(_, weight)| format!("{weight:?}")).collect();
    text.add(format!(
        "(BOUNDED_CURVE()B_SPLINE_CURVE(2,({}),.UNSPECIFIED.,.T.,.F.)\
         B_SPLINE_CURVE_WITH_KNOTS((3,2,2,2,3),(0.,1.,2.,3.,4.),.UNSPECIFIED.)CURVE()\
         GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE(({}))REPRESENTATION_ITEM(''))",
        points.join(","),
        weights.join(",")
    ))
}

/// The vertex of a closed edge need not be where its curve begins.
#[test]
fn a_closed_spline_may_begin_anywhere() {
    for angle in [0.0_f64, 1.0, 2.5, 6.0] {
        let mut text = StepText::new();
        let circle = rational_circle(&mut text, 3.0, 0.0);
        let vertex = text.vertex([3.0 * angle.cos(), 3.0 * angle.sin(), 0.0]);
        let rim = text.edge(circle, [vertex, vertex], true);
        let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
        let surface = text.add(format!("PLANE('',#{placement})"));
        let path = text.edge_loop(&[(rim, true)]);
        let disc = text.face(&[path], surface, true);
        let (model, report) = face(text, disc);
        assert_near(areas(&model)[0], PI * 9.0, 1e-12);
        assert_eq!(report.fitted, 0);
    }
}

/// Two arcs of a closed B-spline between two vertices, one of them over the curve's end.
#[test]
fn an_edge_may_run_over_the_end_of_a_closed_spline() {
    let mut text = StepText::new();
    let circle = rational_circle(&mut text, 3.0, 0.0);
    let vertices = [-1.0_f64, 0.5].map(|angle| text.vertex([3.0 * angle.cos(), 3.0 * angle.sin(), 0.0]));
    let short = text.edge(circle, vertices, true);
    let long = text.edge(circle, [vertices[1], vertices[0]], true);
    let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let surface = text.add(format!("PLANE('',#{placement})"));
    let path = text.edge_loop(&[(short, true), (long, true)]);
    let disc = text.face(&[path], surface, true);
    let (model, _) = face(text, disc);
    assert_near(areas(&model)[0], PI * 9.0, 1e-12);
}

/// A closed B-spline that is a whole cylinder, with the seam along its two sides.
#[test]
fn a_closed_surface_has_its_seam_on_both_sides() {
    let mut text = StepText::new();
    let circle = whole_circle(2.0);
    let points: Vec<Vec<String>> = circle
        .iter()
        .map(|([x, y], _)| [0.0, 5.0].map(|z| format!("#{}", text.point([*x, *y, z]))).to_vec())
        .collect();
    let weights: Vec<Vec<String>> = circle.iter().map(|(_, weight)| vec![format!("{weight:?}"); 2]).collect();
    let surface = text.add(format!(
        "(BOUNDED_SURFACE()B_SPLINE_SURFACE(2,1,{},.UNSPECIFIED.,.T.,.F.,.F.)\
         B_SPLINE_SURFACE_WITH_KNOTS((3,2,2,2,3),(2,2),(0.,1.,2.,3.,4.),(0.,1.),.UNSPECIFIED.)\
         GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE({})REPRESENTATION_ITEM('')SURFACE())",
        nested(&points),
        nested(&weights)
    ));
    let ends = [[2.0, 0.0, 0.0], [2.0, 0.0, 5.0]].map(|end| (end, text.vertex(end)));
    let rims = [0.0, 5.0].map(|height| rational_circle(&mut text, 2.0, height));
    let rims = [0, 1].map(|index| text.edge(rims[index], [ends[index].1; 2], true));
    let seam = segment(&mut text, ends[0], ends[1]);
    let path = text.edge_loop(&[(rims[0], true), (seam, true), (rims[1], false), (seam, false)]);
    let whole = text.face(&[path], surface, true);
    let (model, report) = face(text, whole);
    assert_near(areas(&model)[0], TAU * 2.0 * 5.0, 1e-9);
    assert_eq!(report.fitted, 0);
}

/// An edge along a polyline, one along a trimmed line of opposite sense, and a Bézier curve.
#[test]
fn polylines_trimmed_curves_and_bezier_curves_bound_a_face() {
    let mut text = StepText::new();
    let corners =
        [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0]].map(|corner| (corner, text.vertex(corner)));
    // Down to y = -1 and back: a triangle of area 2 more.
    let points = [[0.0, 0.0, 0.0], [2.0, -1.0, 0.0], [4.0, 0.0, 0.0]].map(|point| text.point(point));
    let polyline = text.add(format!("POLYLINE('',(#{},#{},#{}))", points[0], points[1], points[2]));
    let polyline = text.edge(polyline, [corners[0].1, corners[1].1], true);
    let line = text.line([4.0, 0.0, 0.0], [0.0, -1.0, 0.0]);
    let line = text.add(format!(
        "TRIMMED_CURVE('',#{line},(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(-4.)),.F.,.PARAMETER.)"
    ));
    let line = text.edge(line, [corners[1].1, corners[2].1], true);
    // A parabola from (4, 4) to the origin with the tangents' corner in (0, 4): the area
    // between it and its chord is two thirds of the triangle's, 16 / 3.
    let points = [[4.0, 4.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 0.0]].map(|point| text.point(point));
    let bezier = text.add(format!(
        "BEZIER_CURVE('',2,(#{},#{},#{}),.UNSPECIFIED.,.F.,.F.)",
        points[0], points[1], points[2]
    ));
    let bezier = text.edge(bezier, [corners[2].1, corners[0].1], true);
    let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let surface = text.add(format!("PLANE('',#{placement})"));
    let path = text.edge_loop(&[(polyline, true), (line, true), (bezier, true)]);
    let part = text.face(&[path], surface, true);
    let (model, report) = face(text, part);
    assert_near(areas(&model)[0], 8.0 + 2.0 + 16.0 / 3.0, 1e-12);
    assert_eq!(report.fitted, 0);
}

/// A circle extruded along an oblique vector, and one turned about an axis beside it: the
/// area of a torus by Pappus.
#[test]
fn swept_surfaces_are_read() {
    let mut text = StepText::new();
    let placement = text.placement([5.0, 0.0, 0.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]);
    let profile = text.circle(placement, 2.0);
    let (origin, up) = (text.point([0.0; 3]), text.direction([0.0, 0.0, 1.0]));
    let axis = text.add(format!("AXIS1_PLACEMENT('',#{origin},#{up})"));
    let surface = text.add(format!("SURFACE_OF_REVOLUTION('',#{profile},#{axis})"));
    let vertex = text.vertex([7.0, 0.0, 0.0]);
    let placement = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let ring = text.circle(placement, 7.0);
    let (ring, tube) = (text.edge(ring, [vertex, vertex], true), text.edge(profile, [vertex, vertex], true));
    let path = text.edge_loop(&[(ring, true), (tube, true), (ring, false), (tube, false)]);
    let torus = text.face(&[path], surface, true);
    let (model, _) = face(text, torus);
    assert_near(areas(&model)[0], TAU * 5.0 * TAU * 2.0, 1e-9);
}
