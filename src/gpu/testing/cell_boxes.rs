//! The kernels' boxes contain the points of the surfaces and the boxes in float64.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

use super::adapter::gpu;
use crate::bezier::extract;
use crate::bvh::Aabb;
use crate::gpu::hierarchy::layouts::Box;
use crate::gpu::submission::Submission;
use crate::gpu::{Gpu, GpuHierarchy, Placement};
use crate::hierarchy::{CellPart, GridTree, boxes, pyramid};
use crate::model::{Model, RigidTransform, SurfaceArrays};
use crate::progress::{NoMonitor, Progress};
use crate::shapes::shape;
use glam::{DQuat, DVec3};
use std::sync::Arc;

fn read(gpu: &Arc<Gpu>, buffer: &wgpu::Buffer, count: usize) -> Vec<Box> {
    let bytes = (count * size_of::<Box>()) as u64;
    let (params, readable) = (gpu.params_buffer(), gpu.readable("boxes", bytes));
    let submission = Submission::new(gpu, &params);
    bytemuck::pod_collect_to_vec(&pollster::block_on(submission.read(buffer, &readable, bytes)).unwrap())
}

/// A net of this degree about `middle`, with noise and weights from 1 to `ratio`.
fn rough(degree: [usize; 2], middle: DVec3, size: f64, ratio: f64, seed: u64) -> Model {
    let mut random = fastrand::Rng::with_seed(seed);
    let counts = degree.map(|degree| degree + 3);
    let knots = degree.map(|degree| [vec![0.0; degree + 1], vec![1.0, 2.0], vec![3.0; degree + 1]].concat());
    let mut point = |i: usize, j: usize| {
        let mut at = |place: usize| size * (place as f64 + 0.4 * random.f64());
        let point = middle + DVec3::new(at(i), at(j), at(0));
        [point.x, point.y, point.z, ratio.powf(random.f64())]
    };
    let control_points = (0..counts[0] * counts[1]).map(|k| point(k / counts[1], k % counts[1])).collect();
    Model::from_arrays(None, vec![SurfaceArrays { degree, knots, counts, control_points }]).unwrap()
}

/// Four patches whose corners' weights are the smallest that a surface may have:
/// their products underflow in float32.
fn weightless_corners() -> Model {
    let knots = vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0];
    let point = |i: usize, j: usize| {
        let heavy = i % 2 == 1 && j % 2 == 1;
        [i as f64, j as f64, 0.0, if heavy { 1.0 } else { 1e-30 }]
    };
    let control_points = (0..25).map(|k| point(k / 5, k % 5)).collect();
    let arrays =
        SurfaceArrays { degree: [2, 2], knots: [knots.clone(), knots], counts: [5, 5], control_points };
    Model::from_arrays(None, vec![arrays]).unwrap()
}

/// Checks the boxes of `a`, moved, against `b`.
fn check(gpu: &Arc<Gpu>, a: &Model, b: &Model, transform: RigidTransform, grid: usize, name: &str) {
    let models = [a, b].map(extract);
    let trees = [0, 1].map(|index| GridTree::new(&models[index], grid).unwrap());
    let uploaded = [0, 1].map(|index| Arc::new(gpu.upload_grid_tree(&models[index], &trees[index])));
    let origin = uploaded[1].origin;
    let mut silent = NoMonitor;
    let mut progress = Progress::new(&mut silent, false);
    let coordinate = origin.length() + transform.offset().length() + a.bounding_box().max.length();
    let placement = Placement { transform, coordinate_error: 64.0 * f64::EPSILON * coordinate };
    let hierarchy = pollster::block_on(GpuHierarchy::new(gpu, uploaded, &placement, &mut progress)).unwrap();
    let (bezier, tree) = (&models[0], &trees[0]);
    let part_box = |part: &CellPart| boxes(&bezier.patches.patch(part.patch), part, &transform, 0.0);
    let in_float64 = pyramid(&tree.levels, tree.parts.iter().map(part_box).collect());
    let unscaled = |corner: [f32; 4]| {
        let [x, y, z, _] = corner.map(|value| f64::from(value) / hierarchy.scale);
        DVec3::new(x, y, z) + origin
    };
    let float32 = |level: usize| -> Vec<Aabb> {
        let found = read(gpu, &hierarchy.boxes[0][level], hierarchy.trees[0].counts[level]);
        found.iter().map(|found| Aabb { min: unscaled(found.low), max: unscaled(found.high) }).collect()
    };
    for (level, expected) in in_float64.iter().enumerate() {
        for (found, expected) in float32(level).iter().zip(expected) {
            assert_eq!(found.union(*expected), *found, "{name}, level {level}");
        }
    }
    // Points of every part, its corners included.
    for (found, part) in float32(tree.levels.len()).iter().zip(&tree.parts) {
        let patch = bezier.patches.patch(part.patch);
        for step in 0..25 {
            let at = |[start, end]: [f64; 2], k: usize| start + (end - start) * k as f64 / 4.0;
            let point = transform.apply(patch.point([at(part.s, step / 5), at(part.t, step % 5)]));
            assert_eq!(found.with(point), *found, "{name}: {part:?}");
        }
    }
}

#[test]
fn boxes_are_rounded_outwards() {
    let Some(gpu) = gpu("boxes_are_rounded_outwards") else { return };
    let turned = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -1.0).normalize(), 0.7);
    let moved = |offset: DVec3| RigidTransform::new(turned, offset).unwrap();
    let away = DVec3::new(1e6, -2e6, 3e5);
    let small = DVec3::new(0.2, 0.1, -0.3);
    for (degree, middle, size, ratio, offset) in [
        ([3, 3], DVec3::ZERO, 1.0, 100.0, small),
        ([1, 2], away, 1.0, 100.0, small),
        ([6, 10], DVec3::ZERO, 1e-9, 1.0, DVec3::ZERO),
        ([15, 15], DVec3::new(0.0, 500.0, 0.0), 1e3, 10.0, away),
        ([2, 5], DVec3::ZERO, 1e12, 1e3, DVec3::ZERO),
    ] {
        let name = format!("{degree:?} at {middle} of {size}, weights 1 to {ratio}, moved by {offset}");
        let (a, b) = (rough(degree, middle, size, ratio, 1), rough([2, 2], middle, size, ratio, 2));
        for grid in [3, 16] {
            check(&gpu, &a, &b, moved(offset), grid, &name);
        }
    }
    let weightless = weightless_corners();
    check(&gpu, &weightless, &weightless, moved(small), 2, "weightless corners");
    for name in ["torus", "glass", "naca-wing"] {
        let model = shape(name).unwrap();
        check(&gpu, &model, &model, moved(small), 9, name);
    }
}
