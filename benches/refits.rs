//! Method `certified` between models and their refits, as fitters and
//! translators of CAD data make them.
//!
//! `cargo bench --bench refits [-- NAME …] [counts=12,24,40,80]
//! [tolerances=1e-6,1e-8] [cells=1000000]`: the models of `../shared/models`
//! whose names contain one of the names, refitted through count × count points
//! a surface. Prints a Markdown table of the distance in both directions with
//! the cells and the seconds of preparation and of the search; a search ends at
//! the limit of cells, marked by `>`.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod support;

use nurbs_hausdorff::Model;
use nurbs_hausdorff::engine::{Backend, Engine, Options, PreparedModel};
use nurbs_hausdorff::progress::NoMonitor;
use nurbs_hausdorff::shapes::operations::refit_model;
use nurbs_hausdorff::shapes::shape;
use std::time::Instant;
use support::shared;

/// Control points of a refit above which it is left out: the largest models
/// would take gigabytes.
const MAX_CONTROL_POINTS: usize = 400_000;

/// Our own shapes, beside the shared models.
const SHAPES: [&str; 3] = ["torus", "sphere", "wavy-sheet"];

struct Arguments {
    names: Vec<String>,
    counts: Vec<usize>,
    tolerances: Vec<f64>,
    max_cells: usize,
}

impl Arguments {
    fn read() -> Self {
        let mut arguments = Self {
            names: Vec::new(),
            counts: vec![12, 24, 40, 80],
            tolerances: vec![1e-6, 1e-8],
            max_cells: 1_000_000,
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
                _ => arguments.names.push(argument),
            }
        }
        arguments
    }

    fn is_chosen(&self, name: &str) -> bool {
        self.names.is_empty() || self.names.iter().any(|part| name.contains(part))
    }
}

fn main() {
    let arguments = Arguments::read();
    let engine = pollster::block_on(Engine::new(Backend::Cpu)).expect("an engine");
    println!(
        "| model | points | tolerance | distance / diagonal | prepare, s | cells | s | back: distance | prepare, s | cells | s |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    for (name, model) in models().into_iter().filter(|(name, _)| arguments.is_chosen(name)) {
        for &count in &arguments.counts {
            if model.surfaces().len() * count * count > MAX_CONTROL_POINTS {
                continue;
            }
            let refit = refit_model(&model, count).expect("a refit");
            for &tolerance in &arguments.tolerances {
                let [there, back] = [[&model, &refit], [&refit, &model]]
                    .map(|pair| measured(&engine, pair, tolerance, arguments.max_cells));
                println!("| {name} | {count} | {tolerance:.0e} | {there} | {back} |");
            }
        }
    }
}

/// The distance relative to the diagonal, the seconds of preparation, the cells
/// and the seconds of the search.
fn measured(engine: &Engine, pair: [&Model; 2], tolerance: f64, max_cells: usize) -> String {
    let started = Instant::now();
    let [a, b] = pair.map(|model| PreparedModel::new(model).expect("valid trims"));
    let extraction = started.elapsed().as_secs_f64();
    let options = Options { tolerance, max_cells: Some(max_cells), ..Options::default() };
    let result = pollster::block_on(engine.distance(&a, &b, &options, &mut NoMonitor)).expect("a distance");
    let cells = result.certified().map_or(0, |details| details.cells);
    let mark = if result.converged { "" } else { ">" };
    let (prepare, solve) = (extraction + result.seconds.prepare, result.seconds.solve);
    format!("{:.1e} | {prepare:.3} | {mark}{cells} | {solve:.3}", result.computed / result.diagonal)
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
