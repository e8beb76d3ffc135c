//! The work of method `certified` on whole families of pairs: what a change of
//! the search is judged by.
//!
//! `cargo bench --bench work [-- SET …] [--each] [--fine] [--prepare-only] [--audit]`, with
//! `RAYON_NUM_THREADS=1` for one thread. Prints, for every set, the pairs, the
//! cells bounded and the seconds of all searches; with `--each` for every pair, too, and with
//! `--fine` at 1e-8 instead of 1e-6 of the diagonal. With `--audit` all upper bounds are audited, and the
//! numbers of cells by lemma are printed, and what was refuted. Under an instruction counter,
//! a second run with `--prepare-only` gives what to subtract.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod support;

use glam::DVec3;
use nurbs_hausdorff::internals::engine::{DistanceOptions, Engine, PreparedModel};
use nurbs_hausdorff::options::Audit;
use nurbs_hausdorff::result::Lemma;
use nurbs_hausdorff::shapes::operations::refit_model;
use nurbs_hausdorff::shapes::shape;
use nurbs_hausdorff::{CertifiedOptions, Method, Model, RigidTransform};
use std::collections::BTreeMap;
use std::rc::Rc;
use support::clock::Stopwatch;
use support::shared;

/// Shapes of every kind; each is measured against every other.
const SHAPES: [&str; 10] = [
    "sphere",
    "torus",
    "cylinder",
    "cone",
    "glass",
    "naca-wing",
    "wigley-hull",
    "wavy-sheet",
    "wavy-sheet-b",
    "net-6x6",
];

/// Pairs that are moved through each other; names of our shapes or of the
/// shared models.
const SWEEPS: [(&str, &str, DVec3); 4] = [
    ("net-6x6", "net-6x6-b", DVec3::Z),
    ("bottle", "bottle", DVec3::X),
    ("sphere-small", "sphere", DVec3::X),
    ("duck", "utah_teapot_4nurbs", DVec3::X),
];

/// Positions of a sweep.
const POSITIONS: usize = 13;

/// Shapes to be refitted, with the number of points along each direction.
const REFITS: [(&str, usize); 8] = [
    ("torus", 12),
    ("torus", 24),
    ("bottle", 24),
    ("naca-wing", 24),
    ("wavy-sheet", 24),
    ("glass", 40),
    ("sphere", 24),
    ("wigley-hull", 24),
];

/// Cells after which a search of this benchmark ends: some refits take millions.
const MAX_CELLS: usize = 300_000;

struct Pair {
    a: Rc<PreparedModel>,
    b: Rc<PreparedModel>,
    transform: RigidTransform,
    name: String,
}

/// A name, and what makes the pairs.
type Set = (&'static str, fn() -> Vec<Pair>);

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let [each, fine] = ["--each", "--fine"].map(|option| arguments.iter().any(|argument| argument == option));
    let audit =
        if arguments.iter().any(|argument| argument == "--audit") { Audit::All } else { Audit::Share };
    let prepare_only = arguments.iter().any(|argument| argument == "--prepare-only");
    let chosen = |name: &str| {
        let mut names = arguments.iter().filter(|argument| !argument.starts_with('-')).peekable();
        names.peek().is_none() || names.any(|argument| argument == name)
    };
    let engine = Engine::cpu();
    println!("| set | pairs | cells | seconds | not converged |");
    println!("|---|---|---|---|---|");
    let sets: [Set; 5] = [
        ("references", references),
        ("shapes", shapes),
        ("sweeps", sweeps),
        ("refits", refits),
        ("coincident", coincident),
    ];
    for (name, pairs) in sets.into_iter().filter(|(name, _)| chosen(name)) {
        let pairs = pairs();
        let (mut cells, mut seconds, mut ended) = (0, 0.0, 0);
        let mut audited = BTreeMap::<Lemma, usize>::new();
        for Pair { a, b, transform, name: pair } in &pairs {
            let max_cells = if prepare_only { Some(1) } else { Some(MAX_CELLS) };
            let relative_tolerance = fine.then_some(1e-8);
            let options = DistanceOptions {
                method: Method::Certified(CertifiedOptions { max_cells, audit, ..Default::default() }),
                transform: *transform,
                relative_tolerance,
                ..DistanceOptions::default()
            };
            let watch = Stopwatch::start(true);
            let result = engine.distance(a, b, &options).wait().expect("a distance");
            let of_pair = result.certified().map_or(0, |details| details.cells);
            if each {
                let (stop, spent) = (result.certified().map(|details| details.stop), watch.cpu_seconds());
                println!("| {pair} | | {of_pair} | {spent:.3} | {stop:?} |");
            }
            if let Some(details) = result.certified() {
                for lemma in Lemma::ALL {
                    *audited.entry(lemma).or_default() += details.audit.cells_of(lemma);
                }
                if !details.audit.struck.is_empty() {
                    println!("REFUTED {pair}: {:?}", result.notice);
                }
            }
            cells += of_pair;
            seconds += result.seconds.solve;
            ended += usize::from(!result.converged);
        }
        println!("| {name} | {} | {cells} | {seconds:.3} | {ended} |", pairs.len());
        let counts = audited.iter().filter(|(_, count)| **count > 0);
        let counts: Vec<String> = counts.map(|(lemma, count)| format!("{lemma}: {count}")).collect();
        println!("bounds audited by lemma: {}", counts.join(", "));
    }
}

fn prepared(model: &Model) -> Rc<PreparedModel> {
    Rc::new(PreparedModel::new(model).expect("valid trims"))
}

/// A shape, or a model of the shared folder.
fn named(name: &str) -> Option<Model> {
    shape(name).ok().or_else(|| {
        let text = std::fs::read_to_string(shared::folder()?.join(format!("{name}.json"))).ok()?;
        Some(Model::from_json(&text).expect("a valid model"))
    })
}

fn references() -> Vec<Pair> {
    let Some(folder) = shared::folder() else {
        println!("SKIPPED references: there is no ../shared/models");
        return Vec::new();
    };
    let pair = |reference: shared::Reference| Pair {
        a: Rc::new(shared::load(&folder, &reference.a)),
        b: Rc::new(shared::load(&folder, &reference.b)),
        transform: RigidTransform::translation(reference.translation).expect("a translation"),
        name: format!("{} to {}", reference.a, reference.b),
    };
    shared::references(&folder).into_iter().map(pair).collect()
}

fn shapes() -> Vec<Pair> {
    let models: Vec<Rc<PreparedModel>> =
        SHAPES.iter().map(|name| prepared(&shape(name).expect("a shape"))).collect();
    let mut pairs = Vec::new();
    for a in &models {
        for b in models.iter().filter(|b| !Rc::ptr_eq(a, b)) {
            pairs.push(Pair {
                a: Rc::clone(a),
                b: Rc::clone(b),
                transform: RigidTransform::IDENTITY,
                name: String::new(),
            });
        }
    }
    pairs
}

fn sweeps() -> Vec<Pair> {
    let mut pairs = Vec::new();
    for (a, b, axis) in SWEEPS {
        let (Some(a), Some(b)) = (named(a), named(b)) else {
            println!("SKIPPED sweep of {a} and {b}: there is no ../shared/models");
            continue;
        };
        let [box_a, box_b] = [&a, &b].map(Model::bounding_box);
        let reach = 0.75 * (box_a.extent() + box_b.extent()).dot(axis);
        let aside = box_b.center() - box_a.center() + 0.03 * box_b.diagonal();
        let (a, b) = (prepared(&a), prepared(&b));
        for position in 0..POSITIONS {
            let along = reach * (2.0 * position as f64 / (POSITIONS - 1) as f64 - 1.0);
            let transform = RigidTransform::translation(aside + along * axis).expect("a translation");
            pairs.push(Pair { a: Rc::clone(&a), b: Rc::clone(&b), transform, name: String::new() });
        }
    }
    pairs
}

fn refits() -> Vec<Pair> {
    let mut pairs = Vec::new();
    for (name, count) in REFITS {
        let model = shape(name).expect("a shape");
        let refit = prepared(&refit_model(&model, count).expect("a refit"));
        let model = prepared(&model);
        let transform = RigidTransform::IDENTITY;
        pairs.push(Pair { a: Rc::clone(&model), b: Rc::clone(&refit), transform, name: String::new() });
        pairs.push(Pair { a: refit, b: model, transform, name: String::new() });
    }
    pairs
}

/// Pairs that lie on each other in other parameters, in both directions.
fn coincident() -> Vec<Pair> {
    let Some(folder) = shared::folder().map(|models| models.with_file_name("coincident")) else {
        println!("SKIPPED coincident: there is no ../shared/coincident");
        return Vec::new();
    };
    let files = std::fs::read_dir(&folder).expect("the pairs of ../shared/coincident");
    let mut names: Vec<String> = files
        .filter_map(|file| Some(file.ok()?.file_name().to_str()?.strip_suffix("_A.json")?.to_owned()))
        .collect();
    names.sort();
    let mut pairs = Vec::new();
    for name in names {
        let [a, b] = ["A", "B"].map(|side| Rc::new(shared::load(&folder, &format!("{name}_{side}"))));
        let transform = RigidTransform::IDENTITY;
        let back = format!("{name}, back");
        pairs.push(Pair { a: Rc::clone(&a), b: Rc::clone(&b), transform, name });
        pairs.push(Pair { a: b, b: a, transform, name: back });
    }
    pairs
}
