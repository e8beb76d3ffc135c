//! Items of representations: what is read of each, and what is named where it is not.

mod left_out;
mod primitives;
mod triangles;

use crate::faces::polygons::box_faces;
use crate::support::writers::step::{Id, StepText, UnitsOf};
use crate::{areas, assert_near};
use nurbs_hausdorff::{Model, ReadReport};
use nurbs_hausdorff_cad::from_step;

/// A box of the size 1 x 2 x 4 and more items in its representation.
fn beside_a_box(add: impl FnOnce(&mut StepText) -> Vec<Id>) -> (Model, ReadReport) {
    let mut text = StepText::new();
    let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    let solid = text.solid("", &faces);
    let more = add(&mut text);
    let items = [vec![solid], more].concat();
    from_step(text.of(&items, UnitsOf::Millimetres).as_bytes()).unwrap()
}

/// The codes and numbers of what was skipped.
fn named(report: &ReadReport) -> Vec<(&'static str, Option<u64>)> {
    report.skipped.iter().map(|skipped| (skipped.code, skipped.entity)).collect()
}

fn square(text: &mut StepText, height: f64) -> Id {
    let rows = [0.0, 3.0].map(|x| {
        let row = [0.0, 3.0].map(|y| format!("#{}", text.point([x, y, height])));
        format!("({})", row.join(","))
    });
    text.add(format!("QUASI_UNIFORM_SURFACE('raw',1,1,({}),.UNSPECIFIED.,.F.,.F.,.F.)", rows.join(",")))
}

#[test]
fn faces_and_surfaces_are_items_themselves() {
    let (model, report) = beside_a_box(|text| {
        let mut items = box_faces(text, [5.0, 7.0, 1.0]);
        items.push(square(text, 9.0));
        items
    });
    assert_eq!(report.skipped, []);
    let found = areas(&model);
    assert_eq!(found.len(), 13);
    assert_near(found[6..12].iter().sum(), 2.0 * (35.0 + 7.0 + 5.0), 1e-12);
    assert_near(found[12], 9.0, 1e-12);
    assert_near(model.bounding_box().max[2], 9.0, 0.0);
}

/// Writers put surfaces in sets of curves too.
#[test]
fn surfaces_are_read_of_any_set() {
    for set in ["GEOMETRIC_SET", "GEOMETRIC_CURVE_SET"] {
        let (model, report) = beside_a_box(|text| {
            let point = text.point([0.0; 3]);
            let line = text.line([0.0; 3], [1.0, 0.0, 0.0]);
            let square = square(text, 9.0);
            vec![text.add(format!("{set}('',(#{point},#{line},#{square}))"))]
        });
        assert_eq!((report.skipped, model.faces().len()), (vec![], 7), "{set}");
    }
}

/// Of an entity that the reader does not know it is not assumed that it has no surface.
#[test]
fn items_that_are_not_known_are_named() {
    for kind in [
        "ELLIPSOID",
        "SOLID_WITH_DEPRESSION",
        "TRIMMED_VOLUME",
        "B_SPLINE_VOLUME",
        "RIGHT_ANGULAR_WEDGE",
        "BOOLEAN_RESULT",
        "RECTANGULAR_COMPOSITE_SURFACE",
        "SURFACE_CURVE_SWEPT_AREA_SOLID",
        "CUBIC_BEZIER_TRIANGULATED_FACE",
        "SOMETHING_NEW",
        "(BLOCK",
        "(SOMETHING_NEW",
    ] {
        let mut number = 0;
        let (_, report) = beside_a_box(|text| {
            let general = "GEOMETRIC_REPRESENTATION_ITEM()REPRESENTATION_ITEM(''))";
            number = text.add(match kind.strip_prefix('(') {
                Some(kind) => format!("({kind}($){general}"),
                None => format!("{kind}('',$)"),
            });
            vec![number]
        });
        assert_eq!(named(&report).len(), 1, "{kind}");
        assert_eq!(report.skipped[0].entity, Some(number as u64), "{kind}");
        assert!(report.skipped[0].why.contains(kind.trim_start_matches('(')), "{}", report.skipped[0].why);
    }
}

#[test]
fn items_without_a_surface_are_not_named() {
    let (_, report) = beside_a_box(|text| {
        let kinds = [
            "CARTESIAN_POINT('',(0.,0.,0.))",
            "POLYLINE('',())",
            "B_SPLINE_CURVE_WITH_KNOTS('',1,(),.UNSPECIFIED.,.F.,.F.,(),(),.UNSPECIFIED.)",
            "COMPOSITE_CURVE_ON_SURFACE('',(),.F.)",
            "SURFACE_CURVE('',$,(),.CURVE_3D.)",
            "POINT_ON_SURFACE('',$,0.,0.)",
            "AXIS2_PLACEMENT_3D('',$,$,$)",
            "MEASURE_REPRESENTATION_ITEM('',$,$)",
            "DESCRIPTIVE_REPRESENTATION_ITEM('','')",
            "SHELL_BASED_WIREFRAME_MODEL('',())",
            "TESSELLATED_CURVE_SET('',$,())",
            "TESSELLATED_ANNOTATION_OCCURRENCE('',(),$)",
            "(CAMERA_MODEL()CAMERA_MODEL_D3()GEOMETRIC_REPRESENTATION_ITEM()REPRESENTATION_ITEM(''))",
            "(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT($,$)REPRESENTATION_ITEM(''))",
        ];
        kinds.iter().map(|kind| text.add(*kind)).collect()
    });
    assert_eq!(report.skipped, []);
}

#[test]
fn bodies_without_faces_are_named() {
    let mut shells = [0; 2];
    let (_, report) = beside_a_box(|text| {
        shells = ["CLOSED_SHELL", "OPEN_SHELL"].map(|kind| text.add(format!("{kind}('',())")));
        let solid = text.add(format!("MANIFOLD_SOLID_BREP('empty',#{})", shells[0]));
        let model = text.add(format!("SHELL_BASED_SURFACE_MODEL('',(#{}))", shells[1]));
        vec![solid, model]
    });
    let expected = shells.map(|shell| ("STEP_ATTRIBUTE", Some(shell as u64)));
    assert_eq!(named(&report), expected);
}

/// Whatever has surfaces and stands in no representation is named once, and not each part of it.
#[test]
fn faces_and_bodies_of_no_representation_are_named() {
    let mut expected = Vec::new();
    let (_, report) = beside_a_box(|text| {
        let faces = box_faces(text, [5.0, 7.0, 1.0]);
        let solid = text.solid("", &faces);
        let face = box_faces(text, [2.0, 2.0, 2.0])[0];
        // The other faces of that box are loose too.
        expected.extend(
            (face..=text.entities.len()).filter(|&id| text.entities[id - 1].starts_with("ADVANCED_FACE")),
        );
        let square = square(text, 9.0);
        let set = text.add(format!("GEOMETRIC_SET('',(#{square}))"));
        expected.extend([solid, set]);
        Vec::new()
    });
    expected.sort_unstable();
    let mut found: Vec<Id> =
        report.skipped.iter().filter_map(|skipped| skipped.entity).map(|id| id as Id).collect();
    found.sort_unstable();
    assert_eq!(found, expected);
    assert!(report.skipped.iter().all(|skipped| skipped.code == "STEP_LOOSE"));
}

/// Triangles of an annotation are no shape.
#[test]
fn pictures_of_annotations_are_not_named() {
    let (_, report) = beside_a_box(|text| {
        let points = text.add("COORDINATES_LIST('',3,((0.,0.,5.),(1.,0.,5.),(1.,1.,5.)))");
        let arrow = text.add(format!("COMPLEX_TRIANGULATED_SURFACE_SET('',#{points},3,(),(),((1,2,3)),())"));
        let set = text.add(format!("TESSELLATED_GEOMETRIC_SET('',(#{arrow}))"));
        text.add(format!("TESSELLATED_ANNOTATION_OCCURRENCE('',(),#{set})"));
        Vec::new()
    });
    assert_eq!(report.skipped, []);
}

#[test]
fn a_mapped_item_of_no_representation_is_named() {
    let mut text = StepText::new();
    let context = text.context(UnitsOf::Millimetres);
    let part = |text: &mut StepText, size: [f64; 3]| {
        let faces = box_faces(text, size);
        let solid = text.solid("", &faces);
        text.representation(&[solid], context)
    };
    let whole = part(&mut text, [1.0, 2.0, 4.0]);
    let other = part(&mut text, [1.0, 1.0, 1.0]);
    text.product("whole", whole);
    let origin = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let map = text.add(format!("REPRESENTATION_MAP(#{origin},#{other})"));
    let item = text.add(format!("MAPPED_ITEM('',#{map},#{origin})"));
    let (_, report) = from_step(text.text().as_bytes()).unwrap();
    assert_eq!(named(&report), [("STEP_LOOSE", Some(item as u64))]);
}
