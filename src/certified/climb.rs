//! Stage `climb`: a sample moved to where the distance is locally largest.

use super::Side;
use super::balance::{Balance, balance, plane_of_distance};
use super::feet::{Feet, Sample};
use super::foot_map::FootMap;
use super::nearest::{foot_on, nearest_within};
use super::side::moved;
use crate::bezier::Jet;
use crate::both::both;
use crate::model::RigidTransform;
use glam::{DMat2, DVec2};

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
        let mut moved = Feet::of(foot_on(b, point, best.patch, best.parameters));
        for foot in &feet.all()[1..] {
            moved.add(foot_on(b, point, foot.patch, foot.parameters));
        }
        let mut found = moved.nearest();
        if found.distance_squared > best.distance_squared {
            found = nearest_within(b, point, found, best.distance());
        }
        if found.distance_squared > best.distance_squared {
            moved.add(found);
            (at, feet) = (next, moved);
            continue;
        }
        let is_known = feet.has(found.patch);
        feet.add(foot_on(b, jet.point, found.patch, found.parameters));
        if is_known || !feet.has(found.patch) {
            reach = SHORTER * step.abs().max_element();
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
    let Balance { weights, place, height } = balance(&planes);
    let [low, high] = [low, high].map(DVec2::from_array);
    let nearest = feet.nearest().distance_squared;
    let model = |index: usize| {
        let foot = &feet.all()[index];
        quadratic(jet, &b.patch(foot.patch).jet(foot.parameters))
    };
    let [(first, of_first), (second, of_second), (_, of_third)] = weights;
    // The nearest patch's is the first plane.
    if of_first == 1.0 && first == 0 {
        let (step, gradient) = ascent(at, reach, jet, model(0))?;
        let step = step.max(low).min(high);
        return Some((step, 2.0 * step.dot(gradient)));
    }
    let place = DVec2::from_array(place);
    let straight = 0.5 * (low + high + place * (high - low));
    if of_third == 0.0 && of_first < 1.0 {
        let [value, other] = [first, second].map(|index| feet.all()[index].distance_squared);
        let (step, gain) = ridge(model(first), model(second), other - value);
        if step == step.max(low).min(high) {
            return Some((step, value - nearest + gain));
        }
    }
    Some((straight, height - nearest))
}

/// Newton's step to the highest place of the ridge between two patches.
fn ridge(one: (DVec2, DMat2), two: (DVec2, DMat2), behind: f64) -> (DVec2, f64) {
    let across = one.0 - two.0;
    let length_squared = across.length_squared();
    let onto = across * (0.5 * behind / length_squared);
    let direction = across.perp();
    let weight = (-two.0.dot(across) / length_squared).clamp(0.0, 1.0);
    let hessian = two.1 + (one.1 - two.1) * weight;
    let gradient = two.0 + weight * across;
    let bend = direction.dot(hessian * direction);
    let step = onto - direction * ((gradient + hessian * onto).dot(direction) / bend.min(0.0));
    (step, step.dot(2.0 * one.0 + hessian * step))
}

/// Gradient and Hessian of half the squared distance.
fn quadratic(a: &Jet, b: &Jet) -> (DVec2, DMat2) {
    let way = a.point - b.point;
    let FootMap { p, q, .. } =
        FootMap::linearised(b, -way, [a.s, a.t], [false; 2]).unwrap_or(FootMap::CONSTANT);
    let s = a.s - p.x * b.s - p.y * b.t;
    let t = a.t - q.x * b.s - q.y * b.t;
    let mixed = a.s.dot(t) + way.dot(a.st);
    let hessian =
        DMat2::from_cols_array(&[a.s.dot(s) + way.dot(a.ss), mixed, mixed, a.t.dot(t) + way.dot(a.tt)]);
    (DVec2::new(way.dot(a.s), way.dot(a.t)), hessian)
}

/// Newton's step to the maximum on one patch, else one uphill that goes as far
/// as `reach`, with what it promises.
fn ascent(at: [f64; 2], reach: f64, a: &Jet, (gradient, hessian): (DVec2, DMat2)) -> Option<(DVec2, DVec2)> {
    let free = both(|axis| {
        !((at[axis] <= 0.0 && gradient[axis] < 0.0) || (at[axis] >= 1.0 && gradient[axis] > 0.0))
    });
    let step = match free {
        [false, false] => return None,
        [true, true] if hessian.x_axis.x < 0.0 && hessian.determinant() > 0.0 => {
            hessian.inverse() * -gradient
        }
        [true, false] if hessian.x_axis.x < 0.0 => DVec2::new(-gradient.x / hessian.x_axis.x, 0.0),
        [false, true] if hessian.y_axis.y < 0.0 => DVec2::new(0.0, -gradient.y / hessian.y_axis.y),
        _ => {
            let uphill = both(|axis| {
                let along = if axis == 0 { a.s } else { a.t };
                if free[axis] { gradient[axis] / along.length_squared().max(f64::MIN_POSITIVE) } else { 0.0 }
            });
            let uphill = DVec2::from_array(uphill);
            uphill * (reach / uphill.abs().max_element().max(f64::MIN_POSITIVE))
        }
    };
    step.is_finite().then_some((step, gradient))
}
