//! The bounds of single nodes.

use super::super::rounding::cut_rounding;
use super::super::{Facet, FacetTarget};
use super::FacetSearch;
use super::cover::MAX_CLIPS;
use super::node::{Domain, Node, Region, Sample};
use super::part::{MAX_LEVELS, Step, TrianglePart};
use super::patch_cell::{CellStep, MIN_LENGTH, PatchCell};
use super::source::{Measured, Source, Start};
use crate::bezier::PatchSet;
use crate::bvh::Aabb;
use crate::rounding::{upper_max, upper_min};

/// The number of nodes that a thread bounds below one of the frontier, depth first: enough to make
/// the frontier's part of the time small.
const NODES_AT_ONCE: usize = 32;

/// The facets below a node of A's tree from which on it is bounded though it is too large to be decided:
/// few enough nodes to cost nothing, and an interval at a budget that is narrower than that of boxes.
const MANY_FACETS: usize = 256;

/// The result of bounding nodes.
#[derive(Debug, Default)]
pub(super) struct Explored {
    /// The largest upper bound of what needs no further search.
    pub(super) decided: f64,
    /// The nodes that are left.
    pub(super) waiting: Vec<Node>,
    /// The farthest point of A that was looked at, beyond the threshold.
    pub(super) farthest: Option<Sample>,
    /// The number of nodes that were bounded.
    pub(super) cells: usize,
    /// The depth of the deepest of them.
    pub(super) levels: u32,
    /// Whether a part was too small to be cut.
    pub(super) exhausted: bool,
    /// A facet of B near the last part.
    near: Option<u32>,
}

impl Explored {
    fn decide(&mut self, upper: f64) {
        self.decided = upper_max(self.decided, upper);
    }

    fn offer(&mut self, sample: Sample) {
        if self.farthest.is_none_or(|farthest| sample.distance > farthest.distance) {
            self.farthest = Some(sample);
        }
    }
}

impl FacetSearch<'_> {
    /// Bounds a node and, as long as they are few, the nodes below it.
    pub(super) fn explore(&self, node: Node, threshold: f64) -> Explored {
        let mut explored = Explored::default();
        let mut stack = vec![node];
        while let Some(node) = stack.pop() {
            if node.upper <= threshold {
                explored.decide(node.upper);
                continue;
            }
            if explored.cells >= NODES_AT_ONCE || self.is_late() {
                explored.waiting.push(node);
                continue;
            }
            explored.levels = explored.levels.max(node.level);
            match (&node.region, self.a, self.b) {
                (Region::Node(index), Source::Facets { facets: a, .. }, _) => {
                    self.bound_node(&node, *index, a, threshold, &mut explored, &mut stack);
                }
                (Region::Part(place, part), Source::Facets { .. }, Measured::Facets { facets: b, .. }) => {
                    self.bound_part(&node, *place, *part, b, threshold, &mut explored, &mut stack);
                }
                (Region::Cell(cell), Source::Patches { patches, .. }, Measured::Facets { facets: b, .. }) => {
                    self.bound_cell(&node, cell, patches, b, threshold, &mut explored, &mut stack);
                }
                // No such node is made; nothing is known of one.
                _ => explored.decide(node.upper),
            }
        }
        explored
    }

    /// Bounds all facets below a node of A's tree by the distance of a point and the farthest
    /// corner of their box from it (lemma F7 of docs/meshes.md).
    fn bound_node(
        &self,
        node: &Node,
        index: u32,
        a: &FacetTarget,
        threshold: f64,
        explored: &mut Explored,
        stack: &mut Vec<Node>,
    ) {
        let Aabb { min, max } = a.tree.nodes()[index as usize].aabb;
        let (center, radius) = (0.5 * (min + max), 0.5 * (max - min).length());
        let (mut start, mut upper) = (node.start, node.upper);
        let is_bounded = radius < threshold || a.tree.nodes()[index as usize].range().len() >= MANY_FACETS;
        explored.cells += usize::from(is_bounded || a.is_cloud());
        if is_bounded {
            let center = self.transform.apply(center);
            let (distance, found) = self.b.nearest(center, start, self.gap(), threshold - radius);
            (start, upper) = (found, distance + radius);
            #[cfg(any(test, feature = "internals"))]
            self.audit_node(a, index, upper);
            if upper <= threshold {
                explored.decide(upper);
                return;
            }
        }
        if let Some(children) = a.tree.nodes()[index as usize].children(index) {
            stack.extend(children.map(|child| node.child(Region::Node(child), start, upper)));
            return;
        }
        for place in a.tree.nodes()[index as usize].range() {
            let place = place as u32;
            match a.facet(place) {
                Facet::Point(point) => {
                    let point = self.transform.apply(point);
                    let (distance, found) = self.b.nearest(point, start, self.gap(), threshold);
                    start = found;
                    explored.decide(distance);
                    if distance > threshold {
                        let domain = Domain::Facet(place);
                        explored.offer(Sample { point, domain, start, distance, moved: 0.0 });
                    }
                }
                Facet::Triangle(corners) => {
                    let corners = corners.map(|corner| self.transform.apply(corner));
                    let part = TrianglePart::new(corners, explored.near.unwrap_or(start.piece));
                    stack.push(node.child(Region::Part(place, part), start, upper));
                }
            }
        }
    }

    /// Bounds a part of a triangle.
    fn bound_part(
        &self,
        node: &Node,
        place: u32,
        mut part: TrianglePart,
        b: &FacetTarget,
        threshold: f64,
        explored: &mut Explored,
        stack: &mut Vec<Node>,
    ) {
        explored.cells += 1;
        if part.level >= MAX_LEVELS {
            explored.exhausted = true;
            explored.decide(upper_min(node.upper, part.upper(b)));
            return;
        }
        let step = part.step(b, threshold);
        explored.near = Some(part.feet[0].facet);
        #[cfg(any(test, feature = "internals"))]
        self.audit_part(b, &part, &step);
        match step {
            Step::Decided(upper) => explored.decide(upper),
            Step::Far { point, foot, upper } => {
                let start = Start { piece: foot.facet, ..Start::default() };
                let distance = foot.distance_squared.sqrt();
                let moved = f64::from(part.level + MAX_CLIPS) * cut_rounding(self.goal.length);
                explored.offer(Sample { point, domain: Domain::Facet(place), start, distance, moved });
                // Once the point is certified, the threshold is above it; the level counts the trial.
                part.level += 1;
                explored.waiting.push(node.child(Region::Part(place, part), start, upper));
            }
            Step::Split { decided, upper, parts } => {
                explored.decide(decided);
                let child = |part| node.child(Region::Part(place, part), node.start, upper);
                stack.extend(parts.into_iter().flatten().map(child));
            }
        }
    }

    /// Bounds a cell of a patch.
    fn bound_cell(
        &self,
        node: &Node,
        cell: &PatchCell,
        patches: &PatchSet,
        b: &FacetTarget,
        threshold: f64,
        explored: &mut Explored,
        stack: &mut Vec<Node>,
    ) {
        explored.cells += 1;
        let net = cell.net(patches, &self.transform);
        let corners = cell.corners(&net, b);
        for corner in corners {
            let distance = corner.foot.distance_squared.sqrt();
            if distance > threshold {
                let start = Start { piece: corner.foot.facet, ..Start::default() };
                let domain = Domain::Patch(cell.patch, corner.parameters);
                explored.offer(Sample { point: corner.point, domain, start, distance, moved: 0.0 });
            }
        }
        match PatchCell::step(&net, &corners, b, threshold, self.goal.tolerance, self.goal.length) {
            CellStep::Decided(upper) => explored.decide(upper),
            CellStep::Halve(axis) => {
                if cell.range.lengths()[axis as usize] < MIN_LENGTH {
                    explored.exhausted = true;
                    explored.decide(node.upper);
                    return;
                }
                let starts = corners.map(|corner| corner.foot.facet);
                let half = |range| Region::Cell(PatchCell { range, starts, ..*cell });
                let upper = net.upper_by(b, starts);
                stack.extend(cell.range.halves(axis).map(|range| node.child(half(range), node.start, upper)));
            }
        }
    }

    /// Compares points of the facets below a node of A's tree with their bound.
    #[cfg(any(test, feature = "internals"))]
    fn audit_node(&self, a: &FacetTarget, index: u32, upper: f64) {
        let (Some(audit), Measured::Facets { facets: b, .. }) = (&self.audit, self.b) else { return };
        let corners = |place: usize| match a.facet(place as u32) {
            Facet::Point(point) => [self.transform.apply(point); 3],
            Facet::Triangle(corners) => corners.map(|corner| self.transform.apply(corner)),
        };
        let below = a.tree.nodes()[index as usize].range();
        audit.facets(b, below.map(corners), upper, self.goal.bounds);
    }

    /// Compares points of a part with the bound on all of it, and those that a step does not keep with
    /// what it decides.
    #[cfg(any(test, feature = "internals"))]
    fn audit_part(&self, b: &FacetTarget, part: &TrianglePart, step: &Step) {
        let Some(audit) = &self.audit else { return };
        let whole = |bound| audit.part(b, &part.corners, &[], bound, self.goal.bounds);
        match step {
            Step::Decided(upper) | Step::Far { upper, .. } => whole(*upper),
            Step::Split { decided, upper, parts } => {
                whole(*upper);
                audit.part(b, &part.corners, parts, *decided, self.goal.bounds);
            }
        }
    }
}
