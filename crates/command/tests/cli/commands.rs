//! The command line as a user runs it.

use nurbs_hausdorff::DVec3;
use nurbs_hausdorff::shapes::{shape, sphere};
use serde_json::{Value, json};
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output};

pub(crate) fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_nurbs-hausdorff")).args(arguments).output().unwrap()
}

/// A file of this text in the folder for the tests' own files.
pub(crate) fn file(name: &str, text: &str) -> String {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

pub(crate) fn plane(height: f64) -> Value {
    json!({ "name": "plane", "source": "extra keys are ignored", "surfaces": [{
        "degree": [1, 1],
        "knots_u": [0, 0, 1, 1],
        "knots_v": [0, 0, 1, 1],
        "ctrl": [[[-1, -1, height, 1], [-1, 1, height, 1]], [[1, -1, height, 1], [1, 1, height, 1]]],
    }]})
}

fn planes(test: &str) -> [String; 2] {
    [0.0, 3.0].map(|height| file(&format!("{test}-{height}.json"), &plane(height).to_string()))
}

pub(crate) fn status(output: &Output) -> i32 {
    output.status.code().unwrap()
}

pub(crate) fn printed(output: &Output) -> Value {
    assert_eq!(status(output), 0, "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

/// Fails without a GPU unless the environment allows it, as the library's tests.
fn gpu_is_missing(output: &Output, test: &str) -> bool {
    let errors = String::from_utf8_lossy(&output.stderr);
    let missing = errors.contains("NO_ADAPTER") && std::env::var_os("NURBS_HAUSDORFF_ALLOW_NO_GPU").is_some();
    if missing {
        // Past libtest's capturing.
        std::io::stderr().write_all(format!("\nSKIPPED {test}: {errors}\n").as_bytes()).unwrap();
    }
    missing
}

#[test]
fn iteration_prints_one_object_with_every_key() {
    let [a, b] = planes("iteration");
    let output = run(&["distance", &a, &b, "--method", "iteration", "--backend", "cpu", "--json"]);
    let result = printed(&output);
    let mut expected = vec![
        "schemaVersion",
        "command",
        "verdict",
        "symmetric",
        "version",
        "files",
        "skipped",
        "method",
        "backend",
        "adapter",
        "diagonal",
        "computed",
        "lower",
        "upper",
        "converged",
        "gap",
        "gapProven",
        "withGaps",
        "bounds",
        "witness",
        "samples",
        "statuses",
        "patches",
        "seconds",
    ];
    let mut found = keys(&result);
    expected.sort_unstable();
    found.sort_unstable();
    assert_eq!(found, expected);
    assert_eq!(keys(&result["bounds"]), ["kA", "kARigorous", "kB"]);
    assert_eq!(keys(&result["witness"]["a"]), ["face", "point", "u", "v"]);
    assert_eq!(keys(&result["seconds"]), ["compile", "prepare", "solve"]);
    assert_eq!((&result["method"], &result["backend"]), (&json!("iteration"), &json!("cpu")));
    assert_eq!(result["computed"], 3.0);
    assert_eq!(result["diagonal"], 8.0_f64.sqrt());
    assert_eq!(result["samples"], 4096);
}

#[test]
fn certified_is_the_default_and_keeps_its_tolerance() {
    let a = file("sphere.json", &shape("sphere").unwrap().to_json().unwrap());
    let b = file("larger.json", &shape("sphere-larger").unwrap().to_json().unwrap());
    // Radii of 2 and 2.2, the centres 0.5 apart: the same both ways.
    let moved = ["distance", &a, &b, "--translate", "0.3,0.4,0", "--json"];
    let result = printed(&run(&[&moved[..], &["--relative-tolerance", "1e-4", "--symmetric"]].concat()));
    assert_eq!(result["method"], "certified");
    let [lower, upper, tolerance] = ["lower", "upper", "tolerance"].map(|key| result[key].as_f64().unwrap());
    assert!(lower <= 0.7 + 1e-12 && 0.7 - 1e-12 <= upper);
    assert!(upper - lower <= tolerance * 1.000_001, "{lower} {upper} {tolerance}");
    assert!((tolerance - 1e-4 * result["diagonal"].as_f64().unwrap()).abs() < 1e-15);
    for key in ["forward", "reverse"] {
        assert!(result[key]["cells"].as_u64().unwrap() > 0);
        assert!(result[key]["levels"].as_u64().unwrap() > 0);
    }
    let in_units = printed(&run(&[&moved[..], &["--tolerance", "0.01"]].concat()));
    assert_eq!(in_units["tolerance"], 0.01);
    let both = run(&[&moved[..], &["--tolerance", "0.01", "--relative-tolerance", "0.01"]].concat());
    assert_eq!(status(&both), 2);
    assert!(String::from_utf8_lossy(&both.stderr).contains("error[OPTION_INVALID]"));
}

#[test]
fn hierarchy_prints_its_pairs_by_level() {
    let [a, b] = planes("hierarchy");
    let arguments = ["distance", &a, &b, "--method", "hierarchy", "--backend", "cpu", "--grid", "16"];
    let result = printed(&run(&[&arguments[..], &["--json"]].concat()));
    assert_eq!(result["method"], "hierarchy");
    assert_eq!((&result["grid"], &result["levels"]), (&json!(16), &json!(5)));
    // Squares above squares: near the middles of a level's boxes nine pairs each, at the end at least one.
    let pairs: Vec<u64> = serde_json::from_value(result["pairs"].clone()).unwrap();
    assert_eq!(pairs.len(), 5);
    assert!(pairs[0] == 1 && pairs[4] >= 256, "{pairs:?}");
    let [lower, upper] = ["lower", "upper"].map(|key| result[key].as_f64().unwrap());
    assert!(lower <= 3.0 && (3.0..3.1).contains(&upper), "{lower} {upper}");
    let text = String::from_utf8(run(&arguments).stdout).unwrap();
    assert!(text.contains("16 x 16 cells a surface; pairs of boxes by level 1, "), "{text}");
}

#[test]
fn a_budget_of_memory_is_an_error_with_the_pairs_wanted() {
    let sphere = file("budget.json", &shape("sphere").unwrap().to_json().unwrap());
    let budget = ["--grid", "128", "--memory-budget", "1", "--backend", "cpu"];
    let output = run(&[&["distance", &sphere, &sphere, "--method", "hierarchy"][..], &budget].concat());
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(status(&output), 2, "{errors}");
    assert!(errors.contains("error[PAIR_BUDGET_EXCEEDED]"), "{errors}");
    assert!(
        errors.contains("pairs of boxes, expected at most 65536") && errors.contains("1 MiB"),
        "{errors}"
    );
}

#[test]
fn both_backends_agree() {
    let a = file("wavy.json", &shape("wavy-sheet").unwrap().to_json().unwrap());
    let b = file("wavy-b.json", &shape("wavy-sheet-b").unwrap().to_json().unwrap());
    let arguments = ["distance", &a, &b, "--method", "iteration", "--json", "--translate", "-0.1,0.2,1"];
    let on = |backend| run(&[&arguments[..], &["--backend", backend]].concat());
    let gpu = on("gpu");
    if gpu_is_missing(&gpu, "both_backends_agree") {
        return;
    }
    let (gpu, cpu) = (printed(&gpu), printed(&on("cpu")));
    assert_eq!((&gpu["backend"], &cpu["backend"]), (&json!("gpu"), &json!("cpu")));
    let [on_gpu, on_cpu] = [&gpu, &cpu].map(|result| result["computed"].as_f64().unwrap());
    assert!((on_gpu - on_cpu).abs() <= 1e-5 * cpu["diagonal"].as_f64().unwrap());
}

#[test]
fn a_limit_decides_the_exit_status() {
    let [a, b] = planes("limit");
    for (limit, expected) in [("3.5", 0), ("3", 0), ("2.9", 1)] {
        let output = run(&["distance", &a, &b, "--limit", limit]);
        // Exactly at the limit the bound's rounding term may leave it undecided, never wrong.
        let found = status(&output);
        assert!(found == expected || (limit == "3" && found == 3), "{limit}: {found}");
    }
    let output = run(&["distance", &a, &b, "--limit", "2.9", "--json"]);
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(result["within"], false);
}

#[test]
fn moves_and_turns_are_applied_to_a() {
    let [a, b] = planes("moves");
    let moved = printed(&run(&["distance", &a, &b, "--translate", "0,0,1.5", "--json"]));
    assert!((moved["computed"].as_f64().unwrap() - 1.5).abs() < 1e-12);
    // Turned by 90° about x, the square reaches down to z = -1: 4 below the plane at 3.
    let turned = printed(&run(&["distance", &a, &b, "--rotate", "1,0,0,90", "--json"]));
    assert!((turned["computed"].as_f64().unwrap() - 4.0).abs() < 1e-12);
}

#[test]
fn people_get_text() {
    let [a, b] = planes("text");
    let output = run(&["distance", &a, &b, "--deviations", "--backend", "cpu"]);
    let text = String::from_utf8(output.stdout).unwrap();
    for part in ["distance 3 (", "interval", "on A", "on B", "estimates  mean 3.0", "converged  yes"] {
        assert!(text.contains(part), "{part:?} is not in {text}");
    }
    let output = run(&["info", &a]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("degree 1,1  net 2x2  polynomial  clamped"), "{text}");
    let info = printed(&run(&["info", &a, "--json"]));
    assert_eq!(info["faces"][0]["counts"], json!([2, 2]));
}

#[test]
fn bad_input_ends_with_2_and_a_code() {
    let [good, _] = planes("bad");
    let broken = |name: &str, change: &dyn Fn(&mut Value)| {
        let mut model = plane(0.0);
        change(&mut model["surfaces"][0]);
        file(name, &model.to_string())
    };
    let cases = [
        ("no-such-file.json".to_owned(), "FILE_UNREADABLE"),
        (file("text.json", "{\"surfaces\": 3"), "JSON_SHAPE"),
        (file("empty.json", "{\"surfaces\": []}"), "EMPTY_MODEL"),
        (broken("weight.json", &|surface| surface["ctrl"][1][0][3] = json!(-1)), "WEIGHT_NOT_POSITIVE"),
        (broken("ragged.json", &|surface| surface["ctrl"][1] = json!([[0, 0, 0, 1]])), "RAGGED_NET"),
        (broken("degree.json", &|surface| surface["degree"] = json!([16, 1])), "DEGREE_OUT_OF_RANGE"),
        (broken("knots.json", &|surface| surface["knots_u"] = json!([0, 1, 0, 1])), "KNOTS_DECREASING"),
    ];
    for (path, code) in cases {
        for (a, b) in [(&path, &good), (&good, &path)] {
            let output = run(&["distance", a, b]);
            let errors = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(status(&output), 2, "{path}");
            assert!(errors.contains(&format!("error[{code}]")), "{path}: {errors}");
            assert!(output.stdout.is_empty());
        }
    }
}

#[test]
fn bad_arguments_end_with_2() {
    let [a, b] = planes("arguments");
    for arguments in [
        &["distance", &a][..],
        &["distance", &a, &b, "--method", "guess"],
        &["distance", &a, &b, "--translate", "1,2"],
        &["distance", &a, &b, "--samples", "1"],
        &["distance", &a, &b, "--tolerance", "0"],
        &["distance", &a, &b, "--rotate", "0,0,0,5"],
        &["measure"],
    ] {
        let output = run(arguments);
        assert_eq!(status(&output), 2, "{arguments:?}");
        assert!(!output.stderr.is_empty());
    }
}

#[test]
fn help_and_completion_name_the_commands() {
    for arguments in [&["--help"][..], &["completions", "bash"], &["distance", "--help"]] {
        let output = run(arguments);
        assert_eq!(status(&output), 0);
        assert!(String::from_utf8_lossy(&output.stdout).contains("distance"), "{arguments:?}");
    }
}

#[test]
fn diff_lists_the_changed_faces_and_its_exit_status_says_whether_there_are_any() {
    let [a, b] = planes("diff");
    let output = run(&["diff", &a, &b]);
    assert_eq!(status(&output), 1);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("faces of A 0 unchanged, 1 changed, 0 undecided"), "{text}");
    assert!(text.contains("B face 0 changed: 3 ("), "{text}");
    let output = run(&["diff", &a, &b, "--json"]);
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(result["state"], "changed");
    assert!(
        result["facesOfA"][0]["lower"].as_f64().unwrap() <= 3.0
            && 3.0 <= result["facesOfA"][0]["upper"].as_f64().unwrap()
    );
    assert_eq!(status(&run(&["diff", &a, &b, "--limit", "4"])), 0);
    assert_eq!(status(&run(&["diff", &a, &b, "--translate", "0,0,3"])), 0);
    let refused = run(&["diff", &a, &b, "--limit", "-1"]);
    assert_eq!(status(&refused), 2);
}

#[test]
fn diff_says_which_radius_a_round_face_had_and_has() {
    let ball = |radius: f64| {
        let model = sphere(DVec3::ZERO, radius).unwrap();
        file(&format!("diff-ball-{radius}.json"), &model.to_json().unwrap())
    };
    let [a, b] = [2.0, 2.5].map(ball);
    let output = run(&["diff", &a, &b]);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("; radius 2 before, 2.5 after (B face 0)\n"), "{text}");
    assert!(text.contains("; radius 2 before, 2.5 after (A face 0)\n"), "{text}");
    let output = run(&["diff", &a, &a, "--translate", "0,0,0.5"]);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("; moved by 0 0 -0.5 (B face 0)\n"), "{text}");
    let info: Value = printed(&run(&["info", &a, "--json"]));
    assert_eq!(info["faces"][0]["form"]["kind"], "sphere");
}

/// A plane has no inside, and the planes are 3 apart: the answers that are not given say why.
#[test]
fn a_clearance_says_why_an_overlap_and_a_verdict_are_not_stated() {
    let [a, b] = planes("unknown-overlap");
    let found = printed(&run(&["clearance", &a, &b, "--json"]));
    assert_eq!((&found["overlapUnknown"], found.get("overlap")), (&json!("both-open"), None));
    let text = |arguments: &[&str]| {
        let output = run(&[&["clearance", &a, &b], arguments].concat());
        (status(&output), String::from_utf8(output.stdout).unwrap())
    };
    let (_, lines) = text(&[]);
    assert!(lines.contains("\noverlap    unknown: neither model is closed\n"), "{lines}");
    let (undecided, lines) = text(&["--limit", "3"]);
    assert_eq!(undecided, 3);
    let first = lines.lines().next().unwrap();
    assert!(
        first.starts_with("UNDECIDED 3: 3 (")
            && first.contains(", as the clearance is the limit but for the rounding"),
        "{lines}"
    );
}
