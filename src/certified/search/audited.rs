//! The audit of the bounds that a search relies on, and the search without those that it refutes.

use super::super::audit::{Audit, AuditReport, Auditor, CellBound, Ledger, Lemma, Lemmas, Refutation};
use super::super::cell_context::LeastBound;
use super::super::nearest::Foot;
use super::super::{Cell, bounds};
use super::evaluation::Evaluation;
use super::frontier::Frontier;
use super::node::{Domain, SearchNode};
use super::{BranchAndBound, by_blocks};

/// Cells that a search audits at its end, for each that it bounds, and at least.
const CELLS_PER_AUDIT: usize = 64;
const MIN_AUDITS: usize = 16;

/// The points of a cell besides its middle and its corners, of a share of the cells and of all.
const FURTHER_OF_SHARE: usize = 3;
const FURTHER_OF_ALL: usize = 8;

/// The patches of a node of A's tree that are looked at, and of A where one bound holds for all of them.
const PATCHES: usize = 16;

/// What is audited, and what came of it.
#[derive(Debug, Default)]
pub(super) struct AuditState {
    pub(super) extent: Audit,
    ledger: Ledger,
    report: AuditReport,
    refutations: Vec<Refutation>,
}

impl AuditState {
    /// The lemmas whose bounds are not tried any more.
    pub(super) fn struck(&self) -> Lemmas {
        self.report.struck
    }

    /// Enters a bound for the audit at the end, whatever its size and the threshold.
    pub(super) fn enter(&mut self, bound: CellBound) {
        self.ledger.enter(bound, f64::INFINITY, bound.upper);
    }

    fn refute(&mut self, refutation: Refutation) {
        self.report.strike(refutation.lemma);
        self.refutations.push(refutation);
    }
}

impl BranchAndBound<'_> {
    /// Audits these bounds from now on.
    pub(crate) fn audit(&mut self, extent: Audit) {
        self.audit.extent = extent;
    }

    /// The work of the audit, and its outcome.
    pub(crate) fn audit_report(&self) -> AuditReport {
        self.audit.report
    }

    /// The bounds that were refuted, the first of each lemma.
    pub(crate) fn refutations(&self) -> &[Refutation] {
        &self.audit.refutations
    }

    fn auditor(&self) -> Auditor<'_> {
        Auditor { pair: &self.pair, nearest: &self.nearest, rounding: self.goal.rounding }
    }

    /// The bounds that the evaluation of a node gave, of its cell, of patches below it or of those of a block.
    fn bounds_of(&self, node: &SearchNode, evaluation: &Evaluation) -> Vec<CellBound> {
        if let Some(split) = &evaluation.split {
            return split.by_patch.clone();
        }
        let Some(lemma) = evaluation.lemma else { return Vec::new() };
        let of = |cell: Cell| CellBound { cell, upper: evaluation.upper, lemma, foot: evaluation.foot };
        match node.domain {
            Domain::Cell(cell) => vec![of(cell)],
            Domain::BvhNode(index) => self.patches_below(index).map(|patch| of(Cell::whole(patch))).collect(),
            Domain::Block(_) => Vec::new(),
        }
    }

    /// Some patches below a node of A's tree.
    fn patches_below(&self, index: u32) -> impl Iterator<Item = u32> {
        let tree = &self.pair.a.target.tree;
        let mut last = index;
        while let Some(node) = tree.nodes().get(last as usize).filter(|node| !node.is_leaf()) {
            last = node.right_child;
        }
        // The nodes below one follow it, and the left child of one is the next.
        let step = (last - index) as usize / PATCHES + 1;
        (index..=last).step_by(step).filter_map(|start| {
            let node = tree.nodes()[start as usize..].iter().find(|node| node.is_leaf())?;
            Some(tree.primitive(node))
        })
    }

    /// Takes note of a bound on all of A by a lemma on whole patches, for the audit at the end.
    pub(super) fn note_root(&mut self, LeastBound { upper, lemma }: LeastBound) {
        let Some(lemma) = lemma else { return };
        let count = self.pair.a.patches().len();
        for patch in (0..count as u32).step_by(count.div_ceil(PATCHES).max(1)) {
            let bound = CellBound { cell: Cell::whole(patch), upper, lemma, foot: Foot::start(0, [0.5; 2]) };
            self.audit.enter(bound);
        }
    }

    /// Looks at all bounds of an evaluation, where all are audited. Called in parallel.
    pub(super) fn refutation_of(&self, node: &SearchNode, evaluation: &Evaluation) -> Option<Refutation> {
        if self.audit.extent != Audit::All {
            return None;
        }
        let auditor = self.auditor();
        self.bounds_of(node, evaluation).iter().find_map(|bound| auditor.cell(bound, FURTHER_OF_ALL))
    }

    /// Takes note of the bounds of an evaluation: as audited where all are, else for the audit at the end.
    pub(super) fn note_bounds(&mut self, node: &SearchNode, evaluation: &Evaluation, threshold: f64) {
        let is_share = self.audit.extent == Audit::Share;
        let is_elementary = evaluation.lemma.is_none_or(Lemma::is_elementary);
        if is_share && is_elementary && evaluation.split.is_none() {
            return;
        }
        for bound in self.bounds_of(node, evaluation) {
            if is_share {
                let size = bound.cell.radius(self.pair.a.patch_bounds(bound.cell.patch).first);
                self.audit.ledger.enter(bound, size, threshold);
            } else {
                self.audit.report.count(bound.lemma, Auditor::count(FURTHER_OF_ALL));
            }
        }
        if let Some(refutation) = evaluation.refutation {
            self.audit.refute(refutation);
        }
    }

    /// Audits the share of the bounds so far that is to be audited at the end of a search.
    pub(super) fn audit_share(&mut self) {
        let count = MIN_AUDITS.max(self.work.cells / CELLS_PER_AUDIT);
        for bound in self.audit.ledger.take(count) {
            if !self.audit.struck().contains(bound.lemma) {
                self.audit.report.count(bound.lemma, Auditor::count(FURTHER_OF_SHARE));
                if let Some(refutation) = self.auditor().cell(&bound, FURTHER_OF_SHARE) {
                    self.audit.refute(refutation);
                }
            }
        }
    }

    /// Starts again from all of A if a bound was refuted since the start, without its lemma; the witness stays.
    pub(super) fn start_again_if_refuted(&mut self) -> bool {
        let struck = self.audit.struck();
        if struck == self.searched_without {
            return false;
        }
        self.searched_without = struck;
        self.audit.ledger = Ledger::default();
        let root = bounds::whole_models(&self.pair, struck);
        self.frontier = Frontier::new(SearchNode::root(root.upper));
        self.incumbent.forget_pruned();
        self.exhausted = false;
        self.blocks = by_blocks(&self.pair.a, self.prune_threshold());
        self.note_root(root);
        true
    }
}
