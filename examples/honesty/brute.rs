//! Distances by dense sampling and polishing: never too small.

use super::evaluator::point;
use glam::DVec3;
use nurbs_hausdorff::Model;

/// Halvings of the polishing step: from a grid's spacing to rounding.
const HALVINGS: usize = 44;

/// A point of a model with its place.
#[derive(Clone, Copy)]
pub(crate) struct Placed {
    pub(crate) surface: usize,
    pub(crate) parameters: [f64; 2],
    pub(crate) point: DVec3,
}

/// Grid points of every surface, `count` by `count`, by the independent evaluator.
pub(crate) fn cloud(model: &Model, count: usize) -> Vec<Placed> {
    let mut cloud = Vec::new();
    for (surface, nurbs) in model.surfaces().iter().enumerate() {
        for parameters in super::evaluator::parameters(nurbs, count) {
            let point = DVec3::from_array(point(nurbs, parameters[0], parameters[1]));
            cloud.push(Placed { surface, parameters, point });
        }
    }
    cloud
}

/// The least distance from `target` to the cloud, polished from the nearest
/// `starts` points by a compass search. At least the distance to the model.
pub(crate) fn distance(model: &Model, cloud: &[Placed], spacing: usize, target: DVec3, starts: usize) -> f64 {
    let mut nearest: Vec<(f64, &Placed)> =
        cloud.iter().map(|placed| (placed.point.distance(target), placed)).collect();
    let count = starts.min(nearest.len() - 1);
    nearest.select_nth_unstable_by(count, |a, b| a.0.total_cmp(&b.0));
    nearest[..=count]
        .iter()
        .map(|(distance, placed)| polish(model, placed, spacing, target, *distance))
        .fold(f64::INFINITY, f64::min)
}

fn polish(model: &Model, start: &Placed, spacing: usize, target: DVec3, from: f64) -> f64 {
    let surface = &model.surfaces()[start.surface];
    let domain = surface.domain();
    let mut step = domain.map(|[start, end]| (end - start) / (spacing - 1) as f64);
    let (mut at, mut best) = (start.parameters, from);
    for _ in 0..HALVINGS {
        let mut improved = false;
        for [du, dv] in [
            [1.0, 0.0],
            [-1.0, 0.0],
            [0.0, 1.0],
            [0.0, -1.0],
            [1.0, 1.0],
            [-1.0, -1.0],
            [1.0, -1.0],
            [-1.0, 1.0],
        ] {
            let next = [
                (at[0] + du * step[0]).clamp(domain[0][0], domain[0][1]),
                (at[1] + dv * step[1]).clamp(domain[1][0], domain[1][1]),
            ];
            let distance = DVec3::from_array(point(surface, next[0], next[1])).distance(target);
            if distance < best {
                (at, best, improved) = (next, distance, true);
            }
        }
        if !improved {
            step = step.map(|step| 0.5 * step);
        }
    }
    best
}
