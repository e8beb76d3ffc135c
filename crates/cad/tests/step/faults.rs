//! Small files of one matter each, from `../shared/faults/step`: read as they are, or named.

use crate::area;
use nurbs_hausdorff::ReadReport;
use nurbs_hausdorff_cad::{from_file, from_step};
use std::f64::consts::PI;

/// The content of a file; `None` where the folder is absent.
fn content(file: &str) -> Option<Vec<u8>> {
    crate::support::models::faults("faults")
        .map(|folder| std::fs::read(folder.join("step").join(file)).unwrap())
}

fn named(report: &ReadReport) -> Vec<(&'static str, Option<u64>)> {
    report.skipped.iter().map(|skipped| (skipped.code, skipped.entity)).collect()
}

/// A unit square at z = 0, and in the same file: what else is read, as the area and the greatest height of all, or
/// what is named.
#[test]
fn nothing_beside_a_square_is_silent() {
    type Named = Option<(&'static str, u64)>;
    let files: [(&str, f64, f64, Named); 20] = [
        ("tess_triangulated_face", 1.0, 0.0, Some(("STEP_TRIANGLES", 57))),
        ("tess_complex_triangulated_face", 1.0, 0.0, Some(("STEP_TRIANGLES", 57))),
        ("tess_triangulated_surface_set", 1.0, 0.0, Some(("STEP_TRIANGLES", 57))),
        ("item_advanced_face", 2.0, 5.0, None),
        ("item_advanced_face_sr", 2.0, 5.0, None),
        ("item_raw_surface", 2.0, 5.0, None),
        ("curve_set_with_surface", 2.0, 5.0, None),
        ("csg_rcc", 1.0 + 6.0 * PI, 2.0, None),
        ("csg_sphere", 1.0, 0.0, Some(("STEP_ENTITY", 52))),
        ("csg_ellipsoid", 1.0, 0.0, Some(("STEP_ENTITY", 52))),
        ("csg_surface_model", 1.0, 0.0, Some(("STEP_ENTITY", 52))),
        ("csg_trimmed_volume", 1.0, 0.0, Some(("STEP_ENTITY", 52))),
        ("csg_volume", 1.0, 0.0, Some(("STEP_ENTITY", 52))),
        ("empty_solid", 1.0, 0.0, Some(("STEP_ATTRIBUTE", 48))),
        ("loose_advanced_face", 1.0, 0.0, Some(("STEP_LOOSE", 87))),
        ("loose_geometric_set", 1.0, 0.0, Some(("STEP_LOOSE", 54))),
        ("mapped_item_loose", 2.0, 0.0, Some(("STEP_LOOSE", 112))),
        ("external_part_missing", 1.0, 10.0, Some(("STEP_PLACE", 95))),
        ("nauo_without_place", 2.0, 20.0, Some(("STEP_PLACE", 90))),
        ("one", 1.0, 0.0, None),
    ];
    for (file, total, height, expected) in files {
        let Some(content) = content(&format!("{file}.step")) else { return };
        let (model, report) = from_step(&content).unwrap();
        let found: f64 = model.faces().map(|face| area::area(&face)).sum();
        assert!((found - total).abs() < 1e-9, "{file}: {found}");
        assert_eq!(model.bounding_box().max[2], height, "{file}");
        assert_eq!(
            named(&report),
            Vec::from_iter(expected.map(|(code, entity)| (code, Some(entity)))),
            "{file}"
        );
    }
}

/// A number that is damaged makes a placement of what is to be a transformation; both uses stood at one place before.
#[test]
fn a_placement_is_no_transformation() {
    let Some(content) = content("nauo_without_place.step") else { return };
    let text = String::from_utf8(content).unwrap();
    let damaged = text.replace("_WITH_TRANSFORMATION(#81)", "_WITH_TRANSFORMATION(#71)");
    assert_ne!(damaged, text);
    let (model, report) = from_step(damaged.as_bytes()).unwrap();
    assert_eq!(model.faces().count(), 1);
    assert_eq!(named(&report), [("STEP_ENTITY", Some(82)), ("STEP_PLACE", Some(90))]);
    assert!(report.skipped[0].why.contains("#71 is AXIS2_PLACEMENT_3D"), "{report:?}");
}

#[test]
fn what_writers_do_otherwise_is_read() {
    for (file, total, height) in [
        ("transform_items_swapped", 1.0, 5.0),
        ("relationship_swapped", 1.0, 5.0),
        ("oriented_edge_chain", PI, 0.0),
        ("flags_true", PI, 0.0),
        ("pcurve_as_edge_geometry", 2.0, 1.0),
        ("torus_negative_major", 4.0 * PI * PI * 500.0, 10.0),
        ("complex_topology", 1.0, 0.0),
    ] {
        let Some(content) = content(&format!("{file}.step")) else { return };
        let (model, report) = from_step(&content).unwrap();
        let found: f64 = model.faces().map(|face| area::area(&face)).sum();
        assert!((found - total).abs() < 1e-9 * total, "{file}: {found}");
        assert!((model.bounding_box().max[2] - height).abs() < 1e-12, "{file}");
        assert_eq!(report.skipped, [], "{file}");
    }
}

#[test]
fn what_is_no_model_is_refused_by_name() {
    for (file, code, why) in [
        ("concatenated.step", "STEP_SYNTAX", "line 65: "),
        ("nauo_nested_without_place.step", "BREP_UNREADABLE", "no relationship or mapped item places it"),
        ("edge_off_plane_0.1.step", "BREP_UNREADABLE", "from the surface"),
        ("bomb_24.step", "TOO_MANY_FACES", "16777216 faces"),
        ("bomb_20.step", "TOO_MANY_FACES", "faces"),
        ("ifc_minimal.ifc", "FORMAT_UNSUPPORTED", "an IFC file"),
        ("lower_case.step", "FORMAT_UNSUPPORTED", "in lower case"),
    ] {
        let Some(content) = content(file) else { return };
        let error = from_file(content, file).unwrap_err();
        assert_eq!(error.code(), code, "{file}: {error}");
        assert!(error.to_string().contains(why), "{file}: {error}");
    }
}

#[test]
fn a_unit_that_is_not_stated_is_none() {
    let Some(content) = content("unit_none.step") else { return };
    let (_, report) = from_step(&content).unwrap();
    assert_eq!(report.unit, None);
}
