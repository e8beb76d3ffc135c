//! The command `batch`: pairs as lines of JSON.

use crate::measures::overlap::cuboid;
use nurbs_hausdorff::{Model, SurfaceArrays};
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

fn command() -> Command {
    Command::new(env!("CARGO_BIN_EXE_nurbs-hausdorff"))
}

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("batch-{name}"))
}

/// The path of a file with a square at this height.
fn square(test: &str, height: f64) -> String {
    let corners = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]];
    let arrays = SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: corners.map(|[x, y]| [x, y, height, 1.0]).to_vec(),
    };
    let path = path(&format!("{test}-{height}.json"));
    std::fs::write(&path, Model::from_arrays(None, vec![arrays]).unwrap().to_json().unwrap()).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Runs `batch` on these lines as standard input.
fn batch(lines: &[Value], more: &[&str]) -> Output {
    let arguments = [&["batch", "-"], more].concat();
    let mut child = command()
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    for line in lines {
        // A command that refuses its arguments reads nothing.
        let _ = writeln!(input, "{line}");
    }
    drop(input);
    child.wait_with_output().unwrap()
}

fn answers(text: &[u8]) -> Vec<Value> {
    let text = std::str::from_utf8(text).unwrap();
    assert!(text.is_empty() || text.ends_with('\n'), "{text}");
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// Pairs of squares whose distances are their indices.
fn pairs(test: &str, count: usize) -> Vec<Value> {
    let ground = square(test, 0.0);
    (0..count).map(|index| json!({ "id": index, "a": ground, "b": square(test, index as f64) })).collect()
}

fn assert_distances(answers: &[Value], expected: impl Iterator<Item = usize>) {
    let expected: Vec<usize> = expected.collect();
    assert_eq!(answers.len(), expected.len());
    for (answer, index) in answers.iter().zip(expected) {
        assert_eq!(answer["id"], index);
        let end = |name: &str| answer[name].as_f64().unwrap();
        let distance = index as f64;
        assert!(end("lower") <= distance && distance <= end("upper") && answer["converged"] == true);
        assert_eq!(answer["files"]["b"]["sha256"].as_str().unwrap().len(), 64);
    }
}

#[test]
fn answers_are_in_the_order_of_the_pairs() {
    for more in [&["--jobs", "3"][..], &["--jobs", "1", "--cache", "1"]] {
        let output = batch(&pairs("order", 12), more);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        assert_distances(&answers(&output.stdout), 0..12);
    }
}

#[test]
fn a_pair_that_fails_is_one_line_with_its_error() {
    let mut lines = pairs("errors", 2);
    lines.insert(1, json!({ "id": "lost", "a": "nowhere.step", "b": "nowhere.step" }));
    lines.push(json!({ "id": "grid", "a": "x", "b": "y", "grid": 8 }));
    lines.push(json!({ "id": "unknown", "a": "x", "b": "y", "symetric": true }));
    lines.push(json!({ "id": "no file", "a": "x" }));
    lines.push(json!({ "id": "moved", "a": "x", "b": "y", "transform": { "rotation": [0, 0, 0, 2] } }));
    let output = batch(&lines, &[]);
    assert_eq!(output.status.code(), Some(1));
    let found = answers(&output.stdout);
    let codes: Vec<&Value> = found.iter().map(|answer| &answer["error"]["code"]).collect();
    let [fine, invalid] = [Value::Null, json!("OPTION_INVALID")];
    let expected = [fine.clone(), json!("FILE_UNREADABLE"), fine, invalid.clone(), invalid.clone(), invalid];
    assert_eq!(codes[..6], expected.iter().collect::<Vec<_>>()[..]);
    assert_eq!(codes[6], "TRANSFORM_NOT_RIGID");
    assert_eq!(found[5]["id"], "no file");
    assert!(found[3]["error"]["message"].as_str().unwrap().contains("an option of method hierarchy"));
}

#[test]
fn every_command_answers_as_it_does_alone() {
    let (a, b) = (square("commands", 0.0), square("commands", 0.5));
    let lines = [
        json!({ "id": 1, "a": a, "b": b, "limit": 1.0, "symmetric": true }),
        json!({ "id": 2, "a": a, "b": b, "command": "diff", "limit": 0.1 }),
        json!({ "id": 3, "a": a, "b": b, "command": "clearance" }),
        json!({ "id": 4, "a": a, "b": b, "method": "hierarchy", "grid": 8, "backend": "cpu" }),
        json!({ "id": 5, "a": a, "b": b, "transform": { "translation": [0, 0, 0.5] } }),
    ];
    let output = batch(&lines, &["--max-seconds", "60"]);
    let found = answers(&output.stdout);
    assert_eq!((found[0]["within"].clone(), found[1]["state"].clone()), (json!(true), json!("changed")));
    assert!((found[2]["upper"].as_f64().unwrap() - 0.5).abs() < 1e-5);
    assert_eq!((&found[3]["method"], &found[3]["grid"]), (&json!("hierarchy"), &json!(8)));
    assert!(found[4]["upper"].as_f64().unwrap() < 1e-6);
    let alone = command().args(["diff", &a, &b, "--limit", "0.1", "--json"]).output().unwrap();
    let alone: Value = serde_json::from_slice(&alone.stdout).unwrap();
    assert_eq!(alone["facesOfA"][0]["state"], found[1]["facesOfA"][0]["state"]);
    assert_eq!(alone["files"], found[1]["files"]);
}

/// A box of an inch and one of 25.4 mm are the same; lines of statistics, volumes in common and facts
/// have the exact numbers, in the unit of A.
#[test]
fn lines_state_statistics_volumes_and_facts_in_units_given() {
    let a = cuboid("batch-inch.off", [1.0, 2.0, 3.0]);
    let b = cuboid("batch-millimetres.off", [25.4, 50.8, 76.2]);
    let lines = [
        json!({ "id": 1, "command": "overlap", "a": a, "b": b, "unitOfA": "in", "unitOfB": "mm" }),
        json!({ "id": 2, "command": "statistics", "a": a, "b": b, "unitOfA": "in", "unitOfB": "mm" }),
        json!({ "id": 3, "command": "statistics", "a": a, "b": b, "limit": 0.5 }),
        json!({ "id": 4, "command": "info", "files": [a], "density": 0.5 }),
        json!({ "id": 5, "command": "overlap", "a": a, "b": b, "unitOfA": "in", "unitOfB": "mm", "scaleUnits": false }),
        json!({ "id": 6, "command": "info", "files": [a, b] }),
        json!({ "id": 7, "command": "info", "a": a }),
        json!({ "id": 8, "command": "check", "files": [a], "unitOfA": "in" }),
        json!({ "id": 9, "a": a, "b": b, "unitOfA": "yard" }),
    ];
    let found = answers(&batch(&lines, &[]).stdout);
    let ends = |interval: &Value| ["lower", "upper"].map(|end| interval[end].as_f64().unwrap());
    let holds = |interval: &Value, number: f64| {
        let [lower, upper] = ends(interval);
        assert!(lower <= number && number <= upper, "{interval} without {number}");
    };
    holds(&found[0]["volumes"]["intersection"], 6.0);
    holds(&found[0]["ratio"], 1.0);
    assert_eq!((&found[0]["command"], &found[0]["verdict"]), (&json!("overlap"), &Value::Null));
    assert!(ends(&found[1]["mean"])[1] < 1e-3, "{}", found[1]["mean"]);
    assert!(ends(&found[2]["beyond"]["part"])[0] > 0.0 && found[2]["hint"].is_string(), "{}", found[2]);
    holds(&found[3]["facts"]["volume"], 6.0);
    holds(&found[3]["mass"], 3.0);
    assert_eq!(found[4]["error"]["code"], "UNITS_DIFFER");
    for answer in &found[5..] {
        assert_eq!(answer["error"]["code"], "OPTION_INVALID", "{answer}");
    }
}

/// Squares are sheets, which are judged where they are apart: the answer is that of the command alone.
#[test]
fn lines_check_the_bodies_of_files() {
    let (a, b) = (square("check", 0.0), square("check", 0.5));
    let rules = json!({ "atLeast": [{ "a": "**", "b": "*-0.5/*", "distance": 0.75 }] });
    let lines = [
        json!({ "id": 1, "command": "check", "files": [a, b], "below": 1.0 }),
        json!({ "id": 2, "command": "check", "files": [a, b], "rules": rules }),
        json!({ "id": 3, "command": "check", "files": [a] }),
        json!({ "id": 4, "command": "check", "files": [] }),
        json!({ "id": 5, "command": "check", "a": a, "b": b }),
        json!({ "id": 6, "command": "check", "files": [a], "transform": { "translation": [0, 0, 1] } }),
        json!({ "id": 7, "a": a, "b": b, "files": [a] }),
        json!({ "id": 8, "command": "check", "files": [a], "limit": 1 }),
    ];
    let output = batch(&lines, &["--max-seconds", "60"]);
    let found = answers(&output.stdout);
    let verdicts: Vec<&Value> = found[..3].iter().map(|answer| &answer["verdict"]).collect();
    assert_eq!(verdicts, ["passed", "failed", "passed"], "{found:?}");
    let pair = &found[0]["pairs"][0];
    assert_eq!((&pair["state"], &found[1]["rules"][0]["broken"]), (&json!("near"), &json!(true)));
    let [lower, upper] = ["lower", "upper"].map(|end| pair["clearance"][end].as_f64().unwrap());
    assert!(lower <= 0.5 && 0.5 <= upper && upper - lower < 1e-5, "{pair}");
    assert_eq!(found[3]["error"]["code"], "EMPTY_MODEL");
    for answer in &found[4..] {
        assert_eq!(answer["error"]["code"], "OPTION_INVALID", "{answer}");
    }
    let alone = command().args(["check", &a, &b, "--below", "1", "--json"]).output().unwrap();
    let mut alone: Value = serde_json::from_slice(&alone.stdout).unwrap();
    alone["id"] = json!(1);
    alone["seconds"] = found[0]["seconds"].clone();
    assert_eq!(alone, found[0]);
}

/// An output whose last line was cut off is gone on with: each pair is answered once.
#[test]
fn an_output_is_resumed_after_its_last_whole_line() {
    let file = path("resumed.jsonl");
    let name = file.to_str().unwrap();
    let lines = pairs("resume", 6);
    let first = batch(&lines[..4], &["--output", name, "--overwrite"]);
    assert_eq!(first.status.code(), Some(0));
    let whole = std::fs::read(&file).unwrap();
    std::fs::write(&file, &whole[..whole.len() - 20]).unwrap();
    let again = batch(&lines, &["--output", name, "--resume"]);
    assert_eq!((again.status.code(), again.stdout.len()), (Some(0), 0));
    assert_distances(&answers(&std::fs::read(&file).unwrap()), 0..6);
    // The file of something else is left as it is.
    std::fs::write(&file, "a list\nof words").unwrap();
    let other = batch(&lines, &["--output", name, "--resume"]);
    assert!(String::from_utf8_lossy(&other.stderr).contains("no output of `batch`"), "{other:?}");
    assert_eq!(
        (other.status.code(), std::fs::read(&file).unwrap().as_slice()),
        (Some(2), &b"a list\nof words"[..])
    );
    let refused = batch(&lines, &["--output", name]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).starts_with("error[OUTPUT_EXISTS]"));
}

/// Lines of one id are answered each, and an error of an earlier run is an error still.
#[test]
fn a_resumed_output_answers_each_line_of_an_id_once() {
    let file = path("repeated.jsonl");
    let name = file.to_str().unwrap();
    let mut lines = pairs("repeated", 4);
    lines[2]["id"] = json!(1);
    lines[3]["b"] = json!("missing.step");
    let whole = batch(&lines, &["--output", name, "--overwrite"]);
    assert_eq!(whole.status.code(), Some(1));
    let expected = answers(&std::fs::read(&file).unwrap());
    for kept in 0..=4 {
        let lines_of = |answers: &[Value]| answers.iter().map(|line| format!("{line}\n")).collect::<String>();
        std::fs::write(&file, lines_of(&expected[..kept])).unwrap();
        let again = batch(&lines, &["--output", name, "--resume", "--jobs", "3"]);
        assert_eq!(again.status.code(), Some(1), "{kept}");
        let found = answers(&std::fs::read(&file).unwrap());
        let upper = |answers: &[Value]| answers.iter().map(|line| line["upper"].clone()).collect::<Vec<_>>();
        assert_eq!(upper(&found), upper(&expected), "{kept}");
    }
}

#[test]
fn the_file_of_the_pairs_is_no_output_and_a_directory_no_file() {
    let file = path("own.jsonl");
    let name = file.to_str().unwrap();
    let text: String = pairs("own", 2).iter().map(|line| format!("\u{feff}{line}\n")).collect();
    std::fs::write(&file, &text).unwrap();
    for more in ["--overwrite", "--resume"] {
        let refused = command().args(["batch", name, "--output", name, more]).output().unwrap();
        assert!(String::from_utf8_lossy(&refused.stderr).starts_with("error[OPTION_INVALID]"), "{refused:?}");
        assert_eq!((refused.status.code(), std::fs::read_to_string(&file).unwrap()), (Some(2), text.clone()));
    }
    // A mark of the bytes' order is no part of a line.
    let read = command().args(["batch", name]).output().unwrap();
    assert_distances(&answers(&read.stdout), 0..2);
    let folder = command().args(["batch", env!("CARGO_TARGET_TMPDIR")]).output().unwrap();
    assert!(String::from_utf8_lossy(&folder.stderr).starts_with("error[FILE_UNREADABLE]"), "{folder:?}");
    assert_eq!((folder.status.code(), folder.stdout.len()), (Some(2), 0));
}

#[test]
fn an_option_is_given_once() {
    let text = pairs("once", 1)[0].to_string().replace('}', r#","limit":1,"limit":2}"#);
    let file = path("once.jsonl");
    std::fs::write(&file, text).unwrap();
    let output = command().args(["batch", file.to_str().unwrap()]).output().unwrap();
    let [answer] = &answers(&output.stdout)[..] else { panic!("{output:?}") };
    assert!(answer["error"]["message"].as_str().unwrap().contains("duplicate field `limit`"), "{answer}");
}

/// A command on pairs whose last takes minutes.
#[cfg(unix)]
fn endless(test: &str) -> (Command, PathBuf) {
    use nurbs_hausdorff::shapes::sphere_parts;
    let mut lines = pairs(test, 2);
    let files = sphere_parts([1.0, 1.1]).unwrap().map(|model| model.to_json().unwrap());
    let [a, b] = std::array::from_fn(|side| {
        let file = path(&format!("{test}-sphere-{side}.json"));
        std::fs::write(&file, &files[side]).unwrap();
        file
    });
    lines.push(json!({ "id": 2, "a": a, "b": b, "relativeTolerance": 1e-13 }));
    let input = path(&format!("{test}.jsonl"));
    std::fs::write(&input, lines.iter().map(|line| format!("{line}\n")).collect::<String>()).unwrap();
    let mut command = command();
    command.args(["batch", input.to_str().unwrap(), "--jobs", "1"]);
    (command, input)
}

#[cfg(unix)]
#[test]
fn an_interrupted_batch_leaves_whole_lines() {
    let (mut command, _) = endless("interrupted");
    let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let read: Vec<Value> =
        (0..2).map(|_| serde_json::from_str(&lines.next().unwrap().unwrap()).unwrap()).collect();
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(lines.next().is_none());
    assert_distances(&read, 0..2);
}

/// The input stays open, and no line comes.
#[cfg(unix)]
#[test]
fn an_interrupt_ends_a_batch_that_waits_for_lines() {
    let mut command = command();
    let mut child =
        command.args(["batch", "-"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    writeln!(input, "{}", pairs("waits", 1)[0]).unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let read: Value = serde_json::from_str(&lines.next().unwrap().unwrap()).unwrap();
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(lines.next().is_none());
    assert_distances(&[read], 0..1);
    drop(input);
}

#[test]
fn a_closed_pipe_ends_the_batch() {
    let input = path("closed.jsonl");
    let lines: String = pairs("closed", 400).iter().map(|line| format!("{line}\n")).collect();
    std::fs::write(&input, lines).unwrap();
    let mut child =
        command().args(["batch", input.to_str().unwrap()]).stdout(Stdio::piped()).spawn().unwrap();
    let mut output = BufReader::new(child.stdout.take().unwrap());
    let mut first = String::new();
    output.read_line(&mut first).unwrap();
    drop(output);
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert_distances(&answers(first.as_bytes()), 0..1);
}

/// A datum in a line lays the square on the higher one; its verdict is that of `align`.
#[test]
fn a_line_may_align() {
    let [a, b] = [square("align", 0.0), square("align", 2.0)];
    let face = json!({ "face": { "index": 0 } });
    let datums = json!([{ "a": face, "b": face }]);
    let lines = [
        json!({ "id": 1, "command": "align", "a": a, "b": b, "norm": "none", "datums": datums }),
        json!({ "id": 2, "command": "align", "a": a, "b": b, "norm": "smallest" }),
    ];
    let output = batch(&lines, &[]);
    let found = answers(&output.stdout);
    assert_eq!((&found[0]["command"], &found[0]["verdict"]), (&json!("align"), &json!("passed")));
    assert_eq!((&found[0]["taken"], &found[0]["motion"]["translation"][2]), (&json!([3]), &json!(2.0)));
    assert_eq!(found[1]["error"]["code"], "OPTION_INVALID");
}
