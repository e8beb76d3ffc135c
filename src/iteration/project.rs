//! Stage `project`: the nearest foot of a sample.

use super::{Projected, Rule};
use crate::bezier::Patch;
use crate::closest::{Foot, Projection, Status, Target, nearest_control, newton, tangent_plane};
use glam::DVec3;
use serde::Deserialize;

/// The choice of patches that a sample is projected on. It does not change the
/// distances: a patch is pruned only if its box is no nearer than a foot found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Culling {
    /// The patches that a bounding volume hierarchy does not prune.
    #[default]
    Tree,
    /// All patches, as in the 2012 paper.
    None,
}

/// Returns the nearest foot of `sample` that the rule's iterations find on the
/// target's patches; its distance is infinite only for a target without patches.
///
/// The distance is an upper bound on the sample's distance to the target. With
/// the hierarchy O(log patches) in general position, else O(patches).
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
                propose(&mut best, index, project_on(&patch, sample, rule));
            }
        }
        Culling::Tree => search_tree(target, sample, rule, &mut best),
    }
    best
}

/// Projects a sample on one patch.
fn project_on(patch: &Patch<'_>, sample: DVec3, rule: &Rule) -> Foot {
    let start = nearest_control(patch, sample);
    match rule.projection {
        Projection::Newton => newton(patch, sample, start, rule.iterations),
        Projection::TangentPlane => tangent_plane(patch, sample, start, rule.iterations, rule.step_tolerance),
    }
}

/// Replaces `best` by a nearer foot.
fn propose(best: &mut Projected, patch: usize, foot: Foot) {
    if foot.distance_squared < best.distance_squared {
        *best = Projected {
            distance_squared: foot.distance_squared,
            patch,
            parameters: foot.parameters,
            status: foot.status,
        };
    }
}

/// Searches the hierarchy depth first, the nearer child first.
fn search_tree(target: &Target, sample: DVec3, rule: &Rule, best: &mut Projected) {
    let nodes = target.tree.nodes();
    let lower_bound = |index: usize| nodes[index].aabb.min_distance_squared(sample);
    if nodes.is_empty() {
        return;
    }
    let mut stack = vec![(lower_bound(0), 0)];
    while let Some((distance_squared, index)) = stack.pop() {
        if distance_squared >= best.distance_squared {
            continue;
        }
        let node = &nodes[index];
        if !node.is_leaf() {
            let mut children =
                [index + 1, node.right_child as usize].map(|child| (lower_bound(child), child));
            if children[0].0 < children[1].0 {
                children.swap(0, 1);
            }
            stack.extend_from_slice(&children);
            continue;
        }
        let patch = target.tree.primitive(node) as usize;
        propose(best, patch, project_on(&target.patches.patch(patch), sample, rule));
    }
}
