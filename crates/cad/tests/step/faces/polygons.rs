//! Bodies of plane faces.

use crate::support::writers::step::{Id, StepText, UnitsOf};
use crate::{areas, assert_near, read};
use std::collections::HashSet;

/// The corners of a box from the origin, numbered by bits of x, y and z, and its faces seen
/// from outside.
pub(crate) fn corner([x, y, z]: [f64; 3], corner: usize) -> [f64; 3] {
    let at = |bit: usize, length: f64| if corner >> bit & 1 == 1 { length } else { 0.0 };
    [at(0, x), at(1, y), at(2, z)]
}
pub(crate) const SIDES: [[usize; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

/// The faces of a box, with edges that neighbours share; half of the edges run against their
/// lines.
pub(crate) fn box_faces(text: &mut StepText, size: [f64; 3]) -> Vec<Id> {
    let corners: Vec<[f64; 3]> = (0..8).map(|index| corner(size, index)).collect();
    let vertices: Vec<Id> = corners.iter().map(|&corner| text.vertex(corner)).collect();
    let mut edges: Vec<([usize; 2], Id)> = Vec::new();
    let mut faces = Vec::new();
    for side in SIDES {
        let mut path = Vec::new();
        for index in 0..4 {
            let ends = [side[index], side[(index + 1) % 4]];
            let known = edges.iter().find(|(known, _)| *known == [ends[1], ends[0]]);
            if let Some(&(_, edge)) = known {
                path.push((edge, false));
                continue;
            }
            let forward = edges.len().is_multiple_of(2);
            let [from, to] = if forward { ends } else { [ends[1], ends[0]] };
            let along = [0, 1, 2].map(|axis| corners[to][axis] - corners[from][axis]);
            let line = text.line(corners[from], along);
            let edge = text.edge(line, [vertices[ends[0]], vertices[ends[1]]], forward);
            edges.push((ends, edge));
            path.push((edge, true));
        }
        let origin = corners[side[0]];
        let difference = |to: usize| [0, 1, 2].map(|axis| corners[side[to]][axis] - origin[axis]);
        let (a, b) = (difference(1), difference(3));
        let normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        let placement = text.axis(origin, normal);
        let surface = text.add(format!("PLANE('',#{placement})"));
        let path = text.edge_loop(&path);
        faces.push(text.face(&[path], surface, true));
    }
    faces
}

#[test]
fn a_box_has_its_faces() {
    let mut text = StepText::new();
    let faces = box_faces(&mut text, [2.0, 3.0, 5.0]);
    let solid = text.solid("brick", &faces);
    let (model, report) = read(&text.of(&[solid], UnitsOf::Millimetres));
    assert_eq!((report.faces, report.trims, report.fitted), (6, 24, 0));
    for (found, expected) in areas(&model).into_iter().zip([6.0, 6.0, 10.0, 10.0, 15.0, 15.0]) {
        assert_near(found, expected, 1e-12);
    }
    let bounds = model.bounding_box();
    assert_near(bounds.diagonal(), 38.0_f64.sqrt(), 1e-12);
    assert_eq!(model.faces().next().unwrap().name(), Some("part / brick / face 0"));
}

/// A body of polygons, whose faces state no surface.
#[test]
fn a_faceted_body_has_its_faces() {
    let mut text = StepText::new();
    let corners: Vec<Id> = (0..8).map(|index| text.point(corner([2.0, 3.0, 5.0], index))).collect();
    let mut faces = Vec::new();
    for side in SIDES {
        let points: Vec<String> = side.iter().map(|&index| format!("#{}", corners[index])).collect();
        let path = text.add(format!("POLY_LOOP('',({}))", points.join(",")));
        let bound = text.add(format!("FACE_OUTER_BOUND('',#{path},.T.)"));
        faces.push(text.add(format!("FACE('',(#{bound}))")));
    }
    let list: Vec<String> = faces.iter().map(|face| format!("#{face}")).collect();
    let shell = text.add(format!("CLOSED_SHELL('',({}))", list.join(",")));
    let solid = text.add(format!("FACETED_BREP('',#{shell})"));
    let (model, report) = read(&text.of(&[solid], UnitsOf::Millimetres));
    assert_eq!((report.faces, report.fitted), (6, 0));
    for (found, expected) in areas(&model).into_iter().zip([6.0, 6.0, 10.0, 10.0, 15.0, 15.0]) {
        assert_near(found, expected, 1e-12);
    }
}

/// A void turns its shell round, and keeps its faces.
#[test]
fn a_solid_with_a_void_has_the_faces_of_both_shells() {
    let mut text = StepText::new();
    let outer = box_faces(&mut text, [4.0, 4.0, 4.0]);
    let inner = box_faces(&mut text, [1.0, 1.0, 1.0]);
    let list = |faces: &[Id]| faces.iter().map(|face| format!("#{face}")).collect::<Vec<_>>().join(",");
    let outer = text.add(format!("CLOSED_SHELL('',({}))", list(&outer)));
    let inner = text.add(format!("CLOSED_SHELL('',({}))", list(&inner)));
    let void = text.add(format!("ORIENTED_CLOSED_SHELL('',*,#{inner},.F.)"));
    let solid = text.add(format!("BREP_WITH_VOIDS('',#{outer},(#{void}))"));
    let (model, _) = read(&text.of(&[solid], UnitsOf::Millimetres));
    assert_near(areas(&model).iter().sum(), 6.0 * 16.0 + 6.0, 1e-12);
    let reversed: Vec<bool> = model.faces().map(|face| face.to_arrays().reversed).collect();
    assert_eq!(reversed, [[false; 6], [true; 6]].concat());
    let numbers: HashSet<_> = model.faces().map(|face| (face.solid(), face.shell())).collect();
    assert_eq!(numbers.len(), 2, "two shells");
    let solids: HashSet<_> = numbers.iter().map(|(solid, _)| *solid).collect();
    assert!(solids.len() == 1 && !solids.contains(&None), "{solids:?}");
}
