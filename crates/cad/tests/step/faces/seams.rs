//! Faces around a period whose edges lie across the seam of their surface.

use crate::support::writers::step::{Id, StepText};
use crate::{areas, assert_near, face};
use std::collections::HashMap;
use std::f64::consts::TAU;

const RADIUS: f64 = 2.0;

/// A loop on a cylinder about z through points (angle, height): arcs between points of equal height,
/// lines between others. An angle may leave the first period; points a period apart are one vertex.
fn path(text: &mut StepText, points: &[[f64; 2]], is_ring: bool) -> Id {
    let mut vertices: HashMap<[u64; 2], Id> = HashMap::new();
    let place = |[angle, height]: [f64; 2]| [RADIUS * angle.cos(), RADIUS * angle.sin(), height];
    let mut vertex = |text: &mut StepText, [angle, height]: [f64; 2]| {
        let key = [angle.rem_euclid(TAU).to_bits(), height.to_bits()];
        *vertices.entry(key).or_insert_with(|| text.vertex(place([angle, height])))
    };
    let last = [points[0][0] + if is_ring { TAU } else { 0.0 }, points[0][1]];
    let mut edges = Vec::new();
    for (index, &from) in points.iter().enumerate() {
        let to = points.get(index + 1).copied().unwrap_or(last);
        let ends = [vertex(text, from), vertex(text, if to == last { points[0] } else { to })];
        let edge = if from[1] == to[1] {
            let placement = text.placement([0.0, 0.0, from[1]], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
            let circle = text.circle(placement, RADIUS);
            text.edge(circle, ends, to[0] > from[0])
        } else {
            let line = text.line(place(from), [0.0, 0.0, to[1] - from[1]]);
            text.edge(line, ends, true)
        };
        edges.push((edge, true));
    }
    text.edge_loop(&edges)
}

/// The area of a face of a cylinder of these loops.
fn area_of(text: &mut StepText, loops: &[Id]) -> f64 {
    let placement = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let surface = text.add(format!("CYLINDRICAL_SURFACE('',#{placement},{RADIUS:?})"));
    let whole = text.face(loops, surface, true);
    let (model, report) = face(std::mem::take(text), whole);
    assert!(report.gap < 1e-9, "{}", report.gap);
    areas(&model)[0]
}

/// A full cylinder without a seam edge has its holes anywhere: also where its rims begin, with one hole and
/// with two, and upside down.
#[test]
fn a_hole_may_lie_where_the_rims_begin() {
    for middles in [vec![0.0], vec![0.0, 2.0], vec![3.0, 0.4]] {
        let mut text = StepText::new();
        let mut loops = vec![path(&mut text, &[[0.0, 0.0]], true)];
        // The upper rim runs the other way: its circle is used in reverse.
        let placement = text.placement([0.0, 0.0, 3.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let circle = text.circle(placement, RADIUS);
        let vertex = text.vertex([RADIUS, 0.0, 3.0]);
        let rim = text.edge(circle, [vertex, vertex], true);
        loops.push(text.edge_loop(&[(rim, false)]));
        for &middle in &middles {
            let [low, high] = [middle - 0.5, middle + 0.5];
            loops.push(path(&mut text, &[[low, 1.0], [low, 2.0], [high, 2.0], [high, 1.0]], false));
        }
        let expected = RADIUS * (3.0 * TAU - middles.len() as f64);
        assert_near(area_of(&mut text, &loops), expected, 1e-9);
    }
}

/// A rim may run back over the place at which it begins: the region below it is of height 1.5 for an angle
/// of 1, 0.5 for one of 0.5, and 2 for the rest.
#[test]
fn a_rim_may_run_back_below_its_start() {
    let mut text = StepText::new();
    let low = path(&mut text, &[[0.0, 0.0]], true);
    let rim = [[0.0, 2.0], [0.5, 2.0], [0.5, 1.0], [-0.5, 1.0], [-0.5, 0.5], [1.0, 0.5], [1.0, 2.0]];
    let high = path(&mut text, &rim, true);
    // The rim has the material on its right, so that its bound turns it.
    let bounds = [text.bound(low, true), text.bound(high, false)];
    let placement = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let surface = text.add(format!("CYLINDRICAL_SURFACE('',#{placement},{RADIUS:?})"));
    let whole = text.add(format!("ADVANCED_FACE('',(#{},#{}),#{surface},.T.)", bounds[0], bounds[1]));
    let (model, _) = face(text, whole);
    assert_near(areas(&model)[0], RADIUS * (1.5 + 0.25 + 2.0 * (TAU - 1.5)), 1e-9);
}

/// The corners of a square, and the knots of a closed curve of three degrees through or beside them: clamped,
/// and with control points that repeat beyond the period.
const SQUARE: [[f64; 2]; 4] = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];

/// A closed B-spline surface of height 1 over the square, of this degree, with `repeated` control points
/// after the four.
fn prism(text: &mut StepText, degree: usize, repeated: usize, knots: &str) -> Id {
    let rows: Vec<String> = (0..4 + repeated)
        .map(|index| {
            let [x, y] = SQUARE[index % 4];
            format!("(#{},#{})", text.point([x, y, 0.0]), text.point([x, y, 1.0]))
        })
        .collect();
    text.add(format!(
        "B_SPLINE_SURFACE_WITH_KNOTS('',{degree},1,({}),.UNSPECIFIED.,.T.,.F.,.F.,{knots},.UNSPECIFIED.)",
        rows.join(",")
    ))
}

/// A face over the part of a prism from one point of its base over the others, given as a B-spline with
/// this degree and knots, to the last.
fn strip(text: &mut StepText, surface: Id, base: &[[f64; 2]], degree: usize, knots: &str) -> Id {
    let ends = [base[0], base[base.len() - 1]];
    let level = |text: &mut StepText, z: f64| {
        let poles: Vec<String> = base.iter().map(|&[x, y]| format!("#{}", text.point([x, y, z]))).collect();
        let curve = text.add(format!(
            "B_SPLINE_CURVE_WITH_KNOTS('',{degree},({}),.UNSPECIFIED.,.F.,.F.,{knots},.UNSPECIFIED.)",
            poles.join(",")
        ));
        let vertices = ends.map(|[x, y]| text.vertex([x, y, z]));
        (text.edge(curve, vertices, true), vertices)
    };
    let (low, high) = (level(text, 0.0), level(text, 1.0));
    let sides = [0, 1].map(|end| {
        let line = text.line([ends[end][0], ends[end][1], 0.0], [0.0, 0.0, 1.0]);
        text.edge(line, [low.1[end], high.1[end]], true)
    });
    let path = text.edge_loop(&[(low.0, true), (sides[1], true), (high.0, false), (sides[0], false)]);
    text.face(&[path], surface, true)
}

/// An edge crosses the seam of a closed B-spline surface at its middle: two sides of a square prism.
#[test]
fn an_edge_crosses_the_seam_of_a_clamped_spline() {
    let mut text = StepText::new();
    let surface = prism(&mut text, 1, 1, "(2,1,1,1,2),(2,2),(0.,1.,2.,3.,4.),(0.,1.)");
    let base = [SQUARE[3], SQUARE[0], SQUARE[1]];
    let whole = strip(&mut text, surface, &base, 1, "(2,1,2),(0.,1.,2.)");
    let (model, report) = face(text, whole);
    assert_near(areas(&model)[0], 2.0 * 2_f64.sqrt(), 1e-9);
    assert!(report.gap < 1e-9, "{}", report.gap);
}

/// The same of a quadratic spline with control points that repeat, as Parasolid writes it. A span is the
/// parabola (t, t² / 2 + const) for t from -1/2 to 1/2 turned by quarters, of length (√2 + asinh 1) / 2.
#[test]
fn an_edge_crosses_the_seam_of_a_spline_that_repeats() {
    let mut text = StepText::new();
    let knots = "(1,1,1,1,1,1,1,1,1),(2,2),(-2.,-1.,0.,1.,2.,3.,4.,5.,6.),(0.,1.)";
    let surface = prism(&mut text, 2, 2, knots);
    // The spans beside the seam, which is between the first two corners.
    let middle = |a: usize, b: usize| [0, 1].map(|axis| 0.5 * (SQUARE[a][axis] + SQUARE[b][axis]));
    let base = [middle(3, 0), SQUARE[0], middle(0, 1), SQUARE[1], middle(1, 2)];
    let whole = strip(&mut text, surface, &base, 2, "(3,2,3),(0.,1.,2.)");
    let (model, report) = face(text, whole);
    assert_near(areas(&model)[0], 2_f64.sqrt() + 1_f64.asinh(), 1e-7);
    assert!(report.gap < 1e-7, "{}", report.gap);
}

/// The vertices of an edge lie on both sides of the end of its closed curve, which is the corner of a
/// square: all of the curve but the corner.
#[test]
fn an_edge_ends_just_before_the_end_of_a_closed_curve() {
    const BESIDE: f64 = 1e-4;
    let mut text = StepText::new();
    let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0]];
    let poles = corners.map(|[x, y]| format!("#{}", text.point([x, y, 0.0])));
    let curve = text.add(format!(
        "B_SPLINE_CURVE_WITH_KNOTS('',1,({}),.UNSPECIFIED.,.T.,.F.,(2,1,1,1,2),(0.,1.,2.,3.,4.),.UNSPECIFIED.)",
        poles.join(",")
    ));
    let ends = [[BESIDE, 0.0, 0.0], [0.0, BESIDE, 0.0]];
    let vertices = ends.map(|end| text.vertex(end));
    let around = text.edge(curve, vertices, true);
    let line = text.line(ends[1], [BESIDE, -BESIDE, 0.0]);
    let corner = text.edge(line, [vertices[1], vertices[0]], true);
    let path = text.edge_loop(&[(around, true), (corner, true)]);
    let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let plane = text.add(format!("PLANE('',#{placement})"));
    let whole = text.face(&[path], plane, true);
    let (model, report) = face(text, whole);
    assert_near(areas(&model)[0], 16.0 - 0.5 * BESIDE * BESIDE, 1e-11);
    assert!(report.gap < 1e-9, "{}", report.gap);
}
