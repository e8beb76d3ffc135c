//! Solids of vertices, edges, loops, faces and shells.

use crate::support::writers::iges::{Id, IgesText, numbers};
use crate::{areas, assert_near, read};
use nurbs_hausdorff_cad::from_iges;
use std::f64::consts::{PI, TAU};

/// The vertices of a solid, as a list of points.
pub(crate) fn vertices(text: &mut IgesText, points: &[[f64; 3]]) -> Id {
    text.add(502, 1, format!("{},{}", points.len(), numbers(&points.concat())))
}

/// Edges, each of a curve and the numbers of its vertices.
pub(crate) fn edges(text: &mut IgesText, vertices: Id, edges: &[(Id, [usize; 2])]) -> Id {
    let edge = |(curve, [from, to]): &(Id, [usize; 2])| format!("{curve},{vertices},{from},{vertices},{to}");
    let edges: Vec<String> = edges.iter().map(edge).collect();
    text.add(504, 1, format!("{},{}", edges.len(), edges.join(",")))
}

/// The loop of edges by their numbers, each with its direction and curve in the parameters.
pub(crate) fn edge_loop(text: &mut IgesText, edges: Id, uses: &[(usize, bool, Option<Id>)]) -> Id {
    let of = |&(edge, forward, curve): &(usize, bool, Option<Id>)| {
        let curve = curve.map_or_else(|| "0".to_owned(), |curve| format!("1,0,{curve}"));
        format!("0,{edges},{edge},{},{curve}", u8::from(forward))
    };
    let uses: Vec<String> = uses.iter().map(of).collect();
    text.add(508, 1, format!("{},{}", uses.len(), uses.join(",")))
}

pub(crate) fn face(text: &mut IgesText, surface: Id, loops: &[Id]) -> Id {
    let loops: Vec<String> = loops.iter().map(Id::to_string).collect();
    text.add(510, 1, format!("{surface},{},1,{}", loops.len(), loops.join(",")))
}

pub(crate) fn solid(text: &mut IgesText, faces: &[Id]) -> Id {
    let listed: Vec<String> = faces.iter().map(|face| format!("{face},1")).collect();
    let shell = text.add(514, 1, format!("{},{}", faces.len(), listed.join(",")));
    text.add(186, 0, format!("{shell},1,0"))
}

/// The box [0, a] x [0, b] x [0, c].
pub(crate) fn brick(text: &mut IgesText, [a, b, c]: [f64; 3]) -> Id {
    let corner =
        |index: usize| [(index & 1) as f64 * a, (index >> 1 & 1) as f64 * b, (index >> 2) as f64 * c];
    let corners: Vec<[f64; 3]> = (0..8).map(corner).collect();
    let list = vertices(text, &corners);
    let mut ends = Vec::new();
    for from in 0..8_usize {
        ends.extend([1, 2, 4].iter().filter(|&&bit| from & bit == 0).map(|bit| [from, from + bit]));
    }
    let curves: Vec<(Id, [usize; 2])> =
        ends.iter().map(|&[from, to]| (text.line(corners[from], corners[to]), [from + 1, to + 1])).collect();
    let edges = edges(text, list, &curves);
    let sides = [
        ([0, 2, 3, 1], [0., 0., -1.]),
        ([4, 5, 7, 6], [0., 0., 1.]),
        ([0, 1, 5, 4], [0., -1., 0.]),
        ([2, 6, 7, 3], [0., 1., 0.]),
        ([0, 4, 6, 2], [-1., 0., 0.]),
        ([1, 3, 7, 5], [1., 0., 0.]),
    ];
    let mut faces = Vec::new();
    for (loop_of, normal) in sides {
        let uses: Vec<(usize, bool, Option<Id>)> = (0..4)
            .map(|side| {
                let [from, to] = [loop_of[side], loop_of[(side + 1) % 4]];
                let at = ends.iter().position(|end| *end == [from.min(to), from.max(to)]).unwrap();
                (at + 1, from < to, None)
            })
            .collect();
        let path = edge_loop(text, edges, &uses);
        let (point, normal) = (text.point(corners[loop_of[0]]), text.direction(normal));
        let plane = text.add(190, 0, format!("{point},{normal}"));
        faces.push(face(text, plane, &[path]));
    }
    solid(text, &faces)
}

#[test]
fn a_box_has_six_faces() {
    let mut text = IgesText::new();
    brick(&mut text, [1.0, 2.0, 4.0]);
    let (model, report) = read(&text);
    let mut found = areas(&model);
    found.sort_by(f64::total_cmp);
    for (found, expected) in found.iter().zip([2.0, 2.0, 4.0, 4.0, 8.0, 8.0]) {
        assert_near(*found, expected, 1e-12);
    }
    assert_eq!((report.fitted, report.notes.len()), (0, 0));
    assert!(model.faces().all(|face| !face.to_arrays().reversed && face.solid().is_some()));
}

/// A cylinder with its seam, with curves in the parameters in degrees and without.
fn cylinder(with_curves: bool) -> IgesText {
    let mut text = IgesText::new();
    let ends = vertices(&mut text, &[[2.0, 0.0, 0.0], [2.0, 0.0, 5.0]]);
    let rims = [0.0, 5.0].map(|height| text.arc(height, [[2.0, 0.0]; 2]));
    let side = text.line([2.0, 0.0, 0.0], [2.0, 0.0, 5.0]);
    let edges = edges(&mut text, ends, &[(rims[0], [1, 1]), (rims[1], [2, 2]), (side, [1, 2])]);
    let (origin, up) = (text.point([0.0; 3]), text.direction([0.0, 0.0, 1.0]));
    let x = text.direction([1.0, 0.0, 0.0]);
    let surface = text.add(192, 1, format!("{origin},{up},2.,{x}"));
    let mut curve = |from: [f64; 2], to: [f64; 2]| {
        with_curves.then(|| text.line([from[0], from[1], 0.0], [to[0], to[1], 0.0]))
    };
    let uses = [
        (1, true, curve([0.0, 0.0], [360.0, 0.0])),
        (3, true, curve([360.0, 0.0], [360.0, 5.0])),
        (2, false, curve([360.0, 5.0], [0.0, 5.0])),
        (3, false, curve([0.0, 5.0], [0.0, 0.0])),
    ];
    let path = edge_loop(&mut text, edges, &uses);
    let side = face(&mut text, surface, &[path]);
    solid(&mut text, &[side]);
    text
}

#[test]
fn a_cylinder_has_its_seam() {
    for with_curves in [true, false] {
        let (model, report) = read(&cylinder(with_curves));
        assert_near(areas(&model)[0], TAU * 2.0 * 5.0, 1e-12);
        assert_eq!((report.trims, report.fitted), (4, 0));
    }
}

/// A seam that ends 0.02 from the rims, at their vertices: the loop keeps the order of the file.
#[test]
fn curves_follow_their_vertices_where_they_end_beside_them() {
    let mut text = IgesText::new();
    let ends = vertices(&mut text, &[[2.0, 0.0, 0.0], [2.0, 0.0, 5.0]]);
    let rims = [0.0, 5.0].map(|height| text.arc(height, [[2.0, 0.0]; 2]));
    let side = text.line([2.0, 0.0, 0.02], [2.0, 0.0, 4.98]);
    let edges = edges(&mut text, ends, &[(rims[0], [1, 1]), (rims[1], [2, 2]), (side, [1, 2])]);
    let (origin, up) = (text.point([0.0; 3]), text.direction([0.0, 0.0, 1.0]));
    let x = text.direction([1.0, 0.0, 0.0]);
    let surface = text.add(192, 1, format!("{origin},{up},2.,{x}"));
    let path =
        edge_loop(&mut text, edges, &[(1, true, None), (3, true, None), (2, false, None), (3, false, None)]);
    face(&mut text, surface, &[path]);
    let (model, _) = read(&text);
    assert_near(areas(&model)[0], TAU * 2.0 * 5.0, 1e-9);
    let gap = model.gap();
    assert!((0.02..0.03).contains(&gap), "{gap}");
}

/// Half of the cylinder by curves in the parameters alone, in degrees and lengths.
#[test]
fn the_parameters_of_a_cylinder_are_degrees() {
    let mut text = IgesText { unit: (1, "INCH"), ..IgesText::new() };
    let (origin, up) = (text.point([0.0; 3]), text.direction([0.0, 0.0, 1.0]));
    let x = text.direction([1.0, 0.0, 0.0]);
    let surface = text.add(192, 1, format!("{origin},{up},2.,{x}"));
    let corners = [[0.0, 1.0, 0.0], [180.0, 1.0, 0.0], [180.0, 4.0, 0.0], [0.0, 4.0, 0.0]];
    let parameters = text.polygon(&corners);
    text.trimmed(surface, Some((parameters, 0)), &[]);
    let (model, _) = read(&text);
    assert_near(areas(&model)[0] / (25.4 * 25.4), PI * 2.0 * 3.0, 1e-9);
    assert_near(model.bounding_box().min[1], 0.0, 1e-9);
}

/// A plane's normal may be against the face's: the loop is directed by the surface.
#[test]
fn a_face_with_a_hole_has_two_loops() {
    let mut text = IgesText::new();
    let ends = vertices(&mut text, &[[5.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
    let rims = [5.0, 2.0].map(|radius| text.arc(0.0, [[radius, 0.0]; 2]));
    let edges = edges(&mut text, ends, &[(rims[0], [1, 1]), (rims[1], [2, 2])]);
    let loops =
        [(1, true), (2, false)].map(|(edge, forward)| edge_loop(&mut text, edges, &[(edge, forward, None)]));
    let (origin, up) = (text.point([0.0; 3]), text.direction([0.0, 0.0, 1.0]));
    let plane = text.add(190, 0, format!("{origin},{up}"));
    face(&mut text, plane, &loops);
    assert_near(areas(&read(&text).0)[0], PI * 21.0, 1e-12);
}

/// The cap of a sphere above a circle, and the whole sphere, whose loop is a vertex.
#[test]
fn spheres_are_read_in_both_parts() {
    let mut text = IgesText::new();
    let (origin, up) = (text.point([0.0; 3]), text.direction([0.0, 0.0, 1.0]));
    let x = text.direction([1.0, 0.0, 0.0]);
    let surface = text.add(196, 1, format!("{origin},5.,{up},{x}"));
    let ends = vertices(&mut text, &[[3.0, 0.0, 4.0], [0.0, 0.0, 5.0]]);
    let rim = text.arc(4.0, [[3.0, 0.0]; 2]);
    let edges = edges(&mut text, ends, &[(rim, [1, 1])]);
    let path = edge_loop(&mut text, edges, &[(1, true, None)]);
    let cap = face(&mut text, surface, &[path]);
    let tip = text.add(508, 1, format!("1,1,{ends},2,1,0"));
    let whole = face(&mut text, surface, &[tip]);
    text.add(514, 1, format!("2,{cap},1,{whole},0"));
    let (model, _) = read(&text);
    let found = areas(&model);
    // The cap has the area of the cylinder around it.
    assert_near(found[0], TAU * 5.0, 1e-9);
    assert_near(found[1], 2.0 * TAU * 25.0, 1e-9);
    let reversed: Vec<bool> = model.faces().map(|face| face.to_arrays().reversed).collect();
    assert_eq!(reversed, [false, true]);
}

/// The tip of a cone below a rim with an overhang, along the seam to the apex and back: from whichever
/// edge its loop begins, no line to the apex crosses the rim.
#[test]
fn a_cone_is_read_to_its_apex_from_every_edge() {
    let at = |u: f64, radius: f64| [radius * u.cos(), radius * u.sin(), radius];
    let corners =
        [at(0.0, 3.0), at(2.0, 3.0), at(2.0, 2.0), at(2.5, 2.0), at(2.5, 1.0), at(1.0, 1.0), at(1.0, 3.0)];
    for start in 0..9 {
        let mut text = IgesText::new();
        let mut points = corners.to_vec();
        points.push([0.0; 3]);
        let ends = vertices(&mut text, &points);
        // Vertices are numbered from 1. Arcs run counter-clockwise.
        let edges: Vec<(Id, [usize; 2])> = [[2, 1], [2, 3], [3, 4], [4, 5], [6, 5], [6, 7], [1, 7], [1, 8]]
            .map(|[from, to]| {
                let [a, b] = [points[from - 1], points[to - 1]];
                let is_arc = a[2] == b[2];
                let arc = [a, b].map(|[x, y, _]| [x, y]);
                (if is_arc { text.arc(a[2], arc) } else { text.line(a, b) }, [from, to])
            })
            .to_vec();
        let edges = self::edges(&mut text, ends, &edges);
        let mut uses = [1, 2, 3, 4, 5, 6, 7, 8, 8].map(|edge| (edge, ![1, 5, 7].contains(&edge), None));
        uses[8].1 = false;
        uses.rotate_left(start);
        let path = edge_loop(&mut text, edges, &uses);
        let (origin, up) = (text.point([0.0, 0.0, 1.0]), text.direction([0.0, 0.0, 1.0]));
        let x = text.direction([1.0, 0.0, 0.0]);
        let surface = text.add(194, 1, format!("{origin},{up},1.,45.,{x}"));
        face(&mut text, surface, &[path]);
        // Half of the squared radius, a radian; the notch is 1 wide from 1 to 3 and 0.5 from 1 to 2.
        let expected = 2.0_f64.sqrt() * (TAU * 4.5 - 4.0 - 0.75);
        assert_near(areas(&read(&text).0)[0], expected, 1e-9);
    }
}

/// An edge along a composite curve, and one whose curve is longer than it.
#[test]
fn edges_may_be_composite_or_parts_of_curves() {
    let mut text = IgesText::new();
    let ends = vertices(&mut text, &[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0]]);
    let corner = [4.0, 3.0, 0.0];
    let sides = [text.line([4.0, 0.0, 0.0], corner), text.line(corner, [0.0, 0.0, 0.0])];
    let composite = text.composite(&sides);
    let long = text.line([-3.0, 0.0, 0.0], [9.0, 0.0, 0.0]);
    let edges = edges(&mut text, ends, &[(long, [1, 2]), (composite, [2, 1])]);
    let path = edge_loop(&mut text, edges, &[(1, true, None), (2, true, None)]);
    let (origin, up) = (text.point([0.0; 3]), text.direction([0.0, 0.0, 1.0]));
    let plane = text.add(190, 0, format!("{origin},{up}"));
    face(&mut text, plane, &[path]);
    let (model, report) = read(&text);
    assert_near(areas(&model)[0], 6.0, 1e-12);
    assert_eq!(report.trims, 3);
}

#[test]
fn an_edge_away_from_its_vertices_is_reported() {
    let mut text = IgesText::new();
    let ends = vertices(&mut text, &[[0.0, 0.0, 0.0], [4.0, 1.0, 0.0]]);
    let long = text.line([0.0, 0.0, 0.0], [9.0, 0.0, 0.0]);
    let edges = edges(&mut text, ends, &[(long, [1, 2])]);
    let path = edge_loop(&mut text, edges, &[(1, true, None)]);
    let (origin, up) = (text.point([0.0; 3]), text.direction([0.0, 0.0, 1.0]));
    let plane = text.add(190, 0, format!("{origin},{up}"));
    let broken = face(&mut text, plane, &[path]);
    brick(&mut text, [1.0; 3]);
    let (_, report) = from_iges(text.text().as_bytes()).unwrap();
    assert_eq!((report.faces, report.skipped[0].code), (6, "IGES_EDGE"));
    assert_eq!(report.skipped[0].entity, Some(broken as u64));
}
