//! The native side of `npm run bench`: reads one pair a line from standard
//! input, `{"a", "b", "translation"}` with the models' files, and prints the
//! seconds of one distance as JSON. `benches/package/package.mjs` runs it in turn with
//! the built package, in one process each, so that neither start is measured.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::expect_used, reason = "a benchmark ends where it cannot run")]

use glam::DVec3;
use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions, Engine, PreparedModel};
use nurbs_hausdorff::{Model, RigidTransform};
use serde_json::{Value, json};
use std::io::Write;
use std::time::Instant;

fn main() {
    let engine = Engine::cpu();
    for line in std::io::stdin().lines() {
        let pair: Value = serde_json::from_str(&line.expect("a line")).expect("a pair");
        println!("{}", seconds(&engine, &pair));
        std::io::stdout().flush().expect("standard output");
    }
}

/// The seconds from the models' texts to the answer, in parts, and the interval.
fn seconds(engine: &Engine, pair: &Value) -> Value {
    let [a, b] = ["a", "b"]
        .map(|name| std::fs::read_to_string(pair[name].as_str().expect("a path")).expect("the model's file"));
    let [x, y, z] = [0, 1, 2].map(|axis| pair["translation"][axis].as_f64().expect("a number"));
    let transform = RigidTransform::translation(DVec3::new(x, y, z)).expect("a translation");
    let options = DistanceOptions { transform, backend: Backend::Cpu, ..DistanceOptions::default() };

    let started = Instant::now();
    let [a, b] = [a, b]
        .map(|text| PreparedModel::new(&Model::from_json(&text).expect("a model")).expect("valid trims"));
    let models = started.elapsed().as_secs_f64();
    let result = engine.distance(&a, &b, &options).wait().expect("a distance");
    let total = started.elapsed().as_secs_f64();
    json!({
        "models": models,
        "prepare": result.seconds.prepare,
        "solve": result.seconds.solve,
        "total": total,
        "lower": result.lower,
        "upper": result.upper,
    })
}
