//! Random pairs on which a certified interval could lie; many more are in
//! `cargo run --release --example honesty`.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../examples/honesty/brute.rs"]
mod brute;
#[path = "../examples/honesty/check.rs"]
mod check;
#[path = "support/evaluator.rs"]
#[allow(dead_code, unreachable_pub, reason = "shared with tests that use more of it")]
mod evaluator;
#[path = "../examples/honesty/offsets.rs"]
mod offsets;
#[path = "../examples/honesty/pairs.rs"]
mod pairs;
#[path = "../examples/honesty/partners.rs"]
mod partners;
#[path = "../examples/honesty/sheet.rs"]
mod sheet;
#[path = "../examples/honesty/surfaces.rs"]
mod surfaces;

/// Pairs, with two that a coarser brute force once raised alarms on.
const SEEDS: [u64; 2] = [9032, 9145];
const PAIRS: u64 = 60;

#[test]
fn intervals_contain_what_brute_force_finds() {
    let (mut converged, mut cells) = (0, 0);
    for seed in (1..=PAIRS).chain(SEEDS) {
        let outcome = check::check(seed);
        assert!(outcome.violations.is_empty(), "{:?}", outcome.violations);
        converged += u64::from(outcome.converged);
        cells += outcome.cells;
    }
    // Both kinds are tried: intervals as narrow as asked, and those that a budget ended.
    assert!((PAIRS / 4..PAIRS).contains(&converged), "{converged} converged");
    assert!(cells > 0);
}
