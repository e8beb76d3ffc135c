//! Parts of areas with like counterparts, and of feature edges with counterparts, by a second way.

mod areas;
mod edges;

use super::check::Outcome;
use super::solids::Shapes;
use super::surfaces::magnitude;
use areas::Surface;
use fastrand::Rng;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{Engine, PreparedModel};
use nurbs_hausdorff::tessellate::{TessellationOptions, tessellate};
use nurbs_hausdorff::{Facets, Interval, Model, RigidTransform, ScoreOptions, TriangleMesh};
use std::time::Instant;

/// The budgets of parts: many searches end with wide intervals.
const BUDGETS: [usize; 4] = [20, 400, 3000, 12_000];

/// The largest ratio of the sizes of two shapes that are laid on each other.
const MAX_RATIO: f64 = 4.0;

/// The seconds that a score may take: what it knows then has to hold too.
const MAX_SECONDS: f64 = 5.0;

/// Rounding of distances, relative to the largest coordinate.
const ROUNDING: f64 = 1e-9;

/// What is asked of a pair.
struct Asked {
    threshold: f64,
    /// The permitted angle between tangent planes, and the angle of feature edges, in radians.
    angles: [f64; 2],
    /// What rounding changes of a distance.
    rounding: f64,
}

/// Checks the score of a seed: a closed shape under an affine or a projective map before itself, moved a little, or
/// before another one; one in four of both as triangles.
pub(crate) fn check_score(seed: u64, shapes: &Shapes) -> Outcome {
    let rng = &mut Rng::with_seed(seed);
    let refused = |code| Outcome { refusal: Some(code), ..Outcome::default() };
    let Some((name, models, transform)) = drawn(rng, shapes) else { return refused("NOT_DRAWN") };
    let size = models[1].bounding_box().diagonal();
    let (degrees, feature) = (5.0 + 80.0 * rng.f64(), 10.0 + 140.0 * rng.f64());
    let threshold = magnitude(rng, -2.5, -0.3) * size;
    let options = ScoreOptions {
        thresholds: vec![threshold],
        normal_angle: degrees,
        feature_angle: feature,
        relative_tolerance: Some(1e-2),
        part_tolerance: magnitude(rng, -2.5, -1.0),
        max_cells: BUDGETS[rng.usize(0..BUDGETS.len())],
        max_seconds: Some(MAX_SECONDS),
        transform,
        ..ScoreOptions::default()
    };
    let origin = models[1].bounding_box().center();
    let meshes = [rng.u8(0..4) == 0, rng.u8(0..4) == 0];
    let built = [0, 1].map(|index| made(&models[index], meshes[index]));
    let [Some((a, of_a)), Some((b, of_b))] = built else { return refused("NOT_DRAWN") };
    let started = Instant::now();
    let found = match Engine::cpu().score(&a, &b, &options).wait() {
        Ok(found) => found,
        Err(error) => return refused(error.code()),
    };
    let seconds = started.elapsed().as_secs_f64();
    let largest = a.bounding_box().farthest_from_origin() + b.bounding_box().farthest_from_origin() + size;
    let rounding = ROUNDING * largest;
    let asked = Asked { threshold, angles: [degrees, feature].map(f64::to_radians), rounding };
    let surfaces = [
        Surface::new(&models[0], of_a, transform, origin),
        Surface::new(&models[1], of_b, RigidTransform::IDENTITY, origin),
    ];
    let at = &found.thresholds[0];
    let mut violations = Vec::new();
    if let Some(normals) = at.normals {
        let parts = [normals.normal_precision, normals.normal_recall];
        violations.extend(areas::violations(rng, &surfaces, parts, &asked));
    }
    if let (Some(of_edges), Some(lengths), [false, false]) = (at.edges, found.edge_length, meshes) {
        let parts = [of_edges.edge_precision, of_edges.edge_recall];
        violations.extend(edges::violations(&surfaces, parts, [lengths.candidate, lengths.truth], &asked));
    }
    Outcome {
        converged: found.converged,
        cells: 0,
        seconds,
        violations: violations.into_iter().map(|what| format!("seed {seed} ({name}): {what}")).collect(),
        ..Outcome::default()
    }
}

/// Draws two shapes of like sizes, and a motion that lays the first one on the second.
fn drawn(rng: &mut Rng, shapes: &Shapes) -> Option<(String, [Model; 2], RigidTransform)> {
    const TRIES: usize = 40;
    let (name, b) = shapes.draw(rng)?;
    let any = |rng: &mut Rng| DVec3::new(rng.f64(), rng.f64(), rng.f64()) * 2.0 - 1.0;
    let size = b.bounding_box().diagonal();
    let (first, a, turn, shift) = if rng.bool() {
        let turn = DQuat::from_scaled_axis(magnitude(rng, -5.0, -0.3) * any(rng));
        (name, b.clone(), turn, magnitude(rng, -5.0, -0.7) * size * any(rng))
    } else {
        let is_like = |model: &Model| {
            let ratio = model.bounding_box().diagonal() / size;
            ratio < MAX_RATIO && ratio * MAX_RATIO > 1.0
        };
        let (first, a) = (0..TRIES).find_map(|_| shapes.draw(rng).filter(|(_, model)| is_like(model)))?;
        (first, a, DQuat::from_scaled_axis(3.0 * any(rng)), 0.2 * size * any(rng))
    };
    let [from, to] = [&a, &b].map(|model| model.bounding_box().center());
    let transform = RigidTransform::new(turn, to - turn * from + shift).ok()?;
    Some((format!("{first} before {name}"), [a, b], transform))
}

/// Prepares a model as it is, or its triangles, which are returned too.
fn made(model: &Model, is_mesh: bool) -> Option<(PreparedModel, Option<Vec<[DVec3; 3]>>)> {
    if !is_mesh {
        return Some((PreparedModel::new(model).ok()?, None));
    }
    let options = TessellationOptions { relative_tolerance: Some(1e-2), ..TessellationOptions::default() };
    let display = tessellate(model, &options).ok()?;
    let points: Vec<DVec3> = display
        .positions
        .chunks_exact(3)
        .map(|at| display.origin + DVec3::new(f64::from(at[0]), f64::from(at[1]), f64::from(at[2])))
        .collect();
    let triangles: Vec<[u32; 3]> = display.indices.chunks_exact(3).map(|at| [at[0], at[1], at[2]]).collect();
    let mesh = TriangleMesh::new(&points, &triangles).ok()?;
    let corners = triangles.iter().map(|corners| corners.map(|corner| points[corner as usize])).collect();
    Some((PreparedModel::of_facets(&Facets::Mesh(mesh), None).ok()?, Some(corners)))
}

/// Returns in words that a part of samples is without an interval: `least` of them are in it, `most` may be, each up to an
/// error.
fn outside(what: &str, found: Interval, [least, most]: [f64; 2], error: f64) -> Option<String> {
    let is_out = least - error > found.upper || most + error < found.lower;
    is_out
        .then(|| format!("{what} [{}, {}], of samples {least} to {most} ± {error}", found.lower, found.upper))
}
