//! Method `certified` on the models of others in `../shared/models`.
//!
//! `cargo bench --bench models [-- NAME]`: pairs whose names contain NAME.
//! Prints Markdown tables: every model against itself moved and turned, and
//! the reference pairs, at the default tolerance and at 1e-9. Without that
//! folder it says that all is skipped.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod support;

use glam::{DQuat, DVec3};
use nurbs_hausdorff::RigidTransform;
use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions, DistanceResult, Engine, PreparedModel};
use std::collections::BTreeMap;
use std::path::Path;
use support::shared::{self, Reference};

/// The number of rounds; the fastest is printed, as other processes only add.
const ROUNDS: usize = 3;

/// What a model is moved by, relative to its diagonal.
const MOVE: DVec3 = DVec3::new(0.01, 0.005, 0.002);

/// Degrees that a model is turned by, about the z axis.
const TURN: f64 = 1.0;

/// Tolerances of the reference pairs, relative to the diagonal.
const TOLERANCES: [f64; 2] = [1e-6, 1e-9];

fn main() {
    let requested = std::env::args().skip(1).find(|argument| !argument.starts_with('-')).unwrap_or_default();
    let Some(folder) = shared::folder() else {
        println!("SKIPPED models: there is no ../shared/models");
        return;
    };
    let names = names(&folder);
    let shelf: BTreeMap<&str, PreparedModel> =
        names.iter().map(|name| (name.as_str(), shared::load(&folder, name))).collect();
    let bench = Bench { engine: Engine::cpu(), shelf, requested };
    bench.copies();
    let references = shared::references(&folder);
    for tolerance in TOLERANCES {
        bench.references(&references, tolerance);
    }
}

/// Every model of the folder, in order.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "json"))
        .filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()))
        .collect();
    names.sort();
    names
}

struct Bench<'a> {
    engine: Engine,
    shelf: BTreeMap<&'a str, PreparedModel>,
    /// What names of pairs contain.
    requested: String,
}

impl Bench<'_> {
    /// Every model against itself. A copy moved is no farther than it was moved.
    fn copies(&self) {
        let mut table = Table::begin("Models against themselves, at 1e-6", "at most the move");
        for (name, model) in &self.shelf {
            let shift = MOVE * model.bounding_box().diagonal();
            let moved = RigidTransform::translation(shift).expect("a finite move");
            let turn = DQuat::from_axis_angle(DVec3::Z, TURN.to_radians());
            let turned = RigidTransform::new(turn, DVec3::ZERO).expect("a rotation");
            let within = |[lower, _]: [f64; 2]| yes_or_no(lower <= shift.length());
            self.measure(&mut table, &format!("{name} moved"), [model; 2], moved, TOLERANCES[0], &within);
            let unknown = |_| "";
            self.measure(&mut table, &format!("{name} turned"), [model; 2], turned, TOLERANCES[0], &unknown);
        }
        table.end();
    }

    fn references(&self, references: &[Reference], tolerance: f64) {
        let title = format!("Reference pairs, at {tolerance:e}");
        let mut table = Table::begin(&title, "overlaps the reference");
        for reference in references {
            let Reference { a, b, translation, interval } = reference;
            let models = [a, b].map(|name| &self.shelf[name.as_str()]);
            let moved = RigidTransform::translation(*translation).expect("a finite move");
            // A copy moved is no farther than it was moved; one reference says so.
            let impossible = a == b && interval[0] > translation.length();
            let overlap = |[lower, upper]: [f64; 2]| match lower <= interval[1] && interval[0] <= upper {
                false if impossible => "no: that is more than the move",
                overlaps => yes_or_no(overlaps),
            };
            let name = format!("{a} to {b} {translation}");
            self.measure(&mut table, &name, models, moved, tolerance, &overlap);
        }
        table.end();
    }

    fn measure(
        &self,
        table: &mut Table,
        name: &str,
        [a, b]: [&PreparedModel; 2],
        transform: RigidTransform,
        tolerance: f64,
        judge: &dyn Fn([f64; 2]) -> &'static str,
    ) {
        if !name.contains(&self.requested) {
            return;
        }
        let options = DistanceOptions {
            relative_tolerance: Some(tolerance),
            transform,
            backend: Backend::Cpu,
            ..DistanceOptions::default()
        };
        let run = || self.engine.distance(a, b, &options).wait().expect("a distance");
        let fastest = (1..ROUNDS).fold(run(), |fastest, _| {
            let again = run();
            if again.seconds.solve < fastest.seconds.solve { again } else { fastest }
        });
        table.row(name, &fastest, judge([fastest.lower, fastest.upper]));
    }
}

fn yes_or_no(answer: bool) -> &'static str {
    if answer { "yes" } else { "no" }
}

/// A Markdown table that is summed up at its end.
struct Table {
    seconds: Vec<f64>,
    converged: usize,
}

impl Table {
    fn begin(title: &str, judged: &str) -> Self {
        println!("### {title}\n");
        println!("| pair | cells | solve, ms | width / diagonal | {judged} |");
        println!("|---|---|---|---|---|");
        Self { seconds: Vec::new(), converged: 0 }
    }

    fn row(&mut self, name: &str, result: &DistanceResult, judgement: &str) {
        let cells = result.certified().map_or(0, |details| details.cells);
        let wide = if result.converged { "" } else { ", not converged" };
        println!(
            "| {name} | {cells} | {:.1} | {:.1e}{wide} | {judgement} |",
            result.seconds.solve * 1e3,
            (result.upper - result.lower) / result.diagonal,
        );
        self.seconds.push(result.seconds.solve);
        self.converged += usize::from(result.converged);
    }

    fn end(mut self) {
        self.seconds.sort_by(f64::total_cmp);
        let count = self.seconds.len();
        let median = self.seconds.get(count / 2).copied().unwrap_or_default();
        let slowest = self.seconds.last().copied().unwrap_or_default();
        println!(
            "\n{} of {count} converge; median {:.1} ms, slowest {:.1} ms.\n",
            self.converged,
            median * 1e3,
            slowest * 1e3,
        );
    }
}
