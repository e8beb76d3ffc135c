//! The 2012 paper's iteration, as published.

use super::{Foot, Status};
use crate::bezier::{Jet, Patch};
use glam::DVec3;

/// Sine squared between the tangents below which a point has no tangent plane.
const DEGENERATE_SINE_SQUARED: f64 = 1e-14;

/// Change of distance relative to the distance below which rounding, not the
/// iteration, moves it.
const OBSERVABLE_CHANGE: f64 = 1e-13;

/// Projects the target on the tangent plane, takes the step to the plane's
/// point, cuts it at the patch, until two consecutive distances differ by less
/// than `step_tolerance` or `iterations` steps are taken.
///
/// This is Gauss-Newton: its contraction is distance times curvature, so it
/// need not converge. The result's distance is that of the last point, which
/// may be farther than the start. O(p q) a step.
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
        let (next, cut) = step(&jet, target, at);
        let next_jet = patch.jet(next);
        let next_distance = next_jet.point.distance(target);
        let change = (next_distance - distance).abs();
        (at, jet, distance) = (next, next_jet, next_distance);
        if change < step_tolerance {
            let status = if cut { Status::OnEdge } else { Status::Converged };
            return Foot { parameters: at, distance_squared: distance * distance, status };
        }
    }
    Foot { parameters: at, distance_squared: distance * distance, status: Status::IterationLimit }
}

/// The contraction α of the tangent-plane iteration observed from `start`:
/// the largest ratio of consecutive changes of the distance in `iterations`
/// steps, as long as the changes are above rounding.
///
/// An α below 1 gives the paper's `K_B = α / (1 - α) step tolerance`; it is an
/// observation along one path, not a proof of contraction.
#[must_use]
pub fn contraction(patch: &Patch<'_>, target: DVec3, start: [f64; 2], iterations: u32) -> f64 {
    let mut at = start;
    let mut distance = patch.point(at).distance(target);
    let mut before: Option<f64> = None;
    let mut largest = 0.0_f64;
    for _ in 0..iterations {
        at = step(&patch.jet(at), target, at).0;
        let next = patch.point(at).distance(target);
        let change = (next - distance).abs();
        distance = next;
        if change <= OBSERVABLE_CHANGE * distance {
            break;
        }
        if let Some(before) = before {
            largest = largest.max(change / before);
        }
        before = Some(change);
    }
    largest
}

/// The next parameters, and whether they were cut at an edge.
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
