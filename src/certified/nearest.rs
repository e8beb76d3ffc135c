//! A near foot on B, found fast and certified by nobody.

use super::Operand;
use super::feet::{Feet, Foot};
use super::met::Met;
use crate::closest::{self, NearbyPatch, Status, nearest_control, newton_below};
use glam::DVec3;
use std::sync::atomic::Ordering;

/// Newton steps on one patch, at most: bounds hold wherever it stops.
const ITERATIONS: u32 = 16;

/// The foot on one patch from a start near it.
pub(super) fn foot_on(side: &Operand<'_>, target: DVec3, patch: u32, start: [f64; 2]) -> Foot {
    foot_below(side, target, patch, start, f64::INFINITY).0
}

/// A place on B as a foot.
pub(super) fn place_on(side: &Operand<'_>, target: DVec3, patch: u32, parameters: [f64; 2]) -> Foot {
    let distance_squared = side.patch(patch).point(parameters).distance_squared(target);
    Foot { distance_squared, ..Foot::start(patch, parameters) }
}

/// The same, given up where it will not be nearer than `most`, squared; with
/// the squared distance that is expected of the patch at least.
fn foot_below(side: &Operand<'_>, target: DVec3, patch: u32, start: [f64; 2], most: f64) -> (Foot, f64) {
    let (foot, least) = newton_below(&side.patch(patch), target, start, ITERATIONS, most);
    let closest::Foot { parameters, distance_squared, status } = foot;
    (Foot { patch, parameters, distance_squared, status }, least)
}

/// The nearest foot over all patches that the tree does not rule out, given
/// one to beat, ended by the first that is at most `prune_threshold` away. O(log patches)
/// in general position.
pub(super) fn nearest_within(side: &Operand<'_>, target: DVec3, known: Foot, prune_threshold: f64) -> Foot {
    nearest_feet(side, target, known, prune_threshold, 0.0, None).nearest()
}

/// The same with the feet met on the way, patches ruled out that cannot be
/// nearer by more than `slack`.
///
/// About the point for which B's patches are listed only those are looked at,
/// from where they were near it, in the order of their bounds. Those met before
/// are looked at again only where they may have come nearer.
pub(super) fn nearest_feet(
    side: &Operand<'_>,
    target: DVec3,
    known: Foot,
    prune_threshold: f64,
    slack: f64,
    met: Option<&mut Met>,
) -> Feet {
    let until = prune_threshold.max(0.0) * prune_threshold;
    let mut looking = Looking { side, target, known, slack, met, feet: Feet::of(known), most: 0.0 };
    looking.tighten();
    if let Some(about) = &side.candidates {
        let moved = about.center.distance(target);
        if moved < about.margin() {
            for candidate in &about.list {
                let NearbyPatch { patch, parameters, lower_bound: least, .. } = *candidate;
                let least = (least - moved).max(0.0);
                if least * least >= looking.most || looking.nearest() <= until {
                    break;
                }
                if about.lower_bound_squared(candidate, target) < looking.most {
                    looking.look(patch, parameters);
                }
            }
            if looking.most.sqrt() <= about.radius - moved {
                return looking.feet;
            }
        }
    }
    let nodes = side.target.tree.nodes();
    let least = |index: usize| nodes[index].aabb.min_distance_squared(target);
    let mut waiting = [(0.0_f64, 0_usize); STACK];
    let mut height = 1;
    while height > 0 && looking.nearest() > until {
        height -= 1;
        let (distance_squared, index) = waiting[height];
        if distance_squared >= looking.most {
            continue;
        }
        let node = &nodes[index];
        if !node.is_leaf() {
            let (first, second) = (index + 1, node.right_child as usize);
            let (near, far) = (least(first), least(second));
            let pair =
                if near <= far { [(far, second), (near, first)] } else { [(near, first), (far, second)] };
            for (distance_squared, child) in pair {
                if distance_squared < looking.most {
                    waiting[height] = (distance_squared, child);
                    height += 1;
                }
            }
            continue;
        }
        let patch = side.target.tree.primitive(node);
        if !looking.is_known_far(patch)
            && side.target.boxes[patch as usize].min_distance_squared(target) < looking.most
        {
            looking.look(patch, nearest_control(&side.patch(patch), target));
        }
    }
    looking.feet
}

/// A search for the nearest foot.
struct Looking<'a> {
    side: &'a Operand<'a>,
    target: DVec3,
    known: Foot,
    slack: f64,
    met: Option<&'a mut Met>,
    feet: Feet,
    /// Squared distance below which a patch is worth a look.
    most: f64,
}

impl Looking<'_> {
    fn nearest(&self) -> f64 {
        self.feet.nearest().distance_squared
    }

    fn tighten(&mut self) {
        let most = (self.feet.nearest().distance() - self.slack).max(0.0);
        self.most = most * most;
    }

    /// Whether a patch was so far, when it was met, that it is not the nearest.
    fn is_known_far(&self, patch: u32) -> bool {
        self.met.as_ref().is_some_and(|met| met.least(patch, self.target) >= self.most.sqrt())
    }

    /// Takes in the foot from a start on a patch.
    fn look(&mut self, patch: u32, start: [f64; 2]) {
        // On the known foot's patch, only another valley is news.
        let stale = patch == self.known.patch
            && self.known.status != Status::IterationLimit
            && self.side.patch(patch).point(start).distance_squared(self.target) >= self.nearest();
        if stale {
            return;
        }
        self.side.looks.fetch_add(1, Ordering::Relaxed);
        let (foot, least) = foot_below(self.side, self.target, patch, start, self.most);
        if let Some(met) = &mut self.met {
            met.add(patch, self.target, least.max(0.0).sqrt());
        }
        self.feet.add(foot);
        self.tighten();
    }
}

/// Deeper than a tree that halves the patches can be, with indices of 32 bits.
const STACK: usize = 64;
