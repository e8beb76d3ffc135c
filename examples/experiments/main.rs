//! Measurements of the papers' experiments and of the open questions of the 2012
//! paper.
//!
//! The 2012 paper is I. Hanniel, A. Krishnamurthy and S. McMains, *Computing the
//! Hausdorff distance between NURBS surfaces using numerical iteration on the GPU*,
//! Graphical Models 74 (2012), 255–264.
//!
//! `cargo run --release --example experiments -- --out DIR [--only NAME] [--quick]`
//!
//! Writes a table (CSV) and a figure (SVG) for each experiment into DIR.
//! `docs/paper.md` and `docs/order.md` discuss them. Models that may not be
//! distributed are read from `../shared/models` if that folder exists, and replaced
//! by shapes of about their sizes if not.

mod suite;

use clap::Parser;
use std::error::Error;
use std::path::PathBuf;

/// Runs the experiments.
#[derive(Parser)]
struct Arguments {
    /// The folder to write to, created if it does not exist.
    #[arg(long)]
    out: PathBuf,
    /// Run only experiments whose file names contain this text.
    #[arg(long, default_value = "")]
    only: String,
    /// Use few positions, few samples and small models; takes seconds.
    #[arg(long)]
    quick: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let setup = suite::Setup::new(arguments.out, arguments.quick, arguments.only)?;
    suite::run(&setup)
}
