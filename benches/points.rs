//! The native side of `benches/points.mjs`: the closest points of a model, the first
//! argument, to the points in the file of float64 numbers that is the second; prints
//! the seconds of the preparation and of all points.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::expect_used, reason = "a benchmark ends where it cannot run")]

use nurbs_hausdorff::engine::{Backend, ClosestPointOptions, Engine, PreparedModel};
use nurbs_hausdorff::{Model, NoMonitor};
use std::time::Instant;

fn main() {
    let mut paths = std::env::args().skip(1).filter(|argument| !argument.starts_with("--"));
    let (Some(model), Some(points)) = (paths.next(), paths.next()) else { return };
    let bytes = std::fs::read(points).expect("the points' file");
    let points: Vec<f64> = bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    let model =
        Model::from_json(&std::fs::read_to_string(model).expect("the model's file")).expect("a model");
    let engine = pollster::block_on(Engine::new(Backend::Cpu)).expect("an engine on the CPU");
    let options = ClosestPointOptions::default();
    let prepared = PreparedModel::new(&model).expect("valid trims");
    // The first points pay for the cuts and the tree.
    let closest = |points: &[f64]| {
        let started = Instant::now();
        let found = pollster::block_on(engine.closest_points(&prepared, points, &options, &mut NoMonitor))
            .expect("closest points");
        (started.elapsed().as_secs_f64(), found)
    };
    let (prepare, _) = closest(&points[..3]);
    let (seconds, found) = closest(&points);
    let widest = found.bounds.iter().copied().fold(0.0, f64::max);
    println!("{{\"prepare\": {prepare}, \"seconds\": {seconds}, \"bound\": {widest:e}}}");
}
