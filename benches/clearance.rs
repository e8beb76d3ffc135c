//! Clearances of the models of others in `../shared/models`, at seeded poses.
//!
//! `cargo bench --bench clearance [-- A B]`: the models of these names, or paths of JSON, STEP or IGES files. Prints a Markdown
//! table with the wall-clock times, the least of three, and the pairs of cells of intervals at 1e-6 of
//! the diagonal and of decisions at a limit of 1e-2 of it, and writes the poses of each pair with their intervals to
//! `target/clearance`, for `benches/peers/clearance_peers.py`.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod support;

use glam::DQuat;
use nurbs_hausdorff::internals::engine::{Engine, PreparedModel};
use nurbs_hausdorff::{ClearanceOptions, ClearanceResult, Overlap, RigidTransform};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use support::clock::Stopwatch;
use support::random::Random;
use support::shared;

/// The pairs that are measured by default.
const PAIRS: [[&str; 2]; 6] = [
    ["occt_linkrods", "occt_bearing"],
    ["nist_pmi_5", "nist_pmi_1"],
    ["nist_pmi_11", "nist_pmi_2"],
    ["occt_bearing", "occt_bearing"],
    ["hammer_trimmed", "occt_linkrods"],
    ["tigl_d150_wing", "tigl_d150_fuselage"],
];

/// The poses of each pair.
const POSES: usize = 100;

/// The distances between the models' centres, as parts of half the sum of their diagonals.
const REACH: [f64; 2] = [0.2, 1.2];

/// The limit of the decisions, relative to the diagonal.
const RELATIVE_LIMIT: f64 = 1e-2;

/// The number of runs of each search. The shortest one counts, as other processes lengthen the others.
const REPEATS: usize = 3;

/// Seconds after which a search is given up.
const MAX_SECONDS: f64 = 20.0;

fn main() {
    let names: Vec<String> = std::env::args().skip(1).filter(|name| !name.starts_with('-')).collect();
    let Some(folder) = shared::folder().or((!names.is_empty()).then(PathBuf::new)) else {
        println!("SKIPPED clearance: there is no ../shared/models");
        return;
    };
    let pairs = match names.as_slice() {
        [a, b] => vec![[a.as_str(), b.as_str()]],
        _ => PAIRS.to_vec(),
    };
    println!(
        "| A | B | poses | interval: median ms | 95 % | max | pairs, median | limit: median ms | 95 % | max | undecided | overlap none, touching, intersecting, contained, unknown |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|");
    for [a, b] in pairs {
        let models = [a, b].map(|name| {
            let is_file = Path::new(name).is_file();
            if is_file { shared::load_file(Path::new(name)) } else { shared::load(&folder, name) }
        });
        let short =
            [a, b].map(|name| Path::new(name).file_stem().map_or(name, |name| name.to_str().unwrap_or("")));
        measure(short, &models);
    }
}

/// Returns a turn about A's centre that moves it to a place near B.
fn pose(random: &mut Random, [a, b]: &[PreparedModel; 2]) -> RigidTransform {
    let turn = DQuat::from_axis_angle(random.direction(), std::f64::consts::TAU * random.next());
    let [a, b] = [a.bounding_box(), b.bounding_box()];
    let reach = REACH[0] + (REACH[1] - REACH[0]) * random.next();
    let place = b.center() + random.direction() * (reach * 0.5 * (a.diagonal() + b.diagonal()));
    RigidTransform::new(turn, place - turn * a.center()).expect("a rigid transform")
}

fn measure([a, b]: [&str; 2], models: &[PreparedModel; 2]) {
    let engine = Engine::cpu();
    let diagonal = models.iter().map(|model| model.bounding_box().diagonal()).fold(0.0, f64::max);
    let mut random = Random(30);
    let (mut widths, mut limits, mut cells, mut undecided) = (Vec::new(), Vec::new(), Vec::new(), 0);
    let (mut lines, mut overlaps) = (String::new(), [0_usize; 5]);
    for index in 0..=POSES {
        let transform = pose(&mut random, models);
        let seconds = Some(MAX_SECONDS);
        let of = |limit| ClearanceOptions {
            transform,
            limit,
            max_seconds: seconds,
            ..ClearanceOptions::default()
        };
        let run = |options: ClearanceOptions| -> (ClearanceResult, f64) {
            let measured = (0..REPEATS).map(|_| {
                let clock = Stopwatch::start(false);
                let result = engine.clearance(&models[0], &models[1], &options).wait().expect("a clearance");
                (result, 1e3 * clock.seconds())
            });
            measured.min_by(|a, b| a.1.total_cmp(&b.1)).expect("a measurement")
        };
        let (interval, width_ms) = run(of(None));
        let (decision, limit_ms) = run(of(Some(RELATIVE_LIMIT * diagonal)));
        // The first pose prepares both models.
        if index == 0 {
            continue;
        }
        undecided += usize::from(!interval.converged) + usize::from(decision.at_least.is_none());
        let place = match interval.overlap {
            Some(Overlap::None) => 0,
            Some(Overlap::Touching) => 1,
            Some(Overlap::Intersecting { .. }) => 2,
            Some(Overlap::Contained { .. }) => 3,
            _ => 4,
        };
        overlaps[place] += 1;
        widths.push(width_ms);
        limits.push(limit_ms);
        cells.push(interval.cells as f64);
        let (turn, offset) = (transform.rotation().to_array(), transform.offset().to_array());
        let (lower, upper) = (interval.lower, interval.upper);
        writeln!(
            lines,
            r#"{{"quaternion":{turn:?},"translation":{offset:?},"lower":{lower:?},"upper":{upper:?},"diagonal":{diagonal:?},"ms":{width_ms:?},"limitMs":{limit_ms:?}}}"#
        )
        .expect("a string");
    }
    let ends = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        [0.5, 0.95, 1.0].map(|part| values[((values.len() - 1) as f64 * part) as usize])
    };
    let ([w, w95, w100], [l, l95, l100], [c, ..]) = (ends(widths), ends(limits), ends(cells));
    println!(
        "| {a} | {b} | {POSES} | {w:.2} | {w95:.2} | {w100:.1} | {c:.0} | {l:.2} | {l95:.2} | {l100:.1} | {undecided} | {overlaps:?} |"
    );
    let folder = Path::new("target/clearance");
    std::fs::create_dir_all(folder).expect("a folder");
    std::fs::write(folder.join(format!("{a}-{b}.jsonl")), lines).expect("a file");
}
