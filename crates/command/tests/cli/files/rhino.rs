//! Files of Rhino, which a program that the environment names turns into interchange JSON.
#![cfg(unix)]

use crate::commands::{file, plane};
use serde_json::{Value, json};
use std::process::{Command, Output};

/// The variable of the environment that names the program.
const PROGRAM: &str = "NURBS_HAUSDORFF_3DM";

/// Runs the command with a program that reads its input and writes this answer.
fn run(name: &str, answer: &Value, arguments: &[&str]) -> Output {
    let answer = file(&format!("{name}.answer"), &answer.to_string());
    let program = json!(["sh", "-c", format!("cat > '{answer}.read'; cat '{answer}'")]);
    Command::new(env!("CARGO_BIN_EXE_nurbs-hausdorff"))
        .args(arguments)
        .env(PROGRAM, program.to_string())
        .output()
        .unwrap()
}

/// The square at this height, and the account of it with these faces left out.
fn model(height: f64, skipped: &Value) -> Value {
    let report = json!({ "kind": "3dm", "reader": "rhino3dm", "faces": 1, "trims": 0, "exact": 0, "fitted": 0,
        "gap": 0, "gapProven": true, "unit": 0.001, "skipped": skipped, "notes": [] });
    json!({ "model": { "json": plane(height).to_string(), "report": report } })
}

fn printed(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{output:?}"))
}

#[test]
fn the_program_reads_the_file_and_its_hash_stays() {
    let part = file("rhino-part.3dm", "3D Geometry File Format        4");
    let ground = file("rhino-ground.json", &plane(0.0).to_string());
    let output = run("rhino-whole", &model(3.0, &json!([])), &["distance", &part, &ground, "--json"]);
    let result = printed(&output);
    let [lower, upper] = ["lower", "upper"].map(|end| result[end].as_f64().unwrap());
    assert!(lower <= 3.0 && 3.0 <= upper && upper - lower < 1e-5, "{lower} {upper}");
    assert_eq!(result["files"]["a"]["path"], json!(part));
    // sha256sum of the text above.
    let hash = Command::new("sha256sum").arg(&part).output().unwrap().stdout;
    let hash = String::from_utf8(hash).unwrap();
    assert_eq!(result["files"]["a"]["sha256"].as_str(), hash.split(' ').next());
    let read = std::fs::read_to_string(file_path("rhino-whole.answer.read")).unwrap();
    assert_eq!(read, "3D Geometry File Format        4");
    let info = printed(&run("rhino-info", &model(3.0, &json!([])), &["info", &part, "--json"]));
    assert_eq!(info["faces"].as_array().unwrap().len(), 1);
}

fn file_path(name: &str) -> std::path::PathBuf {
    std::path::PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

#[test]
fn faces_that_the_program_left_out_leave_a_verdict_undecided() {
    let part = file("rhino-partial.3dm", "3D Geometry File Format        4");
    let ground = file("rhino-partial.json", &plane(0.0).to_string());
    let skipped = json!([{ "face": "Box 1", "code": "CAD_UNREADABLE", "why": "no loops" }]);
    let answer = model(0.0, &skipped);
    let output = run("rhino-skipped", &answer, &["diff", &part, &ground, "--json"]);
    assert_eq!(output.status.code(), Some(3), "{output:?}");
    assert_eq!(
        (&printed(&output)["skipped"]["a"], &printed(&output)["verdict"]),
        (&skipped, &json!("undecided"))
    );
    let warning = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(warning.contains("Box 1 is left out: no loops"), "{warning}");
    let allowed = run("rhino-allowed", &answer, &["diff", &part, &ground, "--allow-skipped"]);
    assert_eq!(allowed.status.code(), Some(0));
}

#[test]
fn errors_of_the_program_are_those_of_the_command() {
    let part = file("rhino-refused.3dm", "3D Geometry File Format        4");
    let missing = json!({ "error": { "code": "PEER_MISSING", "message": "npm install rhino3dm" } });
    let output = run("rhino-missing", &missing, &["info", &part]);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        error.starts_with("error[PEER_MISSING]: ") && error.contains("rhino-refused.3dm: npm"),
        "{error}"
    );
    let output = run("rhino-nothing", &json!("no answer"), &["info", &part]);
    assert!(String::from_utf8_lossy(&output.stderr).starts_with("error[CAD_UNREADABLE]: "), "{output:?}");
    // Without the program the error says what converts the file.
    let output = Command::new(env!("CARGO_BIN_EXE_nurbs-hausdorff")).args(["info", &part]).output().unwrap();
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(error.starts_with("error[FORMAT_UNSUPPORTED]") && error.contains("a Rhino 3DM file"), "{error}");
}
