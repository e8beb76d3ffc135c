//! The feet and bounds of stage `closest_point`, against certified distances in float64.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

use super::adapter::gpu;
use super::projection_error::rough;
use crate::bezier::{PatchSet, extract};
use crate::closest::{Located, Target, closest};
use crate::flatness::{Flatness, flatten};
use crate::gpu::{Gpu, GpuPoints};
use crate::model::Model;
use crate::shapes::shape;
use glam::DVec3;
use std::collections::HashMap;
use std::sync::Arc;

/// Width of the certified intervals, relative to the diagonal: far below float32's rounding.
const CERTIFIED: f64 = 1e-10;

fn target_of(model: &Model) -> Target {
    Target::new(flatten(&extract(model).patches, Flatness::Loose).patches)
}

fn locate(gpu: &Arc<Gpu>, target: &Target, points: &[DVec3], gap: f64) -> Vec<Located> {
    let uploaded = Arc::new(gpu.upload_point_target(target));
    let stage = pollster::block_on(GpuPoints::new(gpu, uploaded, gap, points.len())).unwrap().unwrap();
    pollster::block_on(stage.locate(points)).unwrap()
}

/// All patches but one; `None` of a single patch.
fn others(target: &Target, patch: u32) -> Option<Target> {
    let mut patches = PatchSet::default();
    let kept = (0..target.patches.len()).filter(|&index| index != patch as usize);
    kept.for_each(|index| patches.push(target.patches.patch(index)));
    (!patches.is_empty()).then(|| Target::new(patches))
}

/// Random points: all over twice the box, and near the patches at distances of every size.
fn points(target: &Target, count: usize, random: &mut fastrand::Rng) -> Vec<DVec3> {
    let aabb = target.patches.bounding_box();
    let mut direction = |size: f64| size * DVec3::from_array([0; 3].map(|_| 2.0 * random.f64() - 1.0));
    let all_over = |direction: DVec3| aabb.center() + aabb.extent() * direction;
    let mut points: Vec<DVec3> = (0..count).map(|_| all_over(direction(1.0))).collect();
    for index in 0..count {
        let near = closest(target, points[index], aabb.diagonal()).unwrap().point;
        let size = aabb.diagonal() * 10.0_f64.powf(-1.0 - 6.0 * index as f64 / count as f64);
        points.push(near + direction(size));
    }
    points
}

/// The shares of points that the kernels' bounds decide at a gap, with the search of the foot's patch and without.
fn check(gpu: &Arc<Gpu>, target: &Target, points: &[DVec3], gap: f64, name: &str) -> [f64; 2] {
    let diagonal = target.patches.bounding_box().diagonal();
    let mut without = HashMap::new();
    let mut decided = [0; 2];
    for (point, located) in points.iter().zip(locate(gpu, target, points, gap)) {
        let rest = without.entry(located.patch).or_insert_with(|| others(target, located.patch));
        let upper = |target: &Target| closest(target, *point, CERTIFIED * diagonal).unwrap().upper;
        let truth = rest.as_ref().map_or(f64::INFINITY, upper);
        assert!(located.others <= truth, "{name}, {point}: {} > {truth}", located.others);
        let lower = located.own.min(located.others);
        assert!(lower <= upper(target), "{name}, {point}: {lower} > {}", upper(target));
        let foot = target.patches.patch(located.patch as usize).point(located.parameters);
        let needed = foot.distance(*point) - gap;
        decided[0] += usize::from(needed <= located.others);
        decided[1] += usize::from(needed <= lower);
    }
    decided.map(|decided| decided as f64 / points.len() as f64)
}

#[test]
fn other_patches_are_no_nearer_than_their_bound() {
    let Some(gpu) = gpu("other_patches_are_no_nearer_than_their_bound") else { return };
    let random = &mut fastrand::Rng::with_seed(31);
    for (name, least) in
        [("torus", 0.97), ("sphere", 0.95), ("bottle", 0.95), ("glass", 0.95), ("naca-wing", 0.75)]
    {
        let target = target_of(&shape(name).unwrap());
        let diagonal = target.patches.bounding_box().diagonal();
        let points = points(&target, 300, random);
        let share = check(&gpu, &target, &points, 1e-6 * diagonal, name);
        println!("{name}: {} patches, {share:?}", target.patches.len());
        assert!(share[1] >= least, "{name}: {share:?}");
    }
}

/// Nets with noise of any degrees and weights, of any size, anywhere. Two of them have more parts than one.
#[test]
fn other_patches_of_rough_nets_are_no_nearer() {
    let Some(gpu) = gpu("other_patches_of_rough_nets_are_no_nearer") else { return };
    let random = &mut fastrand::Rng::with_seed(57);
    for (degree, middle, size, ratio) in [
        ([3, 3], DVec3::ZERO, 1.0, 1.0),
        ([1, 2], DVec3::new(1e6, -2e6, 3e5), 1.0, 10.0),
        ([6, 10], DVec3::ZERO, 1e-9, 10.0),
        ([15, 15], DVec3::new(0.0, 500.0, 0.0), 1e3, 3.0),
        ([2, 5], DVec3::ZERO, 1e12, 1e2),
    ] {
        let name = format!("{degree:?} at {middle} of {size}, weights 1 to {ratio}");
        let surfaces = vec![
            rough(random, degree, middle, size, ratio),
            rough(random, [2, 2], middle + DVec3::splat(0.2 * size), size, ratio),
        ];
        let target = target_of(&Model::from_arrays(None, surfaces).unwrap());
        let diagonal = target.patches.bounding_box().diagonal();
        let points = points(&target, 60, random);
        for gap in [1e-6, 1e-2] {
            let share = check(&gpu, &target, &points, gap * diagonal, &name);
            println!("{name}: {} patches, {gap:e}: {share:?}", target.patches.len());
        }
    }
}
