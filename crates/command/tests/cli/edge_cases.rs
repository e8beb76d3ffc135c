//! The command line where users and machines are not as hoped.

use crate::support::fixtures::peaked_sheet;
use crate::support::writers::iges::IgesText;
use crate::support::writers::step::{StepText, UnitsOf};
use nurbs_hausdorff::Model;
use nurbs_hausdorff::shapes::shape;
use nurbs_hausdorff_meshes::MeshFile;
use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Stdio};

struct Run {
    status: i32,
    stdout: String,
    stderr: String,
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_nurbs-hausdorff"));
    command.args(arguments);
    command
}

fn finish(mut command: Command) -> Run {
    let output = command.output().unwrap();
    Run {
        status: output.status.code().unwrap(),
        stdout: String::from_utf8(output.stdout).unwrap(),
        stderr: String::from_utf8(output.stderr).unwrap(),
    }
}

fn run(arguments: &[&str]) -> Run {
    finish(command(arguments))
}

/// `distance MODEL MODEL` by `iteration` on the CPU, as JSON.
fn iterate(model: &str, more: &[&str]) -> Value {
    let fixed = ["distance", model, model, "--json", "--method", "iteration", "--backend", "cpu"];
    let run = run(&[&fixed, more].concat());
    assert_eq!(run.status, 0, "{}", run.stderr);
    serde_json::from_str(&run.stdout).unwrap()
}

fn file(name: &str, content: &[u8]) -> String {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("edges-{name}.json"));
    std::fs::write(&path, content).unwrap();
    path.to_str().unwrap().to_owned()
}

fn shape_file(test: &str, name: &str) -> String {
    file(&format!("{test}-{name}"), shape(name).unwrap().to_json().unwrap().as_bytes())
}

fn assert_refused(run: &Run, code: &str, message: &[&str]) {
    assert_eq!(run.status, 2, "{}", run.stderr);
    assert_eq!(run.stdout, "");
    for message in [&[format!("error[{code}]: ").as_str()], message].concat() {
        assert!(run.stderr.contains(message), "{message} in {}", run.stderr);
    }
}

#[test]
fn errors_name_the_file() {
    let good = shape_file("named", "cone");
    let bad = file("bad", good.as_bytes());
    for arguments in [&["distance", &good, &bad][..], &["distance", &bad, &good], &["info", &bad]] {
        assert_refused(&run(arguments), "FORMAT_UNSUPPORTED", &[&bad, "an unknown format"]);
    }
    let cut = file("cut", b"{\"surfaces\": 3");
    assert_refused(&run(&["info", &cut]), "JSON_SHAPE", &[&cut, "line 1"]);
    let folder = env!("CARGO_TARGET_TMPDIR");
    assert_refused(&run(&["info", folder]), "FILE_UNREADABLE", &[folder]);
    let binary = file("binary", &[0xff, 0x00]);
    assert_refused(&run(&["info", &binary]), "FORMAT_UNSUPPORTED", &[&binary]);
}

#[test]
fn binary_brep_is_named() {
    let path = file(
        "binary.brep",
        b"\nOpen CASCADE Topology V4, (c) Open Cascade\nLocations 0\nCurve2ds 1\n\x01\xff",
    );
    assert_refused(&run(&["info", &path]), "BREP_SYNTAX", &["in binary", "BRepTools::Write"]);
}

/// What is no model is called by its name, with what to do.
#[test]
fn files_of_other_kinds_are_named() {
    let step = |schema: &str| {
        format!("ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('{schema}'));\nENDSEC;\nDATA;\nENDSEC;\n")
    };
    let ifc = step("IFC4");
    let tar = [vec![b'a'; 257], b"ustar".to_vec()].concat();
    let cases: [(&[u8], &[&str]); 12] = [
        (ifc.as_bytes(), &["an IFC file", "IFC4", "IfcConvert"]),
        (b"iso-10303-21;\nheader;\n", &["STEP file in lower case", "upper case"]),
        (b"<?xml version='1.0'?>\n<iso_10303_28 xmlns='x'/>", &["in XML"]),
        (b"\n<!DOCTYPE html>\n<html></html>", &["a page in HTML", "fetch the file itself"]),
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n", &["Git LFS", "git lfs pull"]),
        (b"", &["an empty file"]),
        (b" \r\n", &["an empty file"]),
        (b"\xff\xfeI\0S\0", &["UTF-16"]),
        (b"BZh91AY", &["bzip2", "unpack"]),
        (&tar, &["a tar archive", "unpack"]),
        (b"PS\0\0", &["Parasolid", "STEP"]),
        (b"AC1027", &["DWG", "STEP"]),
    ];
    for (index, (content, words)) in cases.into_iter().enumerate() {
        let path = file(&format!("foreign-{index}"), content);
        assert_refused(&run(&["info", &path]), "FORMAT_UNSUPPORTED", words);
    }
}

/// A unit that the file does not state is null, and the notes on faces are stated beside what was skipped.
#[test]
fn info_has_the_unit_and_the_notes() {
    let path = shape_file("no-unit", "cone");
    let json: Value = serde_json::from_str(&run(&["info", "--json", &path]).stdout).unwrap();
    assert_eq!((&json["unit"], &json["notes"]), (&Value::Null, &serde_json::json!([])));
    assert!(json.as_object().unwrap().contains_key("unit"));
}

/// Triangles of a STEP file without faces are a mesh; beside faces they are left out, and a verdict is undecided.
#[test]
fn triangles_of_a_step_file_are_a_mesh_or_named() {
    let square = |with_face: bool, height: f64| {
        let mut text = StepText::new();
        let points = text.add(format!(
            "COORDINATES_LIST('',4,((0.,0.,{height:?}),(1.,0.,{height:?}),(1.,1.,{height:?}),(0.,1.,{height:?})))"
        ));
        let triangles = text.add(format!("TRIANGULATED_FACE('',#{points},4,(),$,(),((1,2,3),(1,3,4)))"));
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let corners: Vec<String> = corners.iter().map(|&corner| format!("#{}", text.point(corner))).collect();
        let path = text.add(format!("POLY_LOOP('',({}))", corners.join(",")));
        let bound = text.add(format!("FACE_OUTER_BOUND('',#{path},.T.)"));
        let items = if with_face {
            let face = text.add(format!("FACE('',(#{bound}))"));
            vec![text.open_shell(&[face]), triangles]
        } else {
            vec![triangles]
        };
        file(&format!("tessellated-{with_face}-{height}"), text.of(&items, UnitsOf::Millimetres).as_bytes())
    };
    let [mesh, both, plain] = [square(false, 5.0), square(true, 5.0), square(false, 0.0)];
    let json: Value = serde_json::from_str(&run(&["distance", &mesh, &plain, "--json"]).stdout).unwrap();
    let end = |name: &str| json[name].as_f64().unwrap();
    assert!(end("lower") <= 5.0 && end("upper") >= 5.0 && json["unit"] == 1e-3, "{json}");
    let judged = run(&["distance", &both, &plain, "--limit", "0.001"]);
    assert_eq!(judged.status, 3, "{}", judged.stderr);
    assert!(judged.stderr.contains("2 triangles, which are not measured beside faces"), "{}", judged.stderr);
}

/// A triangle in millimetres, and a face without a surface, which is named by its number.
#[test]
fn a_step_file_is_read_by_its_content() {
    let mut text = StepText::new();
    let corners = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]].map(|corner| text.point(corner));
    let path = text.add(format!("POLY_LOOP('',(#{},#{},#{}))", corners[0], corners[1], corners[2]));
    let bound = text.add(format!("FACE_OUTER_BOUND('',#{path},.T.)"));
    let face = text.add(format!("FACE('',(#{bound}))"));
    let broken = text.add(format!("ADVANCED_FACE('',(#{bound}),#9999,.T.)"));
    let shell = text.open_shell(&[face, broken]);
    let path = file("triangle", text.of(&[shell], UnitsOf::Millimetres).as_bytes());
    let run = run(&["info", "--json", &path]);
    let json: Value = serde_json::from_str(&run.stdout).unwrap();
    let diagonal = json["diagonal"].as_f64().unwrap();
    assert!(json["unit"] == 1e-3 && (diagonal - 5.0).abs() < 1e-9, "{diagonal}");
    assert!(run.stderr.contains(&format!("face 1 (#{broken}) is left out: #9999")), "{}", run.stderr);
    let cut = file("cut", b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=POINT(");
    assert_refused(&self::run(&["info", &cut]), "STEP_SYNTAX", &[&cut, "line 5"]);
}

/// A rectangle in inches, and a face without a surface, which is named by its number.
#[test]
fn an_iges_file_is_read_by_its_content() {
    let mut text = IgesText { unit: (1, "INCH"), ..IgesText::new() };
    text.bilinear([[0.0; 3], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0], [3.0, 4.0, 0.0]]);
    let broken = text.add(144, 0, "999,0,0,0");
    let path = file("rectangle", text.text().as_bytes());
    let run = run(&["info", "--json", &path]);
    let json: Value = serde_json::from_str(&run.stdout).unwrap();
    let diagonal = json["diagonal"].as_f64().unwrap();
    assert!(json["unit"] == 1e-3 && (diagonal - 127.0).abs() < 1e-9, "{diagonal}");
    assert!(run.stderr.contains(&format!("face 1 (#{broken}) is left out: entity 999")), "{}", run.stderr);
    let end = text.text().find("P      1").unwrap();
    let cut = file("cut-iges", &text.text().as_bytes()[..end + 9]);
    assert_refused(&self::run(&["info", &cut]), "IGES_SYNTAX", &[&cut, "section T"]);
}

#[test]
fn files_over_the_limit_are_not_read() {
    // All holes: it takes no room on the disk.
    let path = file("large", b"");
    std::fs::OpenOptions::new().write(true).open(&path).unwrap().set_len(Model::MAX_JSON_BYTES + 1).unwrap();
    assert_refused(&run(&["info", &path]), "FILE_TOO_LARGE", &[&path, &Model::MAX_JSON_BYTES.to_string()]);
    // A mesh may be larger, by the ending of its name.
    let path = file("large", b"").replace(".json", ".stl");
    std::fs::File::create(&path).unwrap().set_len(MeshFile::MAX_BYTES + 1).unwrap();
    assert_refused(&run(&["info", &path]), "FILE_TOO_LARGE", &[&path, &MeshFile::MAX_BYTES.to_string()]);
}

/// A device has no length.
#[cfg(target_os = "linux")]
#[test]
fn endless_files_end_at_the_limit() {
    assert_refused(&run(&["info", "/dev/zero"]), "FILE_TOO_LARGE", &["/dev/zero"]);
}

/// The line about a search that stalls is for those who wait: it comes after seconds.
#[test]
fn a_short_search_that_gains_nothing_prints_no_line() {
    let [peaked, even] = [1e8, 1.0].map(|weight| {
        file(&format!("peaked-{weight:e}"), peaked_sheet(weight).to_json().unwrap().as_bytes())
    });
    let stalled = run(&["distance", &peaked, &even, "--max-cells", "40000"]);
    assert!(!stalled.stderr.contains("the interval has not halved"), "{}", stalled.stderr);
    assert_eq!(run(&["distance", &even, &even]).stderr, "");
}

#[test]
fn a_relative_tolerance_of_points_is_reported() {
    let point = |x: f64| {
        let corner = format!("[{x},0.2,0.1,1]");
        let text = format!(
            r#"{{"surfaces":[{{"degree":[1,1],"knots_u":[0,0,1,1],"knots_v":[0,0,1,1],"ctrl":[[{corner},{corner}],[{corner},{corner}]]}}]}}"#
        );
        file(&format!("point-{x}"), text.as_bytes())
    };
    let run = run(&["distance", &point(0.25), &point(1.5)]);
    assert!(run.stdout.contains("both models are single points"), "{}", run.stdout);
    assert!(run.stdout.contains("allow a tolerance of"), "{}", run.stdout);
}

#[test]
fn bad_arguments_have_codes() {
    let good = shape_file("arguments", "cone");
    let cases: [(&[&str], &str, &[&str]); 14] = [
        (&["--samples", "1", "--deviations"], "OPTION_OUT_OF_RANGE", &["samples", "1", "2 to 1024"]),
        (
            &["--grid", "8"],
            "OPTION_INVALID",
            &["grid is an option of method hierarchy, found method certified"],
        ),
        (&["--samples", "8"], "OPTION_INVALID", &["samples", "deviations", "method certified"]),
        (&["--method", "iteration", "--iterations", "0"], "OPTION_OUT_OF_RANGE", &["iterations", "0"]),
        (&["--method", "iteration", "--step-tolerance", "inf"], "OPTION_OUT_OF_RANGE", &["step tolerance"]),
        (&["--max-cells", "0"], "OPTION_OUT_OF_RANGE", &["max cells"]),
        (&["--method", "hierarchy", "--grid", "1"], "OPTION_OUT_OF_RANGE", &["grid", "1", "2 to 1024"]),
        (
            &["--method", "hierarchy", "--memory-budget", "0"],
            "OPTION_OUT_OF_RANGE",
            &["memory budget", "1 to 256 MiB"],
        ),
        (&["--samples", "many"], "OPTION_INVALID", &["--samples", "many"]),
        (&["--flatness", "flat"], "OPTION_INVALID", &["--flatness", "none, loose, tight, curvature"]),
        (&["--translate", "1,2"], "OPTION_INVALID", &["--translate", "found 2 numbers, expected 3"]),
        (&["--translate", "0,NaN,0"], "OPTION_INVALID", &["--translate", "NaN", "finite"]),
        (&["--rotate", "0,0,0,90"], "OPTION_INVALID", &["--rotate", "axis has length 0"]),
        (&["--unheard-of"], "OPTION_INVALID", &["--unheard-of"]),
    ];
    for (arguments, code, message) in cases {
        assert_refused(&run(&[&["distance", &good, &good], arguments].concat()), code, message);
    }
    assert_refused(&run(&["distance"]), "OPTION_INVALID", &["<A>", "<B>"]);
}

#[test]
fn the_length_of_an_axis_does_not_matter() {
    let torus = shape_file("axis", "torus");
    let computed = |rotate| iterate(&torus, &["--samples", "16", "--rotate", rotate])["computed"].clone();
    let unit = computed("1,0,0,90").as_f64().unwrap();
    for rotate in ["1e-200,0,0,90", "1e200,0,0,90"] {
        assert!((computed(rotate).as_f64().unwrap() - unit).abs() < 1e-12, "{rotate}");
    }
}

/// The interval of `iteration` is wide; a limit inside it must not pass.
#[test]
fn a_limit_is_decided_by_the_interval_of_iteration_too() {
    let sheet = shape_file("limit", "wavy-sheet");
    let moved = ["--translate", "0,0,0.5", "--method", "iteration", "--backend", "cpu"];
    for (limit, status) in [("0.499", 1), ("0.501", 3), ("2", 0)] {
        let run = run(&[&["distance", &sheet, &sheet, "--limit", limit], &moved[..]].concat());
        assert_eq!(run.status, status, "--limit {limit}: {}{}", run.stdout, run.stderr);
    }
}

#[test]
fn a_budget_leaves_a_limit_undecided() {
    let sheet = shape_file("budget", "wavy-sheet");
    let other = shape_file("budget-b", "wavy-sheet-b");
    let budget = ["--translate", "0,0,0.5", "--limit", "2", "--max-cells", "1"];
    let run = run(&[&["distance", &sheet, &other], &budget[..]].concat());
    assert_eq!(run.status, 3, "{}{}", run.stdout, run.stderr);
    for message in ["ended by the budget of cells", "converged  no"] {
        assert!(run.stdout.contains(message), "{message} in {}", run.stdout);
    }
}

#[test]
fn options_reach_the_method() {
    let sheet = shape_file("options", "wavy-sheet");
    let with = |more: &[&str]| iterate(&sheet, &[&["--translate", "0,0,0.5"], more].concat());
    let plain = with(&["--samples", "16"]);
    let statuses = plain["statuses"].as_object().unwrap().values().map(|count| count.as_u64().unwrap());
    assert_eq!(statuses.sum::<u64>(), 16 * 16);
    let patches = |flatness| with(&["--samples", "4", "--flatness", flatness])["patches"]["b"].as_u64();
    assert!(patches("none") < patches("loose"));
    assert!(patches("loose") < patches("tight"));
    // Every patch or those near enough: the same distance.
    assert_eq!(with(&["--samples", "16", "--culling", "none"])["computed"], plain["computed"]);
    assert_ne!(with(&["--samples", "16", "--sampling", "arc-length"])["bounds"], plain["bounds"]);
    let published = ["--samples", "16", "--projection", "tangent-plane", "--iterations", "1"];
    assert_ne!(with(&published)["statuses"], plain["statuses"]);
}

/// Without a driver's description the Vulkan loader has no GPU to offer.
#[cfg(target_os = "linux")]
#[test]
fn without_a_gpu_the_result_says_so() {
    let cone = shape_file("no-gpu", "cone");
    let on = |backend| {
        let fixed = ["distance", &cone, &cone, "--json", "--method", "iteration", "--backend", backend];
        let mut command = command(&fixed);
        command.envs([("VK_DRIVER_FILES", "/dev/null"), ("VK_ICD_FILENAMES", "/dev/null")]);
        finish(command)
    };
    let auto = on("auto");
    let result: Value = serde_json::from_str(&auto.stdout).unwrap();
    assert_eq!(result["backend"], "cpu");
    assert!(result["notice"].as_str().unwrap().contains("computed on the CPU"));
    let gpu = on("gpu");
    assert!(gpu.status == 2 && gpu.stderr.contains("error[NO_ADAPTER]"), "{}", gpu.stderr);
}

#[test]
fn completion_for_every_shell() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = run(&["completions", shell]);
        assert_eq!(script.status, 0, "{shell}");
        for word in ["nurbs-hausdorff", "step-tolerance", "tangent-plane"] {
            assert!(script.stdout.contains(word), "{word} for {shell}");
        }
    }
}

/// As with `| head -0`: no failure, and no panic.
#[test]
fn a_reader_that_leaves_is_no_failure() {
    let cone = shape_file("reader", "cone");
    let mut command = command(&["info", &cone]);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(output.stderr, b"");
}
