//! Faces and bodies that cannot be read: each is in the report with its number.

use crate::faces::polygons::box_faces;
use crate::support::writers::step::{Id, StepText, UnitsOf};
use nurbs_hausdorff::Skipped;
use nurbs_hausdorff_cad::from_step;

/// A box whose text a function changes, and the face whose reading that spoils.
fn damaged(damage: impl Fn(&mut StepText, Id)) -> (Id, Vec<Skipped>) {
    let mut text = StepText::new();
    let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    damage(&mut text, faces[2]);
    let solid = text.solid("", &faces);
    let written = text.of(&[solid], UnitsOf::Millimetres);
    let (model, report) = from_step(written.as_bytes()).unwrap();
    assert_eq!(model.faces().len(), 6 - report.skipped.len());
    (faces[2], report.skipped)
}

/// The instance to which a face refers by the keyword of that.
fn surface_of(text: &StepText, face: Id) -> Id {
    let entity = &text.entities[face - 1];
    entity.rsplit_once('#').and_then(|(_, rest)| rest.split_once(',')).unwrap().0.parse().unwrap()
}

#[track_caller]
fn assert_left_out((face, skipped): (Id, Vec<Skipped>), code: &str, why: &str) {
    assert_eq!(skipped.len(), 1, "{skipped:?}");
    assert_eq!((&skipped[0].face, skipped[0].entity), (&2.into(), Some(face as u64)));
    assert_eq!(skipped[0].code, code);
    assert!(skipped[0].why.contains(why), "{}", skipped[0].why);
}

#[test]
fn a_reference_to_nothing_leaves_out_the_face_alone() {
    let found = damaged(|text, face| {
        let surface = format!("#{}", surface_of(text, face));
        text.entities[face - 1] = text.entities[face - 1].replace(&format!("{surface},"), "#99999,");
    });
    assert_left_out(found, "STEP_REFERENCE", "#99999 is referred to, and not defined");
}

#[test]
fn a_surface_of_another_kind_is_named() {
    let found = damaged(|text, face| {
        let surface = surface_of(text, face);
        text.entities[surface - 1] = "FREE_FORM_SURFACE('',$)".to_owned();
    });
    assert_left_out(found, "STEP_ENTITY", "FREE_FORM_SURFACE, expected a surface");
}

#[test]
fn an_attribute_of_another_type_is_named() {
    let found = damaged(|text, face| {
        let surface = surface_of(text, face);
        text.entities[surface - 1] = "PLANE('',.T.)".to_owned();
    });
    assert_left_out(found, "STEP_ATTRIBUTE", "attribute 2 of");
}

/// A face that the shell names and the file does not define.
#[test]
fn a_face_that_is_not_there_is_left_out() {
    let mut text = StepText::new();
    let mut faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    faces.push(77_777);
    let solid = text.solid("", &faces);
    let (_, report) = from_step(text.of(&[solid], UnitsOf::Millimetres).as_bytes()).unwrap();
    assert_eq!(report.faces, 6);
    assert_eq!((report.skipped[0].entity, report.skipped[0].code), (Some(77_777), "STEP_REFERENCE"));
}

#[test]
fn a_number_given_twice_is_not_chosen_from() {
    let mut text = StepText::new();
    let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    let solid = text.solid("", &faces);
    let face = faces[4];
    let again = format!("#{face}={};\nENDSEC;\nEND-ISO", text.entities[face - 1]);
    let written = text.of(&[solid], UnitsOf::Millimetres).replace("ENDSEC;\nEND-ISO", &again);
    let (_, report) = from_step(written.as_bytes()).unwrap();
    assert_eq!(report.faces, 5);
    assert_eq!((&report.skipped[0].face, report.skipped[0].code), (&4.into(), "STEP_REFERENCE"));
}

#[test]
fn a_shell_of_no_representation_and_a_body_of_another_kind_are_named() {
    let mut text = StepText::new();
    let faces = box_faces(&mut text, [1.0, 2.0, 4.0]);
    let solid = text.solid("", &faces);
    let loose = text.add(format!("OPEN_SHELL('',(#{}))", faces[0]));
    let block = text.add("SWEPT_AREA_SOLID('',$)");
    let written = text.of(&[solid, block], UnitsOf::Millimetres);
    let (_, report) = from_step(written.as_bytes()).unwrap();
    assert_eq!(report.faces, 6);
    let found: Vec<_> = report.skipped.iter().map(|skipped| (skipped.code, skipped.entity)).collect();
    assert_eq!(found, [("STEP_ENTITY", Some(block as u64)), ("STEP_LOOSE", Some(loose as u64))]);
}

#[test]
fn a_file_without_bodies_has_no_model() {
    let mut text = StepText::new();
    let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let error = from_step(text.of(&[placement], UnitsOf::Millimetres).as_bytes()).unwrap_err();
    assert_eq!(error.code(), "EMPTY_MODEL");
}

/// Curves nested in each other without an end.
#[test]
fn a_curve_of_itself_is_left_out() {
    let mut text = StepText::new();
    let number = text.entities.len() + 1;
    let curve = text.add(format!("SURFACE_CURVE('',#{number},(),.CURVE_3D.)"));
    let vertex = text.vertex([0.0; 3]);
    let edge = text.edge(curve, [vertex, vertex], true);
    let path = text.edge_loop(&[(edge, true)]);
    let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let surface = text.add(format!("PLANE('',#{placement})"));
    let face = text.face(&[path], surface, true);
    let shell = text.open_shell(&[face]);
    let error = from_step(text.of(&[shell], UnitsOf::Millimetres).as_bytes()).unwrap_err();
    assert_eq!(error.code(), "BREP_UNREADABLE");
    assert!(error.to_string().contains("nested more than 32 times"), "{error}");
}

/// Surfaces of a set, within boundary curves or whole; a set has no shells.
#[test]
fn the_surfaces_of_a_set_are_faces() {
    let mut text = StepText::new();
    let placement = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let plane = text.add(format!("PLANE('',#{placement})"));
    let circle = text.circle(placement, 2.0);
    let segment = text.add(format!("COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#{circle})"));
    let boundary = text.add(format!("OUTER_BOUNDARY_CURVE('',(#{segment}),.F.)"));
    let disc = text.add(format!("CURVE_BOUNDED_SURFACE('disc',#{plane},(#{boundary}),.F.)"));
    let sphere = text.add(format!("SPHERICAL_SURFACE('',#{placement},3.)"));
    let zone = text.add(format!("RECTANGULAR_TRIMMED_SURFACE('',#{sphere},0.,3.,0.,0.5,.T.,.T.)"));
    let point = text.point([0.0; 3]);
    let set = text.add(format!("GEOMETRIC_SET('',(#{point},#{disc},#{zone}))"));
    let (model, report) = from_step(text.of(&[set], UnitsOf::Millimetres).as_bytes()).unwrap();
    assert_eq!(report.skipped, []);
    let found: Vec<f64> = model.faces().map(|face| crate::area::area(&face)).collect();
    crate::assert_near(found[0], std::f64::consts::PI * 4.0, 1e-12);
    crate::assert_near(found[1], 9.0 * 3.0 * 0.5_f64.sin(), 1e-9);
    assert_eq!(model.faces().next().unwrap().name(), Some("part / disc"));
}

/// A hole in a whole surface: a B-spline of the square [0, 4]², and a zone of a sphere up to its
/// pole, each without the disc that a circle bounds.
#[test]
fn a_whole_surface_of_a_set_has_its_hole() {
    let mut text = StepText::new();
    let rows: Vec<String> = [0.0, 4.0]
        .iter()
        .map(|&x| {
            let row = [0.0, 4.0].map(|y| format!("#{}", text.point([x, y, 0.0])));
            format!("({})", row.join(","))
        })
        .collect();
    let square = text.add(format!(
        "B_SPLINE_SURFACE_WITH_KNOTS('',1,1,({}),.UNSPECIFIED.,.F.,.F.,.F.,(2,2),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.)",
        rows.join(",")
    ));
    let origin = text.axis([0.0; 3], [0.0, 0.0, 1.0]);
    let sphere = text.add(format!("SPHERICAL_SURFACE('',#{origin},5.)"));
    let zone =
        text.add(format!("RECTANGULAR_TRIMMED_SURFACE('',#{sphere},0.,3.,0.,1.5707963267948966,.T.,.T.)"));
    let mut faces = Vec::new();
    // The circle on the sphere is 4.9 from its centre.
    for (surface, at, axis, radius) in [
        (square, [2.0, 2.0, 0.0], [0.0, 0.0, 1.0], 1.5),
        (zone, [0.0, 3.92, 2.94], [0.0, 0.8, 0.6], 0.99_f64.sqrt()),
    ] {
        let placement = text.axis(at, axis);
        let circle = text.circle(placement, radius);
        let segment = text.add(format!("COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.F.,#{circle})"));
        let boundary = text.add(format!("BOUNDARY_CURVE('',(#{segment}),.F.)"));
        faces.push(text.add(format!("CURVE_BOUNDED_SURFACE('',#{surface},(#{boundary}),.T.)")));
    }
    let set = text.add(format!("GEOMETRIC_SET('',(#{},#{}))", faces[0], faces[1]));
    let (model, report) = from_step(text.of(&[set], UnitsOf::Millimetres).as_bytes()).unwrap();
    assert_eq!(report.skipped, []);
    let found: Vec<f64> = model.faces().map(|face| crate::area::area(&face)).collect();
    let pi = std::f64::consts::PI;
    crate::assert_near(found[0], 16.0 - pi * 2.25, 1e-7);
    // The zone has 3 radians of the half sphere; the cap has the height 0.1.
    crate::assert_near(found[1], 3.0 * 25.0 - 2.0 * pi * 5.0 * 0.1, 1e-6);
}

/// Faces share a surface of 40,000 control points, and each face of the model has a copy.
#[test]
fn faces_that_share_a_large_surface_are_limited() {
    let mut text = StepText::new();
    let (rows, faces) = (200, 500);
    let mut point = |row: usize, column: usize| format!("#{}", text.point([row as f64, column as f64, 0.0]));
    let poles: Vec<String> = (0..rows)
        .map(|row| format!("({})", (0..rows).map(|column| point(row, column)).collect::<Vec<_>>().join(",")))
        .collect();
    let surface =
        text.add(format!("QUASI_UNIFORM_SURFACE('',1,1,({}),.UNSPECIFIED.,.F.,.F.,.F.)", poles.join(",")));
    let faces: Vec<Id> = (0..faces).map(|_| text.face(&[], surface, true)).collect();
    let shell = text.open_shell(&faces);
    let (model, report) = from_step(text.of(&[shell], UnitsOf::Millimetres).as_bytes()).unwrap();
    let expected = (1 << 24) / (rows * rows);
    assert_eq!((model.faces().len(), report.skipped.len()), (expected, 500 - expected));
    assert!(report.skipped.iter().all(|skipped| skipped.code == "BREP_TOO_LARGE"));
}
