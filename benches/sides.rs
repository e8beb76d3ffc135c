//! The sides of random points of the models of others in `../shared/models`.
//!
//! `cargo bench --bench sides [-- NAME …]`: models of these names, or paths of JSON, STL, IGES or STEP files.
//! Prints a Markdown table: whether the model closes, its shells and free edges, and the time that
//! random points of its box take. Points that `benches/peers/sides_occt.py` has written to
//! `target/sides` take their place, and those with their sides are written there for it.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod support;

use nurbs_hausdorff::PreparedModel;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;
use support::random::Random;
use support::shared;

/// The points of each model.
const POINTS: usize = 10_000;

fn main() {
    let names: Vec<String> = std::env::args().skip(1).filter(|name| !name.starts_with('-')).collect();
    let paths: Vec<PathBuf> = if names.is_empty() {
        let Some(folder) = shared::folder() else {
            println!("SKIPPED sides: there is no ../shared/models");
            return;
        };
        ["nist_pmi_1", "nist_pmi_5", "nist_pmi_11", "occt_bearing", "occt_linkrods", "hammer_trimmed"]
            .map(|name| folder.join(format!("{name}.json")))
            .to_vec()
    } else {
        names.iter().map(PathBuf::from).collect()
    };
    println!(
        "| model | faces | shells | free edges | joining, ms | inside | outside | undecided | µs a point |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for path in paths {
        measure(&path);
    }
}

/// Returns the points of a file, one a line.
fn given(path: &Path) -> Option<Vec<[f64; 3]>> {
    let text = std::fs::read_to_string(path).ok()?;
    let point = |line: &str| {
        let mut numbers = line.split(' ').map(|word| word.parse().expect("a number"));
        std::array::from_fn(|_| numbers.next().expect("three numbers"))
    };
    Some(text.lines().map(point).collect())
}

/// Returns random points of a box somewhat larger than the model's.
fn random_points(model: &PreparedModel) -> Vec<[f64; 3]> {
    let (aabb, mut random) = (model.bounding_box(), Random(7));
    let mut point = || {
        let fractions = std::array::from_fn(|_| 1.1 * random.next() - 0.05);
        (aabb.min + aabb.extent() * glam::DVec3::from_array(fractions)).to_array()
    };
    (0..POINTS).map(|_| point()).collect()
}

fn measure(path: &Path) {
    let model = shared::load_file(path);
    let started = Instant::now();
    let solid = model.solid();
    let joining = 1e3 * started.elapsed().as_secs_f64();
    let folder = Path::new("target/sides");
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let (mut counts, mut lines) = ([0_usize; 3], format!("gap {:?}\n", model.gap()));
    let points = given(&folder.join(format!("{stem}.points"))).unwrap_or_else(|| random_points(&model));
    let started = Instant::now();
    if solid.closed {
        for &[x, y, z] in &points {
            let side = model.side([x, y, z]);
            counts[side as usize] += 1;
            writeln!(lines, "{x:?} {y:?} {z:?} {side:?}").expect("a string");
        }
    }
    let each = 1e6 * started.elapsed().as_secs_f64() / points.len() as f64;
    std::fs::create_dir_all(folder).expect("a folder");
    std::fs::write(folder.join(format!("{stem}.txt")), lines).expect("a file");
    let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    println!(
        "| {name} | {} | {} | {} | {joining:.1} | {} | {} | {} | {each:.1} |",
        model.face_count(),
        solid.shells.len(),
        solid.free_edges.len(),
        counts[0],
        counts[1],
        counts[2],
    );
}
