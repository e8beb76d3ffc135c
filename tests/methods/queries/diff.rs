//! The comparison of faces against distances known from geometry.

use crate::support::cpu;
use crate::support::trims::{circle, face, plane, rectangle, reversed};
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{DiffOptions, DiffResult, DistanceOptions, Engine, FaceState};
use nurbs_hausdorff::shapes::shape;
use nurbs_hausdorff::{Model, ModelArrays, PreparedModel, Query, RigidTransform, SurfaceArrays};

/// Rounding of the truths below, of size 0 to 10.
const ROUNDING: f64 = 1e-12;

fn diff(a: &Model, b: &Model, options: &DiffOptions) -> DiffResult {
    let engine = Engine::cpu();
    let (a, b) = (PreparedModel::new(a).unwrap(), PreparedModel::new(b).unwrap());
    engine.diff(&a, &b, options).wait().unwrap()
}

/// The square [0, 1]² of the plane at this height, moved along x.
fn square(x: f64, height: f64) -> SurfaceArrays {
    let knots = || vec![0.0, 0.0, 1.0, 1.0];
    SurfaceArrays {
        degree: [1, 1],
        knots: [knots(), knots()],
        counts: [2, 2],
        control_points: [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]
            .map(|[u, v]| [x + u, v, height, 1.0])
            .to_vec(),
    }
}

/// Squares far from each other, at these heights.
fn squares(heights: &[f64]) -> Model {
    let squares = heights.iter().enumerate().map(|(index, &height)| square(10.0 * index as f64, height));
    Model::from_arrays(None, squares.collect()).unwrap()
}

fn states(faces: &[nurbs_hausdorff::FaceDifference]) -> Vec<FaceState> {
    faces.iter().map(|face| face.state).collect()
}

#[test]
fn a_raised_square_is_the_one_face_that_changed() {
    use FaceState::{Changed, Unchanged};
    let (a, b) = (squares(&[0.0, 0.0, 0.0, 0.0]), squares(&[0.0, 5e-4, 0.25, 0.0]));
    let result = diff(&a, &b, &DiffOptions::default());
    assert_eq!(result.state, Changed);
    for faces in [&result.faces_of_a, &result.faces_of_b] {
        assert_eq!(states(faces), [Unchanged, Unchanged, Changed, Unchanged]);
        assert_eq!(faces.iter().map(|face| face.face).collect::<Vec<_>>(), [0, 1, 2, 3]);
        for (face, truth) in faces.iter().zip([0.0, 5e-4, 0.25, 0.0]) {
            assert!(face.lower <= truth + ROUNDING && truth - ROUNDING <= face.upper, "{face:?}");
        }
        let changed = &faces[2];
        assert!(changed.upper - changed.lower <= 1e-3 * changed.lower);
        assert_eq!((changed.witness.a.face, changed.witness.b.face), (2, 2));
        assert!((changed.witness.b.point[2] - changed.witness.a.point[2] - 0.25).abs() < ROUNDING);
    }
    let [of_a, of_b] = result.faces_in(Changed);
    assert_eq!((of_a.len(), of_b.len()), (1, 1));
}

#[test]
fn a_model_without_the_last_face_lacks_it_and_nothing_else() {
    use FaceState::{Changed, Unchanged};
    let result = diff(&squares(&[0.0; 3]), &squares(&[0.0; 2]), &DiffOptions::default());
    assert_eq!(states(&result.faces_of_a), [Unchanged, Unchanged, Changed]);
    assert_eq!(states(&result.faces_of_b), [Unchanged, Unchanged]);
    // Its farther edge is at x = 21, the other squares end at x = 11.
    assert!(result.faces_of_a[2].lower <= 10.0 + ROUNDING && 10.0 - ROUNDING <= result.faces_of_a[2].upper);
}

#[test]
fn the_transform_moves_a_and_its_witnesses() {
    let rotation = DQuat::from_rotation_z(1.0);
    let translation = DVec3::new(1.0, -2.0, 3.0);
    let forth = RigidTransform::new(rotation, translation).unwrap();
    let back = RigidTransform::new(rotation.inverse(), -(rotation.inverse() * translation)).unwrap();
    let model = squares(&[0.0, 0.0]);
    let moved = nurbs_hausdorff::shapes::operations::transformed(&model, &forth).unwrap();
    let unchanged = diff(&model, &moved, &DiffOptions { transform: forth, ..DiffOptions::default() });
    assert_eq!(unchanged.state, FaceState::Unchanged);
    let wrong = diff(&model, &moved, &DiffOptions { transform: back, ..DiffOptions::default() });
    assert_eq!(wrong.state, FaceState::Changed);
    let face = &wrong.faces_of_b[0];
    let [a, b] = [face.witness.a.point, face.witness.b.point].map(DVec3::from_array);
    assert!(face.lower <= a.distance(b) + ROUNDING && a.distance(b) - ROUNDING <= face.upper);
}

/// A model's distance is the largest of its faces'.
#[test]
fn the_farthest_face_is_as_far_as_the_model() {
    for [one, other] in [["bottle", "torus"], ["sphere", "sphere-larger"], ["wavy-sheet", "wavy-sheet-b"]] {
        let (a, b) = (shape(one).unwrap(), shape(other).unwrap());
        let result = diff(&a, &b, &DiffOptions { limit: 1e-4, ..DiffOptions::default() });
        let whole = cpu::measure(&a, &b, &DistanceOptions::default());
        let largest = |bound: fn(&nurbs_hausdorff::FaceDifference) -> f64| {
            result.faces_of_a.iter().map(bound).fold(0.0_f64, f64::max)
        };
        let (lower, upper) = (largest(|face| face.lower), largest(|face| face.upper));
        assert!(lower <= whole.upper && whole.lower <= upper, "{one}: [{lower}, {upper}]");
    }
}

#[test]
fn a_budget_of_one_cell_leaves_a_face_undecided_and_the_interval_true() {
    let [a, b] = ["wavy-sheet", "wavy-sheet-b"].map(|name| shape(name).unwrap());
    let whole = cpu::measure(&a, &b, &DistanceOptions::default());
    // At the distance itself no search of a few cells can decide.
    let limit = 0.5 * (whole.lower + whole.upper);
    let result = diff(&a, &b, &DiffOptions { limit, max_cells: 1, ..DiffOptions::default() });
    let face = &result.faces_of_a[0];
    assert_eq!(face.state, FaceState::Undecided);
    assert!(face.lower <= whole.upper && whole.lower <= face.upper);
}

#[test]
fn without_time_faces_are_undecided_and_the_interval_true() {
    let [a, b] = ["wavy-sheet", "wavy-sheet-b"].map(|name| shape(name).unwrap());
    let whole = cpu::measure(&a, &b, &DistanceOptions::default());
    let limit = 0.5 * (whole.lower + whole.upper);
    let at_once = DiffOptions { limit, max_seconds: Some(f64::MIN_POSITIVE), ..DiffOptions::default() };
    let result = diff(&a, &b, &at_once);
    let face = &result.faces_of_a[0];
    assert_eq!((result.state, face.state), (FaceState::Undecided, FaceState::Undecided));
    assert!(face.lower <= whole.upper && whole.lower <= face.upper);
    let in_time = diff(&a, &b, &DiffOptions { max_seconds: Some(1e9), ..at_once });
    assert!(in_time.faces_of_a[0].cells > face.cells, "{} {}", in_time.faces_of_a[0].cells, face.cells);
}

/// A plate whose hole moved: the farthest points are on the hole's edge, and no bound but one over
/// tiny cells distinguishes them from those beside it.
#[test]
fn a_face_that_is_decided_ends_after_few_cells() {
    let plate = |x: f64| {
        let sheet = plane([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [[0.0, 60.0], [0.0, 40.0]]);
        let loops = vec![rectangle([0.0, 0.0], [60.0, 40.0]), reversed(circle([x, 12.0], 3.0))];
        let faces = vec![face(sheet, loops)];
        Model::from_faces(ModelArrays { faces, ..ModelArrays::default() }).unwrap()
    };
    let result = diff(&plate(15.0), &plate(15.01), &DiffOptions::default());
    for face in result.faces_of_a.iter().chain(&result.faces_of_b) {
        assert_eq!(face.state, FaceState::Changed);
        assert!(face.lower <= 0.01 + ROUNDING && 0.01 - 1e-6 <= face.upper, "{face:?}");
        assert!(face.cells <= 80_000, "{} cells", face.cells);
    }
}

#[test]
fn options_out_of_range_are_refused() {
    for limit in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = DiffOptions { limit, ..DiffOptions::default() };
        assert_eq!(options.validate().unwrap_err().code(), "OPTION_OUT_OF_RANGE");
    }
    let options = DiffOptions { max_seconds: Some(0.0), ..DiffOptions::default() };
    assert_eq!(options.validate().unwrap_err().code(), "OPTION_OUT_OF_RANGE");
    let options = DiffOptions { max_cells: 0, ..DiffOptions::default() };
    assert_eq!(options.validate().unwrap_err().code(), "OPTION_OUT_OF_RANGE");
}
