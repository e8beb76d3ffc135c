//! The experiments, each with a table and a figure.

mod chart;
mod convergence;
mod figure5;
mod inputs;
mod methods;
mod nurbs_evaluation;
mod order;
mod patch_count;
mod sampling_rule;
mod split_rule;
mod sweep;
mod table;

use nurbs_hausdorff::internals::engine::{Backend, DistanceOptions, DistanceResult, Engine, PreparedModel};
use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;
pub(crate) use table::{Cell, Table};

/// A result with any error.
pub(crate) type Anyhow<T> = Result<T, Box<dyn Error>>;

/// The output folder, the extent of the measurements, and the engine.
#[derive(Debug)]
pub(crate) struct Setup {
    pub(crate) out: PathBuf,
    /// Whether to use few positions, few samples and small models.
    pub(crate) quick: bool,
    only: String,
    engine: Engine,
}

impl Setup {
    /// Creates the folder, and an engine on the GPU if there is one.
    pub(crate) fn new(out: PathBuf, quick: bool, only: String) -> Anyhow<Self> {
        std::fs::create_dir_all(&out)?;
        Ok(Self { out, quick, only, engine: Engine::new_blocking(Backend::Auto)? })
    }

    /// Returns whether files of this name, or some that begin with it, are requested.
    pub(crate) fn is_requested(&self, name: &str) -> bool {
        name.contains(&self.only) || self.only.starts_with(name)
    }

    /// Computes the distance from `a` to `b`.
    pub(crate) fn measure(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        options: &DistanceOptions,
    ) -> nurbs_hausdorff::Result<DistanceResult> {
        self.engine.distance(a, b, options).wait()
    }

    /// Returns `full`, or `quick` in a quick run.
    pub(crate) fn choose<T>(&self, full: T, quick: T) -> T {
        if self.quick { quick } else { full }
    }

    /// Writes NAME.csv and NAME.svg.
    pub(crate) fn save(&self, name: &str, table: &Table, panels: &[chart::Panel]) -> Anyhow<()> {
        table.save(&self.out.join(format!("{name}.csv")))?;
        chart::save(&self.out.join(format!("{name}.svg")), panels)
    }
}

type Experiment = fn(&Setup) -> Anyhow<()>;

/// Every experiment with the name of its files; a sweep's pair follows a hyphen.
const EXPERIMENTS: [(&str, Experiment); 8] = [
    ("sweep", sweep::run),
    ("figure5", figure5::run),
    ("nurbs-evaluation", nurbs_evaluation::run),
    ("split-rule", split_rule::run),
    ("sampling-rule", sampling_rule::run),
    ("convergence", convergence::run),
    ("order", order::run),
    ("patch-count", patch_count::run),
];

/// Runs the requested experiments.
pub(crate) fn run(setup: &Setup) -> Anyhow<()> {
    let adapter = setup.engine.adapter().unwrap_or_else(|| "none, everything runs on the CPU".to_owned());
    println!("GPU: {adapter}");
    for (name, experiment) in EXPERIMENTS.iter().filter(|(name, _)| setup.is_requested(name)) {
        let started = Instant::now();
        experiment(setup)?;
        println!("{name}: {:.1} s", started.elapsed().as_secs_f64());
    }
    Ok(())
}
