//! Frames a second of a deforming sheet against a fixed part, each frame an update
//! of its control points and one directed distance: `cargo bench --bench frames`.
//! `benches/frames/frames.mjs` measures the same in the package.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::expect_used, reason = "a benchmark ends where it cannot run")]

use nurbs_hausdorff::internals::engine::{DistanceOptions, Engine, MethodName, PreparedModel};
use nurbs_hausdorff::{Model, SurfaceArrays, shapes};
use std::time::Instant;

/// The degree of the sheet along both axes.
const DEGREE: usize = 3;

/// The frames before the clock starts.
const WARM_UP: usize = 3;

/// Sizes of the sheet's net, and the frames measured.
const SIZES: [([usize; 2], usize); 2] = [([14, 13], 120), ([100, 100], 12)];

fn main() {
    let engine = Engine::cpu();
    let fixed = PreparedModel::new(&shapes::shape("torus").expect("a shape")).expect("valid trims");
    println!("net, method                frames/s   median ms  fastest ms  of which update ms");
    for (counts, frames) in SIZES {
        for method in [MethodName::Certified, MethodName::Hierarchy] {
            let options = DistanceOptions {
                method: method.into(),
                relative_tolerance: Some(1e-4),
                ..DistanceOptions::default()
            };
            let source = sheet(counts);
            let mut prepared = PreparedModel::new(&source).expect("valid trims");
            let (mut times, mut updates) = (Vec::new(), 0.0);
            for frame in 0..frames + WARM_UP {
                let net = points(counts, 0.1 * frame as f64);
                let started = Instant::now();
                prepared = prepared
                    .updated(&source.with_control_points(0, net).expect("a surface"))
                    .expect("valid trims");
                let updated = started.elapsed().as_secs_f64();
                engine.distance(&prepared, &fixed, &options).wait().expect("a distance");
                if frame >= WARM_UP {
                    times.push(1e3 * started.elapsed().as_secs_f64());
                    updates += 1e3 * updated;
                }
            }
            let count = times.len() as f64;
            let rate = 1e3 * count / times.iter().sum::<f64>();
            times.sort_by(f64::total_cmp);
            let (median, fastest) = (times[times.len() / 2], times[0]);
            let name = format!("{} x {}, {method:?}", counts[0], counts[1]);
            println!("{name:<24} {rate:11.2} {median:11.2} {fastest:11.2} {:11.2}", updates / count);
        }
    }
}

/// A sheet across the unit torus.
fn sheet(counts: [usize; 2]) -> Model {
    let knots = counts.map(|count| {
        (0..=count + DEGREE).map(|index| index.saturating_sub(DEGREE).min(count - DEGREE) as f64).collect()
    });
    let control_points = points(counts, 0.0);
    let arrays = SurfaceArrays { degree: [DEGREE; 2], knots, counts, control_points };
    Model::from_arrays(None, vec![arrays]).expect("a surface")
}

/// The sheet's net with a wave that runs through it.
fn points([rows, columns]: [usize; 2], time: f64) -> Vec<[f64; 4]> {
    let at = |index: usize, count: usize| 3.0 * index as f64 / (count - 1) as f64 - 1.5;
    let point = |index: usize| {
        let (x, y) = (at(index / columns, rows), at(index % columns, columns));
        [x, y, 0.3 * (2.0 * x + 1.5 * y + time).sin(), 1.0]
    };
    (0..rows * columns).map(point).collect()
}
