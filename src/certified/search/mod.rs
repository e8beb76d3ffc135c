//! Branch and bound over A.

mod ascents;
mod audited;
mod blocks;
mod evaluation;
mod frontier;
mod gains;
mod incumbent;
mod node;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

pub(crate) use gains::Gains;
pub(crate) use incumbent::Witness;
pub(crate) use node::{Domain, SearchNode};

use super::audit::Lemmas;
use super::bounds;
use super::nearest::{Foot, NearestPoint, Sample};
use super::rounding::{before_rounding_up, closest_point_error, point_error, rounded_up};
use super::{Block, Pair, Sheets};
use crate::bezier::Patch;
use crate::interval::{Interval, Limit, Stop};
use crate::threads::parallel::{is_few, map_short, together};
use audited::AuditState;
use blocks::by_blocks;
use frontier::Frontier;
use incumbent::Incumbent;
use web_time::Instant;

/// Nodes bounded between two updates of the incumbent: enough to keep all
/// threads busy, few enough that a better incumbent prunes soon.
const CHUNK: usize = 1024;

/// Half-width of a cell that float64 does not usefully halve further. Centres
/// are multiples of such dyadic widths, and exact.
const MIN_HALF_WIDTH: f64 = 1.0 / (1_u64 << 40) as f64;

/// Part of the tolerance that rounding and slack may take. Where they take more,
/// the interval cannot be as narrow as requested, and the search stops at the
/// narrowest that can be.
const MAX_ROUNDING_PART: f64 = 0.5;

/// Stopping criterion.
#[derive(Debug, Clone, Copy)]
struct Goal {
    /// The width that upper and lower bounds may differ by.
    tolerance: f64,
    /// A limit on the distance that is to be decided, instead of a width.
    limit: Option<Limit>,
    /// What rounding may add to an upper bound or take off a lower bound.
    rounding: f64,
    /// How much farther a point of A may be than the points that are searched.
    slack: f64,
    /// The part of an interval's width that is reserved for rounding and slack.
    reserved_width: f64,
}

/// Counters of the work done.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Work {
    /// Nodes bounded.
    pub(crate) cells: usize,
    /// Those of them that a kernel bounded.
    pub(crate) kernel_cells: usize,
    /// The depth of the deepest node.
    pub(crate) levels: u32,
}

/// A branch and bound for the directed distance of a pair.
pub(crate) struct BranchAndBound<'a> {
    pair: Pair<'a>,
    nearest: NearestPoint<'a>,
    goal: Goal,
    frontier: Frontier,
    incumbent: Incumbent,
    /// The sheets of A if it is searched by blocks of patches.
    blocks: Option<Sheets<'a>>,
    /// Whether a cell was too small to branch.
    exhausted: bool,
    work: Work,
    audit: AuditState,
    /// The lemmas without which the frontier was made.
    searched_without: Lemmas,
    /// When no further node is bounded.
    deadline: Option<Instant>,
}

/// The result of a kernel for the cells taken out.
#[derive(Debug, Default)]
pub(crate) struct BatchResult {
    /// The largest upper bound of the cells that it pruned.
    pub(crate) dropped: f64,
    /// Cells that it bounded, and levels that it went down.
    pub(crate) cells: usize,
    pub(crate) levels: u32,
    /// Cells still to be bounded.
    pub(crate) waiting: Vec<SearchNode>,
    /// Cells that only float64 can bound.
    pub(crate) undecided: Vec<SearchNode>,
    /// A far point of A: patch and parameters.
    pub(crate) farthest: Option<(u32, [f64; 2])>,
}

impl<'a> BranchAndBound<'a> {
    /// Searches all of A for an interval of width `tolerance`, or with a
    /// `limit` until the distance is known to exceed it or not, with the gap
    /// and without it. Points of A
    /// may be farther by `slack` than those that the operand represents.
    pub(crate) fn new(pair: Pair<'a>, tolerance: f64, limit: Option<Limit>, slack: f64) -> Self {
        let rounding = point_error(&pair);
        // Both ends of the interval are rounded, and so is a certified distance.
        let reserved_width = slack + 2.0 * rounding + closest_point_error(&pair);
        let is_small = reserved_width < MAX_ROUNDING_PART * tolerance;
        let reachable = if is_small { tolerance - reserved_width } else { reserved_width };
        let root = bounds::whole_models(&pair, Lemmas::default());
        let mut search = Self {
            pair,
            nearest: NearestPoint::new(pair.b),
            goal: Goal { tolerance: reachable, limit, rounding, slack, reserved_width },
            frontier: Frontier::new(SearchNode::root(root.upper)),
            incumbent: Incumbent::default(),
            blocks: None,
            exhausted: false,
            work: Work::default(),
            audit: AuditState::default(),
            searched_without: Lemmas::default(),
            deadline: None,
        };
        search.find_first_incumbent();
        search.blocks = by_blocks(&search.pair.a, search.prune_threshold());
        search.note_root(root);
        search
    }

    /// Bounds no node from this moment on: [`Self::advance`] returns early.
    pub(crate) fn stop_at(&mut self, deadline: Instant) {
        self.deadline = Some(deadline);
    }

    /// Whether that moment has come.
    pub(crate) fn is_over(&self) -> bool {
        self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// The interval so far.
    pub(crate) fn interval(&self) -> Interval {
        let lower = self.incumbent.lower_bound();
        let upper = lower.max(self.incumbent.pruned_upper_bound()).max(self.frontier.upper_bound());
        Interval { lower, upper: rounded_up(upper) + self.goal.slack + self.goal.rounding }
    }

    /// The least width that an interval can be requested to have, given the
    /// rounding of these coordinates.
    pub(crate) fn min_tolerance(&self) -> f64 {
        self.goal.reserved_width / MAX_ROUNDING_PART
    }

    pub(crate) fn witness(&self) -> Option<&Witness> {
        self.incumbent.witness()
    }

    /// The patches of a witness and of its foot.
    pub(crate) fn witness_patches(&self, witness: &Witness) -> [Patch<'a>; 2] {
        [self.pair.patch_of_a(witness.patch), self.pair.b.patch(witness.closest.patch as u32)]
    }

    pub(crate) fn pair(&self) -> &Pair<'a> {
        &self.pair
    }

    /// The width that the bounds may differ by.
    pub(crate) fn tolerance(&self) -> f64 {
        self.goal.tolerance
    }

    pub(crate) fn work(&self) -> Work {
        self.work
    }

    /// The number of nodes waiting to be bounded.
    pub(crate) fn waiting(&self) -> usize {
        self.frontier.len()
    }

    /// Whether the node that waits longest is a cell, as kernels bound no others.
    pub(crate) fn begins_with_cell(&self) -> bool {
        self.frontier.begins_with_cell()
    }

    /// Whether there are cells that only float64 can bound.
    pub(crate) fn has_undecided(&self) -> bool {
        self.frontier.has_float64_only()
    }

    /// Whether the distance is at most the limit, once that is known.
    pub(crate) fn within(&self) -> Option<bool> {
        self.goal.limit?.keeps(self.interval())
    }

    /// Whether the rounding of these coordinates decides the width that a search without a limit can reach, and it is
    /// reached although nodes are left.
    fn is_as_narrow_as_possible(&self) -> bool {
        let Goal { tolerance, limit, reserved_width, .. } = self.goal;
        if limit.is_some() || tolerance > reserved_width {
            return false;
        }
        // This visits all waiting nodes.
        let Interval { lower, upper } = self.interval();
        upper - lower <= self.min_tolerance()
    }

    /// The pruning threshold: a node whose upper bound is at most this is not
    /// searched further.
    pub(crate) fn prune_threshold(&self) -> f64 {
        let Goal { tolerance, limit, rounding, slack, .. } = self.goal;
        let lower = self.incumbent.lower_bound();
        let within = lower + tolerance;
        let level = limit.and_then(|limit| limit.next_level(lower));
        level.map_or(within, |level| within.max(before_rounding_up(level - rounding - slack)))
    }

    /// Takes the next cells out, at most `count`. They must come back by
    /// [`BranchAndBound::return_batch`]: until then the interval does not cover them.
    pub(crate) fn take_batch(&mut self, count: usize) -> Vec<SearchNode> {
        let (cells, pruned) = self.frontier.next_cells(count, self.prune_threshold());
        self.incumbent.prune(pruned);
        cells
    }

    /// Takes back the cells of a batch.
    pub(crate) fn return_batch(&mut self, batch: BatchResult) {
        self.incumbent.prune(batch.dropped);
        self.work.cells += batch.cells;
        self.work.kernel_cells += batch.cells;
        self.work.levels = self.work.levels.max(batch.levels);
        self.frontier.extend(batch.waiting);
        self.frontier.extend_float64_only(batch.undecided);
        if let Some((patch, parameters)) = batch.farthest {
            let target = self.pair.point_of_a(patch, parameters);
            let foot = self.nearest.nearest(target, Foot::start(0, [0.5; 2]), 0.0);
            self.ascend_from(Sample { patch, parameters, foot });
        }
    }

    /// Bounds the next chunk of nodes or more, at most `max_cells` > 0; `Some` when nothing
    /// is left to do.
    pub(crate) fn advance(&mut self, max_cells: usize) -> Option<Stop> {
        if is_few(self.frontier.len()) {
            return self.advance_once(max_cells);
        }
        let (end, last) = (self.work.cells + CHUNK.min(max_cells), self.work.cells.saturating_add(max_cells));
        together(|| {
            loop {
                let stop = self.advance_once(last - self.work.cells);
                if stop.is_some() || self.work.cells >= end || self.is_over() {
                    return stop;
                }
            }
        })
    }

    /// Ends the search: its bounds are audited, and the upper bound covers that of the witness. Where a bound is
    /// refuted, nothing is known of A but what its boxes say.
    pub(crate) fn finish(&mut self) {
        self.audit_share();
        self.start_again_if_refuted();
        if let Some(witness) = self.incumbent.witness() {
            let upper = witness.closest.upper - self.goal.rounding;
            self.incumbent.prune(upper);
        }
    }

    /// Bounds the waiting nodes, at most a chunk and at most `max_cells` > 0. Where nothing is left to do, the bounds
    /// are audited, and the search starts again if one is refuted.
    pub(crate) fn advance_once(&mut self, max_cells: usize) -> Option<Stop> {
        let stop = self.bound_chunk(max_cells);
        if stop.is_some() {
            self.audit_share();
        }
        if self.start_again_if_refuted() { None } else { stop }
    }

    fn bound_chunk(&mut self, max_cells: usize) -> Option<Stop> {
        let lower = self.incumbent.lower_bound();
        if self.goal.limit.is_some_and(|limit| limit.next_level(lower).is_none()) {
            return Some(Stop::Converged);
        }
        if self.frontier.is_empty() {
            return Some(if self.exhausted { Stop::Precision } else { Stop::Converged });
        }
        if self.is_as_narrow_as_possible() {
            return Some(Stop::Precision);
        }
        // What a kernel could not bound it cannot bound in parts either, and it would
        // lose their feet: they stay in float64.
        let float64_only = self.frontier.has_float64_only();
        let nodes = self.frontier.next(CHUNK.min(max_cells));
        self.update_shortlist(&nodes[0]);
        let threshold = self.prune_threshold();
        let evaluations = map_short(nodes.len(), |index| {
            let node = &nodes[index];
            let is_left = node.upper > threshold && !self.is_over();
            is_left.then(|| self.evaluate(node, threshold))
        });
        self.ascend_from_farthest(&evaluations);
        let threshold = self.prune_threshold();
        let mut children = Vec::new();
        for (node, evaluation) in nodes.iter().zip(&evaluations) {
            let Some(evaluation) = evaluation else {
                // It was pruned, or the deadline has passed.
                if node.upper <= threshold {
                    self.incumbent.prune(node.upper);
                } else {
                    children.push(*node);
                }
                continue;
            };
            self.note_bounds(node, evaluation, threshold);
            self.work.levels = self.work.levels.max(node.level);
            self.work.cells += 1;
            let node = SearchNode { upper: evaluation.upper, ..*node };
            if let Some(split) = &evaluation.split {
                self.incumbent.prune(node.upper.min(split.decided));
                node.push_children(split.children.iter().copied(), evaluation.foot, &mut children);
            } else if node.upper <= threshold {
                self.incumbent.prune(node.upper);
            } else if is_too_small(&node) {
                self.exhausted = true;
                self.incumbent.prune(node.upper);
            } else if let (Domain::BvhNode(0), Some(sheets)) = (&node.domain, self.blocks) {
                let blocks = Block::all(sheets).flat_map(|block| blocks::domains(sheets, block));
                node.push_children(blocks, evaluation.foot, &mut children);
            } else {
                node.branch(&self.pair.a, evaluation.foot, evaluation.halved, &mut children);
            }
        }
        if float64_only {
            self.frontier.extend_float64_only(children);
        } else {
            self.frontier.extend(children);
        }
        None
    }

    /// Lists B's patches near the witness before nodes like this one are bounded.
    fn update_shortlist(&mut self, node: &SearchNode) {
        match (&node.domain, self.incumbent.witness()) {
            (Domain::Cell(cell), Some(witness)) if !cell.is_whole() => {
                let radius = cell.radius(self.pair.a.patch_bounds(cell.patch).first);
                self.nearest.update_shortlist(witness.point, witness.closest.upper, radius);
            }
            _ => self.nearest.reset_queries(),
        }
    }
}

fn is_too_small(node: &SearchNode) -> bool {
    matches!(&node.domain, Domain::Cell(cell) if cell.half[0].min(cell.half[1]) < MIN_HALF_WIDTH)
}
