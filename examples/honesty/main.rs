//! A fuzzer of method `certified`: random pairs, with intervals checked by brute force.
//!
//! `cargo run --release --example honesty -- --pairs 10000 --seed 1`
//!
//! Every pair has a budget of cells, so that many searches end early with a wide
//! interval, which must be valid too. An evaluator that shares no code with the
//! library then checks that
//!
//! - no sampled point of A is farther from B than `upper`;
//! - the witness on A is at least `lower` away from every sampled and refined point
//!   of B, and is the point of A at its parameters.
//!
//! The exit status is 1 if any interval is violated.
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
    /// The number of pairs.
    #[arg(long, default_value_t = 1000)]
    pairs: u64,
    /// The seed of the first pair; the others have the following ones.
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
