//! The kernels against float64 on the CPU.

use crate::support::gpu::{engine, measure};
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::closest::Projection;
use nurbs_hausdorff::internals::engine::{
    Backend, DistanceOptions, DistanceResult, Engine, MethodName, PreparedModel, Processor,
};
use nurbs_hausdorff::internals::flatness::Flatness;
use nurbs_hausdorff::internals::iteration::{Culling, PAGE_SAMPLES, SamplingRule};
use nurbs_hausdorff::shapes::operations::cut_model;
use nurbs_hausdorff::shapes::{WavySheet, shape, sphere, wavy_sheet};
use nurbs_hausdorff::{IterationOptions, Method, Model, RigidTransform, SurfaceArrays};

/// What rounding makes of a distance of about 1: the search for the foot begins where the
/// projection ended, which is another point of the same neighbourhood with the tree.
const FLOAT64: f64 = 16.0 * f64::EPSILON;

/// What two backends may differ by, relative to the diagonal: some tens of
/// roundings of float32.
const FLOAT32: f64 = 1e-5;

fn iteration() -> DistanceOptions {
    DistanceOptions {
        method: MethodName::Iteration.into(),
        samples: 24,
        deviations: true,
        ..DistanceOptions::default()
    }
}

/// A net over a square with heights, shifts and weights from a fixed recurrence.
fn bumpy(degree: [usize; 2], counts: [usize; 2], weights: [f64; 2], seed: u64) -> SurfaceArrays {
    let mut state = seed;
    let mut random = move || {
        // Knuth's MMIX constants; the upper bits are the good ones.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / (1_u64 << 31) as f64
    };
    let knots = [0, 1].map(|axis| {
        let inner = counts[axis] - degree[axis];
        let rising = (0..=inner).map(|knot| knot as f64);
        let start = std::iter::repeat_n(0.0, degree[axis]);
        start.chain(rising).chain(std::iter::repeat_n(inner as f64, degree[axis])).collect()
    });
    let control_points = (0..counts[0] * counts[1])
        .map(|index| {
            let (i, j) = (index / counts[1], index % counts[1]);
            let at = |k: usize, count: usize| k as f64 / (count - 1) as f64;
            [
                at(i, counts[0]) + 0.05 * random(),
                at(j, counts[1]) + 0.05 * random(),
                0.4 * random(),
                weights[0] + (weights[1] - weights[0]) * random(),
            ]
        })
        .collect();
    SurfaceArrays { degree, knots, counts, control_points }
}

fn model(surfaces: Vec<SurfaceArrays>) -> Model {
    Model::from_arrays(None, surfaces).unwrap()
}

/// Nets of many degrees, rational with a weight ratio of 10.
fn mixed(seed: u64) -> Model {
    model(vec![
        bumpy([3, 3], [7, 6], [1.0, 1.0], seed),
        bumpy([1, 2], [4, 5], [0.5, 5.0], seed + 1),
        bumpy([2, 5], [5, 7], [0.5, 5.0], seed + 2),
        bumpy([6, 10], [8, 11], [0.5, 5.0], seed + 3),
    ])
}

fn on(backend: Backend, options: &DistanceOptions) -> DistanceOptions {
    DistanceOptions { backend, ..options.clone() }
}

fn distances(result: &DistanceResult) -> Vec<f64> {
    result.deviations.iter().flat_map(|field| field.distances.clone()).collect()
}

/// Both backends' results, and the largest difference of a sample's distance.
fn both(
    engine: &Engine,
    a: &Model,
    b: &Model,
    options: &DistanceOptions,
) -> (DistanceResult, DistanceResult, f64) {
    let gpu = measure(engine, a, b, &on(Backend::Gpu, options));
    let cpu = measure(engine, a, b, &on(Backend::Cpu, options));
    assert_eq!((gpu.backend, cpu.backend), (Processor::Gpu, Processor::Cpu));
    let pairs = distances(&gpu).into_iter().zip(distances(&cpu));
    let difference = pairs.map(|(gpu, cpu)| (gpu - cpu).abs()).fold(0.0, f64::max);
    let relative = difference / cpu.diagonal;
    (gpu, cpu, relative)
}

fn moved() -> RigidTransform {
    RigidTransform::new(
        DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.3),
        DVec3::new(0.1, -0.05, 0.3),
    )
    .unwrap()
}

#[test]
fn kernels_find_the_distances_that_float64_finds() {
    let Some(engine) = engine("kernels_find_the_distances_that_float64_finds") else { return };
    for seed in 1..4 {
        // Enough steps that both precisions end at the same points.
        let options = DistanceOptions {
            method: Method::Iteration(IterationOptions { iterations: 20, ..Default::default() }),
            transform: moved(),
            ..iteration()
        };
        let (gpu, cpu, difference) = both(&engine, &mixed(seed), &mixed(seed + 100), &options);
        assert!(difference < FLOAT32, "seed {seed}: {difference}");
        assert!((gpu.computed - cpu.computed).abs() <= FLOAT32 * cpu.diagonal);
        for result in [&gpu, &cpu] {
            let details = result.iteration().unwrap();
            let statuses = details.statuses;
            assert_eq!(statuses.converged + statuses.iteration_limit + statuses.on_edge, details.samples);
            assert!(statuses.iteration_limit * 50 < details.samples, "{statuses:?}");
        }
    }
}

#[test]
fn the_tangent_plane_step_takes_the_same_steps() {
    let Some(engine) = engine("the_tangent_plane_step_takes_the_same_steps") else { return };
    // Far enough above that the first step's errors are not amplified: distance times curvature below 1.
    let options = DistanceOptions {
        method: Method::Iteration(IterationOptions {
            projection: Projection::TangentPlane,
            step_tolerance: 1e-4,
            flatness: Flatness::Tight,
            ..Default::default()
        }),
        transform: RigidTransform::translation(DVec3::new(0.0, 0.0, 0.1)).unwrap(),
        ..iteration()
    };
    let sheet = shape("wavy-sheet").unwrap();
    let (gpu, cpu, _) = both(&engine, &sheet, &sheet, &options);
    let off =
        distances(&gpu).iter().zip(distances(&cpu)).filter(|(gpu, cpu)| (*gpu - cpu).abs() > 1e-4).count();
    assert!(off * 100 < distances(&cpu).len(), "{off} samples differ");
}

#[test]
fn the_tree_leaves_out_no_patch_that_matters() {
    let Some(engine) = engine("the_tree_leaves_out_no_patch_that_matters") else { return };
    let (a, b) = (mixed(7), mixed(8));
    for projection in [Projection::Newton, Projection::TangentPlane] {
        for (backend, tolerance) in [(Backend::Cpu, FLOAT64), (Backend::Gpu, 1e-6)] {
            let with = |culling| DistanceOptions {
                method: Method::Iteration(IterationOptions { projection, culling, ..Default::default() }),
                transform: moved(),
                ..on(backend, &iteration())
            };
            let tree = measure(&engine, &a, &b, &with(Culling::Tree));
            let all = measure(&engine, &a, &b, &with(Culling::None));
            for (tree, all) in distances(&tree).iter().zip(distances(&all)) {
                assert!((tree - all).abs() <= tolerance, "{projection:?} {backend:?}: {tree} {all}");
            }
        }
    }
}

#[test]
fn samples_lie_where_the_evaluator_puts_them() {
    let Some(engine) = engine("samples_lie_where_the_evaluator_puts_them") else { return };
    let (a, b) = (mixed(3), shape("sphere").unwrap());
    for sampling in [SamplingRule::Uniform, SamplingRule::ArcLength] {
        let options = DistanceOptions { sampling, ..iteration() };
        // The sampling kernel shows in the distances to a sphere of radius 2 about the origin.
        let (gpu, _, _) = both(&engine, &a, &b, &options);
        for field in &gpu.deviations {
            for (point, distance) in field.points.chunks(3).zip(&field.distances) {
                let expected = 2.0 - DVec3::from_slice(point).length();
                assert!((distance - expected.abs()).abs() < FLOAT32 * gpu.diagonal, "{distance} {expected}");
            }
        }
    }
}

#[test]
fn many_pages_and_blocks_are_reduced_to_the_farthest() {
    let Some(engine) = engine("many_pages_and_blocks_are_reduced_to_the_farthest") else { return };
    let flat = |x: f64, height: f64| SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: vec![
            [x, 0.0, height, 1.0],
            [x, 1.0, height, 1.0],
            [x + 1.0, 0.0, height, 1.0],
            [x + 1.0, 1.0, height, 1.0],
        ],
    };
    // The farthest sample is a corner of the one tilted square, in the last page.
    let mut squares: Vec<SurfaceArrays> = (0..5).map(|index| flat(f64::from(index), 1.0)).collect();
    squares[4].control_points[3][2] = 1.5;
    let ground: Vec<SurfaceArrays> = (0..5).map(|index| flat(f64::from(index), 0.0)).collect();
    let options = DistanceOptions { samples: 300, deviations: false, ..iteration() };
    let result = measure(&engine, &model(squares), &model(ground), &on(Backend::Gpu, &options));
    assert!(result.iteration().unwrap().samples > PAGE_SAMPLES);
    assert_eq!(result.computed, 1.5);
    assert_eq!((result.witness.a.face, result.witness.a.u, result.witness.a.v), (4, 1.0, 1.0));
}

#[test]
fn the_farthest_sample_is_found_wherever_it_is() {
    let Some(engine) = engine("the_farthest_sample_is_found_wherever_it_is") else { return };
    // A polyhedral sheet of 64 x 64 corners, which are the samples, one of them raised.
    let count = 64;
    let sheet = |raised: Option<usize>| {
        let mut knots: Vec<f64> = (0..count).map(f64::from).collect();
        knots.insert(0, 0.0);
        knots.push(f64::from(count - 1));
        let side = count as usize;
        let height = |index| if Some(index) == raised { 0.5 } else { 0.0 };
        let corner = |index| [(index / side) as f64, (index % side) as f64, height(index), 1.0];
        let control_points = (0..side * side).map(corner).collect();
        let knots = [knots.clone(), knots];
        PreparedModel::new(&model(vec![SurfaceArrays {
            degree: [1, 1],
            knots,
            counts: [side; 2],
            control_points,
        }]))
        .unwrap()
    };
    let ground = sheet(None);
    // Around the ends of threads' strides, blocks and the page.
    for raised in [0, 1, 63, 64, 65, 1023, 1024, 1025, 2047, 2048, 3000, 4095] {
        let options = DistanceOptions { samples: 64, deviations: false, ..on(Backend::Gpu, &iteration()) };
        let result = engine.distance(&sheet(Some(raised)), &ground, &options).wait().unwrap();
        assert_eq!(result.computed, 0.5, "{raised}");
        let at = [raised / 64, raised % 64].map(|place| place as f64);
        assert_eq!([result.witness.a.u, result.witness.a.v], at);
        // The ground is one patch once its knots are removed; its points are rounded by its size.
        for (found, expected) in result.witness.b.point.into_iter().zip([at[0], at[1], 0.0]) {
            assert!((found - expected).abs() <= 1e-13, "{found} {expected}");
        }
    }
}

#[test]
fn moving_a_model_changes_nothing_that_is_kept() {
    let Some(engine) = engine("moving_a_model_changes_nothing_that_is_kept") else { return };
    let torus = PreparedModel::new(&shape("torus").unwrap()).unwrap();
    let run = |height: f64| {
        let transform = RigidTransform::translation(DVec3::new(0.0, 0.0, height)).unwrap();
        let options = DistanceOptions { transform, deviations: false, ..iteration() };
        engine.distance(&torus, &torus, &options).wait().unwrap()
    };
    let first = run(5.0);
    run(1.0);
    let again = run(5.0);
    assert_eq!(first.computed, again.computed);
    assert_eq!(again.seconds.compile, 0.0);
}

#[test]
fn few_samples_meet_many_patches() {
    // Thousands of patches a thread: more turns than llvmpipe allows the loops of one invocation.
    let Some(engine) = engine("few_samples_meet_many_patches") else { return };
    let counts = [90, 80];
    let sheet = WavySheet { counts, size: [9.0, 8.0], amplitude: 0.3, waves: [3.0, 4.0], phase: 0.0 };
    let (a, b) = (wavy_sheet(&sheet).unwrap(), wavy_sheet(&WavySheet { phase: 0.7, ..sheet }).unwrap());
    for projection in [Projection::Newton, Projection::TangentPlane] {
        let options = DistanceOptions {
            method: Method::Iteration(IterationOptions {
                culling: Culling::None,
                projection,
                ..Default::default()
            }),
            samples: 8,
            ..iteration()
        };
        let (gpu, cpu, difference) = both(&engine, &a, &b, &options);
        assert!(gpu.patches.b > 6000);
        assert!(difference < FLOAT32, "{projection:?}: {difference}");
        assert_eq!(gpu.witness.a.u, cpu.witness.a.u);
    }
}

#[test]
fn a_sample_equally_near_to_all_patches_is_finished_in_float64() {
    // From a sphere's centre no box rules out another: the tree visits every piece.
    let Some(engine) = engine("a_sample_equally_near_to_all_patches") else { return };
    let fractions: Vec<f64> = (1..40).map(|index| f64::from(index) / 40.0).collect();
    let ball = cut_model(&sphere(DVec3::ZERO, 2.0).unwrap(), [&fractions, &fractions]).unwrap();
    let speck = model(vec![SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: vec![
            [0.0, 0.0, 0.0, 1.0],
            [0.0, 1e-3, 0.0, 1.0],
            [1e-3, 0.0, 0.0, 1.0],
            [1e-3, 1e-3, 0.0, 1.0],
        ],
    }]);
    let options = DistanceOptions { samples: 2, deviations: false, ..iteration() };
    let result = measure(&engine, &speck, &ball, &on(Backend::Gpu, &options));
    assert!((result.computed - 2.0).abs() < 1e-9, "{}", result.computed);
    assert!(result.converged);
    assert!(result.lower <= 2.0 && 2.0 <= result.upper);
}
