//! The 2012 paper's tangent-plane iteration, as published.

use super::{Foot, Status};
use crate::bezier::{Jet, Patch};
use glam::DVec3;

/// The squared sine of the angle between the tangents below which a point has no tangent plane.
const DEGENERATE_SINE_SQUARED: f64 = 1e-14;

/// The change of the distance, relative to it, below which rounding may cause it.
const OBSERVABLE_CHANGE: f64 = 1e-13;

/// Projects the target on the tangent plane, steps to the parameters of the
/// projection and clamps them to the patch, until two consecutive distances
/// differ by less than `step_tolerance` or `iterations` steps are taken.
///
/// This is the Gauss–Newton method: its contraction factor is distance times
/// curvature, so it need not converge. The result is the last point, which may
/// be farther away than the start. O(p q) per step.
#[must_use]
pub fn tangent_plane(
    patch: &Patch<'_>,
    target: DVec3,
    start: [f64; 2],
    iterations: u32,
    step_tolerance: f64,
) -> Foot {
    let mut at = start;
    let mut jet = patch.jet(at);
    let mut distance = jet.point.distance(target);
    for _ in 0..iterations {
        let (next, clamped) = step(&jet, target, at);
        let next_jet = patch.jet(next);
        let next_distance = next_jet.point.distance(target);
        let change = (next_distance - distance).abs();
        (at, jet, distance) = (next, next_jet, next_distance);
        if change < step_tolerance {
            let status = if clamped { Status::OnEdge } else { Status::Converged };
            return Foot { parameters: at, distance_squared: distance * distance, status };
        }
    }
    Foot { parameters: at, distance_squared: distance * distance, status: Status::IterationLimit }
}

/// Returns the contraction factor α of the tangent-plane iteration observed from
/// `start`: the largest ratio of consecutive changes of the distance in
/// `iterations` steps, while the changes exceed rounding.
///
/// An α below 1 gives the paper's `K_B = α / (1 - α) E_B` with E_B the step
/// tolerance; it is an observation along one path, not a proof of contraction.
#[must_use]
pub fn contraction(patch: &Patch<'_>, target: DVec3, start: [f64; 2], iterations: u32) -> f64 {
    let mut at = start;
    let mut distance = patch.point(at).distance(target);
    let mut previous: Option<f64> = None;
    let mut largest = 0.0_f64;
    for _ in 0..iterations {
        at = step(&patch.jet(at), target, at).0;
        let next = patch.point(at).distance(target);
        let change = (next - distance).abs();
        distance = next;
        if change <= OBSERVABLE_CHANGE * distance {
            break;
        }
        if let Some(previous) = previous {
            largest = largest.max(change / previous);
        }
        previous = Some(change);
    }
    largest
}

/// Returns the next parameters, and whether they were clamped to an edge.
fn step(jet: &Jet, target: DVec3, at: [f64; 2]) -> ([f64; 2], bool) {
    let residual = target - jet.point;
    let [ss, st, tt] = [jet.s.dot(jet.s), jet.s.dot(jet.t), jet.t.dot(jet.t)];
    let [gs, gt] = [residual.dot(jet.s), residual.dot(jet.t)];
    let determinant = ss * tt - st * st;
    if determinant <= DEGENERATE_SINE_SQUARED * ss * tt || determinant <= 0.0 {
        return (at, false);
    }
    let free = [at[0] + (tt * gs - st * gt) / determinant, at[1] + (ss * gt - st * gs) / determinant];
    let inside = free.map(|parameter| parameter.clamp(0.0, 1.0));
    (inside, inside != free)
}
