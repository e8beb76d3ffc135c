//! The native side of `benches/points/points.mjs`: the closest points of a model, the first
//! argument, to the points in the file of float64 numbers that is the second; prints
//! the seconds by the clock and by the processor, and the widest bound.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::expect_used, reason = "a benchmark ends where it cannot run")]

use nurbs_hausdorff::Model;
use nurbs_hausdorff::internals::engine::{ClosestPointOptions, Engine, PreparedModel};
use std::time::Instant;

fn main() {
    let mut paths = std::env::args().skip(1).filter(|argument| !argument.starts_with("--"));
    let (Some(model), Some(points)) = (paths.next(), paths.next()) else { return };
    let bytes = std::fs::read(points).expect("the points' file");
    let points: Vec<f64> = bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    let model =
        Model::from_json(&std::fs::read_to_string(model).expect("the model's file")).expect("a model");
    let engine = Engine::cpu();
    let options = ClosestPointOptions::default();
    let prepared = PreparedModel::new(&model).expect("valid trims");
    let closest =
        |points: &[f64]| engine.closest_points(&prepared, points, &options).wait().expect("closest points");
    // The first points pay for the cuts and the tree.
    closest(&points[..3]);
    let (started, used) = (Instant::now(), processor_seconds());
    let found = closest(&points);
    let (seconds, busy) = (started.elapsed().as_secs_f64(), processor_seconds() - used);
    let bound = found.bounds.iter().copied().fold(0.0, f64::max);
    println!("{{\"seconds\": {seconds}, \"busy\": {busy}, \"bound\": {bound:e}}}");
}

/// The processor's time of all threads of this process, by Linux's file of it, whose
/// fields 14 and 15 count hundredths of seconds.
fn processor_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after_name = stat.rsplit(')').next().unwrap_or_default();
    after_name.split_whitespace().skip(11).take(2).filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>()
        / 100.0
}
