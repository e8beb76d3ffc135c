//! Measures the experiments of the two papers and the open questions of the 2012 paper.
//!
//! `cargo run --release --example experiments -- --out DIR [--only NAME] [--quick]`
//!
//! Writes a table (CSV) and a figure (SVG) for each experiment into DIR;
//! `docs/paper.md` and `docs/order.md` discuss them. Models that are not ours to
//! distribute are read from `../shared/models`; without that folder, shapes of
//! about the same size replace them.

mod suite;

use clap::Parser;
use std::error::Error;
use std::path::PathBuf;

/// Runs the experiments.
#[derive(Parser)]
struct Arguments {
    /// The output folder, created if it does not exist.
    #[arg(long)]
    out: PathBuf,
    /// Runs only the experiments whose file names contain this text.
    #[arg(long, default_value = "")]
    only: String,
    /// Uses few positions, few samples and small models; takes seconds.
    #[arg(long)]
    quick: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let setup = suite::Setup::new(arguments.out, arguments.quick, arguments.only)?;
    suite::run(&setup)
}
