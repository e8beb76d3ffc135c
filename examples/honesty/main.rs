//! Are the certified intervals honest? Random pairs, checked by brute force.
//!
//! `cargo run --release --example honesty -- --pairs 10000 --seed 1`
//!
//! Every pair is measured by method `certified` under a budget of cells, so
//! that many end early with a wide interval: that must be honest too. Then,
//! with an evaluator that shares no code with the library,
//!
//! - no sampled point of A may be farther from B than `upper`;
//! - the witness on A must be at least `lower` away from every sampled and
//!   polished point of B, and lie on A at the parameters told.
//!
//! Exit status 1 if any pair is dishonest.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a tool that stops at the first surprise")]

mod fuzzer;
#[path = "../../tests/support/mod.rs"]
mod support;

use clap::Parser;
use fuzzer::check::{Outcome, check};
use rayon::prelude::*;
use std::process::ExitCode;

/// Checks random pairs.
#[derive(Parser)]
struct Arguments {
    /// How many pairs.
    #[arg(long, default_value_t = 1000)]
    pairs: u64,
    /// The first pair's seed; the others follow.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let seeds = arguments.seed..arguments.seed + arguments.pairs;
    let outcomes: Vec<Outcome> = seeds.into_par_iter().map(check).collect();
    let converged = outcomes.iter().filter(|outcome| outcome.converged).count();
    let mut cells: Vec<usize> = outcomes.iter().map(|outcome| outcome.cells).collect();
    cells.sort_unstable();
    let violations: Vec<&String> = outcomes.iter().flat_map(|outcome| &outcome.violations).collect();
    println!(
        "{} pairs: {} converged, {} ended by the budget; median {} cells; {} violations",
        outcomes.len(),
        converged,
        outcomes.len() - converged,
        cells.get(cells.len() / 2).copied().unwrap_or(0),
        violations.len()
    );
    for violation in &violations {
        println!("{violation}");
    }
    ExitCode::from(u8::from(!violations.is_empty()))
}
