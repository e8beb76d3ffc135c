//! Bodies that are embedded by construction, and bodies that meet themselves.

use super::draw::mapped;
use super::frames::frame;
use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{Engine, PreparedModel};
use nurbs_hausdorff::{CheckOptions, CheckedBody, Model, NamedModel, SurfaceArrays, shapes};
use std::f64::consts::TAU;

/// The least part of a tube's height by which it passes into itself, or past itself.
const MIN_DEPTH: f64 = 1e-5;

/// Returns in words what is said wrongly of a body that is embedded, and of others made here. No map of a shape that is
/// embedded makes it meet itself, and none of one that meets itself parts it.
pub(super) fn violations(rng: &mut Rng, embedded: &PreparedModel) -> Vec<String> {
    let mut found = Vec::new();
    let mut judge = |what: &str, model: &PreparedModel, is_embedded: bool| match bodies(model) {
        Ok(bodies) => found.extend(
            bodies
                .iter()
                .filter(|body| body.embedded == Some(!is_embedded))
                .map(|body| format!("{what}: embedded is {:?}, {:?}", body.embedded, body.self_overlap)),
        ),
        Err(error) => found.push(format!("check: {error}")),
    };
    judge("a shape", embedded, true);
    let depth = MIN_DEPTH.powf(rng.f64());
    let (model, is_embedded) = match rng.u8(0..5) {
        0 => (tube(rng, 1.0 - depth), false),
        1 => (tube(rng, 1.0 + depth), true),
        2 => (shapes::torus(1.0, 1.0 + 2.0 * depth).ok(), false),
        3 => (frame(rng, depth), false),
        _ => (frame(rng, -depth), true),
    };
    // Maps are of untrimmed surfaces; frames have one of their own.
    let model = model.and_then(|model| if model.is_trimmed() { Some(model) } else { mapped(rng, &model) });
    if let Some(prepared) = model.and_then(|model| PreparedModel::new(&model).ok()) {
        judge("a body made to meet itself, or not to", &prepared, is_embedded);
    }
    found
}

fn bodies(model: &PreparedModel) -> nurbs_hausdorff::Result<Vec<CheckedBody>> {
    let options = CheckOptions { max_cells: 1, ..CheckOptions::default() };
    Ok(Engine::cpu().check(&[NamedModel { name: None, model }], &options).wait()?.bodies)
}

/// A tube of height 1 along a figure of eight. Where the two strands cross, one is `rise` above the other one, so that the
/// tube passes into itself if `rise` is less than 1. It has degree 1 or 2 along both parameters, and its seam is anywhere.
fn tube(rng: &mut Rng, rise: f64) -> Option<Model> {
    let parts = 24 + 8 * rng.usize(0..4);
    let (degree, first) = (rng.usize(1..3), rng.usize(0..parts));
    let curve = |t: f64| {
        let height = 0.5 * rise * (2.0 * t.cos()).clamp(-1.0, 1.0);
        DVec3::new(4.0 * t.sin(), 3.0 * (2.0 * t).sin(), height)
    };
    let mut control_points = Vec::new();
    for part in 0..parts + degree {
        let t = TAU * ((part + first) % parts) as f64 / parts as f64;
        let [point, next] = [t - 1e-6, t + 1e-6].map(curve);
        let across = 0.4 * (next - point).cross(DVec3::Z).normalize();
        let point = curve(t);
        let ring = [point + across, point - across, point - across + DVec3::Z, point + across + DVec3::Z];
        control_points.extend((0..4 + degree).map(|k| ring[k % 4].extend(1.0).to_array()));
    }
    let counts = [parts + degree, 4 + degree];
    let knots = counts.map(|count| (0..=count + degree).map(|knot| knot as f64).collect());
    Model::from_arrays(None, vec![SurfaceArrays { degree: [degree; 2], knots, counts, control_points }]).ok()
}
