//! Local maximization of the distance to B: far points of A, which raise the
//! lower bound.
//!
//! Nothing here is certified. The search certifies a point's distance before it
//! becomes the incumbent.

mod adjacency;
mod ascend;
mod newton_step;
mod support_point;

use super::Pair;
use super::nearest::{Foot, NearestPoint, Sample};
use adjacency::adjacent_patches;
use ascend::ascend;
use support_point::support_point;

/// Bound on the patches that an ascent crosses to from the first.
const MAX_CROSSINGS: usize = 8;

/// Moves a sample to a local maximum of the distance, over the edges of its
/// patch too, as long as that gains more than `min_gain`.
pub(super) fn ascend_across(
    pair: &Pair<'_>,
    nearest: &NearestPoint<'_>,
    start: Sample,
    min_gain: f64,
) -> Sample {
    let mut best = ascend(pair, nearest, start, min_gain);
    let mut visited = vec![best.patch];
    for _ in 0..MAX_CROSSINGS {
        let from = best;
        for (patch, parameters) in adjacent_patches(&pair.a, from.patch, from.parameters) {
            if visited.contains(&patch) {
                continue;
            }
            visited.push(patch);
            let further = ascend(pair, nearest, Sample { patch, parameters, ..from }, min_gain);
            if further.foot.distance() > best.foot.distance() + min_gain {
                best = further;
                break;
            }
        }
        if best.patch == from.patch {
            break;
        }
    }
    best
}

/// Two samples to begin with: the support point of A in the direction from B's
/// centre to A's, which is a witness also where the boxes alone answer and the
/// farthest point of a moved copy, and the middle of a patch. `None` for a model
/// without patches.
pub(super) fn starting_points(pair: &Pair<'_>, nearest: &NearestPoint<'_>) -> Option<[Sample; 2]> {
    let tree = &pair.a.target.tree;
    let (root_a, root_b) = (tree.nodes().first()?, pair.b.target.tree.nodes().first()?);
    let [from, to] = [root_a.aabb.center(), root_b.aabb.center()];
    let direction = pair.transform.inverse().rotate(pair.transform.apply(from) - to);
    let start = |(patch, parameters)| {
        let target = pair.point_of_a(patch, parameters);
        Sample { patch, parameters, foot: nearest.nearest(target, Foot::start(0, [0.5; 2]), 0.0) }
    };
    let support = support_point(&pair.a, direction).unwrap_or((0, [0.5; 2]));
    Some([start(support), start((tree.primitive(root_a), [0.5; 2]))])
}
