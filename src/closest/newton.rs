//! The damped Newton iteration with an active set at the patch's edges.

use super::{Foot, Status};
use crate::bezier::{Jet, Patch};
use glam::DVec3;

/// The cosine of the angle between the residual and a tangent below which a
/// point is stationary: the relative error of the distance is half its square,
/// below the rounding of float64.
const STATIONARY_COSINE: f64 = 1e-8;

/// The rounding error of a residual relative to the patch's size; the test for
/// stationary points cannot resolve less.
const RESIDUAL_ROUNDING: f64 = 1e-15;

/// A predicted decrease below this fraction of the squared distance is less
/// than its rounding: where no step achieves it, the point is stationary.
const STALLED_DECREASE: f64 = 1e-14;

/// The decrease of the squared distance, relative to that predicted for the next
/// step, which all further steps together are expected not to exceed, as steps
/// converge quadratically.
const MAX_GAIN_FACTOR: f64 = 2.0;

/// Below this ratio of the second derivatives along the two axes the point is
/// near a degenerate edge, where one step hardly predicts the next.
const SKEWED_RATIO: f64 = 1e-3;

/// The largest number of halvings of a step.
pub(crate) const MAX_HALVINGS: u32 = 8;

/// Below this ratio of the second derivatives along the two axes the point is on
/// a degenerate edge, along which no step changes it.
const DEGENERATE_RATIO: f64 = 1e-14;

/// Minimises `½ |S - target|²` over the patch from `start`.
///
/// Guarantee: the result's distance is that of a point of the patch, and at most
/// that of the start. Steps use the Hessian where it is positive definite, else
/// the absolute values of its diagonal. A parameter at an edge is frozen while
/// the gradient pushes it outwards. A step that leaves the patch is clamped to
/// the edge, and the other parameter is solved for again. Steps are halved until
/// the distance falls. At most `iterations` steps, each O(p q).
#[must_use]
pub fn newton(patch: &Patch<'_>, target: DVec3, start: [f64; 2], iterations: u32) -> Foot {
    newton_below(patch, target, start, iterations, f64::INFINITY).0
}

/// Minimises as [`newton`] does, and stops once even [`MAX_GAIN_FACTOR`] times the
/// predicted decrease would leave the squared distance above `threshold`.
///
/// Also returns the squared distance that further steps are not expected to go
/// below, an estimate and no bound.
pub(crate) fn newton_below(
    patch: &Patch<'_>,
    target: DVec3,
    start: [f64; 2],
    iterations: u32,
    threshold: f64,
) -> (Foot, f64) {
    let mut at = start;
    let mut jet = patch.jet(at);
    let mut value = jet.point.distance_squared(target);
    for _ in 0..iterations {
        let residual = jet.point - target;
        let gradient = [residual.dot(jet.s), residual.dot(jet.t)];
        let free = [0, 1].map(|axis| !pushes_out(at[axis], gradient[axis]));
        if is_stationary(&jet, residual, gradient, free) {
            return (Foot { parameters: at, distance_squared: value, status: settled(free) }, value);
        }
        let hessian = hessian(&jet, residual);
        let full = step(at, gradient, &hessian, free);
        let decrease = (gradient[0] * full[0] + gradient[1] * full[1]).abs();
        let skewed = SKEWED_RATIO * hessian[0].max(hessian[2]);
        let balanced = (0..2).all(|axis| !free[axis] || hessian[2 * axis] > skewed);
        let expected = value - MAX_GAIN_FACTOR * decrease;
        if balanced && expected > threshold {
            return (
                Foot { parameters: at, distance_squared: value, status: Status::IterationLimit },
                expected,
            );
        }
        let mut scale = 1.0;
        let mut halvings = 0;
        loop {
            let next = [0, 1].map(|axis| (at[axis] + scale * full[axis]).clamp(0.0, 1.0));
            let next_jet = patch.jet(next);
            let next_value = next_jet.point.distance_squared(target);
            if next_value < value {
                (at, jet, value) = (next, next_jet, next_value);
                break;
            }
            halvings += 1;
            // A shorter step would not decrease it by more than rounding either.
            let stalled = decrease <= STALLED_DECREASE * value;
            if stalled || halvings > MAX_HALVINGS {
                let status = if stalled { settled(free) } else { Status::IterationLimit };
                let expected = if stalled { value } else { f64::NEG_INFINITY };
                return (Foot { parameters: at, distance_squared: value, status }, expected);
            }
            scale *= 0.5;
        }
    }
    (Foot { parameters: at, distance_squared: value, status: Status::IterationLimit }, f64::NEG_INFINITY)
}

/// Returns the status of a stationary point with these parameters free.
fn settled(free: [bool; 2]) -> Status {
    if free[0] && free[1] { Status::Converged } else { Status::OnEdge }
}

/// Returns whether descent would leave the patch at this parameter.
fn pushes_out(parameter: f64, gradient: f64) -> bool {
    (parameter <= 0.0 && gradient > 0.0) || (parameter >= 1.0 && gradient < 0.0)
}

/// Returns whether the residual is orthogonal to the free tangents, up to [`STATIONARY_COSINE`] and rounding.
fn is_stationary(jet: &Jet, residual: DVec3, gradient: [f64; 2], free: [bool; 2]) -> bool {
    let size = residual.length();
    let tangents = [jet.s.length(), jet.t.length()];
    let rounding = RESIDUAL_ROUNDING * (tangents[0] + tangents[1] + size);
    let threshold = rounding + STATIONARY_COSINE * size;
    (0..2).all(|axis| !(free[axis] && gradient[axis].abs() > tangents[axis] * threshold))
}

/// Returns the Hessian `[ss, st, tt]` of ½|S - target|² if it is positive
/// definite, else the absolute values of its diagonal alone: where the distance
/// is concave, that gives a descent direction and a step of a sensible length.
fn hessian(jet: &Jet, residual: DVec3) -> [f64; 3] {
    let ss = jet.s.dot(jet.s) + residual.dot(jet.ss);
    let st = jet.s.dot(jet.t) + residual.dot(jet.st);
    let tt = jet.t.dot(jet.t) + residual.dot(jet.tt);
    if ss > 0.0 && ss * tt > st * st { [ss, st, tt] } else { [ss.abs(), 0.0, tt.abs()] }
}

/// Returns the step to the minimum of the quadratic model inside the patch; a
/// minimum outside is clamped to one edge and solved for once more.
fn step(at: [f64; 2], gradient: [f64; 2], hessian: &[f64; 3], free: [bool; 2]) -> [f64; 2] {
    let [ss, st, tt] = *hessian;
    let weight = [ss, tt];
    let least = DEGENERATE_RATIO * ss.max(tt);
    let free = [free[0] && ss > least, free[1] && tt > least];
    // The minimum along one axis with the other parameter's step given.
    let along = |axis: usize, other: f64| {
        if free[axis] { -(gradient[axis] + st * other) / weight[axis] } else { 0.0 }
    };
    if !(free[0] && free[1]) {
        return [along(0, 0.0), along(1, 0.0)];
    }
    let determinant = ss * tt - st * st;
    if determinant <= DEGENERATE_RATIO * ss * tt {
        return [along(0, 0.0), 0.0];
    }
    let mut full = [
        (st * gradient[1] - tt * gradient[0]) / determinant,
        (st * gradient[0] - ss * gradient[1]) / determinant,
    ];
    for axis in 0..2 {
        let inside = (at[axis] + full[axis]).clamp(0.0, 1.0) - at[axis];
        if inside != full[axis] {
            full[axis] = inside;
            full[1 - axis] = along(1 - axis, inside);
        }
    }
    full
}
