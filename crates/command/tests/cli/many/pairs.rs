//! Directories against directories, and the reports that CI services read.

use crate::commands::{plane, run, status};
use quick_junit::{NonSuccessKind, Report, TestCaseStatus};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Two new directories with these files.
fn directories(test: &str, files: [&[(&str, Value)]; 2]) -> [String; 2] {
    let root = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("pairs-{test}"));
    let _ = std::fs::remove_dir_all(&root);
    ["old", "new"].map(|name| root.join(name)).into_iter().zip(files).for_each(|(folder, files)| {
        for (path, content) in files {
            let path = folder.join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, content.to_string()).unwrap();
        }
    });
    ["old", "new"].map(|name| root.join(name).to_str().unwrap().to_owned())
}

/// A file of each kind of outcome, one of them in a folder and of a name with XML's marks.
fn mixed(test: &str) -> [String; 2] {
    let broken = json!("no model");
    directories(
        test,
        [
            &[
                ("same.json", plane(0.0)),
                ("sub/moved <&>.json", plane(0.0)),
                ("gone.json", plane(0.0)),
                ("broken.json", broken.clone()),
                ("notes.md", broken.clone()),
            ],
            &[
                ("same.json", plane(0.0)),
                ("sub/moved <&>.json", plane(3.0)),
                ("new.json", plane(0.0)),
                ("broken.json", broken),
            ],
        ],
    )
}

const STATES: [(&str, &str); 5] = [
    ("broken.json", "error"),
    ("gone.json", "removed"),
    ("new.json", "added"),
    ("same.json", "unchanged"),
    ("sub/moved <&>.json", "changed"),
];

fn text(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

#[test]
fn directories_are_compared_by_relative_path() {
    let [a, b] = mixed("json");
    let output = run(&["diff", &a, &b, "--format", "json"]);
    assert_eq!(status(&output), 2, "{}", String::from_utf8_lossy(&output.stderr));
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    let pairs = printed["pairs"].as_array().unwrap();
    let states: Vec<_> =
        pairs.iter().map(|pair| (pair["path"].as_str().unwrap(), pair["state"].as_str().unwrap())).collect();
    assert_eq!(states, STATES);
    assert_eq!(pairs[0]["error"]["code"], "FORMAT_UNSUPPORTED");
    let moved = &pairs[4]["result"];
    let [lower, upper] = ["lower", "upper"].map(|end| moved["facesOfA"][0][end].as_f64().unwrap());
    assert!(lower <= 3.0 && 3.0 <= upper && upper - lower < 1e-6);
    // What one pair prints, but for the time.
    let [one, other] = [&a, &b].map(|folder| Path::new(folder).join("sub/moved <&>.json"));
    let alone = run(&["diff", one.to_str().unwrap(), other.to_str().unwrap(), "--json"]);
    let mut alone: Value = serde_json::from_slice(&alone.stdout).unwrap();
    alone["seconds"] = moved["seconds"].clone();
    assert_eq!(&alone, moved);
}

#[test]
fn the_exit_status_is_that_of_the_worst_pair() {
    let [a, b] = mixed("status");
    let of =
        |include: &str, limit: &str| status(&run(&["diff", &a, &b, "--include", include, "--limit", limit]));
    assert_eq!(of("*.json", "1"), 2);
    assert_eq!(of("{same,gone}.json", "1"), 1);
    assert_eq!(of("{same,new}.json", "1"), 1);
    assert_eq!(of("sub/*", "1"), 1);
    assert_eq!(of("sub/*", "4"), 0);
    assert_eq!(of("sub/*", "3"), 3);
    // A pattern without a slash is a name in any folder, and one with slashes a path.
    assert_eq!(of("moved*", "1"), 1);
    assert_eq!(of("**/same.json", "1"), 0);
    // A check of nothing does not pass.
    assert_eq!(of("*/same.json", "1"), 2);
    let distance = |limit: &str| status(&run(&["distance", &a, &b, "--include", "sub/*", "--limit", limit]));
    assert_eq!([distance("1"), distance("4")], [1, 0]);
}

#[test]
fn junit_is_read_by_a_parser_of_its_own() {
    let [a, b] = mixed("junit");
    let output = run(&["diff", &a, &b, "--format", "junit"]);
    let report = Report::deserialize_from_str(&text(&output)).unwrap();
    assert_eq!((report.tests, report.failures, report.errors), (5, 3, 1));
    let cases = &report.test_suites[0].test_cases;
    for (case, (path, state)) in cases.iter().zip(STATES) {
        assert_eq!(case.name.as_str(), path);
        let expected = match state {
            "unchanged" => None,
            "error" => Some(NonSuccessKind::Error),
            _ => Some(NonSuccessKind::Failure),
        };
        match &case.status {
            TestCaseStatus::NonSuccess { kind, ty, .. } => {
                assert_eq!((Some(*kind), ty.as_ref().map(|ty| ty.as_str())), (expected, Some(state)));
            }
            TestCaseStatus::Success { .. } => assert_eq!(expected, None),
            TestCaseStatus::Skipped { .. } => panic!("no pair is skipped"),
        }
    }
}

#[test]
fn files_alone_have_reports_too_and_errors_are_rows_of_them() {
    let [a, b] = mixed("alone").map(|folder| format!("{folder}/broken.json"));
    let plain = run(&["diff", &a, &b]);
    assert_eq!((status(&plain), text(&plain).as_str()), (2, ""));
    for (format, expected) in
        [("junit", "<error type=\"error\""), ("markdown", "**error**"), ("html", "status-2")]
    {
        let output = run(&["diff", &a, &b, "--format", format]);
        assert_eq!(status(&output), 2);
        assert!(text(&output).contains(expected), "{}", text(&output));
    }
}

#[test]
fn a_directory_beside_a_file_is_refused() {
    let [a, b] = mixed("kinds");
    for pair in [[a.clone(), format!("{b}/same.json")], [format!("{a}/same.json"), b]] {
        let output = run(&["diff", &pair[0], &pair[1]]);
        assert_eq!(status(&output), 2);
        assert!(String::from_utf8_lossy(&output.stderr).starts_with("error[OPTION_INVALID]"));
    }
    assert_eq!(status(&run(&["diff", &a, &a, "--include", "[", "--limit", "1"])), 2);
}

#[test]
fn answers_are_used_again_for_the_same_content_and_options_alone() {
    let [a, b] = mixed("reuse");
    let kept = format!("{a}/../kept");
    let count = || std::fs::read_dir(&kept).unwrap().count();
    let of = |limit: &str| run(&["diff", &a, &b, "--format", "json", "--reuse", &kept, "--limit", limit]);
    let first = of("1");
    assert_eq!(count(), 2);
    assert_eq!(text(&of("1")), text(&first));
    // Another limit, and another content.
    assert_eq!(status(&of("4")), 2);
    assert_eq!(count(), 4);
    std::fs::write(format!("{b}/same.json"), plane(2.0).to_string()).unwrap();
    let changed: Value = serde_json::from_slice(&of("1").stdout).unwrap();
    assert_eq!(changed["pairs"][3]["state"], "changed");
    assert_eq!(count(), 5);
}

/// Runs git in a folder, with the command of this build first on the path.
fn git(folder: &str, arguments: &[&str]) -> Output {
    let tool = Path::new(env!("CARGO_BIN_EXE_nurbs-hausdorff")).parent().unwrap();
    let path = std::env::var("PATH").unwrap();
    Command::new("git")
        .args(["-c", "user.name=test", "-c", "user.email=test@localhost", "-c", "init.defaultBranch=main"])
        .args(arguments)
        .current_dir(folder)
        .env("PATH", format!("{}:{path}", tool.display()))
        .output()
        .unwrap()
}

/// The recipes of `docs/batch.md`.
#[test]
fn git_shows_differences_by_textconv_and_difftool() {
    let [folder, _] = directories("git", [&[("part.step.json", plane(0.0))], &[]]);
    let done = |arguments: &[&str]| {
        let output = git(&folder, arguments);
        assert!(output.status.success(), "{arguments:?} {}", String::from_utf8_lossy(&output.stderr));
        text(&output)
    };
    done(&["init", "--quiet"]);
    done(&["config", "diff.cad.textconv", "nurbs-hausdorff info"]);
    done(&["config", "difftool.cad.cmd", "nurbs-hausdorff diff \"$LOCAL\" \"$REMOTE\""]);
    std::fs::write(format!("{folder}/.gitattributes"), "*.json diff=cad\n").unwrap();
    done(&["add", "."]);
    done(&["commit", "--quiet", "--message", "first"]);
    std::fs::write(format!("{folder}/part.step.json"), plane(3.0).to_string()).unwrap();
    let difference = done(&["diff"]);
    assert!(difference.contains("-from") && difference.contains("+from"), "{difference}");
    let compared = done(&["difftool", "--no-prompt", "--tool", "cad"]);
    assert!(compared.contains("CHANGED 0.001: 3 ("), "{compared}");
}
