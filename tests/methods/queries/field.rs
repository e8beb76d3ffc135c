//! The field: distances of samples, finished on the whole of the other model.

use crate::support::{cpu, models};
use nurbs_hausdorff::internals::engine::{DistanceOptions, DistanceResult, MethodName};

/// The largest number of Bézier patches of the models measured here, to keep the time short.
const MAX_PATCHES: usize = 3000;

/// Samples along each direction of a surface.
const SAMPLES: usize = 8;

fn measured(a: &nurbs_hausdorff::Model, b: &nurbs_hausdorff::Model, method: MethodName) -> DistanceResult {
    let options = DistanceOptions {
        method: method.into(),
        relative_tolerance: Some(1e-4),
        samples: SAMPLES,
        deviations: true,
        ..DistanceOptions::default()
    };
    cpu::measure(a, b, &options)
}

/// No sample is farther than the certificate allows: on itself, where every distance
/// is 0, an unfinished projection shows.
#[test]
fn no_sample_of_a_model_is_farther_from_the_model_itself_than_the_upper_bound() {
    for (name, model) in models::all("no_sample_of_a_model_is_farther_from_the_model_itself") {
        if nurbs_hausdorff::PreparedModel::new(&model)
            .unwrap()
            .patch_counts()
            .map(|[u, v]| u * v)
            .sum::<usize>()
            > MAX_PATCHES
        {
            continue;
        }
        let result = measured(&model, &model, MethodName::Certified);
        assert!(!result.deviations.is_empty(), "{name}");
        for field in &result.deviations {
            let largest = field.distances.iter().fold(0.0_f64, |largest, &distance| largest.max(distance));
            assert!(largest <= result.upper, "{name}: {largest} above {}", result.upper);
            assert!(largest <= 1e-9 * result.diagonal, "{name}: {largest}");
        }
    }
}

/// On another model the distances are those of an independent evaluation: the least
/// over a fine grid of the other model is never below by more than the grid's spacing.
#[test]
fn distances_are_those_of_the_nearest_points() {
    use nurbs_hausdorff::shapes::{sphere, torus};
    let (ball, ring) = (sphere(glam::DVec3::ZERO, 1.0).unwrap(), torus(3.0, 0.5).unwrap());
    let result = measured(&ball, &ring, MethodName::Certified);
    for field in &result.deviations {
        for (point, &distance) in field.points.chunks_exact(3).zip(&field.distances) {
            let [x, y, z] = [point[0], point[1], point[2]];
            let truth = ((x.hypot(y) - 3.0).hypot(z) - 0.5).abs();
            assert!((distance - truth).abs() <= 1e-8, "{distance} is not {truth}");
        }
    }
}

/// Without a distance the same samples come, within an upper bound that is given.
#[test]
fn a_field_without_its_distance_is_that_of_the_distance() {
    use nurbs_hausdorff::PreparedModel;
    use nurbs_hausdorff::internals::engine::{Engine, FieldOptions};
    use nurbs_hausdorff::shapes::{sphere, torus};
    let (ball, ring) = (sphere(glam::DVec3::ZERO, 1.0).unwrap(), torus(3.0, 0.5).unwrap());
    let with_distance = measured(&ball, &ring, MethodName::Certified);
    let engine = Engine::new_blocking(nurbs_hausdorff::Backend::Cpu).unwrap();
    let [a, b] = [&ball, &ring].map(|model| PreparedModel::new(model).unwrap());
    let field = |options| engine.field(&a, &b, &options).wait();
    let options = FieldOptions { samples: SAMPLES, ..FieldOptions::default() };

    let limited = field(FieldOptions { upper: Some(with_distance.upper), ..options.clone() }).unwrap();
    assert_eq!(limited.deviations, with_distance.deviations);
    assert_eq!(limited.statistics, with_distance.statistics);
    assert_eq!(limited.diagonal.to_bits(), with_distance.diagonal.to_bits());

    let upper = 0.5 * with_distance.upper;
    let cut = field(FieldOptions { upper: Some(upper), ..options.clone() }).unwrap();
    let largest = cut.deviations.iter().flat_map(|field| &field.distances).fold(0.0_f64, |a, &b| a.max(b));
    assert_eq!(largest.to_bits(), upper.to_bits());

    for wrong in
        [FieldOptions { samples: 1, ..options.clone() }, FieldOptions { upper: Some(-1.0), ..options }]
    {
        assert_eq!(field(wrong).unwrap_err().code(), "OPTION_OUT_OF_RANGE");
    }
}
