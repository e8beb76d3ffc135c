//! The work of statistics: what a change of them is judged by.
//!
//! `cargo bench --bench statistics [-- NAME …] [cells=N]`, with `RAYON_NUM_THREADS=1` for one thread. Prints the parts
//! and the CPU seconds of each pair whose name contains one of these words, with its intervals at the default
//! tolerance. Pairs are the STEP and STL files of `../shared/models/so101`, both ways.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod support;

use flate2::read::GzDecoder;
use nurbs_hausdorff::StatisticsOptions;
use nurbs_hausdorff::internals::engine::{Engine, PreparedModel};
use nurbs_hausdorff_cad::from_step;
use nurbs_hausdorff_meshes::{MeshFile, MeshFormat};
use std::io::Read;
use std::path::Path;
use support::clock::Stopwatch;
use support::shared;

const PARTS: [&str; 8] = [
    "Base",
    "Motor_holder_SO101_Base",
    "Motor_holder_SO101_Wrist",
    "Rotation_Pitch",
    "Seeedstudio_Mounting_Plate",
    "Trigger",
    "Upper_arm",
    "WaveShare_Mounting_Plate",
];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let cells = arguments.iter().find_map(|word| word.strip_prefix("cells="));
    let max_cells = cells.map(|count| count.parse().expect("a number"));
    let words: Vec<&String> = arguments.iter().filter(|word| !word.contains('=')).collect();
    let Some(folder) = shared::folder() else {
        println!("SKIPPED: there is no ../shared/models");
        return;
    };
    println!("| pair | tolerance | parts | CPU s | mean | RMS | 0.99 | converged |");
    println!("|---|---|---|---|---|---|---|---|");
    for part in PARTS {
        let names =
            [("STEP to STL", 0), ("STL to STEP", 1)].map(|(way, from)| (format!("{part} {way}"), from));
        let is_chosen =
            |name: &str| words.is_empty() || words.iter().any(|word| name.contains(word.as_str()));
        if !names.iter().any(|(name, _)| is_chosen(name)) {
            continue;
        }
        let file = if part.contains("SO101") { part.to_owned() } else { format!("{part}_SO101") };
        let models = both(&folder.join("so101"), &file);
        for (name, from) in names.iter().filter(|(name, _)| is_chosen(name)) {
            measure(name, &models[*from], &models[1 - *from], max_cells);
        }
    }
}

fn measure(name: &str, a: &PreparedModel, b: &PreparedModel, max_cells: Option<usize>) {
    let default = StatisticsOptions::default();
    let options = StatisticsOptions { max_cells: max_cells.unwrap_or(default.max_cells), ..default };
    let watch = Stopwatch::start(true);
    let found = Engine::cpu().statistics(a, b, &options).wait().expect("statistics");
    let spent = watch.cpu_seconds();
    let (mean, rms, high) = (found.mean, found.rms, found.percentiles[2].distance);
    println!(
        "| {name} | {:.5} | {} | {spent:.2} | {:.6} to {:.6} | {:.6} to {:.6} | {:.6} to {:.6} | {} |",
        found.tolerance,
        found.cells,
        mean.lower,
        mean.upper,
        rms.lower,
        rms.upper,
        high.lower,
        high.upper,
        found.converged
    );
}

/// The part as STEP and as STL.
fn both(folder: &Path, name: &str) -> [PreparedModel; 2] {
    let bytes = |ending: &str| {
        let mut bytes = Vec::new();
        let file = std::fs::File::open(folder.join(format!("{name}.{ending}.gz"))).expect("a file");
        GzDecoder::new(file).read_to_end(&mut bytes).expect("gzip");
        bytes
    };
    let (model, mut report) = from_step(&bytes("step")).expect("STEP");
    let (_, model) = PreparedModel::new_skipping(model, &mut report).expect("faces");
    let facets = MeshFile::read(&bytes("stl"), MeshFormat::Stl).expect("a mesh").facets;
    [model, PreparedModel::of_facets(&facets, None).expect("a mesh")]
}
