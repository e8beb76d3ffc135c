//! The command `check`: boxes of one file and of several.

use crate::commands::{file, run, status};
use crate::support::writers::step::{StepText, UnitsOf};
use serde_json::Value;
use std::process::Output;

/// The interchange JSON of boxes by their least and largest coordinates, named one after the other.
fn boxes(name: &str, all: &[(&str, [f64; 3], [f64; 3])]) -> String {
    let faces: Vec<Value> = all.iter().flat_map(|(name, min, max)| faces(name, *min, *max)).collect();
    file(&format!("check-{name}.json"), &serde_json::json!({ "surfaces": faces }).to_string())
}

/// The six faces of a box.
pub(crate) fn faces(name: &str, min: [f64; 3], max: [f64; 3]) -> Vec<Value> {
    let corner = |index: usize| {
        let [x, y, z] = [0, 1, 2].map(|axis| if index >> axis & 1 == 1 { max[axis] } else { min[axis] });
        serde_json::json!([x, y, z, 1.0])
    };
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let face = |(index, [a, b, c, d]): (usize, [usize; 4])| {
        serde_json::json!({
            "degree": [1, 1],
            "knots_u": [0, 0, 1, 1],
            "knots_v": [0, 0, 1, 1],
            "ctrl": [[corner(a), corner(d)], [corner(b), corner(c)]],
            "part": format!("{name} / face {index}"),
        })
    };
    quads.into_iter().enumerate().map(face).collect()
}

fn text(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

#[test]
fn a_clash_is_the_first_line_and_exit_status_1() {
    let path = boxes(
        "clash",
        &[
            ("shaft", [0.0; 3], [1.0; 3]),
            ("housing", [0.5, 0.25, 0.25], [2.0; 3]),
            ("lid", [0.0, 0.0, 2.0], [1.0, 1.0, 3.0]),
        ],
    );
    let output = run(&["check", &path, "--below", "1.5"]);
    assert_eq!(status(&output), 1);
    let text = text(&output);
    assert!(text.starts_with("CLASH: 1 of 3 pairs: shaft and housing, at "), "{text}");
    assert!(
        text.contains("touching   housing and lid") && text.contains("near       shaft and lid"),
        "{text}"
    );
    let json = run(&["check", &path, "--json"]);
    let found: Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!((status(&json), &found["verdict"], &found["command"]), (1, &"failed".into(), &"check".into()));
    assert_eq!(found["schemaVersion"], 1);
    let pair = &found["pairs"][0];
    assert_eq!(
        (&pair["a"], &pair["b"], &pair["state"]),
        (&"shaft".into(), &"housing".into(), &"clash".into())
    );
    assert_eq!(pair["clearance"]["upper"], 0.0);
    // Half of the shaft's length, three quarters of its width and height; out along x is the shortest way.
    for (name, expected) in [("volume", 0.5 * 0.75 * 0.75), ("depth", 0.5)] {
        let [lower, upper] = ["lower", "upper"].map(|end| pair[name][end].as_f64().unwrap());
        assert!(lower <= expected && expected <= upper && upper - lower < 0.05, "{name}: {lower} {upper}");
    }
    assert!(text.contains("; common volume 0.28") && text.contains("; depth "), "{text}");
    let point: Vec<f64> = pair["point"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    assert!((0.5..1.0).contains(&point[0]) && (0.25..1.0).contains(&point[1]), "{point:?}");
    assert_eq!(found["bodies"].as_array().unwrap().len(), 3);
}

/// Serde would accept an array as the values of an object, and an empty array as no rules.
#[test]
fn rules_are_lists_of_objects_by_name() {
    let path = boxes("rules", &[("shaft", [0.0; 3], [1.0; 3]), ("housing", [0.5, 0.25, 0.25], [2.0; 3])]);
    let meant = r#"{"intended": [{"a": "shaft", "b": "housing"}]}"#;
    for (rules, expected) in [
        (meant.to_owned(), 0),
        (format!("\u{feff}{meant}"), 0),
        ("[]".to_owned(), 2),
        (r#"[[["shaft", "housing"]]]"#.to_owned(), 2),
        (r#"{"intended": [["shaft", "housing"]]}"#.to_owned(), 2),
        (r#"{"intended": {}}"#.to_owned(), 2),
    ] {
        let file = file("check-rules-kinds.json", &rules);
        let output = run(&["check", &path, "--rules", &file]);
        assert_eq!(status(&output), expected, "{rules}");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(expected == 0 || said.contains("OPTION_INVALID"), "{rules}: {said}");
    }
}

#[test]
fn the_tolerance_is_said() {
    let path =
        boxes("tolerance", &[("one", [0.0; 3], [1.0; 3]), ("far", [1e6, 0.0, 0.0], [1e6 + 1.0, 1.0, 1.0])]);
    // The tolerance is a millionth of the diagonal, which the far body makes long.
    assert!(text(&run(&["check", &path])).contains("\ntolerance  1, up to which bodies touch\n"));
    let stated = text(&run(&["check", &path, "--tolerance", "0.015"]));
    assert!(stated.contains("\ntolerance  0.015, "), "{stated}");
}

/// A block of side 10 with a pocket of depth 12, whose walls pass through the floor.
const POCKET: &str = "OFF
16 14 0
0 0 0
10 0 0
10 10 0
0 10 0
0 0 10
10 0 10
10 10 10
0 10 10
3 3 10
7 3 10
7 7 10
3 7 10
3 3 -2
7 3 -2
7 7 -2
3 7 -2
4 0 3 2 1
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
4 4 5 9 8
4 5 6 10 9
4 6 7 11 10
4 7 4 8 11
4 8 9 13 12
4 9 10 14 13
4 10 11 15 14
4 11 8 12 15
4 12 13 14 15
";

/// Its fault is no part of the verdict, and the first line says it.
#[test]
fn a_body_that_meets_itself_is_in_the_first_line() {
    let output = run(&["check", &file("check-pocket.off", POCKET)]);
    let text = text(&output);
    assert!(
        text.starts_with("CLEAN: 0 pairs, 0 touching, 0 near; 1 body meets itself\n"),
        "{text} {output:?}"
    );
    assert!(text.contains("meets itself: walls have passed through each other"), "{text}");
    assert_eq!(status(&output), 0);
}

#[test]
fn files_are_checked_where_they_stand_by_rules() {
    let shaft = boxes("shaft", &[("shaft", [0.0; 3], [1.0; 3])]);
    let hub = boxes("hub", &[("hub", [1.25, 0.0, 0.0], [2.0, 1.0, 1.0])]);
    let output = run(&["check", &shaft, &hub]);
    assert_eq!(status(&output), 0);
    assert!(text(&output).starts_with("CLEAN: 1 pair, 0 touching, 0 near"), "{}", text(&output));
    for (distance, expected, word) in [(0.2, 0, "CLEAN"), (0.3, 1, "BROKEN: 1 rule: ")] {
        let rules =
            serde_json::json!({ "atLeast": [{ "a": "*/shaft", "b": "**/hub", "distance": distance }] });
        let rules = file("check-rules.json", &rules.to_string());
        let output = run(&["check", &shaft, &hub, "--rules", &rules]);
        assert_eq!(status(&output), expected);
        assert!(text(&output).starts_with(word), "{}", text(&output));
    }
    for rules in [r#"{"mustTouch": [{"a": "lid", "b": "**"}]}"#, r#"{"most": 1}"#, "{"] {
        let output = run(&["check", &shaft, &hub, "--rules", &file("check-bad-rules.json", rules)]);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(status(&output) == 2 && errors.contains("OPTION_INVALID"), "{errors}");
    }
}

#[test]
fn reports_have_a_row_for_each_pair() {
    let path = boxes(
        "report",
        &[
            ("a", [0.0; 3], [1.0; 3]),
            ("b", [0.5, 0.625, 0.625], [2.0; 3]),
            ("c", [1.0, 0.125, 0.125], [2.0, 0.5, 0.5]),
        ],
    );
    let junit = text(&run(&["check", &path, "--format", "junit"]));
    assert!(junit.contains("tests=\"2\" failures=\"1\" errors=\"0\""), "{junit}");
    assert!(junit.contains("<testcase name=\"a and b\""), "{junit}");
    let markdown = run(&["check", &path, "--format", "markdown"]);
    assert_eq!(status(&markdown), 1);
    assert!(text(&markdown).contains("| a and b | **clash** |"), "{}", text(&markdown));
}

/// Each clash that is not meant has a section with three pictures, and what was measured.
#[test]
fn a_page_has_a_section_for_each_clash() {
    let path = boxes(
        "page",
        &[("a <b>", [0.0; 3], [1.0; 3]), ("b", [0.5; 3], [2.0; 3]), ("c", [1.5, 1.5, 0.0], [2.5, 2.5, 1.0])],
    );
    let rules = serde_json::json!({ "intended": [{ "a": "b", "b": "c" }] });
    let rules = file("check-page-rules.json", &rules.to_string());
    let output = run(&["check", &path, "--rules", &rules, "--format", "html"]);
    assert_eq!(status(&output), 1);
    let page = text(&output);
    assert!(page.contains("<title>nurbs-hausdorff check: 1 clash, 1 intended</title>"), "{page}");
    assert_eq!(page.matches("<section class=\"pair status-1\">").count(), 1);
    assert_eq!((page.matches("<section").count(), page.matches("<img ").count()), (1, 3));
    for part in
        ["<h2>a &lt;b&gt; and b</h2>", "<b class=\"badge\">FAIL</b>", "<dt>Depth</dt><dd>[", "<dt>At</dt>"]
    {
        assert!(page.contains(part), "{part}");
    }
    assert!(page.contains("<th>Bodies</th>") && !page.contains("SHA-256"));
    assert!(!page.contains("NO VERDICT") && !page.contains("Allowed deviation") && !page.contains("A: "));
    let apart = boxes("page-apart", &[("a", [0.0; 3], [1.0; 3]), ("b", [5.0; 3], [6.0; 3])]);
    let page = text(&run(&["check", &apart, "--format", "html"]));
    assert!(page.contains("<b class=\"badge\">PASS</b> apart: 1 pair, none nearer than 0"), "{page}");
    assert!(!page.contains("<img ") && !page.contains("have pictures"));
}

/// An open face in a file of STEP is clean, and said not to close.
#[test]
fn a_body_that_does_not_close_is_named() {
    let mut step = StepText::new();
    let placement = step.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let plane = step.add(format!("PLANE('',#{placement})"));
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let vertices = corners.map(|corner| step.vertex(corner));
    let edges: Vec<(usize, bool)> = (0..3)
        .map(|index| {
            let [from, to] = [corners[index], corners[(index + 1) % 3]];
            let line = step.line(from, [0, 1, 2].map(|axis| to[axis] - from[axis]));
            (step.edge(line, [vertices[index], vertices[(index + 1) % 3]], true), true)
        })
        .collect();
    let path = step.edge_loop(&edges);
    let face = step.face(&[path], plane, true);
    let shell = step.open_shell(&[face]);
    let text_of_file = step.of(&[shell], UnitsOf::Millimetres);
    let output = run(&["check", &file("check-open.step", &text_of_file)]);
    assert_eq!(status(&output), 0, "{}", String::from_utf8_lossy(&output.stderr));
    assert!(text(&output).contains("is not closed"), "{}", text(&output));
}

/// Parts whose names differ in their numbers alone keep these; copies that moved alike are one group.
#[test]
fn the_first_line_of_a_difference_names_the_parts_that_moved() {
    let names = ["M6", "M8", "bolt:1", "bolt:2"];
    let at = |moved: &[(usize, f64)]| {
        let part = |(index, name): (usize, &&'static str)| {
            let y = moved.iter().find(|(other, _)| *other == index).map_or(0.0, |&(_, y)| y);
            let x = 10.0 * index as f64;
            // No part is a copy of another one.
            let size = 1.0 + index as f64 / 8.0;
            (*name, [x, y, 0.0], [x + size, y + 1.0, 2.0])
        };
        names.iter().enumerate().map(part).collect::<Vec<_>>()
    };
    let a = boxes("named-a", &at(&[]));
    for (name, moved, expected) in [
        ("named-b", &[(1, 3.0)][..], "1 of 4 parts changed: M8 moved by 3.000 along y;"),
        ("named-c", &[(2, 3.0), (3, 3.0)], "2 of 4 parts changed: bolt ×2 moved by 3.000 along y;"),
        ("named-d", &[(3, 3.0)], "1 of 4 parts changed: bolt:2 moved by 3.000 along y;"),
    ] {
        let found = text(&run(&["diff", &a, &boxes(name, &at(moved))]));
        assert!(found.lines().next().is_some_and(|line| line.contains(expected)), "{found}");
    }
}

/// A file without a unit beside one with a unit is named: its lengths are taken as they are.
#[test]
fn a_file_without_a_unit_is_named() {
    let stated = {
        let text = std::fs::read_to_string(boxes("stated", &[("a", [0.0; 3], [1.0; 3])])).unwrap();
        file("check-millimetres.json", &text.replacen('{', r#"{"unit":0.001,"#, 1))
    };
    let unknown = boxes("unknown", &[("b", [3.0; 3], [4.0; 3])]);
    let error = |files: [&str; 2]| {
        let output = run(&[&["check"], &files[..]].concat());
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    let found = error([&stated, &unknown]);
    assert!(found.contains("check-unknown.json: it states no unit") && found.contains("0.001 m"), "{found}");
    assert_eq!(error([&unknown, &unknown]), "");
}

/// A copy in its original's place has no face of its own.
#[test]
fn a_part_more_is_a_change_that_comes_first() {
    let (bolt, plate) = (("bolt", [0.0; 3], [1.0; 3]), ("plate", [3.0, 0.0, 0.0], [5.0, 2.0, 1.0]));
    let before = boxes("parts-before", &[bolt, plate]);
    let after = boxes("parts-after", &[bolt, plate, ("spare", bolt.1, bolt.2)]);
    let output = run(&["diff", &before, &after, "--limit", "0.001"]);
    assert_eq!(status(&output), 1);
    let said = text(&output);
    assert!(said.starts_with("CHANGED 0.001: 1 of 3 parts changed: spare added; "), "{said}");
    assert!(said.contains("12 unchanged, 0 changed"), "{said}");
    assert_eq!(status(&run(&["diff", &before, &before, "--limit", "0.001"])), 0);
    let late = run(&["diff", &before, &after, "--limit", "0.001", "--max-seconds", "1e-9"]);
    assert!(
        text(&late).contains("\nparts      not compared, as the time was spent before\n"),
        "{}",
        text(&late)
    );
}
