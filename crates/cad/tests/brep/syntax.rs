//! Damaged texts, and the three versions of the format.

use crate::support::writers::brep::{BrepText, Child, plus, rectangle};
use nurbs_hausdorff::Error;
use nurbs_hausdorff_cad::from_brep;

fn square() -> (BrepText, Child) {
    let mut text = BrepText::new();
    let plane = text.surface("1 0 0 0 0 0 1 1 0 0 0 1 0");
    let face = text.region(plane, &[rectangle([0.0, 0.0], [1.0, 1.0])]);
    (text, plus(face))
}

fn refused(text: &str, line: usize, found: &str, expected: &str) {
    match from_brep(text) {
        Err(Error::BrepSyntax { line: at, found: word, expected: rule }) => {
            assert!(rule.contains(expected), "{rule}");
            assert_eq!((at, word.as_str()), (line, found));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn errors_name_the_line_and_what_was_expected() {
    refused("", 1, "the end of the text", "the header");
    refused("\nCASCADE Topology V9, (c)", 2, "V9,", "V1, V2 or V3");
    let header = "CASCADE Topology V1, (c) Matra-Datavision\nLocations ";
    refused(&format!("{header}1\n3"), 3, "3", "the kind of a location");
    refused(&format!("{header}1\n2 1 1 0"), 3, "1", "a location above");
    refused(&format!("{header}x"), 2, "x", "the number of locations");
    refused(&format!("{header}0\nCurve2ds 1\n1 0 zero"), 4, "zero", "a coordinate");
    refused(&format!("{header}0\nCurve2ds 1\n1 0 NaN"), 4, "NaN", "a coordinate");
    refused(&format!("{header}0\nCurve2ds 1\n7 0 0 3 4 2 0 0 1 1 2 2 3 3\n 0 4 0 4"), 5, "0", "a knot above");
    refused(&format!("{header}0\nCurve2ds 1\n6 1 1 0 0 -1"), 4, "-1", "a weight above 0");
    refused(&format!("{header}0\nCurve2ds 1\n7 0 0 26 4"), 4, "26", "a degree, 1 to 25");
}

/// Counts far beyond the text take no memory, and end where the text does.
#[test]
fn bogus_counts_end_with_the_text() {
    let huge = usize::MAX;
    let header = "CASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 0\nCurves 0\n";
    refused(&format!("{header}Surfaces {huge}"), 5, "the end of the text", "the kind of a surface");
    let spline = format!("{header}Surfaces 1\n9 0 0 0 0 1 1 {huge} {huge} 2 2 0 0 0");
    refused(&spline, 6, "the end of the text", "a coordinate");
    refused(&format!("{header}Surfaces 0\nTShapes {huge}"), 6, "the end of the text", "a kind of shape");
}

#[test]
fn deep_nesting_is_refused() {
    let header = "CASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 1\n";
    let curves = format!("{header}{}1 0 0 1 0", "9 1\n".repeat(100_000));
    refused(&curves, 37, "9", "at most 32 nested curves");
    let surfaces = format!(
        "CASCADE Topology V1, (c)\nLocations 0\nCurve2ds 0\nCurves 0\nSurfaces 1\n{}",
        "11 1\n".repeat(100_000)
    );
    refused(&surfaces, 39, "11", "at most 32 nested surfaces");
}

#[test]
fn shapes_refer_to_those_above_them() {
    let (text, root) = square();
    let written = text.text(root);
    let face = written.rfind("\nFa").unwrap();
    let damaged = written[..face].to_owned() + &written[face..].replacen("+2 0 *", "+1 0 *", 1);
    assert!(matches!(from_brep(&damaged), Err(Error::BrepSyntax { .. })));
    let beyond = written[..face].to_owned() + &written[face..].replacen("+2 0 *", "+99 0 *", 1);
    assert!(matches!(from_brep(&beyond), Err(Error::BrepSyntax { .. })));
}

#[test]
fn every_truncation_is_an_error() {
    let (text, root) = square();
    let written = text.text(root);
    assert!(from_brep(&written).is_ok());
    let end = written.trim_end().len();
    // The last words are the root.
    for length in 0..end - 3 {
        if written.is_char_boundary(length) {
            assert!(from_brep(&written[..length]).is_err(), "{length}");
        }
    }
}

#[test]
fn the_three_versions_give_the_same_model() {
    let (mut text, root) = square();
    let first = from_brep(&text.text(root)).unwrap();
    text.version = 3;
    assert_eq!(from_brep(&text.text(root)).unwrap(), first);
    text.version = 2;
    for (head, _) in &mut text.shapes {
        // The ends of each curve follow it.
        *head = head.replace(" 0.0 1.0\n", " 0.0 1.0\n0 0 1 0\n");
    }
    assert_eq!(from_brep(&text.text(root)).unwrap(), first);
    let drawn = format!("DBRep_DrawableShape\n{}", text.text(root));
    assert_eq!(from_brep(&drawn).unwrap(), first);
}

/// Polygons and triangles, which the file may hold beside the exact shape, are skipped.
#[test]
fn triangulations_are_skipped() {
    let (text, root) = square();
    let plain = text.text(root);
    let written = plain
        .replace("Polygon3D 0", "Polygon3D 1\n2 1\n0.1\n0 0 0 1 0 0\n0 1")
        .replace("PolygonOnTriangulations 0", "PolygonOnTriangulations 1\n2 1 2\np 0.1 1 0 1")
        .replace("Triangulations 0", "Triangulations 1\n3 1 1 0.1\n0 0 0 1 0 0 0 1 0 0 0 1 0 0 1 1 2 3")
        .replace("\n0\n\n0101000", "\n5 1 0\n6 1 1 0\n7 1 1 1 0\n0\n\n0101000")
        .replace(" 1 0\n\n0101000", " 1 0\n2 1\n0101000");
    assert_ne!(plain, written);
    assert_eq!(from_brep(&written).unwrap(), from_brep(&plain).unwrap());
}
