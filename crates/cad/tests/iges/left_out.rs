//! Faces and bodies that cannot be read, each in the report with its number and the reason.

use crate::solids::brick;
use crate::support::writers::iges::{Id, IgesText, list};
use nurbs_hausdorff::ReadReport;
use nurbs_hausdorff_cad::from_iges;

/// Reads a file with a box, besides which one entity is not read.
#[track_caller]
fn left_out(text: &mut IgesText, entity: Id, code: &str) -> ReadReport {
    brick(text, [1.0, 2.0, 4.0]);
    let (_, report) = from_iges(text.text().as_bytes()).unwrap();
    let found: Vec<_> = report.skipped.iter().map(|skipped| (skipped.entity, skipped.code)).collect();
    assert_eq!(found, [(Some(entity as u64), code)], "{report:?}");
    assert_eq!(report.faces, 6);
    report
}

fn square(text: &mut IgesText) -> Id {
    text.bilinear([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]])
}

#[test]
fn references_to_nothing_are_reported() {
    for parameters in ["999,0,0,0", "2,0,0,0", "0,0,0,0", "1,1,0,999"] {
        let mut text = IgesText::new();
        square(&mut text);
        let face = text.add(144, 0, parameters);
        let code = if parameters.starts_with('0') { "IGES_PARAMETER" } else { "IGES_REFERENCE" };
        // The surface is one of the trimmed surface's, or a face of its own.
        if parameters.starts_with('1') {
            left_out(&mut text, face, code);
        } else {
            text.entries[0].dependent = true;
            brick(&mut text, [1.0; 3]);
            let (_, report) = from_iges(text.text().as_bytes()).unwrap();
            let codes: Vec<_> = report.skipped.iter().map(|skipped| skipped.code).collect();
            assert_eq!(codes, ["IGES_LOOSE", code], "{parameters}");
        }
    }
}

#[test]
fn entities_where_others_belong_are_reported() {
    let mut text = IgesText::new();
    let line = text.line([0.0; 3], [1.0, 0.0, 0.0]);
    let face = text.add(144, 0, format!("{line},0,0,0"));
    let report = left_out(&mut text, face, "IGES_ENTITY");
    assert!(report.skipped[0].why.contains("entity 1 is of type 110"), "{report:?}");
}

/// A block of constructive geometry, an array of instances, and a reference to another file.
#[test]
fn bodies_that_are_not_read_are_reported() {
    for (kind, parameters) in [
        (150, "1.,2.,3.,0.,0.,0.,1.,0.,0.,0.,0.,1."),
        (412, "1,1.,0.,0.,0.,1,1,1.,1.,0.,0,0"),
        (416, "5Hother"),
    ] {
        let mut text = IgesText::new();
        let body = text.add(kind, 0, parameters);
        left_out(&mut text, body, "IGES_ENTITY");
    }
}

#[test]
fn a_subfigure_without_instances_is_reported() {
    let mut text = IgesText::new();
    let surface = square(&mut text);
    let face = text.trimmed(surface, None, &[]);
    text.add(308, 0, format!("0,4Hnone,{}", list(&[face])));
    left_out(&mut text, face, "IGES_LOOSE");
}

#[test]
fn matrices_other_than_rotations_are_reported() {
    for rows in [[[2.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]], [[0.0; 4]; 3]] {
        let mut text = IgesText::new();
        let surface = square(&mut text);
        let matrix = text.matrix(rows);
        text.place(surface, matrix);
        left_out(&mut text, surface, "IGES_MATRIX");
    }
}

/// A matrix that places itself, and a composite curve that is part of itself.
#[test]
fn circles_of_references_are_reported() {
    let mut text = IgesText::new();
    let surface = square(&mut text);
    let matrix = text.matrix([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);
    text.place(matrix, matrix);
    text.place(surface, matrix);
    left_out(&mut text, surface, "IGES_NESTING");
    let mut text = IgesText::new();
    let surface = square(&mut text);
    let own = 2 * text.entries.len() + 1;
    let curve = text.composite(&[own, own]);
    let face = text.trimmed(surface, Some((0, curve)), &[]);
    left_out(&mut text, face, "IGES_NESTING");
}

/// Counts beyond the parameters that follow are refused before memory is taken for them.
#[test]
fn counts_beyond_the_parameters_are_reported() {
    for parameters in
        ["16777215,16777215,3,3,0,0,0,0,0,0.,1.", "1,1,99,1,0,0,1,0,0,0.", "4e99,1,1,1,0,0,1,0,0,0."]
    {
        let mut text = IgesText::new();
        let surface = text.add(128, 0, parameters);
        left_out(&mut text, surface, "IGES_PARAMETER");
    }
}

#[test]
fn an_unbounded_plane_is_reported() {
    let mut text = IgesText::new();
    let plane = text.add(108, 0, "0.,0.,1.,0.,0,0.,0.,0.,0.");
    left_out(&mut text, plane, "BREP_UNBOUNDED");
}
