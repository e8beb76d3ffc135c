//! Faces placed by instances, and the interchange format that carries them.

use super::sheet;
use crate::support::trims::{circle, face, rectangle, reversed};
use nurbs_hausdorff::Model;
use nurbs_hausdorff::internals::model::trim::FaceArrays;
use nurbs_hausdorff::internals::model::{IDENTITY, InstanceArrays, ModelArrays};

/// A model of two trimmed faces, placed twice.
fn assembly() -> ModelArrays {
    let mut named = face(sheet(), vec![rectangle([0.0, 0.0], [4.0, 4.0]), reversed(circle([2.0, 2.0], 1.0))]);
    named.face_name = Some("plate".to_owned());
    named.trim.as_mut().unwrap()[1][0].gap = 1e-5;
    named.trim.as_mut().unwrap()[1][0].edge = Some(17);
    named.kind = Some("plane".to_owned());
    named.gap = 1e-6;
    named.gap_measured = true;
    let mut transform = IDENTITY;
    transform[3] = 10.0;
    let instance = |surfaces: Vec<usize>, transform| InstanceArrays {
        surfaces,
        transform,
        name: Some("bolt:2".to_owned()),
        solid: None,
    };
    ModelArrays {
        name: Some("assembly".to_owned()),
        unit: Some(0.001),
        faces: vec![named, FaceArrays { trim: None, reversed: true, ..face(sheet(), vec![]) }],
        instances: vec![instance(vec![0, 1], IDENTITY), instance(vec![0], transform)],
    }
}

#[test]
fn instances_place_faces_by_any_affine_map() {
    let model = Model::from_faces(assembly()).unwrap();
    assert_eq!((model.surfaces().len(), model.unit()), (3, Some(0.001)));
    let parts: Vec<_> = model.faces().map(|face| face.name()).collect();
    assert_eq!(parts, [Some("bolt:2 / plate"), Some("bolt:2"), Some("bolt:2 / plate")]);
    assert_eq!(model.surfaces()[2].control_points()[0], [10.0, 0.0, 0.0, 1.0]);
    assert!((model.gap() - 1.1e-5).abs() < 1e-12, "{}", model.gap());

    let mut sheared = assembly();
    // x doubled and sheared by y: the lengthening is that of the matrix [[2, 1], [0, 1]].
    sheared.instances[1].transform = [2.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0];
    let model = Model::from_faces(sheared).unwrap();
    assert_eq!(model.surfaces()[2].control_points()[3], [12.0, 4.0, 0.0, 1.0]);
    let exact = (3.0 + 5.0_f64.sqrt()).sqrt();
    let factor = model.faces().last().unwrap().gap() / 1.1e-5;
    assert!((exact..1.1 * exact).contains(&factor), "{factor}, expected {exact}");
    assert!(model.faces().last().unwrap().is_reversed());

    for (index, value) in [(0, f64::NAN), (0, 0.0), (3, 1e200)] {
        let mut arrays = assembly();
        arrays.instances[1].transform[index] = value;
        let error = Model::from_faces(arrays).unwrap_err();
        assert_eq!(error.code(), "INSTANCE_TRANSFORM", "{error}");
        assert!(error.to_string().contains("instance 1"), "{error}");
    }
    let mut arrays = assembly();
    arrays.instances[0].surfaces[1] = 2;
    assert_eq!(Model::from_faces(arrays).unwrap_err().code(), "INSTANCE_SURFACE");
    let mut arrays = assembly();
    arrays.unit = Some(-1.0);
    assert_eq!(Model::from_faces(arrays).unwrap_err().code(), "UNIT_INVALID");
    let mut arrays = assembly();
    arrays.faces[1].gap = f64::INFINITY;
    assert_eq!(Model::from_faces(arrays).unwrap_err().code(), "GAP_INVALID");
}

#[test]
fn interchange_json_keeps_trims_names_unit_and_gaps() {
    let model = Model::from_faces(ModelArrays { instances: vec![], ..assembly() }).unwrap();
    let text = model.to_json().unwrap();
    assert_eq!(Model::from_json(&text).unwrap(), model);
    let placed = Model::from_faces(assembly()).unwrap();
    let text = placed.to_json().unwrap();
    assert_eq!(Model::from_json(&text).unwrap().to_json().unwrap(), text);
    // As in the description of the format, with keys that are ignored.
    let text = r#"{"unit": 0.001, "source": {"file": "part.stp", "uncertainty": 0.01},
        "surfaces": [{"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1],
            "ctrl": [[[0, 0, 0, 1], [0, 1, 0, 1]], [[1, 0, 0, 1], [1, 1, 0, 1]]],
            "trim": [[
                {"degree": 1, "knots": [0, 0, 1, 1], "ctrl": [[0, 0, 1], [1, 0, 1]], "gap": 0.0, "edge": 17},
                {"degree": 1, "knots": [0, 0, 1, 1], "ctrl": [[1, 0, 1], [0, 1, 1]]},
                {"degree": 1, "knots": [0, 0, 1, 1], "ctrl": [[0, 1, 1], [0, 0, 1]], "degenerate": false}]],
            "reversed": false, "part": "face 12", "kind": "plane", "gap": 3e-7}],
        "instances": [{"surfaces": [0, 0], "transform": [1,0,0,0, 0,1,0,0, 0,0,1,5], "name": "bolt:2"}]}"#;
    let model = Model::from_json(text).unwrap();
    assert_eq!(model.surfaces()[1].control_points()[0], [0.0, 0.0, 5.0, 1.0]);
    assert_eq!(model.faces().next().unwrap().kind(), Some("plane"));
    assert_eq!(model.faces().next().unwrap().trim().unwrap().winding().number([0.3, 0.3]), Some(1));
    let error = Model::from_json(&text.replace("[1, 0, 1], [0, 1, 1]", "[1, 0, 1], [0, 1, 0]")).unwrap_err();
    assert_eq!(error.code(), "TRIM_WEIGHT_NOT_POSITIVE");
    let error = Model::from_json(&text.replace("\"degree\": 1, ", "")).unwrap_err();
    assert!(error.to_string().contains("surfaces[0].trim[0][0]"), "{error}");
}
