//! The bounds of single nodes.

use super::super::audit::{Lemma, Refutation};
use super::super::bounds;
use super::super::cell_context::{CellContext, LeastBound};
use super::super::nearest::{Feet, Foot, Query, Sample};
use super::BranchAndBound;
use super::blocks::{Split, split_block};
use super::node::{Domain, SearchNode};

/// Width of a certified query for a cell's foot, relative to the tolerance.
const FOOT_PART: f64 = 0.25;

/// An upper bound on one node, its foot and its farthest point evaluated.
pub(super) struct Evaluation {
    pub(super) upper: f64,
    /// The lemma of a bound that is less than the inherited one.
    pub(super) lemma: Option<Lemma>,
    pub(super) foot: Foot,
    pub(super) farthest: Sample,
    /// For a block, what it is split into.
    pub(super) split: Option<Split>,
    /// For a cell that is to be halved, the sides.
    pub(super) halved: Option<[bool; 2]>,
    /// What the audit of all bounds refuted.
    pub(super) refutation: Option<Refutation>,
}

impl BranchAndBound<'_> {
    /// The least upper bound found for a node; the first that is at most the threshold.
    pub(super) fn evaluate(&self, node: &SearchNode, threshold: f64) -> Evaluation {
        let mut evaluation = self.bound(node, threshold);
        evaluation.refutation = self.refutation_of(node, &evaluation);
        evaluation
    }

    fn bound(&self, node: &SearchNode, threshold: f64) -> Evaluation {
        let (mut split, mut halved) = (None, None);
        let (bound, foot, farthest) = match &node.domain {
            Domain::BvhNode(index) => {
                let (upper, sample) =
                    bounds::bvh_node(&self.pair, &self.nearest, *index, &node.foot, threshold);
                (LeastBound { upper, lemma: Some(Lemma::TreeNode) }, sample.foot, sample)
            }
            Domain::Block(block) => {
                let (parts, [sample, farthest]) =
                    split_block(&self.pair, &self.nearest, block, node, threshold, self.audit.struck());
                split = Some(parts);
                (LeastBound::NONE, sample.foot, farthest)
            }
            Domain::Cell(cell) => {
                let mut context = CellContext::new(&self.pair, &self.nearest, *cell, &node.foot);
                context.struck = self.audit.struck();
                let bound = self.evaluate_cell(&mut context, node, threshold);
                let is_decided = bound.upper <= threshold;
                if !is_decided {
                    halved = Some(bounds::halved_sides(&context));
                }
                (bound, context.foot(), context.farthest)
            }
        };
        // NaN bounds nothing.
        let is_less = bound.upper < node.upper;
        Evaluation {
            upper: if is_less { bound.upper } else { node.upper },
            lemma: bound.lemma.filter(|_| is_less),
            foot,
            farthest,
            split,
            halved,
            refutation: None,
        }
    }

    fn evaluate_cell(&self, context: &mut CellContext<'_>, node: &SearchNode, threshold: f64) -> LeastBound {
        let any = bounds::with_any_foot(context, threshold);
        if any.upper <= threshold {
            return any;
        }
        self.find_nearest_feet(context, node, threshold);
        let nearest = bounds::with_nearest_feet(context, threshold);
        if nearest.upper < any.upper { nearest } else { any }
    }

    /// Replaces the inherited foot of a cell's centre by the nearest ones.
    fn find_nearest_feet(&self, context: &mut CellContext<'_>, node: &SearchNode, threshold: f64) {
        let is_whole = context.cell.is_whole();
        let (target, known) = (context.jet.point, context.foot());
        // The first patch of a leaf has the leaf's point, whose nearest foot is known.
        if !(is_whole && known.distance_squared == node.foot.distance_squared) {
            let query = Query { target, known, sufficient: threshold - context.radius };
            context.set_feet(self.nearest.near(&query));
        }
        // The parent's foot and this one are close to the threshold although no
        // point that far is known: Newton's method probably converged to the
        // wrong local minimum of a patch.
        let suspicious = 0.5 * (self.incumbent.lower_bound() + threshold);
        let is_far = |foot: &Foot| foot.distance_squared.is_finite() && foot.distance() > suspicious;
        if !is_whole && is_far(&node.foot) && is_far(&context.foot()) {
            let foot = self.nearest.certified(target, context.foot(), FOOT_PART * self.goal.tolerance);
            if foot != context.foot() {
                context.set_feet(Feet::new(foot));
            }
        }
    }
}
