//! Groups, subfigures and instances, and where they are placed.

use crate::solids::brick;
use crate::support::writers::iges::{IgesText, list};
use crate::{areas, assert_near, read};
use nurbs_hausdorff::Model;
use nurbs_hausdorff_cad::from_iges;

#[track_caller]
fn assert_bounds(model: &Model, low: [f64; 3], high: [f64; 3]) {
    let bounds = model.bounding_box();
    for axis in 0..3 {
        assert_near(bounds.min[axis], low[axis], 1e-12);
        assert_near(bounds.max[axis], high[axis], 1e-12);
    }
}

/// A part used twice: where it is, and scaled, moved and then turned about z.
#[test]
fn a_subfigure_stands_where_its_instances_do() {
    let mut text = IgesText { unit: (1, "INCH"), ..IgesText::new() };
    let solid = brick(&mut text, [1.0, 2.0, 4.0]);
    let definition = text.add(308, 0, format!("0,4Hbolt,{}", list(&[solid])));
    text.add(408, 0, format!("{definition},0.,0.,0.,1."));
    let moved = text.add(408, 0, format!("{definition},10.,0.,0.,3."));
    let turn = text.matrix([[0.0, -1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);
    text.place(moved, turn);
    let (model, report) = read(&text);
    assert_eq!((report.faces, model.faces().len()), (6, 12));
    // The second one reaches from x = -6 to 0 and from y = 10 to 13.
    assert_bounds(&model, [-6.0, 0.0, 0.0].map(|x| 25.4 * x), [1.0, 13.0, 12.0].map(|x| 25.4 * x));
    let parts = [0, 6].map(|face| model.faces().nth(face).unwrap().name().unwrap().to_owned());
    assert_eq!(parts, ["bolt / face 0", "bolt (2) / face 0"]);
}

/// A subfigure of subfigures, whose places are chained.
#[test]
fn subfigures_are_nested() {
    let mut text = IgesText::new();
    let solid = brick(&mut text, [1.0, 1.0, 1.0]);
    let inner = text.add(308, 0, format!("0,5Hinner,{}", list(&[solid])));
    let uses = [0.0, 5.0].map(|x| text.add(408, 0, format!("{inner},{x:?},0.,0.,1.")));
    let outer = text.add(308, 0, format!("1,5Houter,{}", list(&uses)));
    text.add(408, 0, format!("{outer},0.,100.,0."));
    let (model, _) = read(&text);
    assert_eq!(model.faces().len(), 12);
    assert_bounds(&model, [0.0, 100.0, 0.0], [6.0, 101.0, 1.0]);
    let parts = [0, 6].map(|face| model.faces().nth(face).unwrap().name().unwrap().to_owned());
    assert_eq!(parts, ["outer / inner / face 0", "outer / inner (2) / face 0"]);
}

/// A colour of the file's own on a face, and a numbered one on the solid that it belongs to.
#[test]
fn a_face_has_its_own_colour_else_that_of_its_body() {
    let mut text = IgesText::new();
    let solid = brick(&mut text, [1.0, 1.0, 1.0]);
    let grey = text.add(314, 0, "25.,50.,75.,4Hgrey");
    text.entries[solid / 2].color = 2;
    let face = text.entries.iter().position(|entry| entry.kind == 510).unwrap();
    text.entries[face].color = -(grey as i64);
    let (model, _) = read(&text);
    let colors: Vec<_> = model.faces().map(|face| face.color().unwrap()).collect();
    assert_eq!(colors.iter().filter(|color| **color == [1.0, 0.0, 0.0]).count(), 5);
    assert_eq!(colors.iter().filter(|color| **color == [0.25, 0.5, 0.75]).count(), 1);
    // Numbers that no colour has are none.
    text.entries[solid / 2].color = 9;
    text.entries[face].color = -(solid as i64);
    let (model, _) = read(&text);
    assert!(model.faces().all(|face| face.color().is_none()));
}

/// A face of a group is one face, though the group and the file name it.
#[test]
fn a_group_repeats_nothing() {
    let mut text = IgesText::new();
    let surfaces =
        [0.0, 1.0].map(|z| text.bilinear([[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z], [1.0, 1.0, z]]));
    let curve = text.line([0.0; 3], [1.0, 0.0, 0.0]);
    text.add(402, 7, list(&[surfaces[1], curve, surfaces[0]]));
    let (model, _) = read(&text);
    assert_eq!(areas(&model).len(), 2);
    // In the order of the group.
    assert_near(model.faces().next().unwrap().to_arrays().surface.control_points[0][2], 1.0, 1e-12);
}

#[test]
fn instances_of_solids_are_placed() {
    let mut text = IgesText::new();
    let solid = brick(&mut text, [1.0, 1.0, 1.0]);
    let shift = text.matrix([[1.0, 0.0, 0.0, 10.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);
    let instance = text.add(430, 0, format!("{solid}"));
    text.place(instance, shift);
    text.add(184, 0, format!("2,{solid},{instance},0,{shift}"));
    let (model, _) = read(&text);
    assert_bounds(&model, [0.0; 3], [21.0, 1.0, 1.0]);
    assert_eq!(model.faces().len(), 12);
}

/// Groups that contain each other are reported, and their other faces read.
#[test]
fn groups_that_contain_each_other_are_reported() {
    let mut text = IgesText::new();
    let surface = text.bilinear([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
    text.add(402, 7, list(&[surface, 5]));
    text.add(402, 7, list(&[3]));
    let (_, report) = from_iges(text.text().as_bytes()).unwrap();
    assert_eq!((report.faces, report.skipped.len()), (1, 1));
    assert_eq!(report.skipped[0].code, "IGES_NESTING");
}
