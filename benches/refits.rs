//! Method `certified` between models and their refits, as fitters and
//! translators of CAD data make them.
//!
//! `cargo bench --bench refits [-- NAME …] [counts=12,24,40,80]
//! [tolerances=1e-6,1e-8] [cells=1000000] [runs=1]`: the models of `../shared/models`
//! whose names contain one of the names, refitted through count × count points
//! a surface. Prints a Markdown table of the distance in both directions with
//! the cells, the CPU seconds of all threads for preparation and for the search, which
//! other processes lengthen little (elsewhere than on Linux they are seconds), and the
//! seconds by the clock from control points in memory to the answer, each the least of so
//! many runs. A search ends at the limit of cells, marked by `>`.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod support;

use std::time::Instant;

use nurbs_hausdorff::internals::engine::{DistanceOptions, Engine, PreparedModel};
use nurbs_hausdorff::shapes::operations::{offset_surface, reduce_degree, refit_model};
use nurbs_hausdorff::shapes::{WavySheet, shape, wavy_sheet};
use nurbs_hausdorff::{Axis, CertifiedOptions, Method, Model};
use support::clock::Stopwatch;
use support::shared;

/// Our own shapes, beside the shared models.
const SHAPES: [&str; 3] = ["torus", "sphere", "wavy-sheet"];

struct Arguments {
    names: Vec<String>,
    counts: Vec<usize>,
    tolerances: Vec<f64>,
    max_cells: usize,
    runs: usize,
}

impl Arguments {
    fn read() -> Self {
        let mut arguments = Self {
            names: Vec::new(),
            counts: vec![12, 24, 40, 80],
            tolerances: vec![1e-6, 1e-8],
            max_cells: 1_000_000,
            runs: 1,
        };
        for argument in std::env::args().skip(1).filter(|argument| argument != "--bench") {
            match argument.split_once('=') {
                Some(("counts", list)) => {
                    arguments.counts = list.split(',').map(|count| count.parse().expect("a count")).collect();
                }
                Some(("tolerances", list)) => {
                    arguments.tolerances =
                        list.split(',').map(|tolerance| tolerance.parse().expect("a tolerance")).collect();
                }
                Some(("cells", cells)) => arguments.max_cells = cells.parse().expect("a number of cells"),
                Some(("runs", runs)) => arguments.runs = runs.parse().expect("a number of runs"),
                _ => arguments.names.push(argument),
            }
        }
        arguments
    }

    fn is_chosen(&self, name: &str) -> bool {
        self.names.is_empty() || self.names.iter().any(|part| name.contains(part))
    }
}

/// Prints the rows of a pair, both ways and for all tolerances.
fn print_rows(engine: &Engine, name: &str, pair: [&Model; 2], arguments: &Arguments) {
    for &tolerance in &arguments.tolerances {
        let [there, back] =
            [pair, [pair[1], pair[0]]].map(|pair| measured(engine, pair, tolerance, arguments));
        println!("| {name} | {tolerance:.0e} | {there} | {back} |");
    }
}

fn main() {
    let arguments = Arguments::read();
    let engine = Engine::cpu();
    println!(
        "| model | points | tolerance | distance / diagonal | cells | prepare, CPU s | search, CPU s | all, s | back: distance | cells | prepare | search | all |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    for (name, model) in models().into_iter().filter(|(name, _)| arguments.is_chosen(name)) {
        for &count in &arguments.counts {
            let refit = refit_model(&model, count).expect("a refit");
            print_rows(&engine, &format!("{name} | {count}"), [&model, &refit], &arguments);
        }
    }
    for (name, [a, b]) in others().into_iter().filter(|(name, _)| arguments.is_chosen(name)) {
        print_rows(&engine, &format!("{name} |"), [&a, &b], &arguments);
    }
}

/// The distance relative to the diagonal, the cells, the CPU seconds of preparation and
/// of the search, and the seconds of both by the clock.
fn measured(engine: &Engine, pair: [&Model; 2], tolerance: f64, arguments: &Arguments) -> String {
    let (mut prepare, mut solve, mut all) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
    let mut answer = String::new();
    for _ in 0..arguments.runs.max(1) {
        let clock = Instant::now();
        let preparation = Stopwatch::start(true);
        let [a, b] = pair.map(|model| PreparedModel::new(model).expect("valid trims"));
        let distance = |max_cells: usize| {
            let options = DistanceOptions {
                method: Method::Certified(CertifiedOptions {
                    max_cells: Some(max_cells),
                    ..Default::default()
                }),
                relative_tolerance: Some(tolerance),
                ..DistanceOptions::default()
            };
            engine.distance(&a, &b, &options).wait().expect("a distance")
        };
        // A search that ends after its first cell prepares all.
        distance(1);
        prepare = prepare.min(preparation.cpu_seconds());
        let search = Stopwatch::start(true);
        let result = distance(arguments.max_cells);
        solve = solve.min(search.cpu_seconds());
        all = all.min(clock.elapsed().as_secs_f64());
        let cells = result.certified().map_or(0, |details| details.cells);
        let mark = if result.converged { "" } else { ">" };
        answer = format!("{:.1e} | {mark}{cells}", result.computed / result.diagonal);
    }
    format!("{answer} | {prepare:.3} | {solve:.3} | {all:.3}")
}

/// Near copies of other kinds: reductions of degree, approximate offsets, and a net of
/// 100 × 100 patches with steep waves and one of jittered control points.
fn others() -> Vec<(String, [Model; 2])> {
    let mut pairs = Vec::new();
    for name in ["net-6x6", "wavy-sheet", "torus"] {
        let model = shape(name).expect("a shape");
        let surface = &model.surfaces()[0];
        let alone = Model::new(None, vec![surface.clone()]).expect("a model");
        let reduced =
            reduce_degree(surface, Axis::U).ok().and_then(|reduced| Model::new(None, vec![reduced]).ok());
        if let Some(reduced) = reduced {
            pairs.push((format!("{name}, reduced"), [alone.clone(), reduced]));
        }
        let size = model.bounding_box().diagonal();
        for distance in [1e-2, 1e-4] {
            let offset = offset_surface(surface, distance * size, [40, 40]).expect("an offset");
            let offset = Model::new(None, vec![offset]).expect("a model");
            pairs.push((format!("{name}, offset by {distance:.0e}"), [alone.clone(), offset]));
        }
    }
    let steep = wavy_sheet(&WavySheet {
        counts: [103, 103],
        size: [1.0, 1.0],
        amplitude: 0.2,
        waves: [12.0, 12.0],
        phase: 0.3,
    })
    .expect("a sheet");
    let mut arrays = steep.surfaces()[0].clone().into_arrays();
    let mut random = fastrand::Rng::with_seed(1);
    for point in &mut arrays.control_points {
        point[2] += 1e-3 * (random.f64() - 0.5);
    }
    let jittered = Model::from_arrays(None, vec![arrays]).expect("a model");
    pairs.push(("steep waves, jittered".to_owned(), [steep, jittered]));
    pairs
}

fn models() -> Vec<(String, Model)> {
    let mut models: Vec<(String, Model)> =
        SHAPES.iter().map(|name| ((*name).to_owned(), shape(name).expect("a shape"))).collect();
    let Some(folder) = shared::folder() else {
        println!("SKIPPED the shared models: there is no ../shared/models");
        return models;
    };
    let mut paths: Vec<_> =
        std::fs::read_dir(folder).expect("a folder").flatten().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths.into_iter().filter(|path| path.extension().is_some_and(|extension| extension == "json"))
    {
        let text = std::fs::read_to_string(&path).expect("a model");
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        models.push((name, Model::from_json(&text).expect("a valid model")));
    }
    models
}
