//! The command `align`.

use crate::commands::{file, run, status};
use nurbs_hausdorff::shapes::shape;
use serde_json::Value;

fn wing(name: &str) -> String {
    file(name, &shape("naca-wing").unwrap().to_json().unwrap())
}

/// The line that measures the pair in the pose found does so.
#[test]
fn a_wing_that_was_turned_is_laid_on_itself_and_measured_there() {
    let part = wing("align-wing.json");
    let moved = ["--rotate=1,2,2,140", "--translate=3,-2,1"];
    let output = run(&[&["align", &part, &part], moved.as_slice()].concat());
    assert_eq!(status(&output), 0, "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with("FITTED: rms "), "{text}");
    let line = text.lines().find_map(|line| line.strip_prefix("measure    nurbs-hausdorff ")).unwrap();
    let words: Vec<&str> = line.split(' ').collect();
    let measured = run(&[words.as_slice(), &["--limit", "0.001"]].concat());
    assert_eq!(status(&measured), 0, "{line}: {}", String::from_utf8_lossy(&measured.stdout));
}

#[test]
fn json_has_the_motion_in_all_forms_and_a_fit_that_is_none_is_undecided() {
    let part = wing("align-json.json");
    let output = run(&["align", &part, &part, "--json"]);
    assert_eq!(status(&output), 0);
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found["command"], "align");
    assert_eq!((&found["verdict"], &found["converged"]), (&"passed".into(), &true.into()));
    assert_eq!(
        found["motion"]["matrix"],
        serde_json::json!([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]])
    );
    for key in
        ["rms", "rmsBefore", "rmsRandom", "steps", "ambiguous", "freedoms", "tried", "leftOut", "transform"]
    {
        assert!(!found[key].is_null(), "{key}");
    }
    // One step from where it lies far off is no fit.
    let far = ["--from", "given", "--rotate=1,2,2,140", "--translate=30,-2,1", "--max-steps", "1"];
    let output = run(&[&["align", &part, &part, "--json"], far.as_slice()].concat());
    assert_eq!(status(&output), 3);
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&found["verdict"], &found["converged"]), (&"undecided".into(), &false.into()));
}
