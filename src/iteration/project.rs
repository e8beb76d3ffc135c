//! Stage `project`: the nearest foot of every sample.

use super::{Projected, Rule};
use crate::bezier::Patch;
use crate::closest::{Foot, Projection, Status, Target, nearest_control, newton, tangent_plane};
use glam::DVec3;
use serde::Deserialize;

/// Which patches a sample is projected on. The distances are the same: a
/// patch is left out only if its box is no nearer than a foot already found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Culling {
    /// Those that a bounding-box tree does not rule out.
    #[default]
    Tree,
    /// All, as in the paper.
    None,
}

/// The least distance from `sample` that the rule's iterations find on the
/// target's patches; infinite only for a target without patches.
///
/// Never less than the sample's distance to the target. With the tree,
/// O(log patches) in general position; else O(patches).
#[must_use]
pub fn project(target: &Target, sample: DVec3, rule: &Rule) -> Projected {
    let mut best = Projected {
        distance_squared: f64::INFINITY,
        patch: 0,
        parameters: [0.0; 2],
        status: Status::IterationLimit,
    };
    match rule.culling {
        Culling::None => {
            for (index, patch) in target.patches.iter().enumerate() {
                offer(&mut best, index, project_on(&patch, sample, rule));
            }
        }
        Culling::Tree => descend(target, sample, rule, &mut best),
    }
    best
}

fn project_on(patch: &Patch<'_>, sample: DVec3, rule: &Rule) -> Foot {
    let start = nearest_control(patch, sample);
    match rule.projection {
        Projection::Newton => newton(patch, sample, start, rule.iterations),
        Projection::TangentPlane => tangent_plane(patch, sample, start, rule.iterations, rule.step_tolerance),
    }
}

fn offer(best: &mut Projected, patch: usize, foot: Foot) {
    if foot.distance_squared < best.distance_squared {
        *best = Projected {
            distance_squared: foot.distance_squared,
            patch,
            parameters: foot.parameters,
            status: foot.status,
        };
    }
}

/// Depth first, the nearer child first.
fn descend(target: &Target, sample: DVec3, rule: &Rule, best: &mut Projected) {
    let nodes = target.tree.nodes();
    let least = |index: usize| nodes[index].aabb.min_distance_squared(sample);
    if nodes.is_empty() {
        return;
    }
    let mut stack = vec![(least(0), 0)];
    while let Some((distance_squared, index)) = stack.pop() {
        if distance_squared >= best.distance_squared {
            continue;
        }
        let node = &nodes[index];
        if !node.is_leaf() {
            let mut children = [index + 1, node.second as usize].map(|child| (least(child), child));
            if children[0].0 < children[1].0 {
                children.swap(0, 1);
            }
            stack.extend_from_slice(&children);
            continue;
        }
        let patch = target.tree.item(node) as usize;
        offer(best, patch, project_on(&target.patches.patch(patch), sample, rule));
    }
}
