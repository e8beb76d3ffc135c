//! Stage `climb`: a sample moved to where the distance is locally largest.

use super::Side;
use super::balance::{balance, plane_of_distance};
use super::feet::{Feet, Sample};
use super::foot_map::FootMap;
use super::nearest::{foot_on, nearest_within};
use super::side::moved;
use crate::bezier::Jet;
use crate::both::both;
use crate::model::RigidTransform;
use glam::DVec2;

/// Steps, at most: from a sample one cell away, Newton's method takes a few.
const STEPS: usize = 16;

/// Part of the patch's parameters that a step goes at most, at first.
const FIRST_REACH: f64 = 0.5;

/// Part of a step that the next may go after one that led no higher.
const SHORTER: f64 = 0.25;

/// A sample of the patch at least as far from B as the one given, up to the
/// search for the nearest patch; steps that promise to go farther by less than
/// `least` are not taken.
///
/// The gradient of `½ d²` on A is `(a - b)·A_s`, the foot's own change adding
/// nothing as it is stationary; its Hessian is `A_s·A_s + (a - b)·A_ss` less
/// what the foot gains by following, `A_s·B_u p_u + A_s·B_v p_v` with p the
/// derivative of the foot. Newton's step where that is negative definite, else
/// a short step uphill. Where a step is stopped by a nearer patch, that counts
/// too from then on, and the step is to where the feet [`balance`]: where a
/// maximum lies on patches equally near, that is Newton's method for it.
pub(super) fn climb(
    a: &Side<'_>,
    b: &Side<'_>,
    transform: &RigidTransform,
    patch: u32,
    start: Sample,
    least: f64,
) -> Sample {
    let surface = a.patch(patch);
    let mut at = start.parameters;
    let mut feet = Feet::of(start.foot);
    let mut reach = FIRST_REACH;
    for _ in 0..STEPS {
        let best = feet.nearest();
        let jet = moved(&surface.jet(at), transform);
        let Some((step, promised)) = step(b, at, &jet, &feet, reach) else { break };
        if promised <= 2.0 * best.distance() * least {
            break;
        }
        let next = both(|axis| (at[axis] + step[axis]).clamp(0.0, 1.0));
        let point = transform.apply(surface.point(next));
        let known = foot_on(b, point, best.patch, best.parameters);
        let found = nearest_within(b, point, known, best.distance());
        if found.distance_squared > best.distance_squared {
            let mut moved = Feet::of(found);
            for foot in feet.all().iter().filter(|foot| foot.patch != found.patch) {
                moved.add(foot_on(b, point, foot.patch, foot.parameters));
            }
            (at, feet) = (next, moved);
        } else if feet.has(found.patch) {
            reach *= SHORTER;
        } else {
            feet.add(foot_on(b, jet.point, found.patch, found.parameters));
        }
    }
    Sample { parameters: at, foot: feet.nearest() }
}

/// A step of at most `reach`, and by how much it promises to raise the squared distance.
fn step(b: &Side<'_>, at: [f64; 2], jet: &Jet, feet: &Feet, reach: f64) -> Option<(DVec2, f64)> {
    let low = both(|axis| (-at[axis]).max(-reach));
    let high = both(|axis| (1.0 - at[axis]).min(reach));
    let mut planes = Vec::with_capacity(feet.all().len());
    for foot in feet.all() {
        planes.push(plane_of_distance(jet, b.patch(foot.patch).point(foot.parameters), low, high));
    }
    let balance = balance(&planes);
    let best = feet.nearest();
    // The nearest patch's is the first plane.
    if balance.weights.iter().any(|&(index, weight)| index == 0 && weight == 1.0) {
        let (step, promised) = ascent(at, reach, jet, &b.patch(best.patch).jet(best.parameters))?;
        let [low, high] = [low, high].map(DVec2::from_array);
        return Some((step.max(low).min(high), promised));
    }
    let along = |axis: usize| {
        let place = balance.place[axis];
        0.5 * ((1.0 - place) * low[axis] + (1.0 + place) * high[axis])
    };
    Some((DVec2::new(along(0), along(1)), balance.height - best.distance_squared))
}

/// Newton's step to the maximum on one patch, else one uphill that goes as far
/// as `reach`, with what it promises.
fn ascent(at: [f64; 2], reach: f64, a: &Jet, b: &Jet) -> Option<(DVec2, f64)> {
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
            uphill * (reach / uphill.abs().max_element().max(f64::MIN_POSITIVE))
        }
    };
    step.is_finite().then_some((step, 2.0 * step.dot(gradient)))
}
