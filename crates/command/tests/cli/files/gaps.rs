//! Verdicts that the gaps of the files could change.

use crate::commands::{file, plane, printed, run, status};
use serde_json::{Value, json};

/// The square at a height, whose source may be this far from it.
fn with_gap(height: f64, gap: f64, measured: bool) -> String {
    let mut model = plane(height);
    model["surfaces"][0]["gap"] = json!(gap);
    model["surfaces"][0]["gap_measured"] = json!(measured);
    model.to_string()
}

/// Squares at the distance 3 whose sources are anywhere from 2.25 to 3.75 apart.
#[test]
fn a_verdict_says_whether_the_gaps_could_change_it() {
    let a = file("gap-a.json", &with_gap(0.0, 0.25, false));
    let b = file("gap-b.json", &with_gap(3.0, 0.5, false));
    for command in ["distance", "diff"] {
        // The limit, the exit statuses without and with --strict-gaps, and whether both agree.
        for (limit, statuses) in [
            ("2", [1, 1]),
            ("2.5", [1, 3]),
            ("3.5", [0, 3]),
            ("3.74", [0, 3]),
            ("3.76", [0, 0]),
            ("2.24", [1, 1]),
        ] {
            let plain = run(&[command, &a, &b, "--limit", limit]);
            let strict = run(&[command, &a, &b, "--limit", limit, "--strict-gaps"]);
            assert_eq!([status(&plain), status(&strict)], statuses, "{command} {limit}");
            let text = String::from_utf8_lossy(&plain.stdout).into_owned();
            let says = text.contains("but the gaps of the files could change that");
            assert_eq!(says, statuses[0] != statuses[1], "{text}");
        }
    }
}

#[test]
fn the_interval_with_gaps_contains_the_distances_of_all_sources() {
    for (a, b, proven) in [(false, false, true), (true, false, false), (false, true, false)] {
        let a = file("gaps-a.json", &with_gap(0.0, 0.25, a));
        let b = file("gaps-b.json", &with_gap(3.0, 0.5, b));
        let result = printed(&run(&["distance", &a, &b, "--symmetric", "--limit", "3.6", "--json"]));
        let end = |name: &str| result["withGaps"][name].as_f64().unwrap();
        // The sources at the heights -0.25 and 3.5, and 0.25 and 2.5.
        assert!(end("lower") <= 2.25 && 3.75 <= end("upper"), "{result}");
        assert_eq!((&result["within"], &result["withGaps"]["within"]), (&json!(true), &Value::Null));
        assert_eq!((&result["gap"], &result["gapProven"]), (&json!(0.75), &json!(proven)));
        let compared = printed(&run(&["diff", &a, &b, "--limit", "3.6", "--json"]));
        assert_eq!((&compared["state"], &compared["withGaps"]), (&json!("unchanged"), &json!("undecided")));
        assert_eq!(compared["facesOfA"][0]["gap"], 0.75);
    }
}

/// Every face of a comparison has its own gap: a face far off does not make the others doubtful.
#[test]
fn gaps_count_by_face() {
    let mut a = plane(0.0);
    let mut doubtful = a["surfaces"][0].clone();
    doubtful["gap"] = json!(0.5);
    a["surfaces"].as_array_mut().unwrap().push(doubtful);
    let a = file("gaps-by-face-a.json", &a.to_string());
    let b = file("gaps-by-face-b.json", &plane(0.0).to_string());
    let result = printed(&run(&["diff", &a, &b, "--limit", "0.1", "--json"]));
    let states: Vec<_> = (0..2).map(|face| result["facesOfA"][face]["withGaps"].clone()).collect();
    assert_eq!(states, [json!("unchanged"), json!("undecided")]);
}
