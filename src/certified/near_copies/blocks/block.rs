//! Rectangles of the patches of one surface of A.

use crate::axis::Axis;
use crate::certified::sheets::Sheets;
use std::ops::Range;

/// The largest number of patches of a block along an axis: one map serves them all, and
/// blocks are what threads share.
const MAX_SIDE: u32 = 16;

/// A rectangle of the Bézier patches of a surface of A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Block {
    /// The surface.
    pub(crate) surface: u32,
    /// The start and the end of its rows of patches, along u.
    pub(crate) rows: [u32; 2],
    /// Those of its columns, along v.
    pub(crate) columns: [u32; 2],
}

impl Block {
    /// The surfaces of a model in blocks of about equal size.
    pub(in crate::certified) fn all(sheets: Sheets<'_>) -> impl Iterator<Item = Self> {
        sheets.bezier.grids.iter().enumerate().flat_map(|(surface, grid)| {
            let [rows, columns] = grid.counts().map(|count| Self::ranges(count as u32));
            rows.flat_map(move |rows| {
                columns.clone().map(move |columns| Self { surface: surface as u32, rows, columns })
            })
        })
    }

    /// The range `0..count` in as few parts as may be.
    fn ranges(count: u32) -> impl Iterator<Item = [u32; 2]> + Clone {
        let parts = count.div_ceil(MAX_SIDE);
        (0..parts).map(move |part| [part * count / parts, (part + 1) * count / parts])
    }

    /// The start and the end of its patches along an axis.
    pub(in crate::certified) fn range(&self, axis: Axis) -> [u32; 2] {
        match axis {
            Axis::U => self.rows,
            Axis::V => self.columns,
        }
    }

    /// The numbers of rows and of columns.
    pub(in crate::certified) fn size(&self) -> [u32; 2] {
        [self.rows, self.columns].map(|[start, end]| end - start)
    }

    /// The row and the column of the patch in its middle.
    pub(in crate::certified) fn middle(&self) -> [u32; 2] {
        let [rows, columns] = self.size();
        [self.rows[0] + rows / 2, self.columns[0] + columns / 2]
    }

    pub(in crate::certified) fn is_single(&self) -> bool {
        self.size() == [1, 1]
    }

    /// The two halves along the longer side.
    fn halves(&self) -> [Self; 2] {
        let [rows, columns] = self.size();
        let [start, end] = if rows >= columns { self.rows } else { self.columns };
        let middle = (start + end) / 2;
        [[start, middle], [middle, end]].map(|range| {
            if rows >= columns { Self { rows: range, ..*self } } else { Self { columns: range, ..*self } }
        })
    }

    /// The smaller blocks that cover the patches at which `undecided` is true, which
    /// are in the order of the block's own. A block stays whole if all its patches are undecided.
    pub(in crate::certified) fn children(&self, undecided: &[bool]) -> Vec<Self> {
        let mut children = Vec::new();
        if self.is_single() {
            if undecided[0] {
                children.push(*self);
            }
        } else {
            for half in self.halves() {
                self.append_children(half, undecided, &mut children);
            }
        }
        children
    }

    fn append_children(&self, part: Self, undecided: &[bool], children: &mut Vec<Self>) {
        let columns = self.size()[1];
        let place =
            |row: u32, column: u32| ((row - self.rows[0]) * columns + column - self.columns[0]) as usize;
        let range = |[start, end]: [u32; 2]| -> Range<u32> { start..end };
        let mut count = 0;
        for row in range(part.rows) {
            for column in range(part.columns) {
                count += u32::from(undecided[place(row, column)]);
            }
        }
        let [rows, columns] = part.size();
        if count == rows * columns {
            children.push(part);
        } else if count > 0 {
            for half in part.halves() {
                self.append_children(half, undecided, children);
            }
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Every undecided patch is in exactly one child, and no decided one is in any.
    #[test]
    fn children_cover_what_is_undecided() {
        let random = &mut fastrand::Rng::with_seed(16);
        for _ in 0..500 {
            let [first_row, first_column] = [random.u32(0..9), random.u32(0..9)];
            let block = Block {
                surface: 0,
                rows: [first_row, first_row + random.u32(1..9)],
                columns: [first_column, first_column + random.u32(1..9)],
            };
            let [rows, columns] = block.size();
            let share = random.u32(0..4);
            let undecided: Vec<bool> = (0..rows * columns).map(|_| random.u32(0..3) < share).collect();
            let mut covered = vec![0; undecided.len()];
            let children = block.children(&undecided);
            for child in &children {
                assert!(block.is_single() || *child != block);
                for row in child.rows[0]..child.rows[1] {
                    for column in child.columns[0]..child.columns[1] {
                        covered[((row - first_row) * columns + column - first_column) as usize] += 1;
                    }
                }
            }
            assert!(covered.iter().zip(&undecided).all(|(count, undecided)| *count == i32::from(*undecided)));
        }
    }

    /// The ranges follow each other from 0 to the count, none of them longer than allowed.
    #[test]
    fn ranges_cover_all_patches() {
        for count in 1..200 {
            let mut end = 0;
            for range in Block::ranges(count) {
                assert!(range[0] == end && (1..=MAX_SIDE).contains(&(range[1] - range[0])), "{count}");
                end = range[1];
            }
            assert_eq!(end, count);
        }
    }
}
