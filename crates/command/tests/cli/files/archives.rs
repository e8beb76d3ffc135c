//! FreeCAD documents, and files that gzip compressed, as all commands read them.

use flate2::Compression;
use flate2::write::GzEncoder;
use serde_json::{Value, json};
use std::io::{Cursor, Write};
use std::path::PathBuf;
use std::process::{Command, Output};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// The unit square of the plane z = 0, written by OpenCASCADE.
const SQUARE: &str = include_str!("../../../../../python/tests/files/square.brep");

fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("archives-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_nurbs-hausdorff")).args(arguments).output().unwrap()
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{output:?}"))
}

/// A document of the square, and of a shape in binary if `is_partial`.
fn document(is_partial: bool) -> Vec<u8> {
    let object = |name: &str, file: &str| {
        format!(r#"<Object name="{name}"><Property name="Shape"><Part file="{file}"/></Property></Object>"#)
    };
    let more = if is_partial { object("Binary", "b.bin") } else { String::new() };
    let objects = object("Box", "a.brp") + &more;
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let xml = format!("<Document><ObjectData>{objects}</ObjectData></Document>");
    for (name, content) in [("Document.xml", xml.as_str()), ("a.brp", SQUARE)] {
        writer.start_file(name, SimpleFileOptions::default()).unwrap();
        writer.write_all(content.as_bytes()).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

fn gzip(content: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(content).unwrap();
    encoder.finish().unwrap()
}

#[test]
fn every_command_reads_documents_and_compressed_files() {
    let folder = folder("all");
    let file = |name: &str, content: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, content).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let a = file("a.FCStd", &document(false));
    let b = file("b.brep.gz", &gzip(SQUARE.as_bytes()));
    let triangle = file("c.xyz.gz", &gzip(b"0 0 0\n1 0 0\n0 1 0.5\n"));
    let info = json(&run(&["info", &a, "--json"]));
    assert_eq!((&info["faces"][0]["faceName"], &info["skipped"]), (&json!("Box / face 0"), &json!([])));
    let converted = json(&run(&["convert", &a, "-"]));
    assert_eq!((&converted["unit"], converted["surfaces"].as_array().unwrap().len()), (&json!(0.001), 1));
    assert_eq!(json(&run(&["diff", &a, &b, "--json"]))["state"], "unchanged");
    // Its farthest point is half a unit above the square.
    let found = json(&run(&["distance", &triangle, &a, "--json", "--scale-units"]));
    let bounds = ["lower", "upper"].map(|end| found[end].as_f64().unwrap());
    assert!(bounds[0] <= 0.5 && 0.5 <= bounds[1] && bounds[1] < 0.500001, "{bounds:?}");
    let pairs = file("pairs.jsonl", json!({ "id": 1, "a": a, "b": b, "limit": 0.1 }).to_string().as_bytes());
    assert_eq!(json(&run(&["batch", &pairs]))["within"], true);
}

#[test]
fn directories_have_them_and_objects_that_are_left_out_are_named() {
    let folder = folder("directories");
    for side in ["old", "new"] {
        std::fs::create_dir(folder.join(side)).unwrap();
        std::fs::write(folder.join(side).join("part.FCStd"), document(true)).unwrap();
        std::fs::write(folder.join(side).join("part.brep.gz"), gzip(SQUARE.as_bytes())).unwrap();
    }
    let sides = ["old", "new"].map(|side| folder.join(side).to_str().unwrap().to_owned());
    let output = run(&["diff", &sides[0], &sides[1], "--json"]);
    let pairs = json(&output)["pairs"].clone();
    let states = [0, 1].map(|index| (pairs[index]["path"].clone(), pairs[index]["state"].clone()));
    assert_eq!(states[1], (json!("part.brep.gz"), json!("unchanged")));
    assert_eq!(states[0].0, "part.FCStd");
    assert_eq!(output.status.code(), Some(3), "faces were left out");
    let warning = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(warning.contains("part.FCStd: Binary is left out: its shape is stored in binary"), "{warning}");
}
