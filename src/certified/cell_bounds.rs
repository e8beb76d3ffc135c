//! Bounds of A's derivatives over a cell.

use super::Operand;
use super::region::Cell;
use crate::bezier::DerivativeBounds;
use std::cell::OnceCell;

/// Bounds over the cell's patch, and closer ones once they may decide.
pub(super) struct CellBounds<'a> {
    a: &'a Operand<'a>,
    cell: Cell,
    close: OnceCell<DerivativeBounds>,
}

impl<'a> CellBounds<'a> {
    /// Of a cell of A.
    pub(super) fn new(a: &'a Operand<'_>, cell: Cell) -> Self {
        Self { a, cell, close: OnceCell::new() }
    }

    /// Over the whole patch.
    pub(super) fn of_patch(&self) -> &DerivativeBounds {
        self.a.whole_bounds(self.cell.patch)
    }

    /// Over the parts of the patch that the cell touches.
    pub(super) fn close(&self) -> &DerivativeBounds {
        self.close.get_or_init(|| {
            let [low, high] = [0, 1].map(|end| self.cell.at([2.0 * end as f64 - 1.0; 2]));
            self.a.bounds(self.cell.patch, low, high)
        })
    }
}
