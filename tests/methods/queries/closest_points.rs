//! Closest points against distances known from geometry.

use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{ClosestPointOptions, ClosestPoints, Engine};
use nurbs_hausdorff::shapes::{sphere, torus};
use nurbs_hausdorff::{Error, Model, PreparedModel, RigidTransform, Signs};

fn closest(model: &Model, points: &[f64], options: &ClosestPointOptions) -> Result<ClosestPoints, Error> {
    let engine = Engine::cpu();
    let model = PreparedModel::new(model).unwrap();
    engine.closest_points(&model, points, options).wait()
}

/// Points in a box about the origin, more than one page of them.
fn points(count: usize) -> Vec<f64> {
    let mut random = fastrand::Rng::with_seed(7);
    (0..3 * count).map(|_| 10.0 * random.f64() - 5.0).collect()
}

#[test]
fn distances_to_a_torus_are_within_their_bounds_of_the_formula() {
    let points = points(20_000);
    let found = closest(&torus(3.0, 0.5).unwrap(), &points, &ClosestPointOptions::default()).unwrap();
    assert_eq!(found.distances.len(), 20_000);
    for (index, point) in points.chunks_exact(3).enumerate() {
        let signed = (point[0].hypot(point[1]) - 3.0).hypot(point[2]) - 0.5;
        let (distance, bound) = (found.distances[index], found.bounds[index]);
        // The formula's own rounding.
        assert!((distance - signed.abs()).abs() <= bound + 1e-14, "{distance}, not {signed}: {bound}");
        assert!(bound <= 1e-9 * 10.0, "{bound}");
        assert!((found.signed[index] - signed).abs() <= bound + 1e-14, "{} {signed}", found.signed[index]);
        let foot = DVec3::from_slice(&found.feet[3 * index..]);
        assert!((foot.distance(DVec3::from_slice(point)) - distance).abs() <= 1e-14);
    }
}

/// Heights above and below the sphere's top, its normal; the distance itself does not depend on it.
#[test]
fn distances_up_to_the_sign_tolerance_have_none() {
    let ball = sphere(DVec3::ZERO, 2.0).unwrap();
    let heights = [1e-3, -1e-3, 2e-3, -2e-3, 0.5, -0.5];
    let points: Vec<f64> = heights.iter().flat_map(|height| [0.0, 0.0, 2.0 + height]).collect();
    let signed = |sign_tolerance: f64| {
        let options = ClosestPointOptions { sign_tolerance, ..ClosestPointOptions::default() };
        let found = closest(&ball, &points, &options).unwrap();
        for (distance, height) in found.distances.iter().zip(heights) {
            assert!((distance - height.abs()).abs() < 1e-8, "{distance} {height}");
        }
        found.signed
    };
    for (tolerance, without) in [(0.0, 0), (1.5e-3, 2), (1.0, 6)] {
        for (index, (found, height)) in signed(tolerance).into_iter().zip(heights).enumerate() {
            let expected = if index < without { 0.0 } else { height };
            assert!((found - expected).abs() < 1e-8, "{found} {expected} with {tolerance}");
        }
    }
}

#[test]
fn feet_lie_where_their_surface_has_them() {
    let model = sphere(DVec3::new(1.0, 2.0, 3.0), 2.0).unwrap();
    let points = points(50);
    let found = closest(&model, &points, &ClosestPointOptions::default()).unwrap();
    for (index, parameters) in found.parameters.chunks_exact(2).enumerate() {
        let surface = &model.surfaces()[found.faces[index] as usize];
        let point =
            DVec3::from_array(crate::support::evaluator::point(surface, parameters[0], parameters[1]));
        assert!(point.distance(DVec3::from_slice(&found.feet[3 * index..])) < 1e-12);
    }
}

#[test]
fn the_transform_moves_the_points() {
    let ball = sphere(DVec3::ZERO, 1.0).unwrap();
    let transform =
        RigidTransform::new(DQuat::from_rotation_x(0.5 * std::f64::consts::PI), DVec3::new(0.0, 0.0, 2.0));
    let options = ClosestPointOptions { transform: transform.unwrap(), ..ClosestPointOptions::default() };
    // (0, 3, 0) turns to (0, 0, 3), and moves to (0, 0, 5).
    let found = closest(&ball, &[0.0, 3.0, 0.0], &options).unwrap();
    assert!((found.distances[0] - 4.0).abs() < 1e-12);
    assert!(DVec3::from_slice(&found.feet).distance(DVec3::Z) < 1e-6);
}

#[test]
fn points_and_options_out_of_range_are_refused() {
    let ball = sphere(DVec3::ZERO, 1.0).unwrap();
    let code = |points: &[f64], options: &ClosestPointOptions| match closest(&ball, points, options) {
        Ok(found) => panic!("{found:?}"),
        Err(error) => error.code(),
    };
    let valid = ClosestPointOptions::default();
    for points in [&[0.0, f64::NAN, 0.0][..], &[f64::INFINITY, 0.0, 0.0], &[2e100, 0.0, 0.0], &[0.0, 0.0]] {
        assert_eq!(code(points, &valid), "POINT_OUT_OF_RANGE");
    }
    let zero = ClosestPointOptions { relative_tolerance: Some(0.0), ..valid.clone() };
    assert_eq!(code(&[0.0; 3], &zero), "OPTION_OUT_OF_RANGE");
    for sign_tolerance in [-1e-9, f64::NAN, f64::INFINITY] {
        let wrong = ClosestPointOptions { sign_tolerance, ..valid.clone() };
        assert_eq!(code(&[0.0; 3], &wrong), "OPTION_OUT_OF_RANGE");
    }
    let both = ClosestPointOptions { tolerance: Some(1.0), relative_tolerance: Some(1.0), ..valid.clone() };
    assert_eq!(code(&[0.0; 3], &both), "OPTION_INVALID");
    let none = closest(&ball, &[], &valid).unwrap();
    assert!(none.distances.is_empty() && none.feet.is_empty() && none.signs == Signs::Solid);
}

/// The same points in another order have the same closest points, bit by bit: they are measured in an order of their own.
#[test]
fn the_order_of_points_does_not_matter() {
    let model = torus(3.0, 0.5).unwrap();
    let given = points(3000);
    let mut order: Vec<usize> = (0..3000).collect();
    fastrand::Rng::with_seed(3).shuffle(&mut order);
    let shuffled: Vec<f64> = order.iter().flat_map(|&index| given[3 * index..][..3].to_vec()).collect();
    let options = ClosestPointOptions::default();
    let [first, second] = [&given, &shuffled].map(|points| closest(&model, points, &options).unwrap());
    for (place, &index) in order.iter().enumerate() {
        let of = |found: &ClosestPoints, index: usize| {
            let feet: [f64; 3] = std::array::from_fn(|axis| found.feet[3 * index + axis]);
            (found.distances[index], found.bounds[index], found.signed[index], feet, found.faces[index])
        };
        assert_eq!(of(&first, index), of(&second, place));
    }
}
