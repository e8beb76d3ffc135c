//! Colours of faces and bodies.

use crate::faces::polygons::box_faces;
use crate::support::writers::step::{Id, StepText, UnitsOf};
use nurbs_hausdorff::Model;
use nurbs_hausdorff_cad::from_step;

type Color = Option<[f64; 3]>;

const RED: Color = Some([1.0, 0.0, 0.0]);
const GREY: Color = Some([0.25, 0.5, 0.75]);

/// A style of a surface with a colour, as writers state it: by its fill area, or by its rendering.
fn style(text: &mut StepText, color: &str, rendered: bool) -> Id {
    let color = text.add(color);
    let side = if rendered {
        text.add(format!("SURFACE_STYLE_RENDERING_WITH_PROPERTIES($,#{color},(#1))"))
    } else {
        let fill = text.add(format!("FILL_AREA_STYLE_COLOUR('',#{color})"));
        let area = text.add(format!("FILL_AREA_STYLE('',(#{fill}))"));
        text.add(format!("SURFACE_STYLE_FILL_AREA(#{area})"))
    };
    let side = text.add(format!("SURFACE_SIDE_STYLE('',(#{side}))"));
    let usage = text.add(format!("SURFACE_STYLE_USAGE(.BOTH.,#{side})"));
    // A style of curves, whose colour is no face's.
    let width = text.add("POSITIVE_LENGTH_MEASURE(0.1)");
    let black = text.add("DRAUGHTING_PRE_DEFINED_COLOUR('black')");
    let curve = text.add(format!("CURVE_STYLE('',$,#{width},#{black})"));
    text.add(format!("PRESENTATION_STYLE_ASSIGNMENT((#{curve},#{usage}))"))
}

const RED_NAMED: &str = "DRAUGHTING_PRE_DEFINED_COLOUR('red')";
const GREY_PARTS: &str = "COLOUR_RGB('',0.25,0.5,0.75)";

/// Reads a box whose styles `paint` states, given its faces and its solid.
fn colors(paint: impl FnOnce(&mut StepText, &[Id], Id)) -> Vec<Color> {
    let mut text = StepText::new();
    text.add("CARTESIAN_POINT('',(0.,0.,0.))");
    let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    let solid = text.solid("box", &faces);
    paint(&mut text, &faces, solid);
    let text = text.of(&[solid], UnitsOf::Millimetres);
    let (model, report) = from_step(text.as_bytes()).unwrap();
    assert_eq!(report.skipped, []);
    model.faces().map(|face| face.color()).collect()
}

#[test]
fn a_face_has_its_own_colour_else_that_of_its_body() {
    for rendered in [false, true] {
        let found = colors(|text, faces, solid| {
            let (red, grey) = (style(text, RED_NAMED, rendered), style(text, GREY_PARTS, rendered));
            text.add(format!("STYLED_ITEM('',(#{red}),#{})", faces[2]));
            text.add(format!("STYLED_ITEM('',(#{grey}),#{solid})"));
        });
        assert_eq!(found, [GREY, GREY, RED, GREY, GREY, GREY]);
    }
    assert_eq!(colors(|_, _, _| {}), [None; 6]);
}

/// An overriding style comes before the one that it overrides in some files.
#[test]
fn a_style_that_overrides_wins() {
    let found = colors(|text, faces, solid| {
        let (red, grey) = (style(text, RED_NAMED, false), style(text, GREY_PARTS, false));
        let body = text.entities.len() + 2;
        text.add(format!("OVER_RIDING_STYLED_ITEM('',(#{red}),#{},#{body})", faces[0]));
        assert_eq!(text.add(format!("STYLED_ITEM('',(#{grey}),#{solid})")), body);
        text.add(format!("STYLED_ITEM('',(#{grey}),#{})", faces[0]));
    });
    assert_eq!(found, [RED, GREY, GREY, GREY, GREY, GREY]);
}

#[test]
fn colours_that_cannot_be_read_are_none() {
    for color in ["COLOUR_RGB('',0.25,2.,0.75)", "COLOUR_RGB('',$,0.,0.)", "PRE_DEFINED_COLOUR('mauve')"] {
        let found = colors(|text, _, solid| {
            let style = style(text, color, false);
            text.add(format!("STYLED_ITEM('',(#{style},#99999),#{solid})"));
        });
        assert_eq!(found, [None; 6], "{color}");
    }
    // A style that leads to itself.
    let found = colors(|text, _, solid| {
        let number = text.entities.len() + 1;
        text.add(format!("FILL_AREA_STYLE('',(#{number}))"));
        text.add(format!("STYLED_ITEM('',(#{number}),#{solid})"));
    });
    assert_eq!(found, [None; 6]);
}

/// A mapped item's colour is that of the faces that it places, unless they have their own.
#[test]
fn a_mapped_item_colours_what_it_places() {
    let mut text = StepText::new();
    let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    let solid = text.solid("", &faces);
    let context = text.context(UnitsOf::Millimetres);
    let part = text.representation(&[solid], context);
    let origin = text.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let map = text.add(format!("REPRESENTATION_MAP(#{origin},#{part})"));
    let item = text.add(format!("MAPPED_ITEM('lid',#{map},#{origin})"));
    let whole = text.representation(&[item], context);
    text.product("whole", whole);
    let (red, grey) = (style(&mut text, RED_NAMED, false), style(&mut text, GREY_PARTS, false));
    text.add(format!("STYLED_ITEM('',(#{grey}),#{item})"));
    text.add(format!("STYLED_ITEM('',(#{red}),#{})", faces[5]));
    let (model, _) = from_step(text.text().as_bytes()).unwrap();
    let found: Vec<Color> = model.faces().map(|face| face.color()).collect();
    assert_eq!(found, [GREY, GREY, GREY, GREY, GREY, RED]);
    assert_eq!(model.faces().next().unwrap().name(), Some("whole / lid / face 0"));
    // Interchange JSON keeps them.
    let again = Model::from_json(&model.to_json().unwrap()).unwrap();
    assert_eq!(again.faces().map(|face| face.color()).collect::<Vec<_>>(), found);
}
