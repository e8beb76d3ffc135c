//! Damped Newton with an active set at the patch's edges.

use super::{Foot, Status};
use crate::bezier::{Jet, Patch};
use glam::DVec3;

/// The cosine between the residual and a tangent below which a point is
/// stationary: the distance's relative error is half its square, below
/// float64's rounding.
const STATIONARY_COSINE: f64 = 1e-8;

/// Rounding of a residual relative to the patch's size, which the stationary
/// test cannot see below.
const RESIDUAL_ROUNDING: f64 = 1e-15;

/// A decrease predicted below this part of the squared distance is lost in its
/// rounding: where no step makes such a distance smaller, it is stationary.
const STALLED_DECREASE: f64 = 1e-14;

/// Decrease of the squared distance, relative to the next step's, that all
/// steps together are expected not to exceed: steps converge quadratically.
const GAIN_ROOM: f64 = 2.0;

/// A second derivative of this size relative to the other direction's is near a
/// degenerate edge, where one step tells little of the next.
const SKEWED_RATIO: f64 = 1e-3;

/// The most halvings of a step, on CPU and GPU.
pub(crate) const MAX_HALVINGS: u32 = 8;

/// A second derivative of this size relative to the other direction's is a
/// degenerate edge, along which there is nothing to step.
const DEGENERATE_RATIO: f64 = 1e-14;

/// Minimises `½ |S - target|^2` over the patch from `start`.
///
/// Guarantee: the result's distance is that of a point of the patch, and no
/// larger than the start's. Steps use the Hessian where it is positive definite,
/// else the sizes of the second derivatives; a parameter at an edge with the gradient
/// pushing out is frozen; a step leaving the patch is cut at the edge and the
/// other parameter solved again; steps are halved until the distance falls.
/// `iterations` at most, each O(p q).
#[must_use]
pub fn newton(patch: &Patch<'_>, target: DVec3, start: [f64; 2], iterations: u32) -> Foot {
    newton_below(patch, target, start, iterations, f64::INFINITY).0
}

/// As [`newton`], given up where even [`GAIN_ROOM`] times the decrease that
/// the step promises would leave the squared distance above `most`; with the
/// squared distance that no further steps are expected to go below.
pub(crate) fn newton_below(
    patch: &Patch<'_>,
    target: DVec3,
    start: [f64; 2],
    iterations: u32,
    most: f64,
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
        let even = (0..2).all(|axis| !free[axis] || hessian[2 * axis] > skewed);
        let least = value - GAIN_ROOM * decrease;
        if even && least > most {
            return (Foot { parameters: at, distance_squared: value, status: Status::IterationLimit }, least);
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
            // No shorter step decreases it beyond rounding either.
            let stalled = decrease <= STALLED_DECREASE * value;
            if stalled || halvings > MAX_HALVINGS {
                let status = if stalled { settled(free) } else { Status::IterationLimit };
                let least = if stalled { value } else { f64::NEG_INFINITY };
                return (Foot { parameters: at, distance_squared: value, status }, least);
            }
            scale *= 0.5;
        }
    }
    (Foot { parameters: at, distance_squared: value, status: Status::IterationLimit }, f64::NEG_INFINITY)
}

fn settled(free: [bool; 2]) -> Status {
    if free[0] && free[1] { Status::Converged } else { Status::OnEdge }
}

fn pushes_out(parameter: f64, gradient: f64) -> bool {
    (parameter <= 0.0 && gradient > 0.0) || (parameter >= 1.0 && gradient < 0.0)
}

/// Whether the cosines between the residual and the free tangents are small, rounding taken off.
fn is_stationary(jet: &Jet, residual: DVec3, gradient: [f64; 2], free: [bool; 2]) -> bool {
    let size = residual.length();
    let tangents = [jet.s.length(), jet.t.length()];
    let rounding = RESIDUAL_ROUNDING * (tangents[0] + tangents[1] + size);
    let most = rounding + STATIONARY_COSINE * size;
    (0..2).all(|axis| !(free[axis] && gradient[axis].abs() > tangents[axis] * most))
}

/// `[ss, st, tt]` of ½|S - target|² if positive definite, else the absolute
/// values of the second derivatives alone: where the distance is bent
/// downwards, its gradient tells the way down and how far it stays one.
fn hessian(jet: &Jet, residual: DVec3) -> [f64; 3] {
    let ss = jet.s.dot(jet.s) + residual.dot(jet.ss);
    let st = jet.s.dot(jet.t) + residual.dot(jet.st);
    let tt = jet.t.dot(jet.t) + residual.dot(jet.tt);
    if ss > 0.0 && ss * tt > st * st { [ss, st, tt] } else { [ss.abs(), 0.0, tt.abs()] }
}

/// The minimum of the quadratic model inside the patch, as far as one cut at
/// an edge finds it.
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
