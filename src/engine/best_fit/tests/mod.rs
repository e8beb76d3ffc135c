//! Fits from poses over all rotations, of parts whose pose is known.

mod near_symmetries;
mod one_side;
mod selection;
mod zone;

use super::*;
use crate::alignment::Robust;
use crate::facets::{Facets, PointCloud};
use crate::iteration::SamplingRule;
use crate::shapes::shape;
use glam::{DQuat, DVec3};

fn cloud(points: Vec<DVec3>) -> PreparedModel {
    PreparedModel::of_facets(&Facets::Cloud(PointCloud::new(points).unwrap()), None).unwrap()
}

/// A rotation by an angle in degrees, about one of a few axes, and a shift.
fn pose(degrees: f64, index: usize) -> RigidTransform {
    let axis = [DVec3::new(1.0, 2.0, 2.0), DVec3::new(-2.0, 1.0, 2.0), DVec3::new(2.0, -3.0, 6.0)][index % 3];
    let rotation = DQuat::from_axis_angle(axis.normalize(), degrees.to_radians());
    RigidTransform::new(rotation, DVec3::new(3.0, -8.0, 5.0)).unwrap()
}

fn prepared(name: &str) -> PreparedModel {
    PreparedModel::new(&shape(name).unwrap()).unwrap()
}

fn fit(a: &PreparedModel, b: &PreparedModel, options: &BestFitOptions) -> BestFit {
    Engine::cpu().best_fit(a, b, options).wait().unwrap()
}

/// Points of a model's samples, moved, as a cloud; the points on one side of a plane that has this share.
fn scan(model: &PreparedModel, share: f64, motion: &RigidTransform, outliers: usize) -> PreparedModel {
    let mut points = model.fit_samples(24, SamplingRule::Uniform).thinned(1500).points;
    points.sort_by(|one, other| one.x.total_cmp(&other.x));
    points.truncate((share * points.len() as f64) as usize);
    let random = &mut fastrand::Rng::with_seed(9);
    let size = model.bounding_box().diagonal();
    let mut far = || size * DVec3::from_array([0; 3].map(|_| random.f64() - 0.5));
    points.extend((0..outliers).map(|_| far()));
    let points = points.into_iter().map(|point| motion.apply(point)).collect();
    PreparedModel::of_facets(&Facets::Cloud(PointCloud::new(points).unwrap()), None).unwrap()
}

/// The mean movement of the samples from where the motion should take them, as a part of the diagonal.
fn off(model: &PreparedModel, found: &RigidTransform, truth: &RigidTransform) -> f64 {
    let samples = model.fit_samples(8, SamplingRule::Uniform).points;
    let squares = samples.iter().map(|&point| found.apply(point).distance_squared(truth.apply(point)));
    (squares.sum::<f64>() / samples.len() as f64).sqrt() / model.bounding_box().diagonal()
}

/// The pose, or one of those listed beside it, is the true one.
fn assert_found(part: &PreparedModel, found: &BestFit, truth: &RigidTransform, within: f64) {
    let others = found.ambiguous.iter().map(|pose| &pose.transform);
    let least = std::iter::once(&found.transform).chain(others).map(|motion| off(part, motion, truth));
    let least = least.fold(f64::INFINITY, f64::min);
    assert!(least <= within, "{least} off, rms {} of {}", found.rms, found.rms_random);
    // Residuals of listed poses are of fewer samples.
    let listed = found.ambiguous.iter().map(|pose| pose.rms).fold(f64::INFINITY, f64::min);
    assert!(found.rms <= 1.2 * listed + within, "{} is worse than a listed {listed}", found.rms);
}

/// A wing has no symmetry but its own: 0° to 180°, where a local fit ends elsewhere.
#[test]
fn a_part_returns_from_any_rotation() {
    let part = prepared("naca-wing");
    for (index, degrees) in [10.0, 60.0, 90.0, 135.0, 180.0].into_iter().enumerate() {
        let transform = pose(degrees, index);
        let found = fit(&part, &part, &BestFitOptions { transform, ..BestFitOptions::default() });
        assert!(found.converged && found.rms < 1e-6, "{degrees}: {found:?}");
        assert_found(&part, &found, &RigidTransform::IDENTITY, 1e-5);
    }
}

/// From 135° and 180° alone the fit is a local one: it does not say that it converged unless it is right.
#[test]
fn a_local_fit_says_that_it_is_none() {
    let part = prepared("wavy-sheet");
    let mut wrong = 0;
    for index in 0..6 {
        let transform = pose([90.0, 135.0][index / 3], index);
        let options = BestFitOptions { transform, start: FitStart::Given, ..BestFitOptions::default() };
        let found = fit(&part, &part, &options);
        assert_eq!(found.tried, 1);
        if found.rms > 1e-3 * part.bounding_box().diagonal() {
            wrong += 1;
            assert!(!found.converged, "{} of {}", found.rms, found.rms_random);
        }
    }
    assert!(wrong > 0, "nothing to tell");
}

#[test]
fn a_model_on_itself_stays() {
    let part = prepared("naca-wing");
    let found = fit(&part, &part, &BestFitOptions::default());
    assert_eq!((found.transform, found.steps), (RigidTransform::IDENTITY, 0));
    assert!(found.converged && found.rms < 1e-9);
}

/// A ball turns freely about three axes, a bottle about one.
#[test]
fn symmetric_parts_are_free_or_ambiguous() {
    for (name, freedoms) in [("sphere", 3), ("bottle", 1)] {
        let part = prepared(name);
        let found =
            fit(&part, &part, &BestFitOptions { transform: pose(100.0, 1), ..BestFitOptions::default() });
        assert!(found.converged && found.rms < 1e-6, "{name}: {found:?}");
        assert_eq!(found.freedoms, freedoms, "{name}");
    }
}

/// A ball lies about a smaller one hardly better than by chance, and no pose is better: in its middle the residual is the
/// difference of both radii.
#[test]
fn a_ball_about_a_smaller_one_has_no_other_fit() {
    let ball = prepared("sphere");
    let (center, radius) = (ball.bounding_box().center(), ball.bounding_box().diagonal() / 12.0_f64.sqrt());
    let points = ball.fit_samples(24, SamplingRule::Uniform).thinned(1500).points;
    let larger = cloud(points.into_iter().map(|point| center + 3.0 * (point - center)).collect());
    let found = fit(&larger, &ball, &BestFitOptions::default());
    assert!((found.rms - 2.0 * radius).abs() < 1e-3 * radius, "{} of {radius}", found.rms);
    assert!(found.converged && found.rms > 0.5 * found.rms_random, "{} of {}", found.rms, found.rms_random);
}

/// A third of the points lie anywhere: left out they change nothing, and least squares of all say that they
/// are no fit.
#[test]
fn outliers_are_left_out_and_are_no_fit_otherwise() {
    let part = prepared("naca-wing");
    let motion = pose(140.0, 2);
    let cloud = scan(&part, 1.0, &motion, 600);
    for robust in [None, Some(Robust::Tukey), Some(Robust::GemanMcclure)] {
        let found =
            fit(&cloud, &part, &BestFitOptions { outliers: 0.3, robust, ..BestFitOptions::default() });
        assert!(found.converged, "{robust:?}: {} of {}", found.rms, found.rms_random);
        assert_found(&cloud, &found, &motion.inverse(), 0.02);
        let left = found.left_out.points.len() / 3;
        assert!((450..=700).contains(&left), "{robust:?}: {left}");
    }
    let all = fit(&cloud, &part, &BestFitOptions::default());
    assert!(!all.converged, "{} of {}", all.rms, all.rms_random);
    assert_eq!((all.left_out.beyond, all.left_out.points.len()), (None, 0));
}

#[test]
fn a_scan_of_a_part_of_the_surface_finds_its_place() {
    let part = prepared("naca-wing");
    for (share, degrees) in [(0.7, 170.0), (0.5, 120.0)] {
        let motion = pose(degrees, 0);
        let cloud = scan(&part, share, &motion, 0);
        let found = fit(&cloud, &part, &BestFitOptions::default());
        assert!(found.converged, "{share}: {} of {}", found.rms, found.rms_random);
        assert_found(&cloud, &found, &motion.inverse(), 0.02);
    }
}

#[test]
fn options_out_of_range_are_refused() {
    let part = prepared("fig5-plane");
    let code = |options: BestFitOptions| {
        Engine::cpu().best_fit(&part, &part, &options).wait().map_err(|error| error.code()).err()
    };
    let default = BestFitOptions::default;
    assert_eq!(code(BestFitOptions { outliers: 0.96, ..default() }), Some("OPTION_OUT_OF_RANGE"));
    assert_eq!(code(BestFitOptions { outliers: f64::NAN, ..default() }), Some("OPTION_OUT_OF_RANGE"));
    assert_eq!(code(BestFitOptions { max_steps: 0, ..default() }), Some("OPTION_OUT_OF_RANGE"));
    assert_eq!(code(BestFitOptions { samples: 1, ..default() }), Some("OPTION_OUT_OF_RANGE"));
    let both = BestFitOptions { tolerance: Some(1.0), relative_tolerance: Some(1.0), ..default() };
    assert_eq!(code(both), Some("OPTION_INVALID"));
    let none = BestFitOptions { outliers: 0.1, robust: Some(Robust::None), ..default() };
    assert_eq!(code(none), Some("OPTION_INVALID"));
}
