//! The commands `closest-points` and `gaps`.

use super::overlap::cuboid;
use crate::commands::{file, plane, printed, run, status};
use nurbs_hausdorff::shapes::shape;
use serde_json::Value;
use std::path::PathBuf;

/// The catalogue's sphere of radius 2 about the origin, and points at these distances from its middle.
const FROM_THE_MIDDLE: [f64; 3] = [0.5, 2.25, 5.0];

fn ball_and_points(test: &str) -> [String; 2] {
    let ball = file(&format!("{test}.json"), &shape("sphere").unwrap().to_json().unwrap());
    let points: String = FROM_THE_MIDDLE.iter().map(|x| format!("{x} 0 0\n")).collect();
    [ball, file(&format!("{test}.xyz"), &points)]
}

fn text(arguments: &[&str]) -> (i32, String) {
    let output = run(arguments);
    (status(&output), String::from_utf8_lossy(&output.stdout).into_owned())
}

#[test]
fn points_have_signed_distances_from_a_solid() {
    let [ball, points] = ball_and_points("closest-points");
    let found = printed(&run(&["closest-points", &ball, &points, "--json"]));
    assert_eq!((&found["command"], &found["signs"]), (&Value::from("closest-points"), &Value::from("solid")));
    for (index, from_the_middle) in FROM_THE_MIDDLE.iter().enumerate() {
        let number = |list: &str| found[list][index].as_f64().unwrap();
        let signed = from_the_middle - 2.0;
        assert!((number("distances") - signed.abs()).abs() <= number("bounds"), "{found}");
        assert!((number("signed") - signed).abs() <= number("bounds"), "{found}");
        assert!((found["feet"][3 * index].as_f64().unwrap() - 2.0).abs() < 1e-6, "{found}");
    }
    let (ended, lines) = text(&["closest-points", &ball, &points]);
    assert_eq!(ended, 0);
    assert!(lines.starts_with("farthest   3 (") && lines.contains("of point 2, at 5.0 0.0 0.0"), "{lines}");
    assert!(lines.contains("points     3, 1 inside the solid, 0 without a sign"), "{lines}");
}

#[test]
fn points_are_moved_and_written_with_all_digits() {
    let [ball, points] = ball_and_points("closest-points-csv");
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("closest-points.csv");
    let _ = std::fs::remove_file(&path);
    let arguments =
        ["closest-points", &ball, &points, "--translate", "1,0,0", "--output", path.to_str().unwrap()];
    assert_eq!(status(&run(&arguments)), 0);
    let written = std::fs::read_to_string(&path).unwrap();
    let mut lines = written.lines();
    assert_eq!(lines.next(), Some("x,y,z,signed,distance,bound,footX,footY,footZ,face,u,v"));
    for (line, from_the_middle) in lines.by_ref().zip(FROM_THE_MIDDLE) {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        assert_eq!(numbers[0], from_the_middle, "a point is written as it is given");
        assert!((numbers[3] - (from_the_middle - 1.0)).abs() <= numbers[5], "{line}");
    }
    assert_eq!(lines.next(), None);
    let (_, printed) = text(&arguments[..5]);
    assert!(printed.contains("of point 2, before its motion at 5.0 0.0 0.0"), "{printed}");
    // A file that is there is kept.
    assert_eq!(status(&run(&arguments)), 2);
    assert_eq!(status(&run(&[&arguments[..], &["--overwrite"]].concat())), 0);
    // A model of surfaces is no file of points.
    let refused = run(&["closest-points", &ball, &ball]);
    assert_eq!(status(&refused), 2);
    assert!(String::from_utf8_lossy(&refused.stderr).starts_with("error[FORMAT_UNSUPPORTED]"));
}

/// Points in inches are no points in millimetres, and a file of points is CSV.
#[test]
fn points_in_another_unit_or_format_are_refused() {
    let [ball, points] = ball_and_points("closest-points-refused");
    let ball = {
        let text = std::fs::read_to_string(&ball).unwrap();
        file("closest-points-mm.json", &text.replacen('{', r#"{"unit":0.001,"#, 1))
    };
    let inches = file("closest-points-in.csv", "x [in],y_in,z (in)\n0.2,0,0\n");
    let refused = run(&["closest-points", &ball, &inches]);
    assert!(String::from_utf8_lossy(&refused.stderr).starts_with("error[UNITS_DIFFER]"), "{refused:?}");
    let both = run(&["closest-points", &ball, &points, "--output", "-", "--json"]);
    assert!(String::from_utf8_lossy(&both.stderr).starts_with("error[OPTION_INVALID]"), "{both:?}");
    for name in ["closest-points.ply", "closest-points.json"] {
        let refused = run(&["closest-points", &ball, &points, "--output", name, "--overwrite"]);
        assert!(String::from_utf8_lossy(&refused.stderr).contains(".csv"), "{refused:?}");
        assert_eq!((status(&refused), std::path::Path::new(name).exists()), (2, false));
    }
    let (ended, lines) = text(&["closest-points", &ball, &points, "--output", "-"]);
    assert_eq!((ended, lines.lines().count()), (0, 1 + FROM_THE_MIDDLE.len()));
    assert!(lines.starts_with("x,y,z,signed,"), "{lines}");
}

#[test]
fn gaps_are_the_pairs_of_faces_that_come_near() {
    let [low, high] =
        [0.0, 3.0].map(|height| file(&format!("gaps-{height}.json"), &plane(height).to_string()));
    let found = printed(&run(&["gaps", &low, &high, "--below", "3.5", "--json"]));
    assert_eq!((&found["command"], &found["complete"]), (&Value::from("gaps"), &Value::from(true)));
    let [pair] = found["pairs"].as_array().unwrap().as_slice() else { panic!("{found}") };
    let end = |name: &str| pair[name].as_f64().unwrap();
    assert!(end("lower") <= 3.0 && 3.0 <= end("upper") && end("upper") - end("lower") < 1e-4, "{pair}");
    let (ended, lines) = text(&["gaps", &low, &high, "--below", "3.5"]);
    assert_eq!(ended, 0);
    assert!(lines.starts_with("1 pair of faces comes nearer than 3.5\n3 ("), "{lines}");
    let (ended, lines) = text(&["gaps", &low, &high, "--below", "2.5"]);
    assert!(ended == 0 && lines.starts_with("no faces come nearer than 2.5\n"), "{lines}");
    // Balls of radius 2 that are 1.02 apart. Where a budget ends the search, it is not known whether they come nearer.
    let [ball, _] = ball_and_points("gaps-ball");
    let few = ["gaps", &ball, &ball, "--translate", "5,0.3,0.4", "--below", "1.01", "--max-cells", "1"];
    let (ended, lines) = text(&few);
    assert!(ended == 3 && lines.starts_with("no faces certainly come nearer than 1.01, 1 may\n"), "{lines}");
    assert!(lines.contains(", undecided\n"), "{lines}");
    let (ended, lines) = text(&few[..7]);
    assert!(ended == 0 && lines.starts_with("no faces come nearer than 1.01\n"), "{lines}");
    let line = text(&[&few[..], &["--json"]].concat()).1;
    assert_eq!(serde_json::from_str::<Value>(&line).unwrap()["verdict"], "undecided");
    // A mesh is one face; from 0 to 1 along each axis, it meets the plane at 0. A cloud has no faces.
    let mesh = cuboid("gaps.off", [1.0; 3]);
    let found = printed(&run(&["gaps", &low, &mesh, "--below", "1", "--json"]));
    let [pair] = found["pairs"].as_array().unwrap().as_slice() else { panic!("{found}") };
    assert!(pair["lower"] == 0.0 && pair["upper"].as_f64().unwrap() < 1e-9, "{pair}");
    let cloud = file("gaps.xyz", "0 0 0\n1 0 0\n");
    assert_eq!(text(&["gaps", &low, &cloud, "--below", "1"]).0, 2);
    assert_eq!(text(&["gaps", &low, &high, "--below=-1"]).0, 2);
}
