//! The verdict: first in the text, one field of the JSON, and the exit status.

use crate::commands::{file, plane, run, status};
use serde_json::{Value, json};
use std::path::PathBuf;
use std::process::Output;

/// Lines that a screen has.
const SCREEN: usize = 40;

fn text(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn first(output: &Output) -> String {
    text(output).lines().next().unwrap_or_default().to_owned()
}

/// Squares at the heights 0 and 3.
fn planes(test: &str) -> [String; 2] {
    [0.0, 3.0].map(|height| file(&format!("verdict-{test}-{height}.json"), &plane(height).to_string()))
}

/// The numbers of a first line: those of the limit, the value and both ends.
fn numbers(line: &str) -> Vec<f64> {
    let words = line.split([' ', ':', '(', ')', ',', '…']);
    words.filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn the_first_line_is_the_verdict_with_an_interval_that_holds_the_distance() {
    let [a, b] = planes("first");
    for (command, limit, word, code) in [
        ("distance", "0.05", "BEYOND 0.05: ", 1),
        ("distance", "4", "WITHIN 4: ", 0),
        ("diff", "0.05", "CHANGED 0.05: ", 1),
        ("diff", "4", "UNCHANGED 4: ", 0),
        ("clearance", "4", "LESS THAN 4: ", 1),
        ("clearance", "0.05", "AT LEAST 0.05: ", 0),
    ] {
        let output = run(&[command, &a, &b, "--limit", limit]);
        let line = first(&output);
        assert_eq!(status(&output), code, "{line}");
        assert!(line.starts_with(word), "{line}");
        let [_, value, lower, upper] = numbers(&line)[..4] else { panic!("{line}") };
        assert!(lower <= 3.0 && 3.0 <= upper, "{line}");
        assert!(lower <= value && value <= upper, "{line}");
    }
    let line = first(&run(&["distance", &a, &b]));
    assert!(line.starts_with("distance 3 (") && line.contains(") on face 0, at "), "{line}");
    let budget = ["--translate", "0.1,0,0.5", "--limit", "2.5", "--max-cells", "1"];
    let sheets = ["wavy-sheet", "wavy-sheet-b"].map(|name| {
        let json = nurbs_hausdorff::shapes::shape(name).unwrap().to_json().unwrap();
        file(&format!("verdict-{name}.json"), &json)
    });
    let undecided = run(&[&["distance", &sheets[0], &sheets[1]][..], &budget].concat());
    if status(&undecided) == 3 {
        assert!(first(&undecided).starts_with("UNDECIDED 2.5: "), "{}", first(&undecided));
    }
}

/// B reaches farther than A, so that the place is on B, whose face has a name and a kind.
#[test]
fn the_place_is_on_the_model_that_is_farther_with_its_name_and_kind() {
    let [a, _] = planes("place");
    let mut large = plane(0.0);
    for (row, x) in [(0, -1), (1, 5)] {
        for corner in large["surfaces"][0]["ctrl"][row].as_array_mut().unwrap() {
            corner[0] = json!(x);
        }
    }
    large["surfaces"][0]["part"] = json!("base");
    large["surfaces"][0]["kind"] = json!("plane");
    let b = file("verdict-large.json", &large.to_string());
    let line = first(&run(&["distance", &a, &b, "--symmetric", "--limit", "0.5"]));
    assert!(line.starts_with("BEYOND 0.5: 4 ("), "{line}");
    assert!(line.contains(" on face 0 of B, base, plane, at 5 "), "{line}");
}

#[test]
fn every_json_has_the_verdict_and_echoes_the_question() {
    let [a, b] = planes("json");
    let of = |arguments: &[&str]| {
        let output = run(&[arguments, &["--json"]].concat());
        let value: Value = serde_json::from_slice(&output.stdout).unwrap();
        (value, status(&output))
    };
    for (arguments, verdict, code) in [
        (&["distance", &a, &b, "--limit", "1", "--symmetric"][..], json!("failed"), 1),
        (&["distance", &a, &b, "--limit", "4"], json!("passed"), 0),
        (&["distance", &a, &b], json!(null), 0),
        (&["diff", &a, &b, "--limit", "1"], json!("failed"), 1),
        (&["clearance", &a, &b, "--limit", "1"], json!("passed"), 0),
        (&["statistics", &a, &b, "--limit", "1"], json!(null), 0),
    ] {
        let (value, found) = of(arguments);
        assert_eq!((&value["verdict"], found), (&verdict, code), "{arguments:?}");
        assert_eq!(value["command"], arguments[0]);
        if let Some(at) = arguments.iter().position(|&word| word == "--limit").filter(|_| !verdict.is_null())
        {
            assert_eq!(value["limit"].as_f64(), arguments[at + 1].parse().ok());
        }
        if arguments[0] == "distance" {
            assert_eq!(value["symmetric"], arguments.contains(&"--symmetric"));
        }
    }
    assert_eq!(of(&["info", &a]).0["command"], "info");
    let line = |id: u32, more: &str| format!("{{\"id\":{id},\"a\":{a:?},\"b\":{b:?}{more}}}\n");
    let pairs = line(1, "") + &line(2, ",\"limit\":1") + &line(3, ",\"command\":\"diff\",\"limit\":4");
    let pairs = file("verdict-pairs.jsonl", &pairs);
    let answers = text(&run(&["batch", &pairs]));
    let verdicts: Vec<Value> =
        answers.lines().map(|line| serde_json::from_str::<Value>(line).unwrap()["verdict"].clone()).collect();
    assert_eq!(verdicts, [json!(null), json!("failed"), json!("passed")]);
}

#[test]
fn errors_are_json_where_json_is_asked_for() {
    let [a, _] = planes("errors");
    for (arguments, code) in [
        (&["distance", &a, "no-such-file.step", "--json"][..], "FILE_UNREADABLE"),
        (&["diff", &a, "no-such-file.step", "--format", "json"], "FILE_UNREADABLE"),
        (&["distance", &a, &a, "--json", "--limit=-1"], "OPTION_OUT_OF_RANGE"),
        (&["distance", &a, "--json"], "OPTION_INVALID"),
        (&["info", "--json", "--unheard-of", &a], "OPTION_INVALID"),
    ] {
        let output = run(arguments);
        let value: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!((status(&output), &value["error"]["code"]), (2, &json!(code)), "{arguments:?}");
        assert_eq!(value["verdict"], "error");
        assert!(!value["error"]["message"].as_str().unwrap().is_empty());
        assert!(String::from_utf8_lossy(&output.stderr).starts_with(&format!("error[{code}]")));
    }
}

#[test]
fn a_directory_that_is_missing_is_named() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("verdict-old");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("part.json"), plane(0.0).to_string()).unwrap();
    let old = folder.to_str().unwrap();
    for pair in [[old, "missing-folder"], ["missing-folder", old]] {
        let output = run(&["diff", pair[0], pair[1]]);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(status(&output), 2);
        assert!(error.starts_with("error[FILE_UNREADABLE]") && error.contains("missing-folder"), "{error}");
        assert!(!error.contains("verdict-old"), "{error}");
    }
}

/// Directories have a verdict of all, by which scripts need no exit status.
#[test]
fn directories_have_one_verdict() {
    let root = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("verdict-directories");
    for (side, height) in [("old", 0.0), ("new", 3.0)] {
        std::fs::create_dir_all(root.join(side)).unwrap();
        std::fs::write(root.join(side).join("part.json"), plane(height).to_string()).unwrap();
    }
    let [old, new] = ["old", "new"].map(|side| root.join(side).to_str().unwrap().to_owned());
    let of = |limit: &str| -> Value {
        serde_json::from_slice(&run(&["diff", &old, &new, "--limit", limit, "--json"]).stdout).unwrap()
    };
    assert_eq!([of("1")["verdict"].clone(), of("4")["verdict"].clone()], ["failed", "passed"]);
}

#[test]
fn short_help_fits_a_screen_and_long_help_has_every_option() {
    for command in
        ["distance", "diff", "clearance", "overlap", "statistics", "align", "batch", "info", "convert"]
    {
        let short = text(&run(&[command, "-h"]));
        let lines = short.lines().count();
        assert!(lines <= SCREEN, "{command}: {lines}");
        assert!(text(&run(&[command, "--help"])).len() >= short.len());
    }
    let long = text(&run(&["distance", "--help"]));
    assert!(["--memory-budget", "--sampling", "--step-tolerance"].iter().all(|option| long.contains(option)));
    assert!(!text(&run(&["distance", "-h"])).contains("--memory-budget"));
}

/// Numbers below 0 are values, and not other arguments.
#[test]
fn a_negative_number_is_a_value_that_is_out_of_range() {
    let part = file("negative.json", &plane(0.0).to_string());
    for option in ["--limit", "--tolerance"] {
        let refused = run(&["distance", &part, &part, option, "-1"]);
        let error = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert!(error.starts_with("error[OPTION_OUT_OF_RANGE]"), "{error}");
    }
}
