//! Distances by dense sampling and polishing: never too small.

use super::evaluator::point;
use glam::DVec3;
use nurbs_hausdorff::Model;

/// Looks over a grid around the best point: from the cloud's spacing to rounding.
const LOOKS: usize = 48;

/// Points on each side of such a grid's middle.
const REACH: usize = 3;

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
/// `starts` points. At least the distance to the model.
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

/// Looks over a grid around the best point, again and again, at half the
/// spacing once the best is inside: slower than descending, and not misled by
/// a kink or a narrow valley.
fn polish(model: &Model, start: &Placed, spacing: usize, target: DVec3, from: f64) -> f64 {
    let surface = &model.surfaces()[start.surface];
    let domain = surface.domain();
    let mut step = domain.map(|[start, end]| (end - start) / ((spacing - 1) * REACH) as f64);
    let (mut at, mut best) = (start.parameters, from);
    for _ in 0..LOOKS {
        let center = at;
        let reach = REACH as i32;
        let mut at_rim = false;
        for i in -reach..=reach {
            for j in -reach..=reach {
                let next = [
                    (center[0] + f64::from(i) * step[0]).clamp(domain[0][0], domain[0][1]),
                    (center[1] + f64::from(j) * step[1]).clamp(domain[1][0], domain[1][1]),
                ];
                let distance = DVec3::from_array(point(surface, next[0], next[1])).distance(target);
                if distance < best {
                    (at, best, at_rim) = (next, distance, i.abs() == reach || j.abs() == reach);
                }
            }
        }
        if !at_rim {
            step = step.map(|step| 0.5 * step);
        }
    }
    best
}
