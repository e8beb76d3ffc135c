//! Local maximization of the distance over one patch of A.

use super::super::Pair;
use super::super::nearest::{Feet, Foot, NearestPoint, Query, Sample};
use super::newton_step::{Step, newton_step};

/// Bound on the steps: from a sample one cell away, Newton's method takes a few.
const MAX_STEPS: usize = 16;

/// Trust region radius of the first step, in the patch's parameters.
const INITIAL_RADIUS: f64 = 0.5;

/// Trust region radius relative to a step that was rejected.
const RADIUS_REDUCTION: f64 = 0.25;

/// Moves a sample uphill on its patch; the result is at least as far from B, up
/// to the query for the nearest patch. Steps whose predicted gain of distance is
/// below `min_gain` are not taken.
///
/// Every step is by the known feet. Where it is rejected because a patch that
/// was not known is nearer there, that patch's foot is known from then on; else
/// the trust region shrinks.
pub(super) fn ascend(pair: &Pair<'_>, nearest: &NearestPoint<'_>, start: Sample, min_gain: f64) -> Sample {
    let patch = pair.a.patch(start.patch);
    let mut at = start.parameters;
    let mut feet = Feet::new(start.foot);
    let mut radius = INITIAL_RADIUS;
    for _ in 0..MAX_STEPS {
        let best = feet.nearest();
        let jet = pair.jet_of_a(start.patch, at);
        let Some(Step { step, predicted_gain }) = newton_step(&pair.b, at, &jet, &feet, radius) else {
            break;
        };
        // The gain is one of squared distances.
        if predicted_gain <= 2.0 * best.distance() * min_gain {
            break;
        }
        let next = [0, 1].map(|axis| (at[axis] + step[axis]).clamp(0.0, 1.0));
        let target = pair.transform.apply(patch.point(next));
        let from_known = |foot: &Foot| nearest.on_patch(target, foot.patch, foot.parameters);
        let mut next_feet = Feet::new(from_known(&best));
        for foot in &feet.all()[1..] {
            next_feet.add(from_known(foot));
        }
        let mut found = next_feet.nearest();
        if found.distance_squared > best.distance_squared {
            let query = Query { target, known: found, sufficient: best.distance() };
            found = nearest.near(&query).nearest();
        }
        if found.distance_squared > best.distance_squared {
            next_feet.add(found);
            (at, feet) = (next, next_feet);
            continue;
        }
        let is_known = feet.has(found.patch);
        feet.add(nearest.on_patch(jet.point, found.patch, found.parameters));
        if is_known || !feet.has(found.patch) {
            radius = RADIUS_REDUCTION * step.abs().max_element();
        }
    }
    Sample { parameters: at, foot: feet.nearest(), ..start }
}
