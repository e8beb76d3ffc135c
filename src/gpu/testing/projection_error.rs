//! The error bound of the kernels' distances, on which the upper bound of
//! method `iteration` rests, against certified distances in float64.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

use super::adapter::gpu;
use crate::closest::{Projection, Target, closest};
use crate::flatness::{Flatness, flatten};
use crate::gpu::{Gpu, GpuIteration};
use crate::iteration::{Culling, Rule, Sampling, SamplingRule, sample};
use crate::model::{Model, RigidTransform, SurfaceArrays};
use crate::progress::{NoMonitor, Progress};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// Width of the certified intervals, relative to the diagonal: far below float32's rounding.
const GAP: f64 = 1e-10;

/// A net over a square of this size about `middle`, with noise in all
/// coordinates and weights from 1 to `ratio`.
pub(super) fn rough(
    random: &mut fastrand::Rng,
    degree: [usize; 2],
    middle: DVec3,
    size: f64,
    ratio: f64,
) -> SurfaceArrays {
    let counts = degree.map(|degree| degree + 4);
    let knots = degree.map(|degree| {
        let inner = [1.0, 2.0, 3.0];
        [vec![0.0; degree + 1], inner.to_vec(), vec![4.0; degree + 1]].concat()
    });
    let mut control_points = Vec::new();
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            let mut rough = |place: f64| size * (place + 0.3 * random.f64());
            let [x, y, z] =
                [rough(i as f64 / counts[0] as f64), rough(j as f64 / counts[1] as f64), rough(0.0)];
            let weight = ratio.powf(random.f64());
            control_points.push([middle.x + x, middle.y + y, middle.z + z, weight]);
        }
    }
    SurfaceArrays { degree, knots, counts, control_points }
}

/// Checks all samples. Returns the error bound relative to the diagonal.
fn check(gpu: &Arc<Gpu>, a: &Model, b: &Model, transform: RigidTransform, name: &str) -> f64 {
    let (a, b) = (crate::bezier::extract(a), crate::bezier::extract(b));
    let sampling = Sampling::new(&a, 10, SamplingRule::Uniform);
    let target = Target::new(flatten(&b.patches, Flatness::Loose).patches);
    let rule =
        Rule { projection: Projection::Newton, iterations: 12, step_tolerance: 0.01, culling: Culling::Tree };
    let from = Arc::new(gpu.upload_sampling(&a, &sampling));
    let to = Arc::new(gpu.upload_target(&target));
    let mut stages = pollster::block_on(GpuIteration::new(gpu, from, to, transform, rule)).unwrap();
    let mut silent = NoMonitor;
    let mut progress = Progress::new(&mut silent, false);
    let error = stages.distance_error();
    let diagonal = target.patches.bounding_box().diagonal();
    for (index, page) in sampling.pages().iter().enumerate() {
        pollster::block_on(stages.project(index, page, &mut progress)).unwrap();
        let found = pollster::block_on(stages.field()).unwrap();
        for (index, projected) in page.clone().zip(&found) {
            let point = sample(&a, &sampling, index, &transform);
            let truth = closest(&target, point, GAP * diagonal).unwrap();
            let distance = projected.distance_squared.sqrt();
            assert!(distance >= truth.lower - error, "{name}: {distance} < {} - {error}", truth.lower);
            // The foot that the kernel wrote is at the distance that it wrote.
            let foot = target.patches.patch(projected.patch).point(projected.parameters);
            let off = (foot.distance(point) - distance).abs();
            assert!(off <= error, "{name}: {off} > {error}");
        }
    }
    error / diagonal
}

#[test]
fn distances_are_within_their_error_bound() {
    let Some(gpu) = gpu("distances_are_within_their_error_bound") else { return };
    let mut random = fastrand::Rng::with_seed(4);
    let turned = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -1.0).normalize(), 0.7);
    for (degree, middle, size, ratio, max_error) in [
        ([3, 3], DVec3::ZERO, 1.0, 1.0, 3e-5),
        ([1, 2], DVec3::new(1e6, -2e6, 3e5), 1.0, 10.0, 1e-4),
        ([6, 10], DVec3::ZERO, 1e-9, 10.0, 2e-4),
        ([15, 15], DVec3::new(0.0, 500.0, 0.0), 1e3, 10.0, 4e-4),
        ([2, 5], DVec3::ZERO, 1e12, 1e3, 5e-3),
    ] {
        let name = format!("{degree:?} at {middle} of {size}, weights 1 to {ratio}");
        let mut model = || {
            let surface = rough(&mut random, degree, middle, size, ratio);
            Model::from_arrays(None, vec![surface]).unwrap()
        };
        let (a, b) = (model(), model());
        // Turned about its middle and moved a little.
        let shift = middle - turned * middle + DVec3::splat(0.1 * size);
        let transform = RigidTransform::new(turned, shift).unwrap();
        let stated = check(&gpu, &a, &b, transform, &name);
        // Tight enough to be useful.
        assert!(stated < max_error, "{name}: {stated}");
        println!("{name}: {stated:.1e}");
    }
}
