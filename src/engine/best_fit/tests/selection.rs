//! Fits on chosen faces and within a distance, of boxes whose other faces are elsewhere.

use super::super::*;
use super::{assert_found, cloud, fit, pose, prepared, scan};
use crate::{Model, SurfaceArrays};
use glam::DVec3;

/// The box from the origin to this corner: its faces are x = 0, x = the corner's, and so on along y and z.
fn block(corner: [f64; 3]) -> PreparedModel {
    let face = |index: usize| {
        let [across, first, second] = [0, 1, 2].map(|step| (index / 2 + step) % 3);
        let control_points = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]].map(|[s, t]| {
            let mut point = [0.0, 0.0, 0.0, 1.0];
            point[across] = corner[across] * (index % 2) as f64;
            (point[first], point[second]) = (corner[first] * s, corner[second] * t);
            point
        });
        SurfaceArrays {
            degree: [1, 1],
            knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
            counts: [2, 2],
            control_points: control_points.to_vec(),
        }
    };
    PreparedModel::new(&Model::from_arrays(None, (0..6).map(face).collect()).unwrap()).unwrap()
}

/// Points of the faces of a box of 3 by 2 by 1, away from edges: 36 of each, the last face being this much higher.
fn scan_of_block(height: f64) -> Vec<DVec3> {
    let corner = [3.0, 2.0, 1.0];
    let steps = || (0..6).map(|k| (f64::from(k) + 1.5) / 8.0);
    let point = |index: usize, [s, t]: [f64; 2]| {
        let [across, first, second] = [0, 1, 2].map(|step| (index / 2 + step) % 3);
        let mut point = [0.0; 3];
        point[across] = corner[across] * (index % 2) as f64;
        (point[first], point[second]) = (corner[first] * s, corner[second] * t);
        DVec3::from_array(point) + if index == 5 { DVec3::Z * height } else { DVec3::ZERO }
    };
    let of = |index: usize| steps().flat_map(move |s| steps().map(move |t| point(index, [s, t])));
    (0..6).flat_map(of).collect()
}

const ALL_BUT_THE_LAST: [usize; 5] = [0, 1, 2, 3, 4];

/// The scan's top is 0.1 too high: on the other faces it lies where the box is, and least squares of all shift it.
#[test]
fn a_fit_on_faces_of_b_does_not_see_the_others() {
    let (part, points) = (block([3.0, 2.0, 1.0]), scan_of_block(0.1));
    let motion = pose(100.0, 1);
    let moved = cloud(points.iter().map(|&point| motion.apply(point)).collect());
    let whole = fit(&moved, &part, &BestFitOptions::default());
    assert!(whole.rms > 0.01, "{whole:?}");
    assert_eq!((whole.samples, whole.counted), (216, 216));
    let faces_of_b = ALL_BUT_THE_LAST.to_vec();
    let found = fit(&moved, &part, &BestFitOptions { faces_of_b, ..BestFitOptions::default() });
    assert!(found.converged && found.rms < 1e-8, "{found:?}");
    assert_eq!((found.samples, found.counted, found.left_out.points.len()), (216, 180, 0));
    // A box coincides with itself in four poses. In one of them the raised face of the scan lies above the top.
    let off = |pose: &RigidTransform| {
        points.iter().map(|&point| pose.apply(motion.apply(point)).distance(point)).fold(0.0, f64::max)
    };
    let others = found.ambiguous.iter().map(|pose| off(&pose.transform));
    assert!(off(&found.transform) < 1e-7 || others.fold(f64::INFINITY, f64::min) < 0.2, "{found:?}");
}

/// A is a box, and B the same box with the top 0.1 higher. In the identity pose all faces of A but the top lie on B.
#[test]
fn a_fit_on_faces_of_a_is_of_their_samples() {
    let [part, higher] = [1.0, 1.1].map(|height| block([3.0, 2.0, height]));
    let start =
        RigidTransform::new(glam::DQuat::from_rotation_x(0.05), DVec3::new(0.02, -0.01, 0.05)).unwrap();
    let options = BestFitOptions { start: FitStart::Given, transform: start, ..BestFitOptions::default() };
    let whole = fit(&part, &higher, &options);
    assert!(whole.rms > 0.01, "{whole:?}");
    let faces_of_a = ALL_BUT_THE_LAST.to_vec();
    let found = fit(&part, &higher, &BestFitOptions { faces_of_a, ..options });
    assert!(found.converged && found.rms < 1e-8, "{found:?}");
    assert_eq!((found.samples, found.counted), (5 * 256, 5 * 256));
    assert!(found.transform.offset().length() < 1e-7, "{found:?}");
}

/// A third of the points lie anywhere, at least a twentieth of the wing away from it by far most.
#[test]
fn a_largest_distance_leaves_out_what_is_beyond() {
    let part = prepared("naca-wing");
    let motion = pose(140.0, 2);
    let moved = scan(&part, 1.0, &motion, 600);
    let most = 1e-4 * part.bounding_box().diagonal();
    let options = BestFitOptions { outliers: 0.3, max_distance: Some(most), ..BestFitOptions::default() };
    let found = fit(&moved, &part, &options);
    assert!(found.converged && found.rms < 1e-9 * part.bounding_box().diagonal(), "{found:?}");
    assert_found(&moved, &found, &motion.inverse(), 1e-6);
    assert_eq!(found.left_out.beyond, Some(most));
    assert_eq!(found.left_out.points.len() / 3 + found.counted, found.samples);
    assert!((1500..1520).contains(&found.counted), "{}", found.counted);
    // Where it does not lie at all the nearest twentieth counts, which is no fit.
    let far = RigidTransform::new(glam::DQuat::IDENTITY, DVec3::splat(100.0)).unwrap();
    let given = BestFitOptions {
        start: FitStart::Given,
        norm: FitNorm::None,
        transform: far,
        max_distance: Some(most),
        ..BestFitOptions::default()
    };
    let none = fit(&moved, &part, &given);
    assert!(!none.converged && none.counted >= 105, "{none:?}");
}

#[test]
fn what_cannot_be_chosen_is_refused() {
    let (part, points) = (block([3.0, 2.0, 1.0]), cloud(scan_of_block(0.0)));
    let code = |a: &PreparedModel, options: BestFitOptions| {
        Engine::cpu().best_fit(a, &part, &options).wait().map_err(|error| error.code()).err()
    };
    let default = BestFitOptions::default;
    let faces = || vec![6];
    let invalid = Some("OPTION_INVALID");
    assert_eq!(code(&part, BestFitOptions { faces_of_a: faces(), ..default() }), invalid);
    assert_eq!(code(&part, BestFitOptions { faces_of_b: faces(), ..default() }), invalid);
    assert_eq!(code(&points, BestFitOptions { faces_of_a: vec![0], ..default() }), invalid);
    let largest = BestFitOptions { norm: FitNorm::Largest, faces_of_b: vec![0], ..default() };
    assert_eq!(code(&part, largest), invalid);
    let none = BestFitOptions { max_distance: Some(1.0), robust: Some(crate::Robust::None), ..default() };
    assert_eq!(code(&part, none), invalid);
    let zone = ZoneOptions { degrees: 2.0, ..ZoneOptions::default() };
    assert_eq!(code(&part, BestFitOptions { zone, ..default() }), invalid);
    for most in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = BestFitOptions { max_distance: Some(most), ..default() };
        assert_eq!(code(&part, options), Some("OPTION_OUT_OF_RANGE"), "{most}");
    }
    // Points of the floor are nearest to it, and not to the face opposite.
    let floor = cloud(scan_of_block(0.0).into_iter().filter(|point| point.z == 0.0).collect());
    let given = BestFitOptions { norm: FitNorm::None, faces_of_b: vec![5], ..default() };
    assert_eq!(code(&floor, given), invalid);
}
