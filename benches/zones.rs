//! The least zone of scans, beside that of least squares: noise, and a part that is bent.
//!
//! `cargo bench --bench zones [-- NAME …]`: shapes of these names, or models of `../shared/models`. Prints a
//! Markdown table: the largest distance after least squares, the interval of the least one over two boxes of
//! motions, in thousandths of the diagonal, the number of boxes that were bounded, and the time of one fit.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod support;

use nurbs_hausdorff::shapes::shape;
use nurbs_hausdorff::{
    BestFitOptions, DVec3, Engine, Facets, FieldOptions, FitNorm, FitStart, Model, PointCloud, PreparedModel,
    RigidTransform, ZoneOptions,
};
use std::time::Instant;
use support::shared;

const PARTS: [&str; 9] = [
    "bottle",
    "naca-wing",
    "wavy-sheet",
    "sphere",
    "cylinder",
    "nist_pmi_1",
    "nist_pmi_5",
    "occt_bearing",
    "occt_linkrods",
];

/// The boxes: shifts in parts of the diagonal, and angles in degrees.
const BOXES: [[f64; 2]; 2] = [[0.002, 0.2], [0.01, 1.0]];

/// The largest number of boxes of motions that are bounded, four times the default.
const MAX_BOXES: usize = 20_000;

/// The noise of a scan, and the sag of a bent part, in parts of the diagonal.
const NOISE: f64 = 1e-3;
const SAG: f64 = 2e-3;

fn main() {
    let names: Vec<String> = std::env::args().skip(1).filter(|name| !name.starts_with('-')).collect();
    let names = if names.is_empty() { PARTS.map(str::to_owned).to_vec() } else { names };
    println!("| part | A | box | least squares | zone | proven | boxes | s |");
    println!("|---|---|---|---|---|---|---|---|");
    for name in names {
        let Some(model) = read(&name) else {
            println!("SKIPPED {name}: there is no ../shared/models");
            continue;
        };
        let prepared = PreparedModel::new(&model).unwrap();
        for kind in ["scan", "bent"] {
            measure(&name, kind, &prepared);
        }
    }
}

fn read(name: &str) -> Option<Model> {
    shape(name).ok().or_else(|| {
        let path = shared::folder()?.join(format!("{name}.json"));
        Some(Model::from_json(&std::fs::read_to_string(path).ok()?).expect("a valid model"))
    })
}

fn measure(name: &str, kind: &str, part: &PreparedModel) {
    let diagonal = part.bounding_box().diagonal();
    let a = PreparedModel::of_facets(
        &Facets::Cloud(PointCloud::new(points(part, kind, diagonal)).unwrap()),
        None,
    )
    .unwrap();
    let given = BestFitOptions { start: FitStart::Given, ..BestFitOptions::default() };
    let mean = Engine::cpu().best_fit(&a, part, &given).wait().unwrap();
    for [shift, degrees] in BOXES {
        let translation = Some(shift * diagonal);
        let zone = ZoneOptions { translation, degrees, max_boxes: MAX_BOXES, ..ZoneOptions::default() };
        let options = BestFitOptions { norm: FitNorm::Largest, zone, ..given.clone() };
        let started = Instant::now();
        let fit = Engine::cpu().best_fit(&a, part, &options).wait().unwrap();
        let seconds = started.elapsed().as_secs_f64();
        let found = fit.zone.unwrap();
        let [before, lower, upper] =
            [mean.largest, found.lower, found.upper].map(|length| 1e3 * length / diagonal);
        let proven = if fit.zone_proven == Some(true) { "yes" } else { "no" };
        println!(
            "| {name} | {kind} | {shift}, {degrees}° | {before:.3} | {lower:.3} … {upper:.3} | {proven} | {} | {seconds:.1} |",
            found.boxes
        );
    }
}

/// Points of the part with noise, or bent along its longest side, where they lie.
fn points(part: &PreparedModel, kind: &str, diagonal: f64) -> Vec<DVec3> {
    let options = FieldOptions { samples: 8, ..FieldOptions::default() };
    let field = Engine::cpu().field(part, part, &options).wait().unwrap();
    let all = field.deviations.iter().flat_map(|face| face.points.chunks_exact(3).map(DVec3::from_slice));
    let all: Vec<DVec3> = all.collect();
    let step = all.len().div_ceil(4000);
    let random = &mut fastrand::Rng::with_seed(17);
    let middle = part.bounding_box().center();
    let turned = RigidTransform::new(
        nurbs_hausdorff::DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 2.0) / 3.0, 0.002),
        DVec3::splat(0.001 * diagonal),
    )
    .unwrap();
    let moved = |point: DVec3| {
        let offset = match kind {
            "scan" => NOISE * diagonal * DVec3::from_array([0; 3].map(|_| 2.0 * random.f64() - 1.0)),
            _ => SAG * diagonal * ((point - middle).x / diagonal).powi(2) * 4.0 * DVec3::Z,
        };
        turned.apply(point + offset)
    };
    all.into_iter().step_by(step).map(moved).collect()
}
