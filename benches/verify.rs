//! The independent checker over results of method `certified`.
//!
//! `cargo bench --bench verify [-- FAMILY [PAIR]...]`: reference pairs, shapes, soundness pairs and
//! random pairs, or one family of them, or the pairs of it whose names begin with one of those given. Prints a Markdown table of verdicts and times, and every pair that
//! was not proved. Family `cuts` proves, of 500 drawn faces, that the pieces that they are cut into are
//! those faces. The reference and soundness pairs lie in `../shared` and are left out without it.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../examples/verify/cuts.rs"]
mod cuts;
#[allow(dead_code, reason = "shared with the example, which uses all of the fuzzer")]
#[path = "../examples/honesty/fuzzer/mod.rs"]
mod fuzzer;
#[allow(dead_code, reason = "shared with the example, which uses all of the proofs")]
#[path = "../examples/verify/proof/mod.rs"]
mod proof;
#[path = "../tests/support/mod.rs"]
mod support;

use glam::DVec3;
use nurbs_hausdorff::internals::engine::{DistanceOptions, Engine, PreparedModel};
use nurbs_hausdorff::shapes::{list, shape};
use nurbs_hausdorff::{CertifiedOptions, Method, Model, RigidTransform};
use proof::{Claim, Motion, Report, Settings, Verdict, Witness};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The time given to one proof, and the slack on both sides of its interval.
const SETTINGS: Settings = Settings { time: Duration::from_secs(60), slack: 1e-3 };

/// The time given to one search: some of the soundness pairs were chosen for searches without end.
const SEARCH_SECONDS: f64 = 10.0;

/// The number of random pairs, and the first one's seed.
const RANDOM_PAIRS: u64 = 200;
const FIRST_SEED: u64 = 1;

/// The least number of drawn faces, and the deviation that they are cut with, relative to the
/// diagonal of their model.
const DRAWN_FACES: u32 = 500;
const CUT_DEVIATION: f64 = 1e-9;

/// The CPU seconds given to the proof of a cut, and its slack, relative to the face's diagonal.
const CUT_SECONDS: f64 = 20.0;
const CUT_SLACK: f64 = 1e-3;

/// What is measured, and how.
struct Pair {
    name: String,
    a: Model,
    b: Model,
    options: DistanceOptions,
}

/// The verdict on one pair, and the seconds it took.
struct Row {
    name: String,
    report: Report,
    seconds: f64,
}

/// The name of a family of pairs, and the function that makes them.
type Family = (&'static str, fn() -> Vec<Pair>);

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|argument| !argument.starts_with('-'));
    let family = arguments.next().unwrap_or_default();
    let names: Vec<String> = arguments.collect();
    let is_chosen = |pair: &Pair| names.is_empty() || names.iter().any(|name| pair.name.starts_with(name));
    let families: [Family; 4] = [
        ("reference", reference_pairs),
        ("shapes", shape_pairs),
        ("soundness", soundness_pairs),
        ("random", random_pairs),
    ];
    println!("| family | pairs | proved | undecided | refuted | median, s | slowest, s |");
    println!("|---|---|---|---|---|---|---|");
    let mut unproved = Vec::new();
    for (name, pairs) in families.into_iter().filter(|(name, _)| name.contains(&family)) {
        let mut rows: Vec<Row> = pairs().into_iter().filter(is_chosen).map(check).collect();
        rows.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
        let count = |verdict| rows.iter().filter(|row| row.report.verdict() == verdict).count();
        let seconds = |index: usize| rows.get(index).map_or(0.0, |row| row.seconds);
        println!(
            "| {name} | {} | {} | {} | {} | {:.2} | {:.1} |",
            rows.len(),
            count(Verdict::Proved),
            count(Verdict::NotProved),
            count(Verdict::Refuted),
            seconds(rows.len() / 2),
            seconds(rows.len().saturating_sub(1))
        );
        unproved.extend(rows.into_iter().filter(|row| row.report.verdict() != Verdict::Proved));
    }
    if "cuts".contains(&family) {
        prove_cuts();
    }
    println!();
    for Row { name, report, seconds } in unproved {
        let Report { lower, upper, notes, cells } = report;
        println!("- {name}: lower {lower:?}, upper {upper:?}, {cells} cells, {seconds:.1} s {notes:?}");
    }
}

/// Proves the cuts of drawn faces, and prints those that are not proved.
fn prove_cuts() {
    let models = (FIRST_SEED..).filter_map(fuzzer::trims::pair).map(|pair| pair.a);
    let mut counts = [0; 3];
    let (mut seconds, mut slowest) = (0.0, 0.0_f64);
    let (mut faces, mut uncut) = (0, 0);
    for model in models {
        for (index, face) in model.faces().enumerate() {
            let max_deviation = CUT_DEVIATION * model.bounding_box().diagonal();
            match cuts::cut(index, &face, max_deviation) {
                None => continue,
                Some(Err(_)) => uncut += 1,
                Some(Ok(cut)) => {
                    let deadline = proof::Deadline::after(CUT_SECONDS);
                    eprint!("face {faces}, {} pieces:", cut.pieces.len());
                    let finding = proof::cut::check(&cut, CUT_SLACK, &deadline);
                    eprintln!(" {:?} {:.2} s", finding.verdict, deadline.spent());
                    seconds += deadline.spent();
                    slowest = slowest.max(deadline.spent());
                    counts[finding.verdict as usize] += 1;
                    if finding.verdict != Verdict::Proved {
                        println!(
                            "- face {faces} of {} pieces: {:?} {}",
                            cut.pieces.len(),
                            finding.verdict,
                            finding.note.unwrap_or_default()
                        );
                    }
                }
            }
            faces += 1;
        }
        if faces >= DRAWN_FACES {
            break;
        }
    }
    let [proved, open, refuted] = counts;
    println!(
        "| cuts | {faces} faces, {uncut} not cut | {proved} | {open} | {refuted} | {:.2} on average | {slowest:.1} |",
        seconds / f64::from(faces)
    );
}

fn check(pair: Pair) -> Row {
    let engine = Engine::cpu();
    let (a, b) = (
        PreparedModel::new(&pair.a).expect("valid trims"),
        PreparedModel::new(&pair.b).expect("valid trims"),
    );
    let result = engine.distance(&a, &b, &pair.options).wait();
    let result = result.unwrap_or_else(|error| panic!("{}: {error}", pair.name));
    let found = result.witness.a;
    let witness = Witness { surface: found.face, u: found.u, v: found.v };
    let claim = Claim { lower: result.lower, upper: result.upper, witness };
    let transform = pair.options.transform;
    let motion =
        Motion { rotation: transform.rotation().to_array(), translation: transform.offset().to_array() };
    let [a, b] = [&pair.a, &pair.b].map(|model| {
        let text = model.to_json().expect("a model's JSON");
        proof::Model::from_json(&text).expect("a valid model")
    });
    let start = Instant::now();
    let report = proof::check(&a, &motion, &b, &claim, &SETTINGS);
    let seconds = start.elapsed().as_secs_f64();
    eprintln!("{} {:?} {seconds:.2} s, {} cells", pair.name, report.verdict(), report.cells);
    Row { name: pair.name, report, seconds }
}

fn options(transform: RigidTransform) -> DistanceOptions {
    DistanceOptions {
        method: Method::Certified(CertifiedOptions {
            max_seconds: Some(SEARCH_SECONDS),
            ..Default::default()
        }),
        transform,
        ..DistanceOptions::default()
    }
}

/// A folder beside the project.
fn shared(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared").join(folder)
}

fn read(path: &Path) -> Model {
    let text = std::fs::read_to_string(path).expect("a readable model");
    Model::from_json(&text).expect("a valid model")
}

fn reference_pairs() -> Vec<Pair> {
    let folder = shared("models");
    let pair = |line: &str| {
        let line: serde_json::Value = serde_json::from_str(line).expect("a reference");
        let along = |axis: usize| line["translate_a"][axis].as_f64().unwrap_or(0.0);
        let shift = DVec3::new(along(0), along(1), along(2));
        let [a, b] = ["a", "b"].map(|side| line[side].as_str().expect("a model's name").to_owned());
        let load = |name: &str| read(&folder.join(format!("{name}.json")));
        Pair {
            name: format!("{a} to {b} {shift}"),
            a: load(&a),
            b: load(&b),
            options: options(RigidTransform::translation(shift).expect("a translation")),
        }
    };
    let lines = std::fs::read_to_string(folder.join("reference.jsonl")).unwrap_or_default();
    lines.lines().map(pair).collect()
}

/// Every shape with the next one of the catalogue, in both directions.
fn shape_pairs() -> Vec<Pair> {
    let names: Vec<&str> = list().map(|shape| shape.name).collect();
    let neighbours = names.windows(2).flat_map(|pair| [[pair[0], pair[1]], [pair[1], pair[0]]]);
    let pair = |[from, to]: [&str; 2]| Pair {
        name: format!("{from} to {to}"),
        a: shape(from).expect("a shape"),
        b: shape(to).expect("a shape"),
        options: options(RigidTransform::IDENTITY),
    };
    neighbours.map(pair).collect()
}

fn soundness_pairs() -> Vec<Pair> {
    let Ok(entries) = std::fs::read_dir(shared("soundness")) else { return Vec::new() };
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().to_str()?.strip_suffix("_A.json").map(str::to_owned))
        .collect();
    names.sort();
    let pair = |name: String| {
        let [a, b] = ["A", "B"].map(|side| read(&shared("soundness").join(format!("{name}_{side}.json"))));
        let diagonal = a.bounding_box().diagonal().max(b.bounding_box().diagonal());
        // Two points have no diagonal to be relative to.
        let tolerance = (diagonal == 0.0).then_some(1e-6);
        let options = DistanceOptions { tolerance, ..options(RigidTransform::IDENTITY) };
        Pair { name, a, b, options }
    };
    names.into_iter().map(pair).collect()
}

fn random_pairs() -> Vec<Pair> {
    let pair = |seed: u64| {
        let pair = fuzzer::pairs::pair(seed);
        let diagonal = pair.a.bounding_box().diagonal().max(pair.b.bounding_box().diagonal());
        let options = DistanceOptions {
            method: Method::Certified(CertifiedOptions {
                max_cells: Some(pair.max_cells),
                ..Default::default()
            }),
            tolerance: (diagonal == 0.0).then_some(pair.tolerance),
            relative_tolerance: (diagonal != 0.0).then_some(pair.tolerance),
            ..options(pair.transform)
        };
        Pair { name: format!("random {seed} ({})", pair.kind), a: pair.a, b: pair.b, options }
    };
    (FIRST_SEED..FIRST_SEED + RANDOM_PAIRS).map(pair).collect()
}
