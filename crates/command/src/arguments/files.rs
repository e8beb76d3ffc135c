//! The arguments of what is said of one file: `info` and `convert`.

use super::models::Unit;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct InfoArguments {
    /// The model; - is standard input.
    pub(crate) model: PathBuf,
    /// The unit of the facts; that of the model if not given.
    #[arg(long, value_enum)]
    pub(crate) unit: Option<Unit>,
    /// The mass of a cubic unit of the facts, for the mass of bodies.
    #[arg(long, value_name = "MASS")]
    pub(crate) density: Option<f64>,
    /// Prints the result as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ConvertArguments {
    /// The model; - is standard input.
    pub(crate) input: PathBuf,
    /// The file to write, .json; - is standard output.
    pub(crate) output: PathBuf,
    /// Replaces the output if it is there already.
    #[arg(long)]
    pub(crate) overwrite: bool,
    /// Prints the report as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}
