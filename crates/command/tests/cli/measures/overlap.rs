//! The command `overlap`, and the units of files.

use crate::commands::{file, plane, printed, run, status};
use serde_json::Value;

/// A box from (0, 0, 0), as text of OFF.
pub(crate) fn cuboid(name: &str, [x, y, z]: [f64; 3]) -> String {
    let corner = |index: usize| {
        let at = |bit: usize, length: f64| if index & bit > 0 { length } else { 0.0 };
        format!("{} {} {}\n", at(1, x), at(2, y), at(4, z))
    };
    let corners: String = (0..8).map(corner).collect();
    let faces = ["0 2 3 1", "4 5 7 6", "0 1 5 4", "2 6 7 3", "0 4 6 2", "1 3 7 5"];
    let faces: String = faces.iter().map(|face| format!("4 {face}\n")).collect();
    file(name, &format!("OFF\n8 6 0\n{corners}{faces}"))
}

fn text(arguments: &[&str]) -> (i32, String) {
    let output = run(arguments);
    (status(&output), String::from_utf8_lossy(&output.stdout).into_owned())
}

#[test]
fn overlap_prints_volumes_and_their_ratio() {
    let [a, b] = [("overlap-a.off", [1.0, 2.0, 3.0]), ("overlap-b.off", [2.0; 3])]
        .map(|(name, size)| cuboid(name, size));
    let arguments = ["overlap", &a, &b, "--translate", "0.5,0.25,0.125"];
    let (ended, lines) = text(&arguments);
    assert_eq!(ended, 0);
    assert!(lines.starts_with("ratio ") && lines.contains("\nonly A     "), "{lines}");
    assert!(lines.contains("\nsearch     converged"), "{lines}");
    let found = printed(&run(&[&arguments[..], &["--json"]].concat()));
    assert_eq!((&found["command"], found["verdict"].is_null()), (&Value::from("overlap"), true));
    let holds = |interval: &Value, number: f64| {
        let end = |name: &str| interval[name].as_f64().unwrap();
        assert!(end("lower") <= number && number <= end("upper"), "{interval} without {number}");
    };
    // A reaches from 0.5, 0.25, 0.125 to 1.5, 2.25, 3.125.
    let common = 1.0 * 1.75 * 1.875;
    holds(&found["volumes"]["intersection"], common);
    holds(&found["volumes"]["union"], 14.0 - common);
    holds(&found["volumes"]["onlyA"], 6.0 - common);
    holds(&found["volumes"]["onlyB"], 8.0 - common);
    holds(&found["ratio"], common / (14.0 - common));
    assert_eq!(text(&["overlap", &a, &b, "--tolerance", "0"]).0, 2);
}

#[test]
fn models_that_are_open_have_no_overlap() {
    let closed = cuboid("overlap-closed.off", [1.0; 3]);
    let open = file("overlap-open.json", &plane(0.0).to_string());
    let (ended, lines) = text(&["overlap", &open, &closed]);
    assert_eq!(ended, 3);
    assert!(lines.starts_with("UNDECIDED: no volumes, as A is not closed\n"), "{lines}");
    let (ended, line) = text(&["overlap", &closed, &open, "--json"]);
    let found: Value = serde_json::from_str(&line).unwrap();
    assert_eq!(
        (ended, &found["volumesUnknown"], &found["verdict"]),
        (3, &"b-open".into(), &"undecided".into())
    );
}

/// Solids that overlap are less apart than any limit, whatever the distance of their boundaries.
#[test]
fn the_first_line_of_a_clearance_says_that_solids_overlap() {
    let [outer, inner] = [("overlapping-outer.off", [8.0; 3]), ("overlapping-inner.off", [2.0; 3])]
        .map(|(name, size)| cuboid(name, size));
    let (ended, lines) = text(&["clearance", &inner, &outer, "--translate", "3,3,3", "--limit", "1"]);
    assert!(ended == 1 && lines.starts_with("OVERLAPPING: the boundaries are 3 ("), "{lines}");
    let (ended, lines) = text(&["clearance", &inner, &outer, "--translate", "-2.5,0,0", "--limit", "1"]);
    assert!(ended == 1 && lines.starts_with("LESS THAN 1: 0.5 ("), "{lines}");
}

#[test]
fn standard_input_is_one_model() {
    let refused = run(&["distance", "-", "-"]);
    assert!(
        String::from_utf8_lossy(&refused.stderr).contains("standard input as both models"),
        "{refused:?}"
    );
    assert_eq!(status(&refused), 2);
}

#[test]
fn units_that_may_be_wrong_are_said() {
    let [a, b] = [("units-a.off", [1.0, 2.0, 3.0]), ("units-b.off", [25.4, 50.8, 76.2])]
        .map(|(name, size)| cuboid(name, size));
    for command in ["distance", "diff", "clearance", "overlap", "statistics"] {
        let (_, lines) = text(&[command, &a, &b]);
        assert!(lines.contains("as if A was in inches and B in millimetres"), "{command}: {lines}");
    }
    let found = printed(&run(&["distance", &a, &b, "--json"]));
    assert!(found["hint"].as_str().unwrap().contains("25.4000 times"), "{found}");
}

/// The same box in inches and in millimetres; neither file states its unit.
#[test]
fn units_of_files_are_stated_on_the_command_line() {
    let inches = cuboid("units-in.off", [1.0, 2.0, 3.0]);
    let millimetres = cuboid("units-mm.off", [25.4, 50.8, 76.2]);
    let units = ["--unit-of-a", "mm", "--unit-of-b", "in"];
    for command in ["distance", "diff", "clearance", "overlap", "statistics"] {
        let arguments = [&[command, &millimetres, &inches, "--json"][..], &units].concat();
        let found = printed(&run(&arguments));
        assert!(found["hint"].is_null(), "{command}: {found}");
        assert_eq!(found["unit"], 1e-3, "{command}: {found}");
    }
    let measured = |arguments: &[&str]| {
        let found = printed(&run(&[arguments, &["--json", "--symmetric"]].concat()));
        found["upper"].as_f64().unwrap()
    };
    assert!(measured(&[&["distance", &millimetres, &inches][..], &units].concat()) < 1e-4);
    // In inches, the other way round.
    let turned = ["--unit-of-a", "in", "--unit-of-b", "mm"];
    assert!(measured(&[&["distance", &inches, &millimetres][..], &turned].concat()) < 1e-5);
    // One unit alone says nothing of the other.
    let found = printed(&run(&["distance", &millimetres, &inches, "--unit-of-a", "mm", "--json"]));
    assert!(found["upper"].as_f64().unwrap() > 50.0 && found["hint"].is_string(), "{found}");
    assert_eq!(status(&run(&["distance", &inches, &inches, "--unit-of-a", "parsec"])), 2);
}
