//! The command `align`.

use crate::commands::{file, run, status};
use nurbs_hausdorff::shapes::shape;
use nurbs_hausdorff::{Model, SurfaceArrays};
use serde_json::Value;

fn wing(name: &str) -> String {
    file(name, &shape("naca-wing").unwrap().to_json().unwrap())
}

/// What is compared with a limit is the zone, which only the fit in the largest distance has.
#[test]
fn a_limit_without_a_zone_is_refused() {
    let part = wing("align-limit.json");
    let output = run(&["align", &part, &part, "--limit", "0.1"]);
    assert_eq!(status(&output), 2);
    assert!(String::from_utf8_lossy(&output.stderr).contains("OPTION_INVALID"));
}

/// In millimetres and in inches, of which the files state neither: the line repeats the units that were given.
#[test]
fn the_line_that_measures_has_the_units_that_were_given() {
    let points = |scale: f64| -> String {
        let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 2.0], [4.0, 3.0, 1.0]];
        corners.map(|point| point.map(|x| (scale * x).to_string()).join(" ") + "\n").concat()
    };
    let [a, b] = [file("align-mm.xyz", &points(25.4)), file("align-in.xyz", &points(1.0))];
    let given = ["--unit-of-a", "mm", "--unit-of-b", "in"];
    let output = run(&[&["align", &a, &b, "--from", "given"][..], &given].concat());
    let text = String::from_utf8(output.stdout).unwrap();
    let line = text.lines().find_map(|line| line.strip_prefix("measure    nurbs-hausdorff ")).unwrap();
    assert!(line.contains("--unit-of-a mm --unit-of-b in") && !line.contains("--scale-units"), "{line}");
    let measured = run(&[&line.split(' ').collect::<Vec<_>>()[..], &["--limit", "1e-4"]].concat());
    assert_eq!(status(&measured), 0, "{line}: {}", String::from_utf8_lossy(&measured.stdout));
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

/// A square by its corners' heights, from (0, 0) to (4, 4).
fn square(name: &str, heights: [f64; 4]) -> String {
    let corners = [(0.0, 0.0), (0.0, 4.0), (4.0, 0.0), (4.0, 4.0)];
    let points = corners.iter().zip(heights).map(|(&(x, y), z)| [x, y, z, 1.0]);
    let arrays = SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: points.collect(),
    };
    file(name, &Model::from_arrays(None, vec![arrays]).unwrap().to_json().unwrap())
}

/// Of a square on a saddle every sample is off; within a hundredth some are left, and of faces there is one.
#[test]
fn samples_are_chosen_by_faces_and_by_a_largest_distance() {
    let saddle = square("align-saddle-chosen.json", [0.1, -0.1, -0.1, 0.1]);
    let plane = square("align-plane-chosen.json", [0.0; 4]);
    let given = ["align", &saddle, &plane, "--norm", "none"];
    let fit = |chosen: &[&str]| -> Value {
        let output = run(&[&given[..], chosen, &["--json"]].concat());
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let near = fit(&["--max-distance", "0.01", "--faces-of-a", "0", "--faces-of-b", "0"]);
    let [samples, counted] = ["samples", "counted"].map(|key| near[key].as_u64().unwrap());
    assert!(0 < counted && counted < samples && samples == 256, "{near}");
    assert!(near["largest"].as_f64().unwrap() <= 0.01 && near["leftOut"]["beyond"] == 0.01, "{near}");
    let text = String::from_utf8(run(&[&given[..], &["--max-distance", "0.01"]].concat()).stdout).unwrap();
    assert!(text.contains(&format!(" of {counted} of 256 samples, ")), "{text}");
    let output = run(&[&given[..], &["--faces-of-a", "0,1"]].concat());
    assert_eq!(status(&output), 2);
    assert!(String::from_utf8_lossy(&output.stderr).contains("face 1 of A"));
}

/// A saddle whose corners are ± 0.1 beside the plane that is nearest to them.
#[test]
fn a_limit_that_no_motion_keeps_fails_and_one_that_the_pose_keeps_passes() {
    let saddle = square("align-saddle.json", [0.1, -0.1, -0.1, 0.1]);
    let plane = square("align-plane.json", [0.0; 4]);
    let fit = |limit: &str| {
        let output = run(&["align", &saddle, &plane, "--norm", "largest", "--limit", limit, "--json"]);
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        (status(&output), found)
    };
    let (passed, found) = fit("0.11");
    assert_eq!((passed, &found["verdict"], &found["zone"]["passes"]), (0, &"passed".into(), &true.into()));
    let [lower, upper] = ["lower", "upper"].map(|end| found["zone"][end].as_f64().unwrap());
    assert!(lower <= 0.1 && 0.1 <= upper + 1e-6 && found["zoneProven"] == true, "{found}");
    let (failed, found) = fit("0.09");
    assert_eq!((failed, &found["verdict"], &found["zone"]["passes"]), (1, &"failed".into(), &false.into()));
    let output = run(&["align", &saddle, &plane, "--norm", "largest"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("\nzone       0.09") && text.contains("no motion of the box"), "{text}");
}

/// Six points 0.1 before the faces of a cube of side 2: no motion leaves more stock everywhere.
#[test]
fn stock_on_a_body_is_a_zone_below_zero() {
    let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let sign = |corner: usize, axis: usize| if (corner >> axis) & 1 == 0 { -1.0 } else { 1.0 };
    let mut cube = String::new();
    for corner in 0..8 {
        cube += &format!("v {} {} {}\n", sign(corner, 0), sign(corner, 1), sign(corner, 2));
    }
    for face in faces {
        cube += &format!("f {}\n", face.map(|corner| (corner + 1).to_string()).join(" "));
    }
    let cube = file("align-cube.obj", &cube);
    let scan = file("align-stock.xyz", "1.1 0 0\n-1.1 0 0\n0 1.1 0\n0 -1.1 0\n0 0 1.1\n0 0 -1.1\n");
    let fit = |limit: &str| {
        let norm = ["align", &scan, &cube, "--from", "given", "--norm", "inside", "--box-translation", "0.1"];
        run(&[&norm as &[&str], &["--limit", limit, "--json"]].concat())
    };
    let passed = fit("-0.09");
    assert_eq!(status(&passed), 0, "{}", String::from_utf8_lossy(&passed.stdout));
    let failed = fit("-0.11");
    assert_eq!(status(&failed), 1, "{}", String::from_utf8_lossy(&failed.stdout));
    let output = run(&["align", &scan, &cube, "--from", "given", "--norm", "inside"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("\nzone       -0.10") && text.contains(" inside B\n"), "{text}");
}

#[test]
fn pairs_and_datums_lay_a_part_by_hand() {
    let part = square("align-by-hand.json", [0.0; 4]);
    let raised = square("align-raised.json", [3.0; 4]);
    let pairs = file("align-pairs.txt", "# a b\n0 0 0, 0 0 3\n4 0 0, 4 0 3, 2\n\n0 4 0, 0 4 3\n");
    let json = |arguments: &[&str]| -> Value {
        let output = run(&[&["align", &part, &raised, "--norm", "none", "--json"], arguments].concat());
        assert_eq!(status(&output), 0, "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    for arguments in [
        &["--pairs", &pairs] as &[&str],
        &["--datum", "face:0=0"],
        &["--datum=plane:0,0,0,0,0,1=1,1,3,0,0,2"],
        &["--from", "boxes"],
    ] {
        let found = json(arguments);
        let translation: Vec<f64> = serde_json::from_value(found["motion"]["translation"].clone()).unwrap();
        assert!((translation[2] - 3.0).abs() < 1e-9 && found["rms"].as_f64() < Some(1e-9), "{found}");
        assert_eq!((&found["steps"], &found["ambiguous"]), (&0.into(), &serde_json::json!([])));
    }
    assert_eq!(json(&["--datum", "face:0=0"])["taken"], serde_json::json!([3]));
    let refused = run(&["align", &part, &raised, "--datum", "face:9=0"]);
    assert_eq!(status(&refused), 2);
    assert_eq!(status(&run(&["align", &part, &raised, "--pairs", "nowhere.txt"])), 2);
    let two = file("align-two-pairs.txt", "0 0 0 0 0 3\n1 0 0 1 0\n");
    let output = run(&["align", &part, &raised, "--pairs", &two]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("line 2"), "{output:?}");
}

#[test]
fn what_has_no_effect_on_a_fit_is_refused() {
    let wing = wing("no-effect");
    for more in [["--box-degrees", "2"], ["--max-boxes", "9"], ["--box-translation", "1"]] {
        let refused = run(&[&["align", &wing, &wing], &more[..]].concat());
        assert!(
            String::from_utf8_lossy(&refused.stderr).contains("whose zone alone has them"),
            "{refused:?}"
        );
    }
    for (text, expected) in [("# none\n", "found no pairs"), ("1 2 3\n", "found 3 numbers, expected 6, or 7")]
    {
        let pairs = file("no-effect.txt", text);
        let refused = run(&["align", &wing, &wing, "--pairs", &pairs]);
        assert!(String::from_utf8_lossy(&refused.stderr).contains(expected), "{refused:?}");
    }
}

/// The names of files are words of a shell in the command that is printed.
#[test]
fn the_line_that_measures_can_be_pasted() {
    let wing = wing("it's a wing");
    let output = run(&["align", &wing, &wing, "--from", "given"]);
    let quoted = format!("'{}'", wing.replace('\'', "'\\''"));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains(&format!("distance {quoted} {quoted} --rotate")), "{text}");
}
