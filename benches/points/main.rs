//! The closest points of a model to many points, by the processor's time.
//!
//! `cargo bench --bench points -- MODEL POINTS`: to the points in a file of float64 numbers, the
//! native side of `benches/points/points.mjs`; prints the seconds by the clock and by the processor,
//! and the widest bound.
//!
//! `cargo bench --bench points -- MODEL near|box COUNT [RELATIVE_TOLERANCE [gpu]]`: to random points within a
//! hundredth of the diagonal of the model, or all over its box; prints points a second of one core as well, and a
//! digest of the distances, to compare one build with another. With `gpu`, the share of points that its feet and
//! bounds decided, and the number of points whose interval misses the one of the search at 1e-9. MODEL is JSON, STL, IGES or STEP, or the name of a shape of the library.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::expect_used, reason = "a benchmark ends where it cannot run")]

#[path = "../support/mod.rs"]
mod support;

use glam::DVec3;
use nurbs_hausdorff::internals::engine::{
    Backend, ClosestPointOptions, ClosestPoints, Engine, PreparedModel,
};
use nurbs_hausdorff::shapes::shape;
use std::path::Path;
use std::time::Instant;
use support::clock::Stopwatch;
use support::random::Random;
use support::shared::load_file;

/// The largest distance along an axis of points near a model, as a fraction of its diagonal.
const NEAR: f64 = 0.01;

fn main() {
    let arguments: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let [model, points, rest @ ..] = &arguments[..] else { return };
    let prepared = match shape(model) {
        Ok(shape) => PreparedModel::new(&shape).expect("a model"),
        Err(_) => load_file(Path::new(model)),
    };
    let number = |index: usize| rest.get(index).map(|text| text.parse::<f64>().expect("a number"));
    let backend =
        if rest.get(2).is_some_and(|backend| backend == "gpu") { Backend::Gpu } else { Backend::Cpu };
    let options =
        ClosestPointOptions { relative_tolerance: number(1), backend, ..ClosestPointOptions::default() };
    let count = number(0).map_or(100_000, |count| count as usize);
    let points = match points.as_str() {
        "box" => in_box(&prepared, count),
        "near" => near(&prepared, count),
        file => of_file(Path::new(file)),
    };
    let engine = Engine::new_blocking(backend).expect("an adapter");
    let closest =
        |points: &[f64]| engine.closest_points(&prepared, points, &options).wait().expect("closest points");
    // The first points pay for the cuts and the tree.
    closest(&points[..3]);
    let (started, watch) = (Instant::now(), Stopwatch::start(true));
    let found = closest(&points);
    let (seconds, busy) = (started.elapsed().as_secs_f64(), watch.cpu_seconds());
    let bound = found.bounds.iter().copied().fold(0.0, f64::max);
    let rate = found.distances.len() as f64 / busy;
    let sum: f64 = found.distances.iter().sum();
    let inside = found.signed.iter().filter(|signed| **signed < 0.0).count();
    let decided = found.decided_on_gpu as f64 / found.distances.len() as f64;
    let apart = if backend == Backend::Gpu { apart(&prepared, &points, &found) } else { 0 };
    println!(
        "{{\"seconds\": {seconds}, \"busy\": {busy}, \"bound\": {bound:e}, \"rate\": {rate:.0}, \"sum\": {sum:?}, \
         \"inside\": {inside}, \"decided\": {decided}, \"apart\": {apart}}}"
    );
}

/// The number of points whose interval has no point of the one that the search on the CPU has.
fn apart(model: &PreparedModel, points: &[f64], found: &ClosestPoints) -> usize {
    let options = ClosestPointOptions::default();
    let exact = Engine::cpu().closest_points(model, points, &options).wait().expect("closest points");
    let apart = |&index: &usize| {
        let between = (found.distances[index] - exact.distances[index]).abs();
        // A NaN is in no interval.
        !(between <= found.bounds[index] + exact.bounds[index])
    };
    (0..found.distances.len()).filter(apart).count()
}

fn of_file(path: &Path) -> Vec<f64> {
    let bytes = std::fs::read(path).expect("the points' file");
    bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect()
}

/// Random points of the model's box.
fn in_box(model: &PreparedModel, count: usize) -> Vec<f64> {
    let (aabb, mut random) = (model.bounding_box(), Random(7));
    let mut point = || aabb.min + aabb.extent() * DVec3::from_array(std::array::from_fn(|_| random.next()));
    (0..count).flat_map(|_| point().to_array()).collect()
}

/// The feet of random points, each moved.
fn near(model: &PreparedModel, count: usize) -> Vec<f64> {
    let reach = NEAR * model.bounding_box().diagonal();
    let (engine, mut random) = (Engine::cpu(), Random(11));
    let options = ClosestPointOptions { sign_tolerance: f64::MAX, ..ClosestPointOptions::default() };
    let feet = engine.closest_points(model, &in_box(model, count), &options).wait().expect("feet").feet;
    feet.into_iter().map(|foot| foot + reach * (2.0 * random.next() - 1.0)).collect()
}
