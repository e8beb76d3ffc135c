//! Zones of parts whose least zone is known, and of others against many motions.

use super::super::*;
use super::cloud;
use crate::engine::ClosestPointOptions;
use crate::iteration::SamplingRule;
use crate::shapes::shape;
use crate::{Model, SurfaceArrays};
use glam::{DQuat, DVec3};

/// The square of side 20 in the plane z = 0.
fn plate() -> PreparedModel {
    let corners = [(-10.0, -10.0), (-10.0, 10.0), (10.0, -10.0), (10.0, 10.0)];
    let square = SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: corners.map(|(x, y)| [x, y, 0.0, 1.0]).to_vec(),
    };
    PreparedModel::new(&Model::from_arrays(None, vec![square]).unwrap()).unwrap()
}

fn grid(height: impl Fn(f64, f64) -> f64) -> Vec<DVec3> {
    let places = || (-5..=5).map(f64::from);
    places()
        .flat_map(|x| places().map(move |y| (x, y)))
        .map(|(x, y)| DVec3::new(x, y, height(x, y)))
        .collect()
}

/// A pose near to the given one.
fn off() -> RigidTransform {
    let rotation = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.01);
    RigidTransform::new(rotation, DVec3::new(0.02, -0.01, 0.1)).unwrap()
}

fn options(zone: ZoneOptions) -> BestFitOptions {
    let norm = FitNorm::Largest;
    BestFitOptions { start: FitStart::Given, norm, transform: off(), zone, ..BestFitOptions::default() }
}

fn fit(a: &PreparedModel, b: &PreparedModel, options: &BestFitOptions) -> BestFit {
    Engine::cpu().best_fit(a, b, options).wait().unwrap()
}

/// The zone is found, contains the true one and is proven.
fn assert_zone(found: &BestFit, least: f64) {
    let zone = found.zone.unwrap();
    assert!(zone.lower <= least && least <= zone.upper, "{zone:?} of {least}");
    // The distance of the pose found is half a hundredth wide.
    assert!(zone.upper <= 1.006 * least, "{zone:?} of {least}");
    assert_eq!(found.zone_proven, Some(true), "{zone:?} of {least}");
    assert!(zone.lower >= 0.985 * least, "{zone:?}");
}

/// The corners of a saddle are ± 0.1 off every plane that is nearest to them.
#[test]
fn the_zone_of_a_saddle_on_a_plane_is_its_height() {
    let a = cloud(grid(|x, y| 0.1 * x * y / 25.0));
    assert_zone(&fit(&a, &plate(), &options(ZoneOptions::default())), 0.1);
}

/// A bump in the middle: least squares leave it as high as it is, and the least zone is half of it.
#[test]
fn the_zone_of_a_bump_is_half_its_height() {
    let a = cloud(grid(|x, y| if x == 0.0 && y == 0.0 { 0.2 } else { 0.0 }));
    let b = plate();
    assert_zone(&fit(&a, &b, &options(ZoneOptions::default())), 0.1);
    let mean = fit(&a, &b, &BestFitOptions { norm: FitNorm::Mean, ..options(ZoneOptions::default()) });
    assert!(mean.largest > 0.19 && mean.zone.is_none(), "{mean:?}");
}

/// Shifts along the plane and turns about its normal change no distance, and the fit near a pose takes none.
#[test]
fn motions_that_change_no_distance_are_not_taken() {
    let b = plate();
    for a in [grid(|x, y| 0.1 * x * y / 25.0), grid(|x, y| if x == 0.0 && y == 0.0 { 0.2 } else { 0.0 })] {
        let near = BestFitOptions { transform: RigidTransform::IDENTITY, ..options(ZoneOptions::default()) };
        let found = fit(&cloud(a), &b, &near);
        for point in [DVec3::ZERO, 5.0 * DVec3::X, 5.0 * DVec3::Y] {
            let moved = found.transform.apply(point) - point;
            assert!(moved.truncate().length() < 1e-2, "{moved} of {point}");
        }
    }
}

/// Points on the axes are 0.05 outside, those on the diagonals 0.05 inside: no shift helps.
#[test]
fn the_zone_of_a_ball_is_its_form_error() {
    let b = PreparedModel::new(&shape("sphere").unwrap()).unwrap();
    let radius = 0.5 * b.facts().extents[0].middle();
    let facts = b.facts();
    let center = DVec3::from_array([0, 1, 2].map(|k| 0.5 * (facts.min[k].middle() + facts.max[k].middle())));
    let error = 0.05 * radius;
    let mut points: Vec<DVec3> =
        DVec3::AXES.iter().flat_map(|&axis| [axis, -axis]).map(|axis| (radius + error) * axis).collect();
    for k in 0..8 {
        let sign = |bit: i32| if k & bit == 0 { 1.0 } else { -1.0 };
        points.push((radius - error) * DVec3::new(sign(1), sign(2), sign(4)).normalize());
    }
    let a = cloud(points.into_iter().map(|point| center + point).collect());
    let zone = ZoneOptions { translation: Some(0.02 * radius), degrees: 1.0, ..ZoneOptions::default() };
    assert_zone(&fit(&a, &b, &options(zone)), error);
}

/// A scan with noise: the largest distance of its points at 200 motions of the box.
#[test]
fn no_motion_of_the_box_is_below_the_interval() {
    let b = PreparedModel::new(&shape("naca-wing").unwrap()).unwrap();
    let diagonal = b.bounding_box().diagonal();
    let random = &mut fastrand::Rng::with_seed(31);
    let mut even = || DVec3::from_array([0; 3].map(|_| 2.0 * random.f64() - 1.0));
    let samples = b.fit_samples(24, SamplingRule::Uniform).thinned(1500).points;
    let points: Vec<DVec3> = samples.into_iter().map(|point| point + 0.004 * diagonal * even()).collect();
    let a = cloud(points.clone());
    let zone_options =
        ZoneOptions { translation: Some(0.004 * diagonal), degrees: 0.5, ..ZoneOptions::default() };
    let found = fit(&a, &b, &options(zone_options));
    let zone = found.zone.unwrap();
    assert!(zone.lower > 0.0, "{zone:?}");
    let flat: Vec<f64> = points.iter().flat_map(|point| point.to_array()).collect();
    let largest = |transform: RigidTransform| {
        let options = ClosestPointOptions { transform, ..ClosestPointOptions::default() };
        let distances = Engine::cpu().closest_points(&b, &flat, &options).wait().unwrap().distances;
        distances.into_iter().fold(0.0, f64::max)
    };
    assert!(largest(found.transform) <= zone.upper);
    let mean = fit(&a, &b, &BestFitOptions { norm: FitNorm::Mean, ..options(ZoneOptions::default()) });
    assert!(zone.upper < largest(mean.transform), "{zone:?}");
    for round in 0..200 {
        // Near the pose found and far from it.
        let size = [1.0, 0.1, 0.01, 0.001][round % 4];
        let vector = size * zone.degrees.to_radians() * even().clamp_length_max(1.0);
        let shift = size * zone.translation * even().clamp_length_max(1.0);
        let motion = found.transform.followed(vector, DVec3::from_array(zone.center), shift);
        assert!(largest(motion) >= zone.lower, "{zone:?} at {vector} {shift}");
    }
}

#[test]
fn a_limit_is_decided_for_all_motions_of_the_box() {
    let a = cloud(grid(|x, y| 0.1 * x * y / 25.0));
    let b = plate();
    let passes = |limit: f64| {
        let zone = ZoneOptions { limit: Some(limit), ..ZoneOptions::default() };
        fit(&a, &b, &options(zone)).zone.unwrap().passes
    };
    assert_eq!(passes(0.101), Some(true));
    assert_eq!(passes(0.09), Some(false));
    // Between the bounds that one box alone gives.
    let zone = ZoneOptions { limit: Some(0.0999), max_boxes: 1, ..ZoneOptions::default() };
    assert_eq!(fit(&a, &b, &options(zone)).zone.unwrap().passes, None);
}

/// A plane as the primary datum leaves no shift along its normal: a saddle 0.05 above it stays there.
#[test]
fn datums_leave_their_freedoms_only() {
    let a = cloud(grid(|x, y| 0.05 + 0.1 * x * y / 25.0));
    let plane = crate::Feature::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    let datums = vec![crate::Datum { a: plane, b: plane }];
    let found = fit(&a, &plate(), &BestFitOptions { datums, ..options(ZoneOptions::default()) });
    assert_eq!(found.taken, [3]);
    assert!((found.transform.rotate(DVec3::Z) - DVec3::Z).length() < 1e-12, "{found:?}");
    let zone = found.zone.unwrap();
    assert!(zone.lower > 0.14 && zone.lower <= 0.15 && zone.upper >= 0.15 && zone.upper < 0.1501, "{zone:?}");
}

#[test]
fn poses_by_hand_stay_where_no_norm_is_asked_for() {
    let part = PreparedModel::new(&shape("naca-wing").unwrap()).unwrap();
    let motion = RigidTransform::new(DQuat::from_rotation_y(2.0), DVec3::new(1.0, 2.0, 3.0)).unwrap();
    let pair = |a: [f64; 3]| {
        let point = DVec3::from_array(a);
        crate::PointPair { a: motion.apply(point).to_array(), b: a, weight: 1.0 }
    };
    let pairs = vec![pair([0.0; 3]), pair([1.0, 0.0, 0.0]), pair([0.0, 2.0, 0.0])];
    let samples = part.fit_samples(24, SamplingRule::Uniform).thinned(1500).points;
    let moved = cloud(samples.iter().map(|&point| motion.apply(point)).collect());
    let by_hand = BestFitOptions { norm: FitNorm::None, ..BestFitOptions::default() };
    let found = fit(&moved, &part, &BestFitOptions { pairs, ..by_hand.clone() });
    assert!(found.converged && found.rms < 1e-9 && found.steps == 0 && found.tried == 1, "{found:?}");
    assert!(found.ambiguous.is_empty());
    for start in [FitStart::Axes, FitStart::Boxes] {
        let transform = if start == FitStart::Boxes { motion.inverse() } else { RigidTransform::IDENTITY };
        let found = fit(&moved, &part, &BestFitOptions { start, transform, ..by_hand.clone() });
        // Points of equal area stand for the area up to their spacing.
        assert!(found.rms < 0.01 * part.bounding_box().diagonal(), "{start:?}: {found:?}");
    }
}

#[test]
fn zones_without_a_meaning_are_refused() {
    let part = plate();
    let code = |options: BestFitOptions| {
        Engine::cpu().best_fit(&part, &part, &options).wait().map_err(|error| error.code()).err()
    };
    let zone = ZoneOptions::default();
    for zone in [
        ZoneOptions { degrees: 46.0, ..zone },
        ZoneOptions { translation: Some(-1.0), ..zone },
        ZoneOptions { limit: Some(f64::NAN), ..zone },
        ZoneOptions { max_boxes: 0, ..zone },
    ] {
        assert_eq!(code(options(zone)), Some("OPTION_OUT_OF_RANGE"), "{zone:?}");
    }
    assert_eq!(code(BestFitOptions { outliers: 0.1, ..options(zone) }), Some("OPTION_INVALID"));
}
