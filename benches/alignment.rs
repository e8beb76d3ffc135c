//! Fits from poses over all rotations: models laid on themselves, and scans of them with noise, of a
//! part of the surface and with outliers.
//!
//! `cargo bench --bench alignment [-- POSES NAME …]`: shapes of these names, or models of
//! `../shared/models`. Prints a Markdown table: of the poses how many were found, how many are among
//! the ambiguous ones, how many were missed, and how many were missed and called converged; the
//! largest residual, in random ones, of a pose that was found and the least of one that was missed;
//! the time of one fit.

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod support;

use nurbs_hausdorff::shapes::shape;
use nurbs_hausdorff::{
    BestFit, BestFitOptions, DQuat, DVec3, Engine, Facets, FieldOptions, FitNorm, FitStart, Model,
    PointCloud, PreparedModel, RigidTransform,
};
use std::time::Instant;
use support::shared;

/// The parts: shapes, and models of others, among them symmetric ones.
const PARTS: [&str; 14] = [
    "bottle",
    "naca-wing",
    "wavy-sheet",
    "torus",
    "net-6x6",
    "sphere",
    "cylinder",
    "nist_pmi_1",
    "nist_pmi_2",
    "nist_pmi_5",
    "occt_bearing",
    "hammer_trimmed",
    "utah_teapot",
    "occt_linkrods",
];

/// What is laid on a part: the part itself, or a scan with its share of the surface and of outliers.
const KINDS: [(&str, Option<[f64; 2]>); 5] = [
    ("itself", None),
    ("scan", Some([1.0, 0.0])),
    ("scan, 10 % outliers", Some([1.0, 0.1])),
    ("scan, 30 % outliers", Some([1.0, 0.3])),
    ("scan of 50 %", Some([0.5, 0.0])),
];

/// The points of a scan, and its noise in parts of the diagonal.
const SCAN_POINTS: usize = 5000;
const NOISE: f64 = 1e-3;

/// The mean movement of the part's points, in diagonals, up to which a pose counts as found.
const FOUND: f64 = 0.01;

/// The ratio to the residual of the true pose, and the part of the diagonal, up to which another one is as good.
const AS_GOOD: f64 = 2.0;
const EXACT: f64 = 1e-6;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|name| !name.starts_with('-')).collect();
    let poses = arguments.first().and_then(|first| first.parse().ok());
    let names: Vec<&str> = arguments.iter().skip(usize::from(poses.is_some())).map(String::as_str).collect();
    let names = if names.is_empty() { PARTS.to_vec() } else { names };
    println!(
        "| part | laid on it | found | ambiguous | missed | converged elsewhere | not converged | largest found | least missed | s |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for name in names {
        let Some(model) = read(name) else {
            println!("SKIPPED {name}: there is no ../shared/models");
            continue;
        };
        for (kind, scan) in KINDS {
            measure(name, &model, kind, scan, poses.unwrap_or(10));
        }
    }
}

fn read(name: &str) -> Option<Model> {
    shape(name).ok().or_else(|| {
        let path = shared::folder()?.join(format!("{name}.json"));
        Some(Model::from_json(&std::fs::read_to_string(path).ok()?).expect("a valid model"))
    })
}

#[derive(Default)]
struct Tally {
    found: usize,
    ambiguous: usize,
    missed: usize,
    elsewhere: usize,
    undecided: usize,
}

fn measure(name: &str, model: &Model, kind: &str, scan: Option<[f64; 2]>, poses: usize) {
    let prepared = PreparedModel::new(model).unwrap();
    let diagonal = prepared.bounding_box().diagonal();
    let mut random = fastrand::Rng::with_seed(53);
    let mut tally = Tally::default();
    let (mut largest, mut least) = (0.0_f64, f64::INFINITY);
    let mut seconds = 0.0;
    let cloud = points(&prepared);
    for _ in 0..poses {
        let pose = pose(&mut random, diagonal);
        let moved = scan.map(|[share, outliers]| {
            let points = scanned(&cloud, [share, outliers, diagonal], &mut random);
            let points = points.into_iter().map(|point| pose.apply(point)).collect();
            PreparedModel::of_facets(&Facets::Cloud(PointCloud::new(points).unwrap()), None).unwrap()
        });
        let options = BestFitOptions {
            // A model is moved by its transform; the points of a scan are where they are.
            transform: if moved.is_some() { RigidTransform::IDENTITY } else { pose },
            outliers: scan.map_or(0.0, |[_, outliers]| outliers),
            ..BestFitOptions::default()
        };
        let started = Instant::now();
        let fit =
            Engine::cpu().best_fit(moved.as_ref().unwrap_or(&prepared), &prepared, &options).wait().unwrap();
        seconds += started.elapsed().as_secs_f64();
        let truth = if moved.is_some() { pose.inverse() } else { RigidTransform::IDENTITY };
        let original = |points: &[DVec3]| -> Vec<DVec3> {
            let at = |point: &DVec3| if moved.is_some() { pose.apply(*point) } else { *point };
            points.iter().map(at).collect()
        };
        let ratio = fit.rms / fit.rms_random;
        let is_free = fit.freedoms > 0 && {
            let at_truth =
                BestFitOptions { transform: truth, start: FitStart::Given, norm: FitNorm::None, ..options };
            let a = moved.as_ref().unwrap_or(&prepared);
            let at_truth = Engine::cpu().best_fit(a, &prepared, &at_truth).wait().unwrap();
            fit.rms <= AS_GOOD * at_truth.rms + EXACT * diagonal
        };
        match outcome(&fit, is_free, &truth, &original(&cloud), diagonal) {
            Outcome::Found => tally.found += 1,
            Outcome::Ambiguous => tally.ambiguous += 1,
            Outcome::Missed => {
                tally.missed += 1;
                tally.elsewhere += usize::from(fit.converged);
                least = least.min(ratio);
                continue;
            }
        }
        tally.undecided += usize::from(!fit.converged);
        largest = largest.max(ratio);
    }
    let Tally { found, ambiguous, missed, elsewhere, undecided } = tally;
    println!(
        "| {name} | {kind} | {found} | {ambiguous} | {missed} | {elsewhere} | {undecided} | {largest:.4} | {least:.4} | {:.2} |",
        seconds / poses as f64
    );
}

enum Outcome {
    Found,
    Ambiguous,
    Missed,
}

/// A pose counts as found where it moves the part's points to their truth. It is ambiguous where that
/// is among the others, or where the part moves freely in the fit and lies as well as in its true pose.
fn outcome(fit: &BestFit, is_free: bool, truth: &RigidTransform, points: &[DVec3], diagonal: f64) -> Outcome {
    let is_true = |motion: &RigidTransform| {
        let squares = points.iter().map(|&point| motion.apply(point).distance_squared(truth.apply(point)));
        (squares.sum::<f64>() / points.len() as f64).sqrt() <= FOUND * diagonal
    };
    if is_true(&fit.transform) {
        return Outcome::Found;
    }
    if fit.ambiguous.iter().any(|pose| is_true(&pose.transform)) || is_free {
        return Outcome::Ambiguous;
    }
    Outcome::Missed
}

/// A rotation spread over all, and a shift by up to two diagonals.
fn pose(random: &mut fastrand::Rng, diagonal: f64) -> RigidTransform {
    let mut normal = || {
        let [u, v] = [1.0 - random.f64(), random.f64()];
        (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
    };
    let rotation = DQuat::from_xyzw(normal(), normal(), normal(), normal()).normalize();
    let shift = DVec3::new(normal(), normal(), normal());
    RigidTransform::new(rotation, diagonal * shift).unwrap()
}

/// Points of the part, of equal share of its area.
fn points(model: &PreparedModel) -> Vec<DVec3> {
    let options = FieldOptions { samples: 24, ..FieldOptions::default() };
    let field = Engine::cpu().field(model, model, &options).wait().unwrap();
    let all = field.deviations.iter().flat_map(|face| {
        let points = face.points.chunks_exact(3).map(|point| DVec3::new(point[0], point[1], point[2]));
        points.zip(face.areas.iter().copied()).collect::<Vec<_>>()
    });
    let all: Vec<(DVec3, f64)> = all.collect();
    let total: f64 = all.iter().map(|(_, area)| area).sum();
    let (mut sum, mut taken) = (0.0, Vec::new());
    for (point, area) in all {
        sum += area;
        if sum * SCAN_POINTS as f64 >= (taken.len() as f64 + 0.5) * total {
            taken.push(point);
        }
    }
    taken
}

/// The points on one side of a plane, which are this share of all, with noise; among them outliers in
/// the box of twice the diagonal.
fn scanned(
    points: &[DVec3],
    [share, outliers, diagonal]: [f64; 3],
    random: &mut fastrand::Rng,
) -> Vec<DVec3> {
    let mut even = || DVec3::from_array([0; 3].map(|_| 2.0 * random.f64() - 1.0));
    let direction = even().normalize();
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    let mut order: Vec<DVec3> = points.to_vec();
    order.sort_by(|one, other| one.dot(direction).total_cmp(&other.dot(direction)));
    order.truncate((share * points.len() as f64) as usize);
    let mut scan: Vec<DVec3> =
        order.into_iter().map(|point| point + NOISE * diagonal * (even() + even() + even())).collect();
    let far = (outliers / (1.0 - outliers) * scan.len() as f64) as usize;
    scan.extend((0..far).map(|_| middle + diagonal * even()));
    random.shuffle(&mut scan);
    scan
}
