//! Closest points with the kernel's feet and bounds, against the CPU's search.

use crate::support::gpu::engine;
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{
    Backend, ClosestPointOptions, ClosestPoints, Engine, PreparedModel,
};
use nurbs_hausdorff::shapes::{shape, sphere};
use nurbs_hausdorff::{Error, Model, RigidTransform, SurfaceArrays};

/// The permitted excess of a distance, relative to the diagonal.
const TOLERANCE: f64 = 1e-6;

/// Random points: all over the model's box, and near its surface.
fn points(model: &PreparedModel, count: usize) -> Vec<f64> {
    let (aabb, mut random) = (model.bounding_box(), fastrand::Rng::with_seed(5));
    let mut direction = || DVec3::from_array([0; 3].map(|_| 2.0 * random.f64() - 1.0));
    let all_over: Vec<f64> =
        (0..count).flat_map(|_| (aabb.center() + 0.5 * aabb.extent() * direction()).to_array()).collect();
    let feet = on(&Engine::cpu(), Backend::Cpu, model, &all_over).feet;
    let near = feet
        .as_chunks::<3>()
        .0
        .iter()
        .map(|&foot| (DVec3::from_array(foot) + 0.01 * aabb.diagonal() * direction()).to_array());
    let near: Vec<f64> = near.flatten().collect();
    [all_over, near].concat()
}

fn on(engine: &Engine, backend: Backend, model: &PreparedModel, points: &[f64]) -> ClosestPoints {
    let options = ClosestPointOptions {
        relative_tolerance: Some(TOLERANCE),
        backend,
        ..ClosestPointOptions::default()
    };
    engine.closest_points(model, points, &options).wait().unwrap()
}

/// Both intervals of every point contain its distance; the kernel's are as narrow as was asked.
#[test]
fn the_gpu_has_the_distances_of_the_cpu() {
    let Some(engine) = engine("the_gpu_has_the_distances_of_the_cpu") else { return };
    for (name, least) in
        [("torus", 0.98), ("sphere", 0.98), ("bottle", 0.97), ("glass", 0.96), ("wavy-sheet", 0.97)]
    {
        let model = PreparedModel::new(&shape(name).unwrap()).unwrap();
        let points = points(&model, 1000);
        let by_cpu = on(&engine, Backend::Cpu, &model, &points);
        let by_gpu = on(&engine, Backend::Gpu, &model, &points);
        assert_eq!(by_cpu.decided_on_gpu, 0);
        let share = by_gpu.decided_on_gpu as f64 / by_gpu.distances.len() as f64;
        println!("{name}: {share}");
        assert!(share >= least, "{name}: {share}");
        let gap = TOLERANCE * model.bounding_box().diagonal();
        for index in 0..by_gpu.distances.len() {
            let [gpu, cpu] = [&by_gpu, &by_cpu].map(|found| (found.distances[index], found.bounds[index]));
            assert!((gpu.0 - cpu.0).abs() <= gpu.1 + cpu.1, "{name}, {index}: {gpu:?} and {cpu:?}");
            assert!(gpu.1 <= 1.01 * gap, "{name}, {index}: {gpu:?}");
            let at = DVec3::from_slice(&points[3 * index..]);
            let foot = DVec3::from_slice(&by_gpu.feet[3 * index..]);
            assert!((foot.distance(at) - gpu.0).abs() <= 1e-12 * (1.0 + gpu.0), "{name}, {index}");
            // A side that both know is the same one.
            let [one, other] = [&by_gpu, &by_cpu].map(|found| found.signed[index]);
            assert!(!(one * other < 0.0), "{name}, {index}: {one} and {other}");
        }
    }
}

/// The kernel is given moved points.
#[test]
fn points_are_moved_before_they_are_located() {
    let Some(engine) = engine("points_are_moved_before_they_are_located") else { return };
    let model = PreparedModel::new(&sphere(DVec3::new(100.0, 0.0, 0.0), 2.0).unwrap()).unwrap();
    let transform = RigidTransform::new(glam::DQuat::IDENTITY, DVec3::new(100.0, 0.0, 0.0)).unwrap();
    let options = ClosestPointOptions {
        backend: Backend::Gpu,
        relative_tolerance: Some(TOLERANCE),
        transform,
        ..ClosestPointOptions::default()
    };
    let points = [[5.0, 0.1, 0.2], [0.3, 0.2, -1.0], [0.1, 2.5, 0.3]];
    let found = engine.closest_points(&model, points.as_flattened(), &options).wait().unwrap();
    for (index, point) in points.into_iter().enumerate() {
        let distance = (DVec3::from_array(point).length() - 2.0).abs();
        assert!((found.distances[index] - distance).abs() <= found.bounds[index], "{point:?}");
    }
    assert_eq!(found.decided_on_gpu, 3);
}

/// Equally near to all of a sphere or far beyond float32, and models whose weights or copies float32 does not hold: the
/// CPU searches, with the same guarantee.
#[test]
fn what_float32_does_not_decide_is_searched() {
    let Some(engine) = engine("what_float32_does_not_decide_is_searched") else { return };
    let ball = PreparedModel::new(&sphere(DVec3::ZERO, 1.0).unwrap()).unwrap();
    let points = [0.0, 0.0, 0.0, 1e20, 0.0, 0.0, 0.0, 1e100, 0.0];
    let found = on(&engine, Backend::Gpu, &ball, &points);
    assert_eq!(found.decided_on_gpu, 0);
    for (distance, exact) in found.distances.iter().zip([1.0, 1e20, 1e100]) {
        assert!((distance / exact - 1.0).abs() <= TOLERANCE, "{distance}");
    }
    let corner = |weight: f64| SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: vec![
            [0.0, 0.0, 0.0, weight],
            [0.0, 1.0, 0.0, 1.0],
            [1.0, 0.0, 0.0, 1.0],
            [1.0, 1.0, 0.0, 1.0],
        ],
    };
    for (weight, decided) in [(1.0, 1), (1e-5, 0)] {
        let model = PreparedModel::new(&Model::from_arrays(None, vec![corner(weight)]).unwrap()).unwrap();
        let found = on(&engine, Backend::Gpu, &model, &[0.3, 0.6, 2.0]);
        assert_eq!(found.decided_on_gpu, decided, "{weight}");
        assert!((found.distances[0] - 2.0).abs() <= TOLERANCE * 2.0);
    }
}

/// An engine without a GPU refuses a request for one. No GPU is used where none is requested.
#[test]
fn the_gpu_is_used_on_request_alone() {
    let model = PreparedModel::new(&shape("torus").unwrap()).unwrap();
    let engine = Engine::cpu();
    let ask = |backend: Backend| {
        let options = ClosestPointOptions { backend, ..ClosestPointOptions::default() };
        engine.closest_points(&model, &[0.0, 0.0, 3.0], &options).wait()
    };
    assert!(matches!(ask(Backend::Gpu), Err(Error::NoAdapter { .. })));
    assert_eq!(ClosestPointOptions::default().backend, Backend::Cpu);
    assert_eq!(ask(Backend::Auto).unwrap(), ask(Backend::Cpu).unwrap());
}
