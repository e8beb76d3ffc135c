//! The commands `score` and `summary`, and scores in a batch.

use crate::commands::{file, run, status};
use nurbs_hausdorff::DVec3;
use nurbs_hausdorff::shapes::sphere;
use serde_json::{Value, json};

/// A file with a sphere of this radius.
fn ball(test: &str, radius: f64) -> String {
    let model = sphere(DVec3::ZERO, radius).unwrap();
    file(&format!("score-{test}-{radius}.json"), &model.to_json().unwrap())
}

fn text(output: &std::process::Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn holds(found: &Value, value: f64) {
    let [lower, upper] = ["lower", "upper"].map(|end| found[end].as_f64().unwrap());
    assert!(lower <= value && value <= upper, "{value} {found}");
}

/// Both radii differ by 1/2: that is each distance, and the volumes are as 8 to 27.
#[test]
fn the_json_has_every_number() {
    let (one, other) = (ball("json", 1.5), ball("json", 1.0));
    let output = run(&["score", &one, &other, "--json", "--threshold", "0.25", "--threshold", "0.75"]);
    assert_eq!(status(&output), 0, "{}", String::from_utf8_lossy(&output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&found["command"], &found["verdict"]), (&"score".into(), &Value::Null));
    holds(&found["chamfer"], 1.0);
    holds(&found["chamferSquared"], 0.5);
    holds(&found["hausdorff"]["distance"], 0.5);
    holds(&found["volume"]["ratio"], 8.0 / 27.0);
    holds(&found["iou"], 8.0 / 27.0);
    holds(&found["thresholds"][0]["f1"], 0.0);
    holds(&found["thresholds"][1]["f1"], 1.0);
    holds(&found["candidate"]["valid"], 1.0);
    holds(&found["thresholds"][0]["normalPrecision"], 0.0);
    holds(&found["thresholds"][1]["normalRecall"], 1.0);
    holds(&found["thresholds"][1]["normalF1"], 1.0);
    assert_eq!(found["thresholds"][1]["normalAngle"], 30.0);
    // Neither has a feature edge.
    for number in ["edgePrecision", "edgeRecall", "edgeF1"] {
        holds(&found["thresholds"][0][number], 1.0);
    }
    holds(&found["edgeLength"]["candidate"], 0.0);
    assert_eq!(found["edgeLength"]["featureAngle"], 30.0);
    assert_eq!(found["placement"]["align"], "none");
    assert_eq!(found["placement"]["scale"], 1.0);
    assert_eq!(found["files"]["a"]["sha256"].as_str().unwrap().len(), 64);
}

#[test]
fn the_first_line_and_the_status_are_the_verdict() {
    let (one, other) = (ball("verdict", 1.5), ball("verdict", 1.0));
    let with = |more: &[&str]| run(&[&["score", &one, &other], more].concat());
    for (more, expected, start) in [
        (&["--at-most", "hausdorff=0.6"][..], 0, "MET hausdorff at most 0.6: 0.5"),
        (&["--at-most", "hausdorff=0.4"], 1, "MISSED hausdorff at most 0.4: at least 0."),
        (&["--at-least", "volume-ratio=0.9"], 1, "MISSED volumeRatio at least 0.9: at most 0.296"),
        // Of balls about one middle the distance is 0, which no interval is wholly below.
        (&["--at-most", "centroid-distance=0"], 3, "UNDECIDED centroidDistance at most 0: "),
        (&["--threshold", "0.75"], 0, "f1 1 ("),
        (&["--threshold", "0.75", "--normal-angle", "5", "--at-least", "normal-f1=0.99"], 0, "MET normalF1"),
        (&["--threshold", "0.25", "--at-least", "normalPrecision=0.01"], 1, "MISSED normalPrecision"),
        (&["--feature-angle", "60", "--at-least", "edge-f1=0.99"], 0, "MET edgeF1 at least 0.99: 1"),
        // Scaled to one box they agree.
        (&["--align", "box", "--at-least", "f1=0.99"], 0, "MET f1 at least 0.99: 1"),
    ] {
        let output = with(more);
        let text = text(&output);
        assert_eq!(status(&output), expected, "{more:?}: {text}");
        assert!(text.starts_with(start), "{more:?}: {text}");
    }
    for wrong in ["f2=1", "f1", "f1=x"] {
        let output = with(&["--at-least", wrong]);
        assert_eq!(status(&output), 2, "{wrong}");
        assert!(String::from_utf8_lossy(&output.stderr).contains("expected"), "{wrong}");
    }
}

/// Three balls and a file that is not there: the means of 0, 1/2 and 1, of three pairs, and one of four invalid.
#[test]
fn a_summary_holds_the_means_and_the_medians() {
    let truth = ball("summary", 1.0);
    let candidates = [1.0, 1.5, 2.0].map(|radius| ball("summary", radius));
    let line =
        |(id, a): (usize, &str)| json!({ "id": id, "command": "score", "a": a, "b": truth }).to_string();
    let paths = candidates.iter().map(String::as_str).chain(["score-missing.json"]);
    let lines: Vec<String> = paths.enumerate().map(line).collect();
    let pairs = file("score-pairs.jsonl", &lines.join("\n"));
    let output = run(&["batch", &pairs]);
    assert_eq!(status(&output), 1, "{}", text(&output));
    let answers = file("score-answers.jsonl", &text(&output));
    let output = run(&["summary", &answers, "--format", "json"]);
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((found["pairs"].as_u64(), found["errors"].as_u64()), (Some(4), Some(1)));
    holds(&found["invalidRatio"], 0.25);
    let number = |name: &str| {
        let numbers = found["numbers"].as_array().unwrap();
        numbers.iter().find(|one| one["number"] == name).unwrap_or_else(|| panic!("{name}"))
    };
    holds(&number("hausdorff")["mean"], 0.5);
    holds(&number("hausdorff")["median"], 0.5);
    holds(&number("chamferSquared")["mean"], 2.0 * (0.25 + 1.0) / 3.0);
    holds(&number("chamferSquared")["median"], 0.5);
    holds(&number("volumeRatio")["mean"], (1.0 + 8.0 / 27.0 + 1.0 / 8.0) / 3.0);
    assert_eq!(number("f1")["pairs"], 3);
    let format = |name: &str| text(&run(&["summary", &answers, "--format", name]));
    let csv = format("csv");
    assert!(csv.starts_with("number,mean_lower,mean_upper,median_lower,median_upper,pairs\n"), "{csv}");
    let row = csv.lines().find(|line| line.starts_with("hausdorff,")).unwrap();
    let cells: Vec<f64> = row.split(',').skip(1).map(|cell| cell.parse().unwrap()).collect();
    assert!(cells[0] <= 0.5 && 0.5 <= cells[1] && cells[2] <= 0.5 && 0.5 <= cells[3] && cells[4] == 3.0);
    let latex = format("latex");
    assert!(latex.starts_with("\\begin{tabular}") && latex.contains("chamfer squared & $[0.8"), "{latex}");
    assert!(format("text").starts_with("4 pairs, 1 without a score, invalid ("));
    // Answers of another command are refused.
    let other = file("score-others.jsonl", r#"{"id": 1, "lower": 0.0}"#);
    let output = run(&["summary", &other]);
    assert_eq!(status(&output), 2);
    assert!(String::from_utf8_lossy(&output.stderr).contains("line 1 is no answer of command score"));
}

/// A requirement in a batch has its verdict in the answer.
#[test]
fn a_batch_judges_requirements() {
    let (one, other) = (ball("batch", 1.5), ball("batch", 1.0));
    let line = json!({ "id": 1, "command": "score", "a": one, "b": other, "atMost": { "hausdorff": 0.1 } });
    let pairs = file("score-judged.jsonl", &line.to_string());
    let output = run(&["batch", &pairs]);
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&found["verdict"], &found["met"]), (&"failed".into(), &false.into()));
    assert_eq!(found["endedEarly"], true);
    assert_eq!(found["requirements"][0]["number"], "hausdorff");
}
