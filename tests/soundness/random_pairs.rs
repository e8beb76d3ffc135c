//! Random pairs on which a certified interval could lie; many more are in
//! `cargo run --release --example honesty`.

use crate::fuzzer::check::check;

/// Pairs, with two that a coarser brute force once raised alarms on.
const SEEDS: [u64; 2] = [9032, 9145];
const PAIRS: u64 = 60;

#[test]
fn intervals_contain_what_brute_force_finds() {
    let (mut converged, mut cells) = (0, 0);
    for seed in (1..=PAIRS).chain(SEEDS) {
        let outcome = check(seed);
        assert!(outcome.violations.is_empty(), "{:?}", outcome.violations);
        converged += u64::from(outcome.converged);
        cells += outcome.cells;
    }
    // Both kinds are tried: intervals as narrow as asked, and those that a budget ended.
    assert!((PAIRS / 4..PAIRS).contains(&converged), "{converged} converged");
    assert!(cells > 0);
}
