//! The methods side by side on the same pairs in the same run, in turn.
//!
//! `cargo bench --bench methods [-- NAME]`: pairs whose names contain NAME.
//! Prints a Markdown table of solve times and of ratios to `certified`.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod support;

use glam::DVec3;
use nurbs_hausdorff::RigidTransform;
use nurbs_hausdorff::internals::closest::Projection;
use nurbs_hausdorff::internals::engine::{
    Backend, DistanceOptions, Engine, IterationOptions, Method, MethodName, PreparedModel,
};
use nurbs_hausdorff::internals::iteration::Culling;
use nurbs_hausdorff::shapes;
use support::shared::{self, Reference};

/// The number of rounds; the median is printed.
const ROUNDS: usize = 5;

/// Projections of samples on patches beyond which the published schedule is left out.
const MAX_PROJECTIONS: usize = 400_000_000;

struct Pair {
    name: String,
    a: PreparedModel,
    b: PreparedModel,
    translation: DVec3,
}

fn main() {
    let requested = std::env::args().skip(1).find(|argument| !argument.starts_with('-')).unwrap_or_default();
    let engine = Engine::new_blocking(Backend::Auto).expect("an engine");
    println!("Adapter: {}\n", engine.adapter().unwrap_or_else(|| "none, on the CPU".to_owned()));
    println!(
        "| pair | patches of B | certified 1e-6, ms | cells | with the GPU, ms (cells there) | iteration 64, ms (ratio) | as published, ms (ratio) |"
    );
    println!("|---|---|---|---|---|---|---|");
    for pair in pairs().into_iter().filter(|pair| pair.name.contains(&requested)) {
        measure(&engine, &pair);
    }
}

fn measure(engine: &Engine, pair: &Pair) {
    let moved = DistanceOptions {
        transform: RigidTransform::translation(pair.translation).expect("a finite translation"),
        ..DistanceOptions::default()
    };
    let certified =
        DistanceOptions { method: MethodName::Certified.into(), backend: Backend::Cpu, ..moved.clone() };
    let on_gpu = DistanceOptions { backend: Backend::Gpu, ..certified.clone() };
    let iteration = DistanceOptions { method: MethodName::Iteration.into(), ..moved };
    let published = DistanceOptions {
        method: Method::Iteration(IterationOptions {
            projection: Projection::TangentPlane,
            culling: Culling::None,
            ..Default::default()
        }),
        ..iteration.clone()
    };
    let run =
        |options: &DistanceOptions| engine.distance(&pair.a, &pair.b, options).wait().expect("a distance");
    let first = run(&certified);
    let samples = run(&iteration).iteration().expect("an iteration").samples;
    let all = samples * first.patches.b <= MAX_PROJECTIONS;
    let helped = run(&on_gpu).certified().map_or(0, |details| details.cells - details.cpu_cells);
    let mut times = [Vec::new(), Vec::new(), Vec::new(), Vec::new()];
    for round in 0..ROUNDS {
        times[0].push(run(&certified).seconds.solve);
        times[1].push(run(&iteration).seconds.solve);
        if all && round == 0 {
            times[2].push(run(&published).seconds.solve);
        }
        if helped > 0 {
            times[3].push(run(&on_gpu).seconds.solve);
        }
    }
    let [certified, iteration, published, on_gpu] = times.map(median);
    let cell = |seconds: Option<f64>| match (seconds, certified) {
        (Some(seconds), Some(certified)) => format!("{:.1} ({:.1}x)", seconds * 1e3, seconds / certified),
        _ => "too long".to_owned(),
    };
    println!(
        "| {} | {} | {:.1} | {} | {} | {} | {} |",
        pair.name,
        first.patches.b,
        certified.unwrap_or_default() * 1e3,
        first.certified().map_or(0, |details| details.cells),
        on_gpu.map_or("not used".to_owned(), |seconds| format!("{:.1} ({helped})", seconds * 1e3)),
        cell(iteration),
        cell(published),
    );
}

fn median(mut times: Vec<f64>) -> Option<f64> {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied()
}

/// Pairs of our own shapes, and those of the shared references if they are there.
fn pairs() -> Vec<Pair> {
    let shape = |name: &str| PreparedModel::new(&shapes::shape(name).expect("a shape")).expect("valid trims");
    let own = [
        ("sphere", "sphere-larger", DVec3::ZERO),
        ("torus", "torus-fatter", DVec3::ZERO),
        ("glass", "bottle", DVec3::new(0.3, 0.1, 0.0)),
        ("naca-wing", "naca-wing-thicker", DVec3::ZERO),
        ("wavy-sheet", "wavy-sheet-b", DVec3::ZERO),
    ];
    let mut pairs: Vec<Pair> = own
        .into_iter()
        .map(|(a, b, translation)| Pair {
            name: format!("{a} to {b}"),
            a: shape(a),
            b: shape(b),
            translation,
        })
        .collect();
    let Some(folder) = shared::folder() else { return pairs };
    for Reference { a, b, translation, .. } in shared::references(&folder) {
        let name = format!("{a} to {b} {translation}");
        pairs.push(Pair { name, a: shared::load(&folder, &a), b: shared::load(&folder, &b), translation });
    }
    pairs
}
