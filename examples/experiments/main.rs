//! The papers' experiments, and the open questions of the 2012 paper, measured.
//!
//! `cargo run --release --example experiments -- --out DIR [--only NAME] [--quick]`
//!
//! Writes a table (CSV) and a figure (SVG) for each experiment into DIR. What
//! they show is told in `docs/paper.md` and `docs/order.md`. Pairs that are
//! not ours to ship are read from `../shared/models` if that is there, and
//! shapes of about their sizes take their places if not.

mod suite;

use clap::Parser;
use std::error::Error;
use std::path::PathBuf;

/// Runs the experiments.
#[derive(Parser)]
struct Arguments {
    /// The folder to write to, made if it is not there.
    #[arg(long)]
    out: PathBuf,
    /// Only experiments whose files' names contain this.
    #[arg(long, default_value = "")]
    only: String,
    /// Few positions, few samples and small models, in seconds.
    #[arg(long)]
    quick: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let setup = suite::Setup::new(arguments.out, arguments.quick, arguments.only)?;
    suite::run(&setup)
}
