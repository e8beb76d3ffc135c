//! Stage `climb`: a sample moved to where the distance is locally largest.

use super::Operand;
use super::feet::{Feet, Foot, Sample};
use super::met::Met;
use super::nearest::{foot_on, nearest_feet};
use super::side::moved;
use super::step::step;
use crate::model::RigidTransform;

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
/// Every [`step`] is by the patches met so far. Where it leads to a patch that
/// is nearer than where it began, that one counts too from then on; where that
/// is no news, the next step is shorter.
pub(super) fn climb(
    a: &Operand<'_>,
    b: &Operand<'_>,
    transform: &RigidTransform,
    patch: u32,
    start: Sample,
    least: f64,
    met: &mut Met,
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
        let next = [0, 1].map(|axis| (at[axis] + step[axis]).clamp(0.0, 1.0));
        let point = transform.apply(surface.point(next));
        let mut again = |foot: &Foot| {
            let foot = foot_on(b, point, foot.patch, foot.parameters);
            met.add(foot.patch, point, foot.distance());
            foot
        };
        let mut moved = Feet::of(again(&best));
        for foot in &feet.all()[1..] {
            moved.add(again(foot));
        }
        let mut found = moved.nearest();
        if found.distance_squared > best.distance_squared {
            found = nearest_feet(b, point, found, best.distance(), 0.0, Some(met)).nearest();
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
