//! A near foot on B, found fast and certified by nobody.

use super::Side;
use crate::project::{Candidate, Status, is_beyond, nearest_control, newton_below};
use glam::DVec3;
use std::sync::atomic::Ordering;

/// Newton steps on one patch, at most: bounds hold wherever it stops.
const ITERATIONS: u32 = 16;

/// A point of B near a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Foot {
    pub(crate) patch: u32,
    pub(crate) parameters: [f64; 2],
    pub(crate) distance_squared: f64,
    pub(crate) status: Status,
}

impl Foot {
    /// A place on B where an iteration may start, however far.
    pub(crate) fn start(patch: u32, parameters: [f64; 2]) -> Self {
        Self { patch, parameters, distance_squared: f64::INFINITY, status: Status::IterationLimit }
    }
}

/// The foot on one patch from a start near it.
pub(super) fn foot_on(side: &Side<'_>, target: DVec3, patch: u32, start: [f64; 2]) -> Foot {
    foot_below(side, target, patch, start, f64::INFINITY)
}

/// The same, given up where it will not be nearer than `most`, squared.
fn foot_below(side: &Side<'_>, target: DVec3, patch: u32, start: [f64; 2], most: f64) -> Foot {
    let foot = newton_below(&side.patch(patch), target, start, ITERATIONS, most);
    Foot { patch, parameters: foot.parameters, distance_squared: foot.distance_squared, status: foot.status }
}

/// The nearest foot over all patches that the tree does not rule out, given
/// one to beat. O(log patches) in general position.
pub(super) fn nearest(side: &Side<'_>, target: DVec3, known: Foot) -> Foot {
    nearest_within(side, target, known, 0.0)
}

/// The same, ended by the first foot that is at most `enough` away.
///
/// About the point for which B's patches are listed only those are looked at,
/// from where they were near it, in the order of their bounds.
pub(super) fn nearest_within(side: &Side<'_>, target: DVec3, known: Foot, enough: f64) -> Foot {
    let until = enough.max(0.0) * enough;
    let mut best = known;
    if let Some(about) = &side.candidates {
        let moved = about.center.distance(target);
        if moved < about.room() {
            for &Candidate { patch, parameters, least } in &about.list {
                if least - moved >= best.distance_squared.sqrt() || best.distance_squared <= until {
                    break;
                }
                look(side, target, patch, parameters, &known, &mut best);
            }
            if best.distance_squared.sqrt() <= about.reach - moved {
                return best;
            }
        }
    }
    let nodes = side.target.tree.nodes();
    let least = |index: usize| nodes[index].aabb.min_distance_squared(target);
    let mut waiting = [(0.0_f64, 0_usize); STACK];
    let mut height = 1;
    while height > 0 && best.distance_squared > until {
        height -= 1;
        let (distance_squared, index) = waiting[height];
        if distance_squared >= best.distance_squared {
            continue;
        }
        let node = &nodes[index];
        if node.count == 0 {
            let (first, second) = (index + 1, node.second as usize);
            let (near, far) = (least(first), least(second));
            let pair =
                if near <= far { [(far, second), (near, first)] } else { [(near, first), (far, second)] };
            for (distance_squared, child) in pair {
                if distance_squared < best.distance_squared {
                    waiting[height] = (distance_squared, child);
                    height += 1;
                }
            }
            continue;
        }
        let first = node.first as usize;
        for &patch in &side.target.tree.order()[first..first + node.count as usize] {
            let view = side.patch(patch);
            let start = nearest_control(&view, target);
            if is_beyond(&view, target, start, best.distance_squared) {
                continue;
            }
            look(side, target, patch, start, &known, &mut best);
        }
    }
    best
}

/// The foot from a start on a patch, if it is nearer than the best.
fn look(side: &Side<'_>, target: DVec3, patch: u32, start: [f64; 2], known: &Foot, best: &mut Foot) {
    // On the known foot's patch, only another valley is news.
    let stale = patch == known.patch
        && side.patch(patch).point(start).distance_squared(target) >= best.distance_squared;
    if stale {
        return;
    }
    side.looks.fetch_add(1, Ordering::Relaxed);
    let foot = foot_below(side, target, patch, start, best.distance_squared);
    if foot.distance_squared < best.distance_squared {
        *best = foot;
    }
}

/// Deeper than a tree that halves the patches can be, with indices of 32 bits.
const STACK: usize = 64;
