//! Times parry's distances and intersection tests of two triangle meshes at given poses.
//!
//! Reads one JSON object from standard input: `meshes`, each with `points` and `triangles`, and `poses`
//! of the first one, each with `quaternion` (x, y, z, w) and `translation`. Prints a JSON array with the
//! distance and the milliseconds of both calls for each pose, by the clock, the least of three.

use parry3d_f64::glamx::DQuat;
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::{distance, intersection_test};
use parry3d_f64::shape::TriMesh;
use serde_json::{Value, json};
use std::error::Error;
use std::time::Instant;

/// The number of runs of each call. The shortest one counts, as other processes lengthen the others.
const REPEATS: usize = 3;

fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let values: Vec<f64> = value.as_array()?.iter().map(Value::as_f64).collect::<Option<_>>()?;
    values.try_into().ok()
}

fn mesh(value: &Value) -> Option<TriMesh> {
    let points = value["points"].as_array()?.iter().map(|point| numbers(point).map(Vector::from_array));
    let triangles = value["triangles"]
        .as_array()?
        .iter()
        .map(|triangle| numbers(triangle).map(|t: [f64; 3]| t.map(|i| i as u32)));
    TriMesh::new(points.collect::<Option<_>>()?, triangles.collect::<Option<_>>()?).ok()
}

fn timed<T>(work: impl Fn() -> T) -> (T, f64) {
    let runs = (0..REPEATS).map(|_| {
        let started = Instant::now();
        let value = work();
        (value, 1e3 * started.elapsed().as_secs_f64())
    });
    runs.min_by(|a, b| a.1.total_cmp(&b.1)).expect("at least one run")
}

fn main() -> Result<(), Box<dyn Error>> {
    let input: Value = serde_json::from_reader(std::io::stdin())?;
    let [a, b] = [0, 1].map(|side| mesh(&input["meshes"][side]).expect("a mesh"));
    let fixed = Pose::IDENTITY;
    let mut rows = Vec::new();
    for pose in input["poses"].as_array().into_iter().flatten() {
        let turn = DQuat::from_array(numbers(&pose["quaternion"]).expect("four numbers"));
        let place = Vector::from_array(numbers(&pose["translation"]).expect("three numbers"));
        let moved = Pose::from_parts(place, turn);
        let (found, spent) = timed(|| distance(&moved, &a, &fixed, &b));
        let (_, test) = timed(|| intersection_test(&moved, &a, &fixed, &b));
        rows.push(json!([found?.distance, spent, test]));
    }
    println!("{}", Value::from(rows));
    Ok(())
}
