//! Bounds on whole models and on the nodes of A's tree.

use super::super::audit::{Lemma, Lemmas};
use super::super::cell_context::LeastBound;
use super::super::nearest::{Foot, NearestPoint, Query, Sample};
use super::super::{Cell, Pair};
use super::{same_net, sphere};

/// An upper bound on the directed distance, before anything is searched: by
/// the models' boxes, or by the bounds on whole patches where they cover A.
/// O(patches p q), less where the first patch has no such bound.
pub(in crate::certified) fn whole_models(pair: &Pair<'_>, struck: Lemmas) -> LeastBound {
    let mut least = over_whole_patches(pair, struck);
    least.take(between_boxes(pair), Lemma::ModelBoxes);
    least
}

/// The largest of the bounds on whole patches of A; none once one has none.
fn over_whole_patches(pair: &Pair<'_>, struck: Lemmas) -> LeastBound {
    let sphere = pair.b.sphere.filter(|_| !struck.contains(Lemma::Sphere));
    let mut largest = LeastBound { upper: 0.0, lemma: None };
    for index in 0..pair.a.patches().len() as u32 {
        let mut least = LeastBound::NONE;
        if !struck.contains(Lemma::SameNet) {
            least.take(same_net::upper_bound(pair, index), Lemma::SameNet);
        }
        if let Some(sphere) = &sphere {
            let (cell, patch) = (Cell::whole(index), pair.a.patch(index));
            least.take(sphere::upper_bound(&cell, &patch, &pair.transform, sphere), Lemma::Sphere);
        }
        if least.upper == f64::INFINITY {
            return LeastBound::NONE;
        }
        if largest.lemma.is_none() || least.upper > largest.upper {
            largest = least;
        }
    }
    largest
}

/// The largest distance between points of the two models' boxes.
fn between_boxes(pair: &Pair<'_>) -> f64 {
    let [a, b] = [&pair.a, &pair.b].map(|operand| operand.target.tree.nodes().first());
    let (Some(a), Some(b)) = (a, b) else { return 0.0 };
    a.aabb.max_distance(|point| pair.transform.apply(point), &b.aabb)
}

/// A bound on all patches below a node of A's tree, by the triangle inequality
/// from the middle of the first of them; with that point and its foot.
///
/// `known` is the foot inherited from the parent. O(log patches) in general position.
pub(in crate::certified) fn bvh_node(
    pair: &Pair<'_>,
    nearest: &NearestPoint<'_>,
    index: u32,
    known: &Foot,
    threshold: f64,
) -> (f64, Sample) {
    let tree = &pair.a.target.tree;
    let node = &tree.nodes()[index as usize];
    let (patch, parameters) = (tree.primitive(node), [0.5; 2]);
    let local = pair.a.patch(patch).point(parameters);
    let target = pair.transform.apply(local);
    let radius = node.aabb.max_distance_squared(local).sqrt();
    let mut foot = nearest.at(target, known.patch, known.parameters);
    // The left child has its parent's point, whose foot is known.
    if node.is_leaf() || foot.distance_squared != known.distance_squared {
        let query = Query { target, known: foot, sufficient: threshold - radius };
        foot = nearest.near(&query).nearest();
    }
    (foot.distance() + radius, Sample { patch, parameters, foot })
}
