//! The kernels where float32 is short of exponent, digits or loop turns: the
//! interval must hold all the same.

use crate::support::fixtures::with_grid;
use crate::support::gpu::{engine, measure};
use glam::DVec3;
use nurbs_hausdorff::internals::closest::Projection;
use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions, DistanceResult, Engine, MethodName};
use nurbs_hausdorff::internals::flatness::Flatness;
use nurbs_hausdorff::internals::iteration::Culling;
use nurbs_hausdorff::shapes::operations::{cut_model, elevate_degree};
use nurbs_hausdorff::shapes::{shape, sphere};
use nurbs_hausdorff::{Axis, IterationOptions, Method, Model, SurfaceArrays};

/// What the backends may differ by, relative to the diagonal: some tens of
/// roundings of float32.
const FLOAT32: f64 = 1e-5;

/// Rounding of float64 some 1e7 from the origin.
const ROUNDING: f64 = 1e-8;

fn iteration() -> DistanceOptions {
    DistanceOptions { method: MethodName::Iteration.into(), samples: 24, ..DistanceOptions::default() }
}

fn on(engine: &Engine, backend: Backend, a: &Model, b: &Model, options: &DistanceOptions) -> DistanceResult {
    measure(engine, a, b, &DistanceOptions { backend, ..options.clone() })
}

/// `model` with every control point mapped.
fn mapped(model: &Model, map: impl Fn([f64; 4]) -> [f64; 4]) -> Model {
    let arrays = model.surfaces().iter().map(|surface| SurfaceArrays {
        degree: surface.degree(),
        knots: Axis::BOTH.map(|axis| surface.knots(axis).to_vec()),
        counts: surface.counts(),
        control_points: surface.control_points().iter().map(|&point| map(point)).collect(),
    });
    Model::from_arrays(None, arrays.collect()).unwrap()
}

fn scaled(model: &Model, size: f64) -> Model {
    mapped(model, |[x, y, z, w]| [size * x, size * y, size * z, w])
}

/// The distance is found, and the bounds contain it and are no wider than a
/// cell between samples.
fn assert_distance(result: &DistanceResult, truth: f64, name: &str) {
    let DistanceResult { computed, lower, upper, converged, .. } = *result;
    let rounding = 1e-12 * result.diagonal;
    assert!((computed - truth).abs() <= rounding, "{name}: {computed}");
    assert!(
        lower <= truth + rounding && truth - rounding <= upper,
        "{name}: {truth} not in [{lower}, {upper}]"
    );
    let radius = result.iteration().unwrap().bounds.k_a_rigorous;
    assert!(upper - lower <= radius + FLOAT32 * result.diagonal, "{name}: [{lower}, {upper}]");
    assert!(converged, "{name}");
}

/// A square over a larger one, one corner higher than the others: the farthest
/// sample is that corner, and missing it by more than a cell shows.
fn tilted_square() -> [Model; 2] {
    let square = |half: f64, heights: [f64; 4]| {
        let corner = |x: f64, y: f64, z: f64| [half * x, half * y, z, 1.0];
        let [a, b, c, d] = heights;
        let arrays = SurfaceArrays {
            degree: [1, 1],
            knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
            counts: [2, 2],
            control_points: vec![
                corner(-1.0, -1.0, a),
                corner(-1.0, 1.0, b),
                corner(1.0, -1.0, c),
                corner(1.0, 1.0, d),
            ],
        };
        Model::from_arrays(None, vec![arrays]).unwrap()
    };
    [square(1.0, [0.1, 0.2, 0.5, 0.3]), square(2.0, [0.0; 4])]
}

#[test]
fn models_of_any_size_are_measured() {
    let Some(engine) = engine("models_of_any_size_are_measured") else { return };
    let models = tilted_square();
    // More samples than float64 alone would put right.
    let options = DistanceOptions { samples: 64, ..iteration() };
    // Lengths near 1e-100 and below are lost in the allowance for underflow.
    for exponent in [-90, -60, -30, -22, -20, -18, -15, -9, 9, 15, 18, 20, 30, 60, 99] {
        let size = 10_f64.powi(exponent);
        let [a, b] = [&models[0], &models[1]].map(|model| scaled(model, size));
        let result = on(&engine, Backend::Gpu, &a, &b, &options);
        assert_distance(&result, 0.5 * size, &format!("size 1e{exponent}"));
    }
}

#[test]
fn a_point_and_models_of_very_different_sizes_are_measured() {
    let Some(engine) = engine("a_point_and_models_of_very_different_sizes_are_measured") else { return };
    let [square, plane] = tilted_square();
    let point = |size: f64| scaled(&mapped(&plane, |[_, _, _, w]| [2.0, 1.0, 0.5, w]), size);
    // From the square's corner (-1, -1, 0.1), and from (-2, -2, 0) of the plane.
    let [to_point, to_dot] = [13.16_f64.sqrt(), 8.0_f64.sqrt()];
    for exponent in [-58, -30, -24, -15, -6, 0, 6, 15, 24, 30] {
        let size = 10_f64.powi(exponent);
        for method in [MethodName::Iteration, MethodName::Hierarchy, MethodName::Certified] {
            let options = DistanceOptions { method: with_grid(method, 16), samples: 16, ..iteration() };
            for backend in [Backend::Gpu, Backend::Cpu] {
                let name = format!("{method:?}, {backend:?}, size 1e{exponent}");
                let result = on(&engine, backend, &scaled(&square, size), &point(size), &options);
                assert_contains(&result, to_point * size, &name);
                // A plane of size 1 against one of this size.
                let (dot, large) = (scaled(&plane, size.min(1.0 / size)), plane.clone());
                let distance = if exponent == 0 { 0.0 } else { to_dot };
                let result = on(&engine, backend, &large, &dot, &options);
                assert_contains(&result, distance * (1.0 - size.min(1.0 / size)), &name);
            }
        }
    }
}

/// The bounds are finite and contain the distance.
fn assert_contains(result: &DistanceResult, truth: f64, name: &str) {
    let DistanceResult { lower, upper, .. } = *result;
    let rounding = 1e-12 * truth;
    assert!(
        lower <= truth + rounding && truth - rounding <= upper && upper.is_finite(),
        "{name}: {truth:e} not in [{lower:e}, {upper:e}]"
    );
}

/// Where weights are so far apart that float32 bounds the error of no point, the bounds of the
/// boxes remain.
#[test]
fn weights_far_apart_leave_the_bound_of_the_boxes() {
    let Some(engine) = engine("weights_far_apart_leave_the_bound_of_the_boxes") else { return };
    let [square, plane] = tilted_square();
    // From the corner (1, -1, 0.5) to (-2, 2, 0), the farthest of the boxes.
    let farthest = 18.25_f64.sqrt();
    for method in [MethodName::Iteration, MethodName::Hierarchy] {
        for ratio in [1e12, 1e20] {
            let heavy = |model| mapped(model, |[x, y, z, w]| [x, y, z, if x > y { ratio * w } else { w }]);
            let options = DistanceOptions { method: with_grid(method, 4), samples: 4, ..iteration() };
            let result = on(&engine, Backend::Gpu, &heavy(&square), &heavy(&plane), &options);
            let name = format!("{method:?}, weights 1 to {ratio:e}");
            assert_contains(&result, 0.5, &name);
            assert!(result.upper <= farthest * (1.0 + FLOAT32), "{name}: {}", result.upper);
        }
    }
}

#[test]
fn weights_of_any_scale_are_the_same_surface() {
    // The points do not change when all weights are multiplied by a number.
    // More samples than float64 alone would put right.
    let options = DistanceOptions { samples: 64, ..iteration() };
    let Some(engine) = engine("weights_of_any_scale_are_the_same_surface") else { return };
    let models = tilted_square();
    for exponent in [-99, -42, -30, 30, 37, 99] {
        let factor = 10_f64.powi(exponent);
        let [a, b] =
            [&models[0], &models[1]].map(|model| mapped(model, |[x, y, z, w]| [x, y, z, factor * w]));
        let result = on(&engine, Backend::Gpu, &a, &b, &options);
        assert_distance(&result, 0.5, &format!("weights times 1e{exponent}"));
    }
}

#[test]
fn far_from_the_origin_the_kernels_lose_no_digit() {
    let Some(engine) = engine("far_from_the_origin") else { return };
    // Float64 leaves 1e-9 between the points; float32 alone would see one point.
    let [a, b] = [1.0, 1.5].map(|radius| sphere(DVec3::new(4e6, -3e6, 2e6), radius).unwrap());
    let result = on(&engine, Backend::Gpu, &a, &b, &DistanceOptions { deviations: true, ..iteration() });
    assert!((result.computed - 0.5).abs() < ROUNDING, "{}", result.computed);
    for &distance in &result.deviations[0].distances {
        assert!((distance - 0.5).abs() < FLOAT32, "{distance}");
    }
}

#[test]
fn degree_15_is_measured() {
    let Some(engine) = engine("degree_15_is_measured") else { return };
    // Degree elevation keeps the points.
    let elevated = |radius: f64| {
        let ball = sphere(DVec3::ZERO, radius).unwrap();
        let mut surface = ball.surfaces()[0].clone();
        for axis in Axis::BOTH {
            while surface.degree()[axis] < 15 {
                surface = elevate_degree(&surface, axis).unwrap();
            }
        }
        Model::new(None, vec![surface]).unwrap()
    };
    let (a, b) = (elevated(1.0), elevated(1.5));
    assert_eq!(a.surfaces()[0].degree(), [15, 15]);
    for culling in [Culling::Tree, Culling::None] {
        let options = DistanceOptions {
            method: Method::Iteration(IterationOptions { culling, ..Default::default() }),
            samples: 12,
            deviations: true,
            ..iteration()
        };
        let result = on(&engine, Backend::Gpu, &a, &b, &options);
        assert!((result.computed - 0.5).abs() < 1e-9, "{culling:?}: {}", result.computed);
        for &distance in &result.deviations[0].distances {
            assert!((distance - 0.5).abs() < FLOAT32, "{culling:?}: {distance}");
        }
    }
}

/// From near a ball's centre no box rules out another: the tree would visit
/// every piece, which is more than a thread may.
fn pieces_all_about() -> (Model, Model) {
    let fractions: Vec<f64> = (1..40).map(|index| f64::from(index) / 40.0).collect();
    let ball = cut_model(&sphere(DVec3::ZERO, 2.0).unwrap(), [&fractions, &fractions]).unwrap();
    (sphere(DVec3::ZERO, 1e-3).unwrap(), ball)
}

#[test]
fn many_samples_nearly_equally_near_to_many_patches() {
    let Some(engine) = engine("many_samples_nearly_equally_near_to_many_patches") else { return };
    let (speck, ball) = pieces_all_about();
    for projection in [Projection::Newton, Projection::TangentPlane] {
        let options = DistanceOptions {
            method: Method::Iteration(IterationOptions { projection, ..Default::default() }),
            samples: 40,
            deviations: true,
            ..iteration()
        };
        let result = on(&engine, Backend::Gpu, &speck, &ball, &options);
        let DistanceResult { computed, lower, upper, .. } = result;
        let truth = 2.0 - 1e-3;
        assert!((computed - truth).abs() <= FLOAT32, "{projection:?}: {computed}");
        assert!(lower <= truth + 1e-9 && truth - 1e-9 <= upper, "{projection:?}: [{lower}, {upper}]");
        // Samples 1e-4 apart on a ball of 1e-3: the bound is of that size.
        assert!(upper - lower < 1e-3, "{projection:?}: [{lower}, {upper}]");
        for &distance in &result.deviations[0].distances {
            assert!((distance - truth).abs() <= FLOAT32, "{projection:?}: {distance}");
        }
    }
}

#[test]
fn every_flatness_gives_the_same_distance() {
    let Some(engine) = engine("every_flatness_gives_the_same_distance") else { return };
    let (a, b) = (shape("bottle").unwrap(), shape("glass").unwrap());
    // Enough steps that the few large patches are solved too.
    let measured = [Flatness::None, Flatness::Loose, Flatness::Tight, Flatness::Curvature].map(|flatness| {
        let options = DistanceOptions {
            method: Method::Iteration(IterationOptions { flatness, iterations: 30, ..Default::default() }),
            ..iteration()
        };
        let [gpu, cpu] = [Backend::Gpu, Backend::Cpu].map(|on_| on(&engine, on_, &a, &b, &options));
        assert!((gpu.computed - cpu.computed).abs() <= FLOAT32 * cpu.diagonal, "{flatness:?}");
        cpu
    });
    for result in &measured {
        assert!((result.computed - measured[0].computed).abs() < 1e-9 * result.diagonal);
    }
    // Cutting went on where the options request it.
    let patches = measured.map(|result| result.patches.b);
    assert!(patches[0] < patches[1] && patches[1] < patches[2] && patches[0] < patches[3], "{patches:?}");
}
