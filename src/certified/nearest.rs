//! A near foot on B, found fast and certified by nobody.

use super::Side;
use crate::bezier::Patch;
use crate::project::{Status, nearest_control, newton_below};
use glam::{DVec3, Vec4Swizzles};

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
    let mut best = known;
    let nodes = side.target.tree.nodes();
    let least = |index: usize| nodes[index].aabb.min_distance_squared(target);
    let mut waiting = [(0.0_f64, 0_usize); STACK];
    let mut height = 1;
    while height > 0 {
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
            if view.bounding_box().min_distance_squared(target) < best.distance_squared {
                let start = nearest_control(&view, target);
                if is_beyond(&view, target, start, best.distance_squared) {
                    continue;
                }
                // On the known foot's patch, only another valley is news.
                let stale = patch == known.patch
                    && view.point(start).distance_squared(target) >= best.distance_squared;
                if stale {
                    continue;
                }
                let foot = foot_below(side, target, patch, start, best.distance_squared);
                if foot.distance_squared < best.distance_squared {
                    best = foot;
                }
            }
        }
    }
    best
}

/// Whether all control points, and so the patch, lie beyond a plane at this
/// distance from the target, square to the way to a control point.
fn is_beyond(patch: &Patch<'_>, target: DVec3, [s, t]: [f64; 2], distance_squared: f64) -> bool {
    let local = target - patch.center;
    let columns = patch.degree[1] + 1;
    let index =
        (s * patch.degree[0] as f64 + 0.5) as usize * columns + (t * patch.degree[1] as f64 + 0.5) as usize;
    let control = patch.controls[index];
    let way = control.xyz() - control.w * local;
    let far = (way.length_squared() * distance_squared).sqrt();
    patch.controls.iter().all(|control| way.dot(control.xyz() - control.w * local) >= control.w * far)
}

/// Deeper than a tree that halves the patches can be, with indices of 32 bits.
const STACK: usize = 64;
