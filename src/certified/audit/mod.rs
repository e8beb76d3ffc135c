//! The audit of upper bounds while a search runs.
//!
//! A bound U states `d(a, B) <= U` for all points a of a cell. At single points of the cell that can be looked at
//! by the certified closest point over B's plain patches, with which the bound has nothing in common: a point that
//! is certainly farther refutes it. A refuted lemma is struck for the search, which starts again without it: that
//! costs cells, and no answer rests on it. The probability that a lemma which is wrong on a share p of its cells
//! passes n of them is `(1 - p)^n` (certifying algorithms: McConnell, Mehlhorn, Näher and Schweitzer 2011).

mod ledger;
mod lemma;
pub(super) mod points;
mod spread;

pub(in crate::certified) use ledger::Ledger;
pub use lemma::{Lemma, Lemmas};
pub(in crate::certified) use points::{Auditor, CellBound};
pub(crate) use points::{Refutation, audit_whole};
pub(crate) use spread::SpreadRefutation;

use serde::{Deserialize, Serialize};

/// The bounds of a search that are audited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Audit {
    /// A share of those that are not elementary, which costs at most some hundredths of the search's time.
    #[default]
    Share,
    /// All of them, at 13 points each: for tests, and where a result is doubted.
    All,
}

/// The work of an audit, and its outcome.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[non_exhaustive]
pub struct AuditReport {
    /// The number of cells whose bounds were looked at.
    pub cells: usize,
    /// The number of their points.
    pub points: usize,
    /// The lemmas that were refuted, without which the interval was computed; none, unless the library has a fault.
    pub struck: Lemmas,
    /// The numbers of cells by lemma.
    #[serde(skip)]
    by_lemma: [u32; Lemma::ALL.len()],
}

impl AuditReport {
    /// Returns the number of cells whose bounds by a lemma were looked at.
    #[must_use]
    pub fn cells_of(&self, lemma: Lemma) -> usize {
        self.by_lemma[lemma as usize] as usize
    }

    pub(crate) fn count(&mut self, lemma: Lemma, points: usize) {
        self.cells += 1;
        self.points += points;
        self.by_lemma[lemma as usize] = self.by_lemma[lemma as usize].saturating_add(1);
    }

    pub(crate) fn strike(&mut self, lemma: Lemma) {
        self.struck.insert(lemma);
    }

    /// Returns what two audits did together.
    pub(crate) fn combined(&self, other: &Self) -> Self {
        let mut by_lemma = self.by_lemma;
        for (count, more) in by_lemma.iter_mut().zip(other.by_lemma) {
            *count = count.saturating_add(more);
        }
        Self {
            cells: self.cells + other.cells,
            points: self.points + other.points,
            struck: self.struck.union(other.struck),
            by_lemma,
        }
    }
}
