//! Signs of deviations from sheets, whose faces do not close.

use super::solids::face;
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{Engine, PreparedModel};
use nurbs_hausdorff::trim::FaceArrays;
use nurbs_hausdorff::{ClosestPointOptions, Model, ModelArrays, Signs, SurfaceArrays};

/// Returns the signed distances of points from a sheet of these faces.
fn signed(faces: &[SurfaceArrays], points: &[[f64; 3]]) -> Vec<f64> {
    let model = PreparedModel::new(&Model::from_arrays(None, faces.to_vec()).unwrap()).unwrap();
    let options = ClosestPointOptions::default();
    let found = Engine::cpu().closest_points(&model, &points.concat(), &options).wait().unwrap();
    assert_eq!(found.signs, Signs::Faces);
    found.signed
}

/// A rectangle from a corner along two directions, with their product as its normal.
fn rectangle(corner: [f64; 3], along: [f64; 3], across: [f64; 3]) -> SurfaceArrays {
    let [corner, along, across] = [corner, along, across].map(DVec3::from_array);
    face([corner, corner + across, corner + along + across, corner + along])
}

fn assert_signed(faces: &[SurfaceArrays], expected: &[([f64; 3], f64)]) {
    let points: Vec<[f64; 3]> = expected.iter().map(|(point, _)| *point).collect();
    for (found, (point, expected)) in signed(faces, &points).into_iter().zip(expected) {
        let agree = (found - expected).abs() < 1e-9 || (found.is_nan() && expected.is_nan());
        assert!(agree, "{point:?}: {found} for {expected}");
    }
}

/// A square in z = 0 whose normal is z.
fn square() -> SurfaceArrays {
    rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
}

#[test]
fn beside_the_rim_the_sign_is_that_of_the_face() {
    let side = 0.34_f64.sqrt();
    let corner = 3.0_f64.sqrt();
    let expected = [
        ([0.5, 0.5, 0.3], 0.3),
        ([0.5, 0.5, -0.2], -0.2),
        ([1.5, 0.5, 0.3], side),
        ([1.5, 0.5, -0.3], -side),
        ([2.0, 2.0, 1.0], corner),
        ([2.0, 2.0, -1.0], -corner),
        ([2.0, 2.0, 0.0], f64::NAN),
    ];
    assert_signed(&[square()], &expected);
}

/// A fold of 30°: the normal of the upper face alone says that the point beside the edge is behind.
#[test]
fn beside_an_edge_the_sign_is_that_of_both_faces() {
    let (sine, cosine) = 30.0_f64.to_radians().sin_cos();
    let lower = rectangle([0.0; 3], [0.0, 1.0, 0.0], [cosine, 0.0, -sine]);
    let outside = ([-0.1, 0.5, -0.15], 0.0325_f64.sqrt());
    let inside = ([0.5, 0.5, -0.1], -0.1);
    assert_signed(&[square(), lower.clone()], &[outside, inside]);
    // The upper face in two halves, which meet beside the point, weighs no more than before.
    let halves = [0.0, 0.5].map(|y| rectangle([0.0, y, 0.0], [1.0, 0.0, 0.0], [0.0, 0.5, 0.0]));
    let [near, far] = halves;
    assert_signed(&[near, far, lower], &[outside, inside]);
}

/// Two halves of a square that are oriented against each other: their normals cancel on the line
/// between them, whose end is the foot.
#[test]
fn where_normals_cancel_there_is_no_sign() {
    let left = rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let right = rectangle([0.0; 3], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]);
    let flipped = rectangle([0.0; 3], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let point = [0.0, -1.0, 0.5];
    assert_signed(&[left.clone(), right], &[(point, 1.25_f64.sqrt())]);
    assert_signed(&[left, flipped], &[(point, f64::NAN)]);
}

/// The normal of a reversed face is opposite to that of its surface, in the face and beside its rim. Two surfaces with
/// opposite normals meet, and one of the faces is reversed, so that the normals of the faces agree.
#[test]
fn signs_are_those_of_reversed_faces() {
    let signed = |faces: Vec<FaceArrays>, points: &[[f64; 3]]| {
        let model = Model::from_faces(ModelArrays { faces, ..ModelArrays::default() }).unwrap();
        let prepared = PreparedModel::new(&model).unwrap();
        let options = ClosestPointOptions::default();
        Engine::cpu().closest_points(&prepared, &points.concat(), &options).wait().unwrap().signed
    };
    let reversed = |surface| FaceArrays { reversed: true, ..FaceArrays::new(surface, None) };
    let side = 0.34_f64.sqrt();
    let found = signed(vec![reversed(square())], &[[0.5, 0.5, 0.3], [0.5, 0.5, -0.2], [1.5, 0.5, 0.3]]);
    let expected = [-0.3, 0.2, -side];
    assert!(found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9), "{found:?}");
    let left = rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let flipped = rectangle([0.0; 3], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let found = signed(vec![FaceArrays::new(left, None), reversed(flipped)], &[[0.0, -1.0, 0.5]]);
    assert!((found[0] - 1.25_f64.sqrt()).abs() < 1e-9, "{found:?}");
}
