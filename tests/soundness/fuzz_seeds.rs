//! The fuzz targets on their kept seeds and on mutations of these.

use crate::fuzz::TARGETS;
use rayon::prelude::*;
use std::path::PathBuf;

/// Mutations of each seed, and the bytes of it that each changes.
const MUTATIONS: u64 = 8;
const MAX_CHANGES: usize = 4;

/// The seeds of a target in order of path: those written, and those found by fuzzing.
fn seeds(target: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/soundness/fuzz/seeds").join(target);
    let mut paths = Vec::new();
    let mut folders = vec![folder];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            (if path.is_dir() { &mut folders } else { &mut paths }).push(path);
        }
    }
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), std::fs::read(path).unwrap())).collect()
}

/// The seed with some bytes replaced.
fn mutated(seed: &[u8], random: &mut fastrand::Rng) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..random.usize(1..=MAX_CHANGES) {
        if !bytes.is_empty() {
            let index = random.usize(..bytes.len());
            bytes[index] = random.u8(..);
        }
    }
    bytes
}

#[test]
fn every_target_holds_on_its_seeds() {
    for (target, check) in TARGETS {
        let seeds = seeds(target);
        assert!(!seeds.is_empty(), "{target} has no seeds");
        for (path, bytes) in seeds {
            // The harness prints the panic; the path names the seed.
            let passed = std::panic::catch_unwind(|| check(&bytes)).is_ok();
            assert!(passed, "{}", path.display());
        }
    }
}

#[test]
fn every_target_holds_on_mutations_of_its_seeds() {
    for (target, check) in TARGETS {
        seeds(target).into_par_iter().enumerate().for_each(|(index, (path, bytes))| {
            for mutation in 0..MUTATIONS {
                let mut random = fastrand::Rng::with_seed(MUTATIONS * index as u64 + mutation);
                let bytes = mutated(&bytes, &mut random);
                let passed = std::panic::catch_unwind(|| check(&bytes)).is_ok();
                assert!(passed, "{}, mutation {mutation}: {bytes:?}", path.display());
            }
        });
    }
}
