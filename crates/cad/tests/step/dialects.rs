//! What writers do that the standard does not have, or has in two ways.

use crate::faces::polygons::box_faces;
use crate::support::writers::step::{Id, StepText, UnitsOf};
use crate::{areas, assert_near, face, read};
use nurbs_hausdorff_cad::from_step;
use std::f64::consts::PI;

/// A disc of radius 2, whose edge is a circle.
fn disc(text: &mut StepText) -> [Id; 2] {
    let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let circle = text.circle(placement, 2.0);
    let vertex = text.vertex([2.0, 0.0, 0.0]);
    let edge = text.edge(circle, [vertex, vertex], true);
    [placement, edge]
}

#[test]
fn uses_of_uses_of_edges_and_faces_are_followed() {
    // Turned twice, the edge runs as it is.
    for orientations in [[".T.", ".T."], [".F.", ".F."]] {
        let mut text = StepText::new();
        let [placement, edge] = disc(&mut text);
        let first = text.add(format!("ORIENTED_EDGE('',*,*,#{edge},{})", orientations[0]));
        let second = text.add(format!("ORIENTED_EDGE('',*,*,#{first},{})", orientations[1]));
        let path = text.add(format!("EDGE_LOOP('',(#{second}))"));
        let plane = text.add(format!("PLANE('',#{placement})"));
        let disc = text.face(&[path], plane, true);
        let turned = text.add(format!("ORIENTED_FACE('',*,#{disc},{})", orientations[0]));
        let turned = text.add(format!("ORIENTED_FACE('',*,#{turned},{})", orientations[1]));
        let (model, report) = face(text, turned);
        assert_eq!(report.notes, []);
        assert_near(areas(&model)[0], 4.0 * PI, 1e-12);
    }
}

/// Uses of each other end.
#[test]
fn uses_of_each_other_are_refused() {
    let mut text = StepText::new();
    let [placement, _] = disc(&mut text);
    let number = text.entities.len() + 1;
    let use_of = text.add(format!("ORIENTED_EDGE('',*,*,#{number},.T.)"));
    let path = text.add(format!("EDGE_LOOP('',(#{use_of}))"));
    let plane = text.add(format!("PLANE('',#{placement})"));
    let disc = text.face(&[path], plane, true);
    let shell = text.open_shell(&[disc]);
    let error = from_step(text.of(&[shell], UnitsOf::Millimetres).as_bytes()).unwrap_err();
    assert!(error.to_string().contains("uses of each other"), "{error}");
}

#[test]
fn logical_values_in_full_are_read() {
    let mut text = StepText::new();
    let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    for entity in &mut text.entities {
        *entity = entity.replace(",.T.)", ",.TRUE.)").replace(",.F.)", ",.FALSE.)");
    }
    let solid = text.solid("", &faces);
    let (model, _) = read(&text.of(&[solid], UnitsOf::Millimetres));
    assert_near(areas(&model).iter().sum(), 28.0, 1e-12);
}

/// Every entity in its external mapping, each part by itself in the order of the alphabet.
#[test]
fn complex_instances_are_what_they_are_of() {
    let mut text = StepText::new();
    let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    let solid = text.solid("", &faces);
    let parts = |kind: &str, attributes: &[&str]| -> Option<String> {
        let [a, rest @ ..] = attributes else { return None };
        let list = rest.join(",");
        let half = |from: usize| rest[from..].join(",");
        let specific = match kind {
            "CARTESIAN_POINT" => format!("CARTESIAN_POINT({list})GEOMETRIC_REPRESENTATION_ITEM()POINT()"),
            "DIRECTION" | "VECTOR" => format!("{kind}({list})GEOMETRIC_REPRESENTATION_ITEM()"),
            "AXIS2_PLACEMENT_3D" => {
                format!(
                    "AXIS2_PLACEMENT_3D({})GEOMETRIC_REPRESENTATION_ITEM()PLACEMENT({})",
                    half(1),
                    rest[0]
                )
            }
            "LINE" => format!("CURVE()GEOMETRIC_REPRESENTATION_ITEM()LINE({list})"),
            "PLANE" => format!("ELEMENTARY_SURFACE({list})GEOMETRIC_REPRESENTATION_ITEM()PLANE()"),
            "VERTEX_POINT" => {
                format!("GEOMETRIC_REPRESENTATION_ITEM()VERTEX()VERTEX_POINT({list})")
            }
            "EDGE_CURVE" => format!("EDGE({},{})EDGE_CURVE({})", rest[0], rest[1], half(2)),
            "ORIENTED_EDGE" => format!("EDGE({},{})ORIENTED_EDGE({})", rest[0], rest[1], half(2)),
            "EDGE_LOOP" => format!("EDGE_LOOP()LOOP()PATH({list})"),
            "FACE_BOUND" => format!("FACE_BOUND({list})"),
            "ADVANCED_FACE" => format!("ADVANCED_FACE()FACE({})FACE_SURFACE({})", rest[0], half(1)),
            "CLOSED_SHELL" => format!("CLOSED_SHELL()CONNECTED_FACE_SET({list})"),
            "MANIFOLD_SOLID_BREP" => format!("MANIFOLD_SOLID_BREP({list})SOLID_MODEL()"),
            _ => return None,
        };
        Some(format!("({specific}REPRESENTATION_ITEM({a})TOPOLOGICAL_REPRESENTATION_ITEM())"))
    };
    let mut count = 0;
    for entity in &mut text.entities {
        let (kind, attributes) = entity.trim_end_matches(')').split_once('(').unwrap();
        let closed = entity.len() - entity.trim_end_matches(')').len();
        let attributes = format!("{attributes}{}", ")".repeat(closed - 1));
        if let Some(complex) = parts(kind, &split(&attributes)) {
            *entity = complex;
            count += 1;
        }
    }
    assert_eq!(count, text.entities.len());
    let (model, _) = read(&text.of(&[solid], UnitsOf::Millimetres));
    assert_near(areas(&model).iter().sum(), 28.0, 1e-12);
}

/// Attributes between the commas that stand in no list.
fn split(attributes: &str) -> Vec<&str> {
    let (mut depth, mut start, mut found) = (0, 0, Vec::new());
    for (at, letter) in attributes.char_indices() {
        match letter {
            '(' => depth += 1,
            ')' => depth -= 1,
            ',' if depth == 0 => {
                found.push(&attributes[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    found.push(&attributes[start..]);
    found
}

/// An edge whose only curve is one in the parameters of its surface, along either of them and back.
#[test]
fn parameter_lines_alone_are_edges() {
    let surfaces: [(&str, [f64; 2], [f64; 2], f64); 4] = [
        ("PLANE('',#{})", [1.0, 3.0], [2.0, 7.0], 2.0 * 5.0),
        ("CYLINDRICAL_SURFACE('',#{},2.)", [0.2, 1.2], [0.0, 3.0], 2.0 * 3.0),
        ("CONICAL_SURFACE('',#{},2.,0.5)", [0.2, 1.2], [0.0, 1.0], 0.0),
        ("SPHERICAL_SURFACE('',#{},2.)", [0.2, 1.2], [0.1, 0.9], 4.0 * (0.9_f64.sin() - 0.1_f64.sin())),
    ];
    for (surface, [u0, u1], [v0, v1], expected) in surfaces {
        let mut text = StepText::new();
        let placement = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let surface = text.add(surface.replace("{}", &placement.to_string()));
        let kind = text.entities[surface - 1].clone();
        let radius = |v: f64| match kind.as_bytes()[1] {
            b'O' => 2.0 + v * 0.5_f64.tan(),
            b'P' => 2.0 * v.cos(),
            _ => 2.0,
        };
        let at = |u: f64, v: f64| match kind.as_bytes()[0] {
            b'P' => [u, v, 0.0],
            b'S' => [radius(v) * u.cos(), radius(v) * u.sin(), 2.0 * v.sin()],
            _ => [radius(v) * u.cos(), radius(v) * u.sin(), v],
        };
        let corners = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]];
        let vertices = corners.map(|[u, v]| text.vertex(at(u, v)));
        let context = text.add("(GEOMETRIC_REPRESENTATION_CONTEXT(2)REPRESENTATION_CONTEXT('',''))");
        let mut edges = Vec::new();
        for side in 0..4 {
            let ([a, b], [c, d]) = (corners[side], corners[(side + 1) % 4]);
            let point = text.add(format!("CARTESIAN_POINT('',({a:?},{b:?}))"));
            let along = text.add(format!("DIRECTION('',({:?},{:?}))", c - a, d - b));
            let vector = text.add(format!("VECTOR('',#{along},1.)"));
            let line = text.add(format!("LINE('',#{point},#{vector})"));
            let drawing = text.add(format!("DEFINITIONAL_REPRESENTATION('',(#{line}),#{context})"));
            let p_curve = text.add(format!("PCURVE('',#{surface},#{drawing})"));
            edges.push((text.edge(p_curve, [vertices[side], vertices[(side + 1) % 4]], true), true));
        }
        let path = text.edge_loop(&edges);
        let patch = text.face(&[path], surface, true);
        let (model, report) = face(text, patch);
        // The slant of the cone is as long as its height by the cosine.
        let mean = 0.5 * (radius(v0) + radius(v1));
        let cone = (u1 - u0) * mean * (v1 - v0) / 0.5_f64.cos();
        let expected = if expected == 0.0 { cone } else { expected };
        assert_near(areas(&model)[0], expected, 1e-9);
        // Gaps are bounds up to 1e-10 of an edge.
        assert!(report.gap < 1e-9, "{}", report.gap);
    }
}

/// A slanted line of a cylinder's parameters is a helix, which no curve of the standard is.
#[test]
fn other_curves_of_parameters_alone_are_named() {
    let mut text = StepText::new();
    let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let cylinder = text.add(format!("CYLINDRICAL_SURFACE('',#{placement},2.)"));
    let point = text.add("CARTESIAN_POINT('',(0.,0.))");
    let along = text.add("DIRECTION('',(1.,1.))");
    let vector = text.add(format!("VECTOR('',#{along},1.)"));
    let line = text.add(format!("LINE('',#{point},#{vector})"));
    let drawing = text.add(format!("DEFINITIONAL_REPRESENTATION('',(#{line}),$)"));
    let p_curve = text.add(format!("PCURVE('',#{cylinder},#{drawing})"));
    let vertices =
        [text.vertex([2.0, 0.0, 0.0]), text.vertex([2.0 * 1.0_f64.cos(), 2.0 * 1.0_f64.sin(), 1.0])];
    let edge = text.edge(p_curve, vertices, true);
    let path = text.edge_loop(&[(edge, true)]);
    let patch = text.face(&[path], cylinder, true);
    let shell = text.open_shell(&[patch]);
    let error = from_step(text.of(&[shell], UnitsOf::Millimetres).as_bytes()).unwrap_err();
    assert!(
        error.to_string().contains(&format!("#{p_curve} is PCURVE, expected a curve in space")),
        "{error}"
    );
}

/// Systems state tori by a major radius below 0; one beyond the minor radius is the whole torus. The trimmed face
/// shows that the parameters are those of the formula: u = v = 0 is (-40, 0, 0).
#[test]
fn a_torus_may_have_a_major_radius_below_zero() {
    let mut text = StepText::new();
    let placement = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let torus = text.add(format!("TOROIDAL_SURFACE('',#{placement},-50.,10.)"));
    let vertex = text.vertex([60.0, 0.0, 0.0]);
    let path = text.add(format!("VERTEX_LOOP('',#{vertex})"));
    let whole = text.face(&[path], torus, true);
    let part = text.add(format!("RECTANGULAR_TRIMMED_SURFACE('',#{torus},0.,0.5,0.,1.5,.T.,.T.)"));
    let set = text.add(format!("GEOMETRIC_SET('',(#{part}))"));
    let shell = text.open_shell(&[whole]);
    let (model, _) = read(&text.of(&[shell, set], UnitsOf::Millimetres));
    let found = areas(&model);
    assert_near(found[0], 4.0 * PI * PI * 500.0, 1e-9);
    // The integral of 10 (50 - 10 cos v) over the part.
    assert_near(found[1], 0.5 * 10.0 * (50.0 * 1.5 - 10.0 * 1.5_f64.sin()), 1e-9);
    let [low, high] = {
        let faces: Vec<_> = model.faces().collect();
        let net = faces[1].surface().control_points().iter().map(|point| point[0]);
        [net.clone().fold(f64::INFINITY, f64::min), net.fold(f64::NEG_INFINITY, f64::max)]
    };
    assert!(low < -40.0 && high < 0.0, "{low} {high}");
}

/// Two files one behind the other: the instances of the second one would be lost.
#[test]
fn a_second_file_behind_the_end_is_refused() {
    let mut text = StepText::new();
    let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    let solid = text.solid("", &faces);
    let file = text.of(&[solid], UnitsOf::Millimetres);
    let lines = file.lines().count();
    let error = from_step(format!("{file}{file}").as_bytes()).unwrap_err();
    assert_eq!(error.code(), "STEP_SYNTAX");
    assert!(error.to_string().starts_with(&format!("line {}: ", lines + 1)), "{error}");
    // A signature may follow (ISO 10303-21, edition 3), and blanks.
    read(&format!("{file}SIGNATURE;\nabc==\nENDSEC;\n\n"));
}

#[test]
fn edges_far_from_their_plane_are_none_of_it() {
    for (height, is_read) in [(0.005, true), (0.1, false)] {
        let mut text = StepText::new();
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, height], [0.0, 1.0, height]];
        let points: Vec<String> = corners.iter().map(|&corner| format!("#{}", text.point(corner))).collect();
        let path = text.add(format!("POLY_LOOP('',({}))", points.join(",")));
        let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
        let plane = text.add(format!("PLANE('',#{placement})"));
        let square = text.face(&[path], plane, true);
        let shell = text.open_shell(&[square]);
        let found = from_step(text.of(&[shell], UnitsOf::Millimetres).as_bytes());
        match found {
            Ok((_, report)) => assert!(is_read && report.gap >= height, "{height}"),
            Err(error) => assert!(!is_read && error.to_string().contains("from the surface"), "{error}"),
        }
    }
}

/// What a file without faces has is named, and that it is to be exported otherwise.
#[test]
fn a_file_without_faces_says_what_it_has() {
    let mut text = StepText::new();
    let line = text.line([0.0; 3], [1.0, 0.0, 0.0]);
    let set = text.add(format!("GEOMETRIC_CURVE_SET('',(#{line}))"));
    let error = from_step(text.of(&[set], UnitsOf::Millimetres).as_bytes()).unwrap_err();
    assert_eq!(error.code(), "EMPTY_MODEL");
    assert!(error.to_string().contains("hold 1 GEOMETRIC_CURVE_SET"), "{error}");
    let error = from_step(b"ISO-10303-21;HEADER;ENDSEC;DATA;#1=FOO();ENDSEC;END-ISO-10303-21;").unwrap_err();
    assert!(error.to_string().contains("no shape is represented by its 1 FOO"), "{error}");
}
