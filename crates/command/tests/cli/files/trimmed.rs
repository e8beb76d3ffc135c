//! Trimmed models and units on the command line.

use crate::commands::{file, plane, printed, run, status};
use crate::support::writers::brep::{BrepText, plus, polygon, rectangle};
use serde_json::{Value, json};

/// The half of the plane's square on one side of a diagonal, as a loop with this gap.
fn triangle(height: f64, gap: f64) -> Value {
    let side = |from: [i32; 2], to: [i32; 2]| {
        json!({ "degree": 1, "knots": [0, 0, 1, 1], "gap": gap,
            "ctrl": [[from[0], from[1], 1], [to[0], to[1], 1]] })
    };
    let mut model = plane(height);
    model["surfaces"][0]["part"] = json!("half");
    model["surfaces"][0]["trim"] =
        json!([[side([0, 0], [1, 0]), side([1, 0], [0, 1]), side([0, 1], [0, 0])]]);
    model
}

#[test]
fn a_trimmed_face_is_measured_as_it_is() {
    let a = file("trimmed-a.json", &triangle(0.0, 0.0).to_string());
    let b = file("trimmed-b.json", &plane(3.0).to_string());
    let interval = |a: &str, b: &str| {
        let result = printed(&run(&["distance", a, b, "--json"]));
        assert_eq!(result["gap"], 0.0);
        assert_eq!(result["skipped"], json!({"a": [], "b": []}));
        [&result["lower"], &result["upper"]].map(|end| end.as_f64().unwrap())
    };
    let [lower, upper] = interval(&a, &b);
    assert!(lower <= 3.0 && 3.0 <= upper && upper - lower < 1e-5, "{lower} {upper}");
    // The corner of the square that is not in the triangle is √2 from its longest side.
    let [lower, upper] = interval(&b, &a);
    let expected = 11.0_f64.sqrt();
    assert!(lower <= expected && expected <= upper && upper - lower < 1e-5, "{lower} {upper}");
    let info = printed(&run(&["info", &a, "--json"]));
    assert_eq!((&info["trimmed"], &info["faces"][0]["trim"]), (&json!(1), &json!([3])));
}

#[test]
fn the_gaps_that_files_state_stand_beside_the_interval() {
    let a = file("gap-a.json", &triangle(0.0, 0.25).to_string());
    let b = file("gap-b.json", &triangle(3.0, 0.5).to_string());
    let result = printed(&run(&["distance", &a, &b, "--json"]));
    assert_eq!(result["gap"], 0.75);
    assert!(result["upper"].as_f64().unwrap() < 3.1);
    let text = run(&["distance", &a, &b]);
    assert!(String::from_utf8_lossy(&text.stdout).contains("gap        0.75"));
}

#[test]
fn a_converted_trimmed_model_is_the_model() {
    let a = file("convert-a.json", &triangle(0.0, 0.0).to_string());
    let out = file("convert-out.json", "");
    let refused = run(&["convert", &a, &out]);
    assert!(String::from_utf8_lossy(&refused.stderr).starts_with("error[OUTPUT_EXISTS]"));
    let report = printed(&run(&["convert", &a, &out, "--overwrite", "--json"]));
    assert_eq!((&report["faces"], &report["trims"], &report["skipped"]), (&json!(1), &json!(3), &json!([])));
    let result = printed(&run(&["distance", &a, &out, "--symmetric", "--json"]));
    assert!(result["upper"].as_f64().unwrap() < 1e-8, "{result}");
    assert_eq!(result["witness"]["b"]["faceName"], "half");
}

/// JSON in a file that is named as another format would be read as that.
#[test]
fn a_conversion_to_another_format_is_refused() {
    let a = file("refused-a.json", &triangle(0.0, 0.0).to_string());
    for name in ["refused.stl", "refused.STEP", "refused"] {
        let out = std::path::Path::new(&a).with_file_name(name);
        let refused = run(&["convert", &a, out.to_str().unwrap(), "--overwrite"]);
        let error = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert!(error.starts_with("error[OPTION_OUT_OF_RANGE]") && error.contains(".json"), "{error}");
        assert_eq!((status(&refused), out.exists()), (2, false));
    }
}

#[test]
fn loops_that_are_invalid_are_named() {
    let mut open = triangle(0.0, 0.0);
    open["surfaces"][0]["trim"][0][1]["ctrl"][1] = json!([0, 0.5, 1]);
    let mut clockwise = triangle(0.0, 0.0);
    for curve in clockwise["surfaces"][0]["trim"][0].as_array_mut().unwrap() {
        curve["ctrl"].as_array_mut().unwrap().reverse();
    }
    clockwise["surfaces"][0]["trim"][0].as_array_mut().unwrap().reverse();
    for (model, code, words) in [
        (open, "TRIM_LOOP_OPEN", "surface 0, loop 0, curve 2"),
        (clockwise, "TRIM_WRONG_NESTING", "surface 0, loop 0"),
    ] {
        let path = file(&format!("{code}.json"), &model.to_string());
        let output = run(&["info", &path]);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(status(&output), 2);
        assert!(errors.contains(&format!("error[{code}]")) && errors.contains(words), "{errors}");
    }
}

#[test]
fn models_of_different_units_are_scaled_only_on_request() {
    let mut metres = plane(0.0);
    for row in metres["surfaces"][0]["ctrl"].as_array_mut().unwrap() {
        for point in row.as_array_mut().unwrap() {
            for axis in 0..3 {
                point[axis] = json!(point[axis].as_f64().unwrap() / 1000.0);
            }
        }
    }
    metres["unit"] = json!(1);
    let mut millimetres = plane(0.0);
    millimetres["unit"] = json!(0.001);
    let a = file("millimetres.json", &millimetres.to_string());
    let b = file("metres.json", &metres.to_string());
    let refused = run(&["distance", &a, &b]);
    assert_eq!(status(&refused), 2);
    assert!(String::from_utf8_lossy(&refused.stderr).contains("error[UNITS_DIFFER]"));
    for (a, b, unit) in [(&a, &b, 0.001), (&b, &a, 1.0)] {
        let result = printed(&run(&["distance", a, b, "--scale-units", "--symmetric", "--json"]));
        assert_eq!(result["unit"], unit);
        assert!(result["upper"].as_f64().unwrap() < 1e-9, "{result}");
    }
    assert_eq!(status(&run(&["diff", &a, &b])), 2);
    assert_eq!(status(&run(&["diff", &a, &b, "--scale-units"])), 0);
}

/// A unit square at the height 2 beside a square whose loop is open: the first one is measured,
/// the second one named in the result and on standard error.
#[test]
fn faces_left_out_are_named_and_the_others_measured() {
    let mut text = BrepText::new();
    let surface = text.surface("1 0 0 2 0 0 1 1 0 0 0 1 0");
    let good = text.region(surface, &[rectangle([-1.0, -1.0], [1.0, 1.0])]);
    let open = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])[..3].to_vec();
    let bad = text.region(surface, &[open]);
    let shell = text.shape("Sh\n", &[plus(bad), plus(good)]);
    let a = file("left-out-a.brep", &text.text(plus(shell)));
    let b = file("left-out-b.json", &plane(0.0).to_string());
    let output = run(&["distance", &a, &b, "--json"]);
    let result = printed(&output);
    let [lower, upper] = [&result["lower"], &result["upper"]].map(|end| end.as_f64().unwrap());
    assert!(lower <= 2.0 && 2.0 <= upper && upper - lower < 1e-5, "{lower} {upper}");
    let left_out = &result["skipped"]["a"];
    assert_eq!((left_out.as_array().unwrap().len(), &left_out[0]["face"]), (1, &json!(0)));
    assert_eq!(result["skipped"]["b"], json!([]));
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(errors.contains("face 0") && errors.contains("open by"), "{errors}");
    // No verdict holds for a file with a face left out, unless that is allowed.
    for (arguments, statuses) in
        [(["distance", "3"], [3, 0]), (["distance", "1"], [3, 1]), (["diff", "1"], [3, 1])]
    {
        let [command, limit] = arguments;
        let judged = run(&[command, &a, &b, "--limit", limit]);
        assert!(String::from_utf8_lossy(&judged.stderr).contains("undecided: 1 faces were left out"));
        let allowed = run(&[command, &a, &b, "--limit", limit, "--allow-skipped"]);
        assert_eq!([status(&judged), status(&allowed)], statuses, "{command} {limit}");
        let json = run(&[command, &a, &b, "--limit", limit, "--json"]).stdout;
        let printed: Value = serde_json::from_slice(&json).unwrap();
        let verdict = if command == "diff" { &printed["state"] } else { &printed["within"] };
        assert_eq!(verdict, &if command == "diff" { json!("undecided") } else { json!(null) });
    }
}
