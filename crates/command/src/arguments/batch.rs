//! The arguments of `batch`.

use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct BatchArguments {
    /// The pairs, a line of JSON each; - is standard input.
    pub(crate) pairs: PathBuf,
    /// The file of the answers; standard output if not given.
    #[arg(long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Goes on with the output: pairs whose id it answers are left out.
    #[arg(long, requires = "output")]
    pub(crate) resume: bool,
    /// Replaces the output if it is there already.
    #[arg(long, conflicts_with = "resume")]
    pub(crate) overwrite: bool,
    /// Pairs compared at the same time; the number of cores if not given.
    #[arg(long, value_name = "PAIRS")]
    pub(crate) jobs: Option<usize>,
    /// Models kept prepared, those used last.
    #[arg(long, value_name = "MODELS", default_value_t = 16)]
    pub(crate) cache: usize,
    /// Seconds per search for pairs that state none, after which the interval reached is the result.
    #[arg(long, value_name = "SECONDS")]
    pub(crate) max_seconds: Option<f64>,
}
