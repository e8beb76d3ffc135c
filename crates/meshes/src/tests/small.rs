//! OFF, PCD, PTX and VTK.

use super::*;

fn file(bytes: impl AsRef<[u8]>, format: MeshFormat) -> MeshFile {
    MeshFile::read(bytes.as_ref(), format).unwrap()
}

fn refusal(bytes: impl AsRef<[u8]>, format: MeshFormat) -> String {
    MeshFile::read(bytes.as_ref(), format).unwrap_err().to_string()
}

fn points(bytes: impl AsRef<[u8]>, format: MeshFormat) -> Vec<[f64; 3]> {
    match file(bytes, format).facets {
        Facets::Cloud(cloud) => cloud.points().iter().map(|point| point.to_array()).collect(),
        Facets::Mesh(_) => panic!("a cloud"),
    }
}

/// A count that is smaller than what is there, as a damaged digit makes it, does not lose elements without a word.
#[test]
fn what_is_not_counted_is_noted() {
    let off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n\n# the end\n";
    let ply = ["ascii", "binary_little_endian", "binary_big_endian"].map(|encoding| {
        let whole = ply(encoding);
        let count = b"element face 4";
        let at = whole.windows(count.len()).position(|found| found == count).unwrap();
        let mut damaged = whole.clone();
        damaged[at + count.len() - 1] = b'3';
        (whole, damaged, MeshFormat::Ply)
    });
    let off = (off.into(), off.replace("4 2 0", "4 1 0").into_bytes(), MeshFormat::Off);
    for (whole, damaged, format) in ply.into_iter().chain([off]) {
        assert!(file(whole, format).notes.is_empty());
        let notes = file(damaged, format).notes;
        assert_eq!(notes.len(), 1, "{notes:?}");
        assert!(notes[0].why.contains("are not read"), "{notes:?}");
    }
}

#[test]
fn off_has_polygons_and_colours() {
    let off = "OFF # a comment\n5 2 0\n\n0 0 0\n2 0 0 255 0 0\n2 2 0\n0 2 0\n5 5 5\n4 0 1 2 3 0.5 0.5 0.5\n3 0 1 2\n";
    assert_eq!(groups_of(&file(off, MeshFormat::Off)), [3]);
    assert_eq!(groups_of(&file(off.replace("OFF # a comment\n5", "COFF 5"), MeshFormat::Off)), [3]);
    assert_eq!(points("OFF\n1 0 0\n1 2 3\n", MeshFormat::Off), [[1.0, 2.0, 3.0]]);
    for (text, found) in [
        ("OFF BINARY\n1 0 0\n", "as text"),
        ("4OFF\n1 0 0\n1 2 3 1\n", "three coordinates"),
        ("OFF\n2 0 0\n1 2 3\n", "1 vertices, expected 2"),
        ("OFF\n1 1 0\n1 2 3\n3 0 0\n", "line 4"),
    ] {
        assert!(refusal(text, MeshFormat::Off).contains(found), "{text:?}");
    }
}

const PCD: &str = "# .PCD v0.7\nVERSION 0.7\nFIELDS intensity x y z\nSIZE 2 4 8 4\nTYPE U F F I\nCOUNT 3 1 1 1\n\
                   WIDTH 3\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA ";

/// The points of [`PCD`] in binary, field by field.
fn pcd_fields() -> Vec<Vec<u8>> {
    let rows = [(1.5_f32, 2.25_f64, -3_i32), (f32::NAN, f64::NAN, 0), (-0.5, 1e-3, 7)];
    vec![
        vec![9; 18],
        rows.iter().flat_map(|row| row.0.to_le_bytes()).collect(),
        rows.iter().flat_map(|row| row.1.to_le_bytes()).collect(),
        rows.iter().flat_map(|row| row.2.to_le_bytes()).collect(),
    ]
}

#[test]
fn pcd_is_read_as_text_in_binary_and_compressed() {
    let expected = [[1.5, 2.25, -3.0], [-0.5, 1e-3, 7.0]];
    let text = format!("{PCD}ascii\n9 9 9 1.5 2.25 -3\n9 9 9 nan nan nan\n9 9 9 -0.5 0.001 7\n");
    assert_eq!(points(&text, MeshFormat::Pcd), expected);
    assert!(file(&text, MeshFormat::Pcd).notes[0].why.starts_with("1 of 3"));
    let fields = pcd_fields();
    let sizes = [6, 4, 8, 4];
    let record = |at: usize| {
        fields.iter().zip(sizes).flat_map(move |(field, size)| field[at * size..][..size].to_vec())
    };
    let binary: Vec<u8> =
        format!("{PCD}binary\n").into_bytes().into_iter().chain((0..3).flat_map(record)).collect();
    assert_eq!(points(&binary, MeshFormat::Pcd), expected);
    assert!(refusal(&binary[..binary.len() - 1], MeshFormat::Pcd).contains("expected 66 for 3 points"));
    // Runs of at most 32 bytes, and the repeated intensities as one byte and a copy of 17 from 1 back.
    let fields = fields.concat();
    let mut packed = vec![0, 9, 7 << 5, 17 - 2 - 7, 0];
    fields[18..].chunks(32).for_each(|run| {
        packed.push(run.len() as u8 - 1);
        packed.extend(run);
    });
    let mut compressed = format!("{PCD}binary_compressed\n").into_bytes();
    compressed.extend((packed.len() as u32).to_le_bytes());
    compressed.extend((fields.len() as u32).to_le_bytes());
    compressed.extend(packed);
    assert_eq!(points(&compressed, MeshFormat::Pcd), expected);
    let turned = text.replace("0 0 0 1 0 0 0", "1 0 0 1 0 0 0");
    assert!(file(turned, MeshFormat::Pcd).notes.iter().any(|note| note.face.to_string() == "VIEWPOINT"));
    assert!(refusal(PCD.replace("x y z", "x y q") + "ascii\n", MeshFormat::Pcd).contains("\"z\""));
}

/// The second scan is turned from x to y to z and moved.
#[test]
fn scans_of_ptx_are_placed() {
    let header = "1\n3\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    let same = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
    let turned = "0 1 0 0\n0 0 1 0\n1 0 0 0\n10 20 30 1\n";
    let rows = "1 2 3 0.5\n0 0 0 0.5\n4 5 6 0.5 255 0 0\n";
    let text = format!("{header}{same}{rows}{header}{turned}{rows}");
    let expected = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [13.0, 21.0, 32.0], [16.0, 24.0, 35.0]];
    assert_eq!(points(&text, MeshFormat::Ptx), expected);
    assert!(file(&text, MeshFormat::Ptx).notes[0].why.starts_with("2 places"));
    assert!(refusal(&text[..text.len() - 20], MeshFormat::Ptx).contains("expected 3"));
    assert!(refusal("1\nx\n", MeshFormat::Ptx).contains("expected 10"));
}

fn vtk_head(coding: &str) -> String {
    format!("# vtk DataFile Version 3.0\ntitle\n{coding}\nDATASET POLYDATA\n")
}

/// A square of side 2 as a polygon, a strip of two triangles above it, and a line.
#[test]
fn legacy_vtk_is_read_as_text_and_in_binary() {
    let text = vtk_head("ASCII")
        + "FIELD FieldData 1\nTimeValue 1 1 double\n0.5\nPOINTS 6 float\n0 0 0 2 0 0 2 2 0\n0 2 0 0 0 1 2 0 1\nMETADATA\nINFORMATION 0\n\n\
           POLYGONS 1 5\n4 0 1 2 3\nTRIANGLE_STRIPS 1 5\n4 0 1 4 5\nLINES 1 3\n2 0 5\nPOINT_DATA 6\nSCALARS a float 1\n";
    let read = file(&text, MeshFormat::Vtk);
    assert_eq!((groups_of(&read), read.notes.len()), (vec![4], 1));
    let newer = text.replace(
        "POLYGONS 1 5\n4 0 1 2 3",
        "POLYGONS 2 4\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2 3",
    );
    assert_eq!(file(&newer, MeshFormat::Vtk), read);

    let mut binary = (vtk_head("BINARY") + "POINTS 6 float\n").into_bytes();
    let numbers: [f32; 18] =
        [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 2.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0, 2.0, 0.0, 1.0];
    binary.extend(numbers.iter().flat_map(|number| number.to_be_bytes()));
    for (name, cells) in [("POLYGONS 1 5", [4, 0, 1, 2, 3]), ("TRIANGLE_STRIPS 1 5", [4, 0, 1, 4, 5])] {
        binary.extend(format!("\n{name}\n").bytes());
        binary.extend(cells.iter().flat_map(|number: &i32| number.to_be_bytes()));
    }
    assert_eq!(file(&binary, MeshFormat::Vtk).facets, read.facets);

    let vertices = vtk_head("ASCII") + "POINTS 1 double\n1 2 3\nVERTICES 1 2\n1 0\n";
    assert_eq!(points(vertices, MeshFormat::Vtk), [[1.0, 2.0, 3.0]]);
    let lines = vtk_head("ASCII") + "POINTS 2 double\n1 2 3 4 5 6\nLINES 1 3\n2 0 1\n";
    assert!(refusal(lines, MeshFormat::Vtk).contains("1 lines and no polygons"));
    let grid = vtk_head("ASCII").replace("POLYDATA", "UNSTRUCTURED_GRID");
    assert!(refusal(grid, MeshFormat::Vtk).contains("UNSTRUCTURED_GRID"));
    let cut = &text[..text.find("2 3\nTRI").unwrap()];
    assert!(refusal(cut, MeshFormat::Vtk).contains("expected a number"));
}

/// Bytes between the parts, as a damaged byte or a wrong type of numbers leaves them, do not end the surface.
#[test]
fn vtk_with_bytes_that_are_no_text_is_refused() {
    let head = vtk_head("BINARY") + "POINTS 3 float\n";
    let points: Vec<u8> = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0_f32]
        .iter()
        .flat_map(|number| number.to_be_bytes())
        .collect();
    let cells: Vec<u8> = [3, 0, 1, 2_i32].iter().flat_map(|number| number.to_be_bytes()).collect();
    let with = |between: &[u8]| [head.as_bytes(), &points, between, b"POLYGONS 1 4\n", &cells].concat();
    assert_eq!(groups_of(&file(with(b"\n"), MeshFormat::Vtk)), [1]);
    let place = format!("from byte {} on", head.len() + points.len());
    for between in [b"\xff\n".as_slice(), b"\xbf\xf0\0\0\0\0\n"] {
        let refusal = refusal(with(between), MeshFormat::Vtk);
        assert!(refusal.contains(&place), "{refusal}");
    }
}

#[test]
fn cells_of_vtk_that_would_be_left_out_are_refused() {
    let head = vtk_head("ASCII") + "POINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n";
    let newer = |counts: &str, offsets: &str| {
        format!(
            "{head}POLYGONS {counts}\nOFFSETS vtktypeint64\n{offsets}\nCONNECTIVITY vtktypeint64\n0 1 2 0 2 3\n"
        )
    };
    assert_eq!(groups_of(&file(newer("3 6", "0 3 6"), MeshFormat::Vtk)), [2]);
    for (text, found) in [
        (newer("2 6", "0 3"), "cells of 3 corners, of which 6"),
        (newer("2 6", "3 6"), "offsets from 3 on"),
        (format!("{head}POLYGONS 1 4\n3 0 1 2\nPOLYGONS 1 4\n3 0 2 3\n"), "POLYGONS twice"),
    ] {
        assert!(refusal(&text, MeshFormat::Vtk).contains(found), "{text}");
    }
}
