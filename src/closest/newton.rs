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

/// The part of the squared distance that a step off a saddle is predicted to save at least: less is not worth its
/// evaluations.
const MIN_SADDLE_DECREASE: f64 = 1e-6;

/// The largest squared sine of the angle between the residual and the tangent plane at which a target lies beside
/// the surface.
const MAX_SINE_BESIDE_SQUARED: f64 = 1e-2;

/// The least squared sine between the tangents with which Gauss and Newton's step is taken.
const MIN_SINE_SQUARED: f64 = 1e-6;

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

/// Minimises as [`newton`] does, and stops once even [`MAX_GAIN_FACTOR`] times the predicted decrease would leave
/// the squared distance above `threshold`.
///
/// Above it, targets beside the surface, nearly in its tangent plane, may lie on the patch, however far from the
/// start. Where the distance is concave there a decrease is not predicted, the step is that of Gauss and Newton, which
/// reaches targets in plane patches, and a step leads off saddles ([`step_off_saddle`]).
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
        let is_beside = || value > threshold && lies_beside(&jet, residual);
        let mut off_saddle = None;
        if is_stationary(&jet, residual, gradient, free) {
            if is_beside() {
                off_saddle = step_off_saddle(at, gradient, &second_derivatives(&jet, residual), value);
            }
            if off_saddle.is_none() {
                return (Foot { parameters: at, distance_squared: value, status: settled(free) }, value);
            }
        }
        let second = second_derivatives(&jet, residual);
        let is_convex = second[0] > 0.0 && second[0] * second[2] > second[1] * second[1];
        let hessian = if is_convex {
            second
        } else if is_beside() && is_regular(&jet) {
            [jet.s.dot(jet.s), jet.s.dot(jet.t), jet.t.dot(jet.t)]
        } else {
            [second[0].abs(), 0.0, second[2].abs()]
        };
        let full = off_saddle.unwrap_or_else(|| step(at, gradient, &hessian, free));
        let decrease = (gradient[0] * full[0] + gradient[1] * full[1]).abs();
        let skewed = SKEWED_RATIO * hessian[0].max(hessian[2]);
        let balanced = (0..2).all(|axis| !free[axis] || hessian[2 * axis] > skewed);
        let expected = value - MAX_GAIN_FACTOR * decrease;
        // A parameter at an edge that the step sets free may save more.
        let is_set_free = |axis: usize| {
            let next = gradient[axis] + MAX_GAIN_FACTOR * second[1] * full[1 - axis];
            !free[axis] && !pushes_out(at[axis], next)
        };
        let predicts = || is_convex && !is_set_free(0) && !is_set_free(1) || !is_beside();
        if balanced && expected > threshold && predicts() {
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
            let stalled = off_saddle.is_none() && decrease <= STALLED_DECREASE * value;
            if stalled || halvings > MAX_HALVINGS {
                let stalled = stalled || off_saddle.is_some();
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

/// Returns whether the target lies nearly in the tangent plane; true where the tangents span no plane.
fn lies_beside(jet: &Jet, residual: DVec3) -> bool {
    let normal = jet.s.cross(jet.t);
    let height = normal.dot(residual);
    height * height <= MAX_SINE_BESIDE_SQUARED * normal.length_squared() * residual.length_squared()
}

/// Returns whether the tangents are not nearly parallel.
fn is_regular(jet: &Jet) -> bool {
    let area_squared = jet.s.cross(jet.t).length_squared();
    area_squared > MIN_SINE_SQUARED * jet.s.length_squared() * jet.t.length_squared()
}

/// Returns the second derivatives `[ss, st, tt]` of ½|S - target|².
fn second_derivatives(jet: &Jet, residual: DVec3) -> [f64; 3] {
    [
        jet.s.dot(jet.s) + residual.dot(jet.ss),
        jet.s.dot(jet.t) + residual.dot(jet.st),
        jet.t.dot(jet.t) + residual.dot(jet.tt),
    ]
}

/// Returns a step along which the second derivatives at a stationary point let the squared distance fall, by more
/// than rounding; `None` at minima.
///
/// It leads along the axis along which the distance is the more concave, with the best step of the other one, half as
/// far as the patch goes on. Where a derivative vanishes at a corner, the corner is stationary for targets far from it.
fn step_off_saddle(
    at: [f64; 2],
    gradient: [f64; 2],
    &[ss, st, tt]: &[f64; 3],
    value: f64,
) -> Option<[f64; 2]> {
    let towards = if ss <= tt { [1.0, slope(st, tt)] } else { [slope(st, ss), 1.0] };
    let [x, y] = towards;
    let curvature = ss * x * x + 2.0 * st * x * y + tt * y * y;
    if curvature >= 0.0 {
        return None;
    }
    let room = |sign: f64| {
        let along = |axis: usize| {
            let direction = sign * towards[axis];
            let rest = if direction > 0.0 { 1.0 - at[axis] } else { at[axis] };
            if direction == 0.0 { f64::INFINITY } else { rest / direction.abs() }
        };
        along(0).min(along(1))
    };
    let length = if room(1.0) >= room(-1.0) { 0.5 * room(1.0) } else { -0.5 * room(-1.0) };
    let linear = length * (gradient[0] * x + gradient[1] * y);
    let predicted = linear + 0.5 * curvature * length * length;
    (predicted < -MIN_SADDLE_DECREASE * value).then_some(towards.map(|share| share * length))
}

/// The step of a parameter with this second derivative for one of the other one, with which the distance is least.
fn slope(mixed: f64, own: f64) -> f64 {
    if own > 0.0 { -mixed / own } else { 0.0 }
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

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::closest::nearest_control;
    use crate::param_box::ParamBox;
    use glam::DVec4;

    /// The part of a plane between a curve and a line, by which no derivative leads along the line from its end.
    const BETWEEN: [[f64; 2]; 6] =
        [[0.0, 76.0], [45.0, 76.0], [67.0, 36.0], [76.0, 76.0], [76.0, 76.0], [76.0, 36.0]];

    const ITERATIONS: u32 = 16;

    /// A squared distance of nearly nothing.
    const NEARLY: f64 = 1e-12;

    fn with_patch<T>(then: impl Fn(&Patch<'_>) -> T) -> T {
        let controls = BETWEEN.map(|[x, y]| DVec4::new(x, y, 0.0, 1.0));
        then(&Patch {
            surface: 0,
            degree: [1, 2],
            domain: ParamBox::UNIT,
            center: DVec3::ZERO,
            controls: &controls,
            rational: false,
        })
    }

    /// Points of the patch within its parameters.
    fn targets(patch: &Patch<'_>) -> Vec<DVec3> {
        let at = |step: usize| (step as f64 + 0.5) / 20.0;
        (0..400).map(|index| patch.point([at(index / 20), at(index % 20)])).collect()
    }

    /// The corner where a derivative vanishes is stationary for the targets beside it; from there and from the
    /// control point nearest to a target every target is reached.
    #[test]
    fn saddles_are_left() {
        with_patch(|patch| {
            let corner = [1.0, 0.0];
            let mut stuck = 0;
            for target in targets(patch) {
                for start in [nearest_control(patch, target), corner] {
                    stuck += usize::from(newton(patch, target, start, ITERATIONS).distance_squared > 1.0);
                    let (foot, _) = newton_below(patch, target, start, ITERATIONS, NEARLY);
                    assert!(foot.distance_squared <= NEARLY, "{target} from {start:?}: {foot:?}");
                }
            }
            assert!(stuck > 0);
        });
    }

    /// Where the distance is concave at the start, or an edge is left, the first step predicts little, and the search
    /// goes on.
    #[test]
    fn no_target_of_the_patch_is_given_up() {
        with_patch(|patch| {
            for target in targets(patch) {
                let start = nearest_control(patch, target);
                let (foot, _) = newton_below(patch, target, start, ITERATIONS, 1.0);
                assert!(foot.distance_squared < 1.0, "{target} from {start:?}: {foot:?}");
            }
        });
    }

    /// A foot at a minimum costs no more: no step is taken from it.
    #[test]
    fn minima_are_no_saddles() {
        let minimum = [2.0, -1.0, 1.0];
        assert_eq!(step_off_saddle([0.5; 2], [0.0; 2], &minimum, 1.0), None);
        // Concave along t, and along a direction between the axes alone.
        assert_eq!(step_off_saddle([0.5, 0.25], [0.0; 2], &[2.0, 0.0, -1.0], 1.0), Some([0.0, 0.375]));
        assert_eq!(step_off_saddle([0.5, 0.75], [0.0; 2], &[2.0, 2.0, 1.0], 1.0), Some([0.25, -0.25]));
        // An edge that is pushed against by more than the distance falls beyond it.
        assert_eq!(step_off_saddle([0.5, 0.0], [0.0, 0.3], &[2.0, 0.0, -1.0], 1.0), None);
    }
}
