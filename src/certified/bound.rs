//! Stage `bound`: how far a region can be from B, by all bounds there are.

use super::BranchAndBound;
use super::blend::{blend, carrying_feet};
use super::cell_bounds::CellBounds;
use super::certify::certify;
use super::compare::compare;
use super::corners::Corners;
use super::feet::{Feet, Foot, Sample};
use super::nearest::{foot_on, nearest_feet, place_on};
use super::on_sphere::on_sphere;
use super::region::{Cell, Domain, SearchNode};
use super::side::moved;
use crate::closest::Status;

/// By how much a foot may be farther than the nearest one, in radii of the
/// region: a bound that much larger is mostly as good, and most patches that
/// are about equally near need not be looked at.
const NODE_SLACK: f64 = 0.3;
const CELL_SLACK: f64 = 0.15;

/// Distance, in radii of the cell, up to which corners are looked at: farther
/// away, weighted means are as close and cost less.
const NEAR: f64 = 0.5;

/// What bounding one region gave.
pub(super) struct Bounded {
    pub(super) upper: f64,
    /// The foot of its middle.
    pub(super) foot: Foot,
    /// The patch of A of the sample.
    pub(super) patch: u32,
    /// The farthest point met.
    pub(super) sample: Sample,
}

impl BranchAndBound<'_> {
    /// A bound of at most `prune_threshold` if one is found, else the least found.
    pub(super) fn bound(&self, region: &SearchNode, prune_threshold: f64) -> Bounded {
        match &region.domain {
            Domain::Node(index) => self.bound_node(*index, region, prune_threshold),
            Domain::Cell(cell) => self.bound_cell(cell, region, prune_threshold),
        }
    }

    /// By the triangle inequality from one point of the node's first patch.
    fn bound_node(&self, index: u32, region: &SearchNode, prune_threshold: f64) -> Bounded {
        let tree = &self.a.target.tree;
        let node = &tree.nodes()[index as usize];
        let patch = tree.primitive(node);
        let parameters = [0.5; 2];
        let local = self.a.patch(patch).point(parameters);
        let point = self.transform.apply(local);
        let radius = node.aabb.max_distance_squared(local).sqrt();
        let mut foot = place_on(&self.b, point, region.foot.patch, region.foot.parameters);
        // The first part's point is the whole's, but a patch's own foot is to be closer.
        if node.is_leaf() || foot.distance_squared != region.foot.distance_squared {
            foot = nearest_feet(&self.b, point, foot, prune_threshold - radius, NODE_SLACK * radius, None)
                .nearest();
        }
        let upper = region.upper.min(foot.distance() + radius);
        Bounded { upper, foot, patch, sample: Sample { parameters, foot } }
    }

    fn bound_cell(&self, cell: &Cell, region: &SearchNode, prune_threshold: f64) -> Bounded {
        let patch = self.a.patch(cell.patch);
        let bounds = CellBounds::new(&self.a, *cell);
        let jet = moved(&patch.jet(cell.center), &self.transform);
        let by_foot = |foot: &Foot| {
            let sphere = self.b.revolution(self.b.patch(foot.patch).surface).and_then(|of_b| of_b.sphere);
            let upper =
                sphere.map_or(f64::INFINITY, |sphere| on_sphere(cell, &patch, &self.transform, &sphere));
            if upper <= prune_threshold {
                upper
            } else {
                upper.min(certify(cell, &jet, &bounds, &self.b, foot, prune_threshold))
            }
        };
        let by_feet = |feet: &Feet| blend(cell, &jet, &bounds, &self.b, feet, prune_threshold);
        let known = foot_on(&self.b, jet.point, region.foot.patch, region.foot.parameters);
        let mut sample = Sample { parameters: cell.center, foot: known };
        let mut upper = by_foot(&known);
        // Away from edges the parent's foot leads to the nearest patch again,
        // except across a ridge, which every other level looks for; and so do
        // the feet that carry a balance.
        let mut follow = known.status == Status::Converged && region.level % 2 == 1 && !cell.is_whole();
        // Near enough as the parent's foot leads, wherever the nearest is.
        if upper > prune_threshold {
            let feet = carrying_feet(cell, &jet, &self.b, known);
            upper = upper.min(by_feet(&feet));
            sample.foot = feet.nearest();
            follow |= feet.all().len() > 1;
        }
        let mut foot = sample.foot;
        if upper > prune_threshold {
            let [h, k] = cell.half;
            let [s, t] = bounds.close().first;
            let radius = h * s + k * t;
            let same = cell.is_whole() && foot.distance_squared == region.foot.distance_squared;
            if !follow && !same {
                let slack = if cell.is_whole() { 0.0 } else { CELL_SLACK * radius };
                let feet = nearest_feet(&self.b, jet.point, foot, prune_threshold - radius, slack, None);
                upper = upper.min(by_feet(&feet));
                foot = feet.nearest();
            }
            // The parent's middle was told to be about as far as no point may be, and
            // no point was found that far: of a patch with two valleys, the iteration
            // may have gone into the wrong one.
            let doubtful = 0.5 * (self.believed() + prune_threshold);
            let far = |foot: &Foot| foot.distance_squared.is_finite() && foot.distance() > doubtful;
            if !cell.is_whole() && far(&region.foot) && far(&foot) {
                foot = self.surest(jet.point, foot);
            }
            if upper > prune_threshold && foot != known {
                upper = upper.min(by_foot(&foot));
            }
            if upper > prune_threshold {
                upper =
                    upper.min(compare(cell, &patch, &self.transform, &jet, &self.b, &foot, prune_threshold));
            }
            sample.foot = foot;
            let corners = Corners {
                cell: *cell,
                patch,
                bounds: bounds.close(),
                transform: &self.transform,
                b: &self.b,
            };
            if upper > prune_threshold
                && foot.distance() <= NEAR * radius
                && corners.may_suffice(&foot, prune_threshold)
            {
                upper = upper.min(corners.bound(&foot, prune_threshold, &mut sample));
            }
        }
        // What is no number bounds nothing.
        let upper = if upper.is_nan() { region.upper } else { upper.min(region.upper) };
        Bounded { upper, foot, patch: cell.patch, sample }
    }
}
