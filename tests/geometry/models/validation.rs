//! Models are parsed once; everything invalid is refused by a stable code and
//! a text that says where, what was found and what was expected.

use crate::support::models;
use nurbs_hausdorff::{Error, Model, NurbsSurface, ParamBox, SurfaceArrays};

/// A valid surface of degree 2 x 1 with 4 x 3 control points.
fn valid() -> SurfaceArrays {
    SurfaceArrays {
        degree: [2, 1],
        knots: [vec![0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0], vec![0.0, 0.0, 0.5, 1.0, 1.0]],
        counts: [4, 3],
        control_points: (0..12).map(|k| [f64::from(k / 3), f64::from(k % 3), 0.0, 1.0]).collect(),
    }
}

/// The interchange JSON of [`valid`] for each of `surfaces`.
fn json(surfaces: &[SurfaceArrays]) -> String {
    let surfaces: Vec<serde_json::Value> = surfaces
        .iter()
        .map(|arrays| {
            let rows: Vec<_> = arrays.control_points.chunks(arrays.counts[1].max(1)).collect();
            serde_json::json!({
                "degree": arrays.degree, "knots_u": arrays.knots[0], "knots_v": arrays.knots[1], "ctrl": rows,
            })
        })
        .collect();
    serde_json::json!({ "surfaces": surfaces }).to_string()
}

/// Checks that surface 3 of a model, changed by `spoil`, is refused with this
/// code and with every one of `said` in the text, as arrays.
fn refused_as_arrays(code: &str, said: &[&str], spoil: impl Fn(&mut SurfaceArrays)) -> Error {
    let mut spoiled = valid();
    spoil(&mut spoiled);
    let error = NurbsSurface::new(3, spoiled.clone()).unwrap_err();
    assert_eq!(error.code(), code, "{error}");
    let text = error.to_string();
    for part in ["surface 3"].iter().chain(said) {
        assert!(text.contains(part), "\"{text}\" does not say \"{part}\"");
    }
    let model = Model::from_arrays(None, vec![valid(), valid(), valid(), spoiled]);
    // Texts, because what was found may be no number, which equals nothing.
    assert_eq!(model.unwrap_err().to_string(), text);
    error
}

/// As [`refused_as_arrays`], and the same from JSON.
fn refused(code: &str, said: &[&str], spoil: impl Fn(&mut SurfaceArrays)) {
    let error = refused_as_arrays(code, said, &spoil);
    let mut spoiled = valid();
    spoil(&mut spoiled);
    let text = json(&[valid(), valid(), valid(), spoiled]);
    assert_eq!(Model::from_json(&text).unwrap_err(), error);
}

#[test]
fn the_example_is_valid() {
    let model = Model::from_json(&json(&[valid(), valid()])).unwrap();
    assert_eq!(model.surfaces().len(), 2);
    assert_eq!(model.surfaces()[1].clone().into_arrays(), valid());
    assert_eq!(model.surfaces()[0].domain(), ParamBox::UNIT);
}

#[test]
fn non_finite_numbers_are_refused() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let found = format!("is {bad}");
        for coordinate in 0..4 {
            refused_as_arrays(
                "NON_FINITE",
                &["control point 7", &found, "expected a finite number"],
                |arrays| {
                    arrays.control_points[7][coordinate] = bad;
                },
            );
        }
        refused_as_arrays("NON_FINITE", &["knot in u 4", &found], |arrays| arrays.knots[0][4] = bad);
        refused_as_arrays("NON_FINITE", &["knot in v 2", &found], |arrays| arrays.knots[1][2] = bad);
    }
}

#[test]
fn numbers_too_large_for_f64_are_refused_in_json() {
    let text = json(&[valid()]).replace("[3.0,2.0,0.0,1.0]", "[3.0,2.0,1e999,1.0]");
    let error = Model::from_json(&text).unwrap_err();
    assert_eq!(error.code(), "JSON_SHAPE");
    assert!(error.to_string().contains("number out of range"));
}

#[test]
fn numbers_whose_squares_may_overflow_are_refused() {
    for (bad, said) in [(1.1e100, "is 1.1e100,"), (-1e155, "is -1e155,"), (f64::MAX, "e308,")] {
        let expected = [said, "expected at most 1e100 in size"];
        for coordinate in 0..4 {
            let found = ["control point 7", expected[0], expected[1]];
            refused("NUMBER_TOO_LARGE", &found, |arrays| arrays.control_points[7][coordinate] = bad);
        }
        refused("NUMBER_TOO_LARGE", &["knot in u 4", expected[0], expected[1]], |arrays| {
            arrays.knots[0][4] = bad;
        });
    }
    let at_the_limit = SurfaceArrays { control_points: vec![[1e100, -1e100, 0.0, 1e100]; 12], ..valid() };
    assert!(Model::from_arrays(None, vec![at_the_limit]).is_ok());
}

#[test]
fn weights_that_are_not_positive_are_refused() {
    for (weight, said) in [(0.0, "is 0.0,"), (-2.5, "is -2.5,"), (-0.0, "is -0.0,"), (1e-101, "is 1e-101,")] {
        refused("WEIGHT_NOT_POSITIVE", &["control point 11", said, "expected at least 1e-100"], |arrays| {
            arrays.control_points[11][3] = weight;
        });
    }
}

#[test]
fn weights_too_far_apart_are_refused() {
    let expected = ["control point 11", "is 9e-31,", "expected at least 1e-30 of", "1.0"];
    refused("WEIGHT_RATIO_TOO_LARGE", &expected, |arrays| arrays.control_points[11][3] = 9e-31);
    let mut at_the_limit = valid();
    at_the_limit.control_points[11][3] = 1.01e-30;
    assert!(Model::from_arrays(None, vec![at_the_limit]).is_ok());
}

#[test]
fn falling_knots_are_refused() {
    refused("KNOTS_DECREASING", &["knot 4 in u is 0.25", "expected at least 0.5"], |arrays| {
        arrays.knots[0][4] = 0.25;
    });
    refused("KNOTS_DECREASING", &["knot 3 in v is 0.2", "expected at least 0.5"], |arrays| {
        arrays.knots[1][3] = 0.2;
    });
}

#[test]
fn knot_vectors_of_the_wrong_length_are_refused() {
    refused("KNOTS_LENGTH", &["6 knots in u", "expected 7"], |arrays| {
        arrays.knots[0].pop();
    });
    refused("KNOTS_LENGTH", &["6 knots in v", "expected 5"], |arrays| arrays.knots[1].push(1.0));
    refused("KNOTS_LENGTH", &["0 knots in v", "expected 5"], |arrays| arrays.knots[1].clear());
}

#[test]
fn knots_repeated_too_often_are_refused() {
    refused("KNOTS_MULTIPLICITY", &["knot 0 in u", "repeated 4 times", "at most 3"], |arrays| {
        arrays.knots[0][3] = 0.0;
    });
    refused("KNOTS_MULTIPLICITY", &["knot 2 in v", "repeated 3 times", "at most 2"], |arrays| {
        arrays.knots[1] = vec![0.0, 0.0, 1.0, 1.0, 1.0];
    });
}

#[test]
fn domains_without_length_are_refused() {
    refused("KNOTS_EMPTY_DOMAIN", &["domain in u is [0.5, 0.5]", "expected a positive length"], |arrays| {
        arrays.knots[0] = vec![0.0, 0.0, 0.5, 0.5, 0.5, 1.0, 1.0];
    });
    refused("KNOTS_EMPTY_DOMAIN", &["domain in v is [2.0, 2.0]"], |arrays| arrays.knots[1] = vec![2.0; 5]);
}

#[test]
fn lists_of_the_wrong_length_are_refused() {
    refused_as_arrays("RAGGED_NET", &["has 11 control points", "expected 12"], |arrays| {
        arrays.control_points.pop();
    });
    refused_as_arrays("RAGGED_NET", &["has 0 control points", "expected 12"], |arrays| {
        arrays.control_points.clear();
    });
}

#[test]
fn ragged_rows_are_refused() {
    let text = json(&[valid(), valid()]);
    let last = text.rfind(",[3.0,2.0,0.0,1.0]").unwrap();
    let ragged = format!("{}{}", &text[..last], &text[last + ",[3.0,2.0,0.0,1.0]".len()..]);
    let error = Model::from_json(&ragged).unwrap_err();
    assert_eq!(error.code(), "RAGGED_NET");
    assert_eq!(error.to_string(), "surface 1: row 3 of the net has 2 control points, expected 3");
}

#[test]
fn too_few_control_points_are_refused() {
    refused("TOO_FEW_CONTROL_POINTS", &["2 control points in u", "at least 3"], |arrays| {
        arrays.counts[0] = 2;
        arrays.control_points.truncate(6);
    });
    refused("TOO_FEW_CONTROL_POINTS", &["1 control points in v", "at least 2"], |arrays| {
        arrays.counts[1] = 1;
        arrays.control_points.truncate(4);
    });
    refused("TOO_FEW_CONTROL_POINTS", &["0 control points in u"], |arrays| {
        arrays.counts = [0, 0];
        arrays.control_points.clear();
    });
}

#[test]
fn degrees_out_of_range_are_refused() {
    for (degree, found) in [(0, "degree 0"), (16, "degree 16"), (usize::MAX, "degree 18446744073709551615")] {
        refused("DEGREE_OUT_OF_RANGE", &[found, "in u", "expected 1 to 15"], |arrays| {
            arrays.degree[0] = degree
        });
        refused("DEGREE_OUT_OF_RANGE", &[found, "in v"], |arrays| arrays.degree[1] = degree);
    }
}

#[test]
fn every_degree_from_1_to_15_is_accepted() {
    for degree in 1..=15 {
        let knots = [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat();
        let count = degree + 1;
        let arrays = SurfaceArrays {
            degree: [degree, 16 - degree],
            knots: [knots, [vec![-3.0; 17 - degree], vec![9.0; 17 - degree]].concat()],
            counts: [count, 17 - degree],
            control_points: vec![[1.0, 2.0, 3.0, 0.5]; count * (17 - degree)],
        };
        assert!(NurbsSurface::new(0, arrays).is_ok(), "degree {degree}");
    }
}

#[test]
fn models_without_surfaces_are_refused() {
    for error in [
        Model::new(None, Vec::new()).unwrap_err(),
        Model::from_arrays(None, Vec::new()).unwrap_err(),
        Model::from_json(r#"{"surfaces": []}"#).unwrap_err(),
    ] {
        assert_eq!(error.code(), "EMPTY_MODEL");
        assert_eq!(error.to_string(), "the model has 0 surfaces, expected at least 1");
    }
}

#[test]
fn json_of_another_shape_is_refused() {
    let good = json(&[valid()]);
    for (text, said) in [
        (String::new(), "EOF"),
        ("[]".to_owned(), "invalid length"),
        ("null".to_owned(), "null"),
        ("{}".to_owned(), "missing field `surfaces`"),
        (good.replace("knots_v", "knots_w"), "missing field `knots_v`"),
        (good.replace("\"degree\":[2,1]", "\"degree\":[2]"), "invalid length 1"),
        (good.replace("\"degree\":[2,1]", "\"degree\":[-2,1]"), "-2"),
        (good.replace("\"degree\":[2,1]", "\"degree\":[2.5,1]"), "2.5"),
        (good.replace("[3.0,2.0,0.0,1.0]", "[3.0,2.0,0.0]"), "invalid length 3"),
        (good.replace("[3.0,2.0,0.0,1.0]", "[3.0,2.0,0.0,\"1\"]"), "invalid type: string"),
        (good.replace("[3.0,2.0,0.0,1.0]", "[3.0,2.0,NaN,1.0]"), "expected value"),
        (good[..good.len() - 1].to_owned(), "EOF"),
        (format!("{good} {good}"), "trailing characters"),
    ] {
        let error = Model::from_json(&text).unwrap_err();
        assert_eq!(error.code(), "JSON_SHAPE", "{text}");
        let message = error.to_string();
        assert!(message.starts_with("the model is not interchange JSON: "), "{message}");
        assert!(message.contains(said) && message.contains("line"), "\"{message}\" does not say \"{said}\"");
    }
}

#[test]
fn deeply_nested_json_is_refused() {
    let error = Model::from_json(&"[".repeat(1_000_000)).unwrap_err();
    assert_eq!(error.code(), "JSON_SHAPE");
}

#[test]
fn names_are_kept_and_other_keys_are_ignored() {
    let text = json(&[valid()]).replacen('{', r#"{"name": "tank \"7\"", "units": "mm", "#, 1);
    let text = text.replacen("\"degree\"", "\"trimmed\": true, \"degree\"", 1);
    let model = Model::from_json(&text).unwrap();
    assert_eq!(model.name(), Some("tank \"7\""));
    assert_eq!(Model::from_json(&model.to_json().unwrap()).unwrap(), model);
}

#[test]
fn the_box_holds_the_control_points() {
    let mut arrays = valid();
    arrays.control_points[5] = [-7.0, 0.5, 2.0, 3.0];
    let box_of_all = Model::from_arrays(None, vec![valid(), arrays]).unwrap().bounding_box();
    assert_eq!(box_of_all.min.to_array(), [-7.0, 0.0, 0.0]);
    assert_eq!(box_of_all.max.to_array(), [3.0, 2.0, 2.0]);
}

#[test]
fn shared_models_parse_and_survive_writing() {
    for (name, model) in models::all("shared_models_parse_and_survive_writing") {
        let written = Model::from_json(&model.to_json().unwrap()).unwrap();
        assert_eq!(written, model, "{name}");
    }
}

#[test]
fn texts_over_the_limit_are_refused() {
    let text = " ".repeat(Model::MAX_JSON_BYTES as usize + 1);
    let error = Model::from_json(&text).unwrap_err();
    assert_eq!(error.code(), "FILE_TOO_LARGE");
    assert_eq!(error.to_string(), "the model is 268435457 bytes, expected at most 268435456");
}
