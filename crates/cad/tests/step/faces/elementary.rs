//! Faces of planes, cylinders, cones, spheres and tori against their areas.

use crate::support::writers::step::{Id, StepText};
use crate::{areas, assert_near, face};
use nurbs_hausdorff::{Model, ReadReport};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// A circle about z at a height, as an edge from the point on the axis x to itself.
fn ring(text: &mut StepText, radius: f64, height: f64) -> (Id, Id) {
    let placement = text.placement([0.0, 0.0, height], Z, X);
    let circle = text.circle(placement, radius);
    let vertex = text.vertex([radius, 0.0, height]);
    (text.edge(circle, [vertex, vertex], true), vertex)
}

/// A face of two circles about z, the lower one counter-clockwise, without a seam.
fn between_rings(surface: &str, [low, high]: [[f64; 2]; 2]) -> (Model, ReadReport) {
    let mut text = StepText::new();
    let placement = text.placement([0.0; 3], Z, X);
    let surface = text.add(surface.replace("@", &format!("#{placement}")));
    let (low, _) = ring(&mut text, low[0], low[1]);
    let (high, _) = ring(&mut text, high[0], high[1]);
    let loops = [text.edge_loop(&[(low, true)]), text.edge_loop(&[(high, false)])];
    let of_rings = text.face(&loops, surface, true);
    face(text, of_rings)
}

#[test]
fn a_cylinder_without_a_seam_is_whole() {
    let (model, report) = between_rings("CYLINDRICAL_SURFACE('',@,5.)", [[5.0, 1.0], [5.0, 21.0]]);
    assert_near(areas(&model)[0], TAU * 5.0 * 20.0, 1e-12);
    assert_eq!(report.fitted, 0);
    assert!(report.gap < 1e-9, "{}", report.gap);
}

/// The same face with the seam edge in its one loop, as most systems write it.
#[test]
fn a_cylinder_with_a_seam_is_whole() {
    for axis in [Z, X, [-1.0, 0.0, 0.0]] {
        let mut text = StepText::new();
        // Along ±x the direction of the axis x, which is left out, is that of y.
        let along = |height: f64| axis.map(|entry| entry * height);
        let radial = if axis == Z { X } else { Y };
        let mut rim = |height: f64| {
            let placement = text.axis(along(height), axis);
            let circle = text.circle(placement, 5.0);
            let mut at = along(height);
            for (entry, radial) in at.iter_mut().zip(radial) {
                *entry += 5.0 * radial;
            }
            let vertex = text.vertex(at);
            (text.edge(circle, [vertex, vertex], true), vertex, at)
        };
        let (low, high) = (rim(1.0), rim(21.0));
        let line = text.line(low.2, axis);
        let seam = text.edge(line, [low.1, high.1], true);
        let placement = text.axis([0.0; 3], axis);
        let surface = text.add(format!("CYLINDRICAL_SURFACE('',#{placement},5.)"));
        let path = text.edge_loop(&[(low.0, true), (seam, true), (high.0, false), (seam, false)]);
        let whole = text.face(&[path], surface, true);
        let (model, report) = face(text, whole);
        assert_near(areas(&model)[0], TAU * 5.0 * 20.0, 1e-12);
        assert_eq!((report.trims, report.fitted), (4, 0));
    }
}

/// The normal of a face opposite to that of its surface turns its loops round.
#[test]
fn a_face_against_its_surface_has_the_same_points() {
    let of = |same_sense: bool| {
        let mut text = StepText::new();
        let placement = text.placement([0.0; 3], Z, X);
        let surface = text.add(format!("PLANE('',#{placement})"));
        let (outer, _) = ring(&mut text, 5.0, 0.0);
        let (inner, _) = ring(&mut text, 2.0, 0.0);
        let loops = [(outer, same_sense), (inner, !same_sense)].map(|used| text.edge_loop(&[used]));
        let annulus = text.face(&loops, surface, same_sense);
        face(text, annulus).0
    };
    for same_sense in [true, false] {
        let model = of(same_sense);
        assert_near(areas(&model)[0], PI * (25.0 - 4.0), 1e-12);
        assert_eq!(model.faces().next().unwrap().to_arrays().reversed, !same_sense);
    }
}

#[test]
fn a_cone_between_circles_and_up_to_its_apex() {
    // The half angle of 45° widens by 1 a unit of height.
    let frustum = between_rings("CONICAL_SURFACE('',@,3.,0.785398163397448)", [[3.0, 0.0], [7.0, 4.0]]);
    assert_near(areas(&frustum.0)[0], PI * (49.0 - 9.0) * 2.0_f64.sqrt(), 1e-12);
    let mut text = StepText::new();
    let placement = text.placement([0.0; 3], Z, X);
    let surface = text.add(format!("CONICAL_SURFACE('',#{placement},3.,0.785398163397448)"));
    let (rim, _) = ring(&mut text, 3.0, 0.0);
    let apex = text.vertex([0.0, 0.0, -3.0]);
    let tip = text.add(format!("VERTEX_LOOP('',#{apex})"));
    let loops = [text.edge_loop(&[(rim, false)]), tip];
    let whole = text.face(&loops, surface, true);
    let (model, _) = face(text, whole);
    assert_near(areas(&model)[0], PI * 9.0 * 2.0_f64.sqrt(), 1e-12);
}

/// The second half of a cone, where the radius of its formula is negative.
#[test]
fn a_cone_is_read_beyond_its_apex() {
    let mut text = StepText::new();
    let placement = text.placement([0.0; 3], Z, X);
    let surface = text.add(format!("CONICAL_SURFACE('',#{placement},3.,0.785398163397448)"));
    // At heights -5 and -9 the radii are -2 and -6; there the normal turns round.
    let (near, _) = ring(&mut text, 2.0, -5.0);
    let (far, _) = ring(&mut text, 6.0, -9.0);
    let loops = [(near, true), (far, false)].map(|used| text.edge_loop(&[used]));
    let band = text.face(&loops, surface, true);
    let (model, _) = face(text, band);
    assert_near(areas(&model)[0], PI * (36.0 - 4.0) * 2.0_f64.sqrt(), 1e-9);
}

#[test]
fn a_whole_sphere_is_a_vertex_loop() {
    let mut text = StepText::new();
    let placement = text.placement([1.0, 2.0, 3.0], Z, X);
    let surface = text.add(format!("SPHERICAL_SURFACE('',#{placement},7.)"));
    let pole = text.vertex([1.0, 2.0, 10.0]);
    let path = text.add(format!("VERTEX_LOOP('',#{pole})"));
    let whole = text.face(&[path], surface, true);
    let (model, report) = face(text, whole);
    assert_near(areas(&model)[0], 2.0 * TAU * 49.0, 1e-9);
    assert_eq!(report.trims, 0);
}

/// The zone of a sphere between two planes has the area of the cylinder around it.
#[test]
fn a_zone_of_a_sphere_has_the_area_of_archimedes() {
    let (model, _) = between_rings("SPHERICAL_SURFACE('',@,5.)", [[5.0, 0.0], [3.0, 4.0]]);
    assert_near(areas(&model)[0], TAU * 5.0 * 4.0, 1e-9);
}

/// An eighth of a sphere, whose loop ends at the pole.
#[test]
fn an_octant_of_a_sphere_reaches_its_pole() {
    let mut text = StepText::new();
    let ends = [X, Y, Z];
    let vertices = ends.map(|end| text.vertex(end.map(|entry| 2.0 * entry)));
    let mut arcs = Vec::new();
    for (from, to, normal) in [(0, 1, Z), (1, 2, X), (2, 0, Y)] {
        let placement = text.placement([0.0; 3], normal, ends[from]);
        let circle = text.circle(placement, 2.0);
        arcs.push((text.edge(circle, [vertices[from], vertices[to]], true), true));
    }
    let placement = text.placement([0.0; 3], Z, X);
    let surface = text.add(format!("SPHERICAL_SURFACE('',#{placement},2.)"));
    let path = text.edge_loop(&arcs);
    let octant = text.face(&[path], surface, true);
    let (model, _) = face(text, octant);
    assert_near(areas(&model)[0], 4.0 * FRAC_PI_2, 1e-9);
}

/// A torus of radii R and r has the area 4 π² R r; its loop runs along both seams.
#[test]
fn a_whole_torus_has_two_seams() {
    let mut text = StepText::new();
    let placement = text.placement([0.0; 3], Z, X);
    let surface = text.add(format!("TOROIDAL_SURFACE('',#{placement},10.,3.)"));
    let (ring, vertex) = ring(&mut text, 13.0, 0.0);
    let tube = text.placement([10.0, 0.0, 0.0], [0.0, -1.0, 0.0], X);
    let tube = text.circle(tube, 3.0);
    let tube = text.edge(tube, [vertex, vertex], true);
    let path = text.edge_loop(&[(ring, true), (tube, true), (ring, false), (tube, false)]);
    let whole = text.face(&[path], surface, true);
    let (model, report) = face(text, whole);
    assert_near(areas(&model)[0], TAU * TAU * 30.0, 1e-9);
    assert_eq!(report.fitted, 0);
}

/// The area of a sheet of a degenerate torus of radii R < r between two angles of its circle:
/// `2 π r ∫ |R + r cos v| dv`.
fn sheet_area([major, minor]: [f64; 2], [start, end]: [f64; 2]) -> f64 {
    (TAU * minor * (major * (end - start) + minor * (end.sin() - start.sin()))).abs()
}

/// The outer sheet of a degenerate torus and the inner one, whole: their poles are vertex loops, or
/// the ends of a seam.
#[test]
fn degenerate_tori_have_two_sheets() {
    let radii: [f64; 2] = [2.0, 5.0];
    let [major, minor] = radii;
    let end = (-major / minor).acos();
    let height = minor * end.sin();
    for (is_outer, range) in [(true, [-end, end]), (false, [end, TAU - end])] {
        for has_seam in [false, true] {
            let mut text = StepText::new();
            let placement = text.placement([0.0; 3], Z, X);
            let logical = if is_outer { ".T." } else { ".F." };
            let surface = text
                .add(format!("DEGENERATE_TOROIDAL_SURFACE('',#{placement},{major:?},{minor:?},{logical})"));
            let poles = [-height, height].map(|z| text.vertex([0.0, 0.0, z]));
            let path = if has_seam {
                let tube = text.placement([major, 0.0, 0.0], [0.0, -1.0, 0.0], X);
                let tube = text.circle(tube, minor);
                let ends = if is_outer { poles } else { [poles[1], poles[0]] };
                let seam = text.edge(tube, ends, true);
                text.edge_loop(&[(seam, true), (seam, false)])
            } else {
                text.add(format!("VERTEX_LOOP('',#{})", poles[0]))
            };
            let whole = text.face(&[path], surface, true);
            let (model, report) = face(text, whole);
            assert_near(areas(&model)[0], sheet_area(radii, range), 1e-9);
            assert!(report.gap < 1e-9, "{}", report.gap);
        }
    }
}

/// The cap of the outer sheet above its largest circle, up to the pole.
#[test]
fn a_cap_of_a_degenerate_torus_reaches_its_pole() {
    let radii = [2.0, 5.0];
    let mut text = StepText::new();
    let placement = text.placement([0.0; 3], Z, X);
    let surface = text.add(format!("DEGENERATE_TOROIDAL_SURFACE('',#{placement},2.,5.,.T.)"));
    let (rim, _) = ring(&mut text, 7.0, 0.0);
    let path = text.edge_loop(&[(rim, true)]);
    let cap = text.face(&[path], surface, true);
    let (model, _) = face(text, cap);
    assert_near(areas(&model)[0], sheet_area(radii, [0.0, (-0.4_f64).acos()]), 1e-9);
}

/// Four plane cuts of a cylinder: a hyperbola, a parabola and ellipses are conics of the file.
#[test]
fn an_ellipse_bounds_the_oblique_section_of_a_cylinder() {
    let mut text = StepText::new();
    let root = 0.5_f64.sqrt();
    // The plane z = x cuts the cylinder of radius 2 in an ellipse of half axes 2 √2 and 2.
    let placement = text.placement([0.0; 3], [-root, 0.0, root], [root, 0.0, root]);
    let ellipse = text.add(format!("ELLIPSE('',#{placement},{:?},2.)", 8.0_f64.sqrt()));
    let vertex = text.vertex([2.0, 0.0, 2.0]);
    let cut = text.edge(ellipse, [vertex, vertex], true);
    let path = text.edge_loop(&[(cut, true)]);
    let surface = text.add(format!("PLANE('',#{placement})"));
    let disc = text.face(&[path], surface, true);
    let (model, report) = face(text, disc);
    assert_near(areas(&model)[0], PI * 2.0 * 8.0_f64.sqrt(), 1e-12);
    assert_eq!(report.fitted, 0);
}

/// Half of a sphere, whose edge passes both poles: the plane of the rim contains the axis.
#[test]
fn an_edge_may_pass_the_poles_of_a_sphere() {
    for turned in [0.0_f64, 0.3] {
        let mut text = StepText::new();
        let placement = text.placement([0.0; 3], Z, X);
        let surface = text.add(format!("SPHERICAL_SURFACE('',#{placement},2.)"));
        let rim = text.placement([0.0; 3], [turned.cos(), turned.sin(), 0.0], Z);
        let circle = text.circle(rim, 2.0);
        let at = [-2.0 * turned.sin(), 2.0 * turned.cos(), 0.0];
        let vertex = text.vertex(at);
        let rim = text.edge(circle, [vertex, vertex], true);
        let path = text.edge_loop(&[(rim, true)]);
        let half = text.face(&[path], surface, true);
        let (model, _) = face(text, half);
        assert_near(areas(&model)[0], TAU * 4.0, 1e-6);
    }
}

/// A cubic B-spline about the half circle of radius 2 from the pole (0, 0, 2) to the other one, at this angle about
/// z. Its ends are beyond the axis by as much as systems round.
fn half_meridian(text: &mut StepText, angle: f64, poles: [Id; 2]) -> Id {
    const PIECES: usize = 4;
    let step = PI / PIECES as f64;
    let tangent = 4.0 / 3.0 * (0.25 * step).tan();
    let at = |sine: f64, cosine: f64| {
        let radius = 2.0 * sine - 1e-16;
        [radius * angle.cos(), radius * angle.sin(), 2.0 * cosine]
    };
    let mut points = vec![at(0.0, 1.0)];
    for piece in 0..PIECES {
        let [(s, c), (end_s, end_c)] =
            [piece, piece + 1].map(|index| index as f64 * step).map(|turn: f64| turn.sin_cos());
        points.push(at(s + tangent * c, c - tangent * s));
        points.push(at(end_s - tangent * end_c, end_c + tangent * end_s));
        points.push(if piece + 1 == PIECES { at(0.0, -1.0) } else { at(end_s, end_c) });
    }
    let points: Vec<String> = points.into_iter().map(|point| format!("#{}", text.point(point))).collect();
    let curve = text.add(format!(
        "B_SPLINE_CURVE_WITH_KNOTS('',3,({}),.UNSPECIFIED.,.F.,.F.,(4,3,3,3,4),(0.,1.,2.,3.,4.),.UNSPECIFIED.)",
        points.join(",")
    ));
    text.edge(curve, poles, true)
}

/// A part of a sphere between two meridians that are circles, wherever their parameters begin: that of the seam may
/// be found a turn away from the other one.
#[test]
fn circles_along_meridians_bound_a_part_of_a_sphere() {
    for (start, turn) in [(0.0_f64, FRAC_PI_2), (-FRAC_PI_2, FRAC_PI_2), (0.0, 3.0), (PI, PI), (0.0, 5.0)] {
        for reference in [Z, [0.0, 0.0, -1.0]] {
            let mut text = StepText::new();
            let placement = text.placement([0.0; 3], Z, X);
            let surface = text.add(format!("SPHERICAL_SURFACE('',#{placement},2.)"));
            let poles = [2.0, -2.0].map(|height| text.vertex([0.0, 0.0, height]));
            let [first, second] = [(start, true), (start + turn, false)].map(|(angle, is_down)| {
                // From the upper pole to the other one and back, on the same side of the axis.
                let sign = if is_down { 1.0 } else { -1.0 };
                let normal = [-sign * angle.sin(), sign * angle.cos(), 0.0];
                let placement = text.placement([0.0; 3], normal, reference);
                let circle = text.circle(placement, 2.0);
                let ends = if is_down { poles } else { [poles[1], poles[0]] };
                text.edge(circle, ends, true)
            });
            let path = text.edge_loop(&[(first, true), (second, true)]);
            let part = text.face(&[path], surface, true);
            let (model, _) = face(text, part);
            assert_near(areas(&model)[0], 2.0 * turn * 4.0, 1e-9);
        }
    }
}

/// A part of a sphere between two meridians that are splines: at the poles their longitude is any.
#[test]
fn splines_along_meridians_bound_a_part_of_a_sphere() {
    for (start, turn) in [(0.0, FRAC_PI_2), (1.0, 1.0), (3.0, 2.0)] {
        let mut text = StepText::new();
        let placement = text.placement([0.0; 3], Z, X);
        let surface = text.add(format!("SPHERICAL_SURFACE('',#{placement},2.)"));
        let poles = [2.0, -2.0].map(|height| text.vertex([0.0, 0.0, height]));
        let [first, second] = [start, start + turn].map(|angle| half_meridian(&mut text, angle, poles));
        let path = text.edge_loop(&[(first, true), (second, false)]);
        let part = text.face(&[path], surface, true);
        let (model, _) = face(text, part);
        assert_near(areas(&model)[0], 2.0 * turn * 4.0, 1e-4);
    }
}

/// A quarter of a sphere, one of whose two edges passes a pole in its middle.
#[test]
fn a_quarter_of_a_sphere_may_have_a_pole_on_an_edge() {
    let mut text = StepText::new();
    let placement = text.placement([0.0; 3], X, Z);
    let surface = text.add(format!("SPHERICAL_SURFACE('',#{placement},2.)"));
    // Between two half circles that meet on the axis y.
    let ends = [[0.0, -2.0, 0.0], [0.0, 2.0, 0.0]].map(|end| text.vertex(end));
    let mut arc = |normal: [f64; 3], start: [f64; 3]| {
        let placement = text.placement([0.0; 3], normal, start);
        let circle = text.circle(placement, 2.0);
        text.edge(circle, ends, true)
    };
    // Through (2, 0, 0), a pole of the surface's frame, and through (0, 0, 2).
    let front = arc(Z, [0.0, -1.0, 0.0]);
    let top = arc([-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]);
    let path = text.edge_loop(&[(front, true), (top, false)]);
    let quarter = text.face(&[path], surface, true);
    let (model, _) = face(text, quarter);
    assert_near(areas(&model)[0], PI * 4.0, 1e-6);
}

/// SolidWorks states the inner sheet of a degenerate torus by a major radius below 0: the point at (u, v)
/// is at the distance -1 + 2 cos v from the axis and at the height 2 sin v. The area is that of a surface of
/// revolution, 2 pi ∫ 2 (2 cos v - 1) dv from 0 to pi / 6.
#[test]
fn a_torus_with_a_negative_major_radius_is_its_inner_sheet() {
    let surface = "TOROIDAL_SURFACE('',@,-1.,2.)";
    let (model, report) = between_rings(surface, [[1.0, 0.0], [3_f64.sqrt() - 1.0, 1.0]]);
    assert_near(areas(&model)[0], 4.0 * PI * (1.0 - PI / 6.0), 1e-9);
    assert!(report.gap < 1e-9, "{}", report.gap);
}
