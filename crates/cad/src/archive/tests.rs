//! FreeCAD documents made here, of a square that OpenCASCADE wrote.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

use crate::{FileKind, from_file};
use flate2::Compression;
use flate2::write::GzEncoder;
use nurbs_hausdorff::{Model, ReadReport, Result};
use std::collections::HashSet;
use std::io::{Cursor, Write};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// The unit square of the plane z = 0.
const SQUARE: &str = include_str!("../../../../python/tests/files/square.brep");

const TIP: &str =
    r#"<Property name="Tip"/><Property name="Group"><LinkList><Link value="Pad"/></LinkList></Property>"#;
const LINK: &str = concat!(
    r#"<Property name="LinkedObject"/><Property name="LinkPlacement">"#,
    r#"<PropertyPlacement Px="1"/></Property>"#
);

/// An object: its name, the file of its shape, its other properties and whether it is shown.
type Object<'a> = (&'a str, &'a str, &'a str, bool);

fn document(objects: &[Object<'_>], files: &[(&str, &[u8])]) -> Vec<u8> {
    let (mut datas, mut views) = (String::new(), String::new());
    for (name, file, more, is_shown) in objects {
        let shape = format!(r#"<Property name="Shape"><Part file="{file}"/></Property>"#);
        let shape = if file.is_empty() { "" } else { shape.as_str() };
        datas += &format!(r#"<Object name="{name}"><Properties>{shape}{more}</Properties></Object>"#);
        let shown = format!(r#"<Property name="Visibility"><Bool value="{is_shown}"/></Property>"#);
        views += &format!(r#"<ViewProvider name="{name}"><Properties>{shown}</Properties></ViewProvider>"#);
    }
    let listed = r#"<Objects Count="1"><Object type="Part::Box" name="Box"/></Objects>"#;
    let xml = format!("<Document>{listed}<ObjectData>{datas}</ObjectData></Document>");
    let gui = format!("<Document><ViewProviderData>{views}</ViewProviderData></Document>");
    let named = [("Document.xml", xml.as_bytes()), ("GuiDocument.xml", gui.as_bytes())];
    archive(&[named.as_slice(), files].concat())
}

fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        writer.start_file(*name, SimpleFileOptions::default()).unwrap();
        writer.write_all(content).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

fn gzip(content: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(content).unwrap();
    encoder.finish().unwrap()
}

fn read(bytes: Vec<u8>) -> Result<(Model, ReadReport, FileKind)> {
    from_file(bytes, "part")
}

fn code(bytes: Vec<u8>) -> &'static str {
    read(bytes).err().unwrap().code()
}

#[test]
fn the_visible_shapes_of_a_document_are_one_model() {
    let objects = [
        ("Box", "a.brp", "", true),
        ("Hidden", "a.brp", "", false),
        ("Pad", "a.brp", "", true),
        ("Body", "a.brp", TIP, true),
        ("Sketch", "empty.brp", "", true),
        ("Nothing", "", "", true),
    ];
    let bytes = document(&objects, &[("a.brp", SQUARE.as_bytes()), ("empty.brp", b"")]);
    let (model, report, kind) = read(gzip(&bytes)).unwrap();
    assert_eq!((kind.name(), model.unit()), ("fcstd", Some(1e-3)));
    assert_eq!((report.faces, report.trims, report.skipped), (2, 8, Vec::new()));
    let names: Vec<_> = model.faces().filter_map(|face| face.name()).collect();
    assert_eq!(names, ["Box / face 0", "Body / face 0"]);
    // Neighbours are known by their edges: every shape has its own.
    let trims = model.faces().filter_map(|face| face.to_arrays().trim).flatten().flatten();
    let edges: Vec<_> = trims.map(|curve| curve.edge.unwrap()).collect();
    assert_eq!((edges.len(), edges.iter().collect::<HashSet<_>>().len()), (8, 8));
}

/// Without views the objects say which of them are shown. A shape whose file is missing is named.
#[test]
fn a_document_without_views_has_the_shapes_that_its_objects_show() {
    let object = |name: &str, file: &str, is_shown: bool| {
        format!(
            r#"<Object name="{name}"><Properties><Property name="Shape"><Part file="{file}"/></Property><Property name="Visibility"><Bool value="{is_shown}"/></Property></Properties></Object>"#
        )
    };
    let objects =
        [object("Cut", "a.brp", true), object("Tool", "a.brp", false), object("Lost", "b.brp", true)];
    let xml = format!("<Document><ObjectData>{}</ObjectData></Document>", objects.concat());
    let (model, report, _) =
        read(archive(&[("Document.xml", xml.as_bytes()), ("a.brp", SQUARE.as_bytes())])).unwrap();
    let names: Vec<_> = model.faces().filter_map(|face| face.name()).collect();
    assert_eq!(names, ["Cut / face 0"]);
    let [skipped] = &report.skipped[..] else { panic!("{:?}", report.skipped) };
    assert!(skipped.code == "CAD_UNREADABLE" && skipped.why.contains("b.brp"), "{skipped:?}");
}

/// What a feature adds, and the faces within a sketch, are stored as shapes before the object's own one.
#[test]
fn the_shape_of_an_object_is_that_of_this_name() {
    let other = |name: &str| {
        format!(
            r#"<Property name="{name}"><Part file="other.brp"/></Property><Property name="Shape"><Part file="a.brp"/></Property>"#
        )
    };
    let [pad, sketch] = ["AddSubShape", "InternalShape"].map(other);
    let objects = [("Pad", "", pad.as_str(), true), ("Sketch", "", sketch.as_str(), true)];
    let bytes = document(&objects, &[("a.brp", SQUARE.as_bytes()), ("other.brp", b"CASCADE Topology V9")]);
    let (model, report, _) = read(bytes).unwrap();
    assert_eq!((model.faces().len(), report.skipped), (2, Vec::new()));
}

#[test]
fn what_a_document_has_besides_is_named() {
    let moved =
        r#"<Property name="Origin"/><Property name="Placement"><PropertyPlacement Q2="1"/></Property>"#;
    let kept =
        r#"<Property name="Origin"/><Property name="Placement"><PropertyPlacement Q3="1"/></Property>"#;
    let objects = [
        ("Box", "a.brp", "", true),
        ("Copy", "", LINK, true),
        ("Moved", "", moved, true),
        ("Kept", "", kept, true),
        ("Binary", "shape.bin", "", true),
        ("Broken", "broken.brp", "", true),
        ("Absent", "absent.brp", "", true),
    ];
    let files: [(&str, &[u8]); 3] =
        [("a.brp", SQUARE.as_bytes()), ("shape.bin", b""), ("broken.brp", b"CASCADE Topology V9")];
    let (_, report, _) = read(document(&objects, &files)).unwrap();
    let skipped: Vec<_> = report.skipped.iter().map(|one| (one.face.to_string(), one.code)).collect();
    let named = [
        ("Copy", "FORMAT_UNSUPPORTED"),
        ("Moved", "FORMAT_UNSUPPORTED"),
        ("Binary", "FORMAT_UNSUPPORTED"),
        ("Broken", "BREP_SYNTAX"),
        ("Absent", "CAD_UNREADABLE"),
    ];
    assert_eq!(report.faces, 1);
    assert_eq!(skipped, named.map(|(name, code)| (name.to_owned(), code)));
}

/// Links may have no placement, groups of links show their elements, and meshes and points have no shape.
#[test]
fn objects_without_a_shape_are_named() {
    let elements = r#"<Property name="ElementList"><LinkList><Link value="Box"/></LinkList></Property>"#;
    let kernel = |name: &str| format!(r#"<Property name="{name}"><{name} file="data"/></Property>"#);
    let [mesh, points, elements_of_analysis] = ["Mesh", "Points", "FemMesh"].map(kernel);
    let objects = [
        ("Box", "a.brp", "", true),
        ("Link", "", r#"<Property name="LinkedObject"><XLink file="" name="Box"/></Property>"#, true),
        ("LinkGroup", "", elements, true),
        ("Scan", "", mesh.as_str(), true),
        ("Hidden", "", mesh.as_str(), false),
        ("Cloud", "", points.as_str(), true),
        ("Analysis", "", elements_of_analysis.as_str(), true),
        ("Wire", "a.brp", r#"<Property name="Points"><VectorList file="Points"/></Property>"#, true),
    ];
    let (_, report, _) = read(document(&objects, &[("a.brp", SQUARE.as_bytes()), ("data", b"")])).unwrap();
    let skipped: Vec<_> = report.skipped.iter().map(|one| one.face.to_string()).collect();
    let noted: Vec<_> = report.notes.iter().map(|one| (one.face.to_string(), one.code)).collect();
    assert_eq!((report.faces, skipped), (2, ["Link", "LinkGroup", "Scan"].map(str::to_owned).to_vec()));
    assert_eq!(noted, ["Cloud", "Analysis"].map(|name| (name.to_owned(), "NOT_MEASURED")));
}

/// A part that is hidden hides all below it, and a plain group does not: the members of that say it of themselves.
#[test]
fn the_members_of_a_part_that_is_hidden_are_hidden() {
    let group = |name: &str| {
        format!(r#"<Property name="Group"><LinkList><Link value="{name}"/></LinkList></Property>"#)
    };
    let part = |name: &str| group(name) + r#"<Property name="Origin"/>"#;
    let [outer, inner, plain, ring] = [part("Inner"), group("Deep"), group("Grouped"), part("Ring")];
    let objects = [
        ("Part", "", outer.as_str(), false),
        ("Inner", "", inner.as_str(), true),
        ("Deep", "a.brp", "", true),
        ("Group", "", plain.as_str(), false),
        ("Grouped", "a.brp", "", true),
        ("Ring", "", ring.as_str(), false),
    ];
    let (model, report, _) = read(document(&objects, &[("a.brp", SQUARE.as_bytes())])).unwrap();
    let names: Vec<_> = model.faces().filter_map(|face| face.name()).collect();
    assert_eq!((names, report.skipped), (vec!["Grouped / face 0"], Vec::new()));
}

#[test]
fn a_face_of_a_document_is_called_by_its_shape() {
    let mut joined = super::joined::Joined::default();
    for name in ["First", "Second"] {
        joined.push(name, crate::read_brep(SQUARE, None).unwrap()).unwrap();
    }
    let whole = joined.into_assembled().unwrap();
    assert_eq!(whole.counts.iter().map(|face| face.number).collect::<Vec<_>>(), [0, 1]);
    assert_eq!([0, 1].map(|number| whole.face_id(number).to_string()), ["First 0", "Second 0"]);
    let mut open = whole;
    open.model.faces[1].trim.as_mut().unwrap()[0].pop();
    let (_, report) = nurbs_hausdorff::workspace::into_model(open).unwrap();
    assert_eq!((report.faces, report.skipped[0].face.to_string().as_str()), (1, "Second 0"));
}

#[test]
fn files_that_are_no_document_are_refused() {
    let hidden = document(&[("Hidden", "a.brp", "", false)], &[("a.brp", SQUARE.as_bytes())]);
    let binary = document(&[("Binary", "a.bin", "", true)], &[]);
    for bytes in [hidden, binary.clone()] {
        assert_eq!(code(bytes), "EMPTY_MODEL");
    }
    let message = read(binary).err().unwrap().to_string();
    assert!(message.contains("Binary: its shape is stored in binary"), "{message}");
    assert_eq!(code(archive(&[("a.txt", b"text")])), "FORMAT_UNSUPPORTED");
    assert_eq!(code(archive(&[("Document.xml", b"<Document><a></b></Document>")])), "CAD_UNREADABLE");
}

#[test]
fn damage_is_refused_with_an_error() {
    let whole = document(&[("Box", "a.brp", "", true)], &[("a.brp", SQUARE.as_bytes())]);
    for length in [4, 30, 200, whole.len() - 1] {
        assert_eq!(code(whole[..length].to_vec()), "CAD_UNREADABLE", "{length}");
    }
    let packed = gzip(SQUARE.as_bytes());
    for length in [2, 50, packed.len() - 1] {
        assert_eq!(code(packed[..length].to_vec()), "CAD_UNREADABLE", "{length}");
    }
    // Any byte may be wrong: what is read then is a model or an error.
    for index in 0..whole.len() {
        let mut bytes = whole.clone();
        bytes[index] ^= 0x55;
        let _ = read(bytes);
    }
}

#[test]
fn what_is_unpacked_has_a_largest_length() {
    let zeros = vec![0; Model::MAX_JSON_BYTES as usize / 2 + 1];
    let (objects, files) = ([("A", "a.brp", "", true), ("B", "b.brp", "", true)], ["a.brp", "b.brp"]);
    let bytes = document(&objects, &files.map(|name| (name, zeros.as_slice())));
    assert_eq!(code(bytes), "FILE_TOO_LARGE");
    // Members of gzip follow each other in one file.
    assert_eq!(code([gzip(&zeros), gzip(&zeros)].concat()), "FILE_TOO_LARGE");
}
