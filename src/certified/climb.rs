//! Stage `climb`: a sample moved to where the distance is locally largest.

use super::Side;
use super::foot_map::FootMap;
use super::nearest::{Foot, foot_on, nearest_within};
use super::side::moved;
use crate::bezier::Jet;
use crate::both::both;
use crate::model::RigidTransform;
use glam::DVec2;

/// Steps, at most: from a sample one cell away, Newton's method takes a few.
const STEPS: usize = 8;

/// Halvings of a step, at most.
const HALVINGS: usize = 4;

/// Part of the patch's parameters that a step without a maximum in sight goes.
const ASCENT: f64 = 0.05;

/// Parameters on the patch whose distance to B is at least the sample's, up to
/// the search for the nearest patch, and their foot.
///
/// The gradient of `½ d²` on A is `(a - b)·A_s`, the foot's own change adding
/// nothing as it is stationary; its Hessian is `A_s·A_s + (a - b)·A_ss` less
/// what the foot gains by following, `A_s·B_u p_u + A_s·B_v p_v` with p the
/// derivative of the foot. Newton's step where that is negative definite, else
/// a short step uphill; each halved until the distance grows.
pub(super) fn climb(
    a: &Side<'_>,
    b: &Side<'_>,
    transform: &RigidTransform,
    patch: u32,
    start: [f64; 2],
    foot: Foot,
) -> ([f64; 2], Foot) {
    let surface = a.patch(patch);
    let (mut at, mut best) = (start, foot);
    for _ in 0..STEPS {
        let jet = moved(&surface.jet(at), transform);
        let Some(step) = ascent(at, &jet, &b.patch(best.patch).jet(best.parameters)) else { break };
        let mut scale = 1.0;
        let mut higher = None;
        for _ in 0..HALVINGS {
            let next = both(|axis| (at[axis] + scale * step[axis]).clamp(0.0, 1.0));
            let point = transform.apply(surface.point(next));
            let known = foot_on(b, point, best.patch, best.parameters);
            let found = nearest_within(b, point, known, best.distance_squared.sqrt());
            if found.distance_squared > best.distance_squared {
                higher = Some((next, found));
                break;
            }
            scale *= 0.5;
        }
        let Some((next, found)) = higher else { break };
        (at, best) = (next, found);
    }
    (at, best)
}

fn ascent(at: [f64; 2], a: &Jet, b: &Jet) -> Option<DVec2> {
    let residual = a.point - b.point;
    let gradient = DVec2::new(residual.dot(a.s), residual.dot(a.t));
    let free = both(|axis| {
        !((at[axis] <= 0.0 && gradient[axis] < 0.0) || (at[axis] >= 1.0 && gradient[axis] > 0.0))
    });
    let follow = FootMap::linearised(b, -residual, [a.s, a.t], [false; 2]).unwrap_or(FootMap::CONSTANT);
    let gain = |tangent: glam::DVec3, map: DVec2| tangent.dot(map.x * b.s + map.y * b.t);
    let ss = a.s.dot(a.s) + residual.dot(a.ss) - gain(a.s, follow.p);
    let st = a.s.dot(a.t) + residual.dot(a.st) - gain(a.s, follow.q);
    let tt = a.t.dot(a.t) + residual.dot(a.tt) - gain(a.t, follow.q);
    let step = match free {
        [false, false] => return None,
        [true, true] if ss < 0.0 && ss * tt > st * st => {
            DVec2::new(st * gradient.y - tt * gradient.x, st * gradient.x - ss * gradient.y)
                / (ss * tt - st * st)
        }
        [true, false] if ss < 0.0 => DVec2::new(-gradient.x / ss, 0.0),
        [false, true] if tt < 0.0 => DVec2::new(0.0, -gradient.y / tt),
        _ => {
            let uphill = DVec2::new(
                if free[0] { gradient.x / a.s.length_squared().max(f64::MIN_POSITIVE) } else { 0.0 },
                if free[1] { gradient.y / a.t.length_squared().max(f64::MIN_POSITIVE) } else { 0.0 },
            );
            uphill * (ASCENT / uphill.abs().max_element().max(f64::MIN_POSITIVE))
        }
    };
    step.is_finite().then_some(step)
}
