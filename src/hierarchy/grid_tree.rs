//! The tree over the cells of a regular grid on every surface.

use super::CellPart;
use crate::axis::Axis;
use crate::bezier::{BezierModel, DerivativeBounds, PatchGrid};
use crate::bezier::{cell_pieces, uniform};
use crate::bvh::{Aabb, Bvh};
use crate::error::{Error, Result};
use crate::threads::parallel::map;
use glam::DVec3;

/// A cell of the grid of one surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GridCell {
    /// The index of the surface.
    pub surface: u32,
    /// Its index along u.
    pub row: u32,
    /// Its index along v.
    pub column: u32,
}

/// The children of a node: consecutive nodes of the level below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ChildRange {
    /// The index of the first child.
    pub first: u32,
    /// The number of children, at least 1.
    pub count: u32,
}

impl ChildRange {
    /// Returns their indices.
    #[must_use]
    pub fn range(self) -> std::ops::Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// The largest number of cells of a model, whose boxes then fit one binding of the GPU.
pub const MAX_CELLS: usize = 1 << 22;

/// The largest number of parts below a node: a thread loops over them, and its
/// neighbours wait. Cells with more parts get levels in between.
pub const MAX_CHILDREN: usize = 64;

/// The number of children of a node above the cells: two by two cells, or four
/// surfaces.
pub(crate) const BRANCHING: usize = 4;

/// The tree over a model's cells.
#[derive(Debug, Clone)]
pub struct GridTree {
    /// The number of cells along each axis of a whole surface; the pieces of a trimmed face
    /// share as many ([`PatchGrid::share`]).
    pub grid: usize,
    /// The levels from the root down; the children of the last are parts.
    pub levels: Vec<Vec<ChildRange>>,
    /// The index of the level of the cells.
    pub finest: usize,
    /// The cells in the order of their level.
    pub cells: Vec<GridCell>,
    /// The parts of all cells.
    pub parts: Vec<CellPart>,
}

impl GridTree {
    /// Builds the tree over `grid` × `grid` cells, at least 1 × 1, evenly spaced in
    /// the parameters of every surface. Nearby surfaces share ancestors.
    ///
    /// O(cells + patches) times p q.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`] for more than [`MAX_CELLS`].
    #[cfg(any(test, feature = "internals"))]
    pub fn new(model: &BezierModel, grid: usize) -> Result<Self> {
        let mut builder = GridTreeBuilder::new(model, grid)?;
        while builder.advance() {}
        Ok(builder.finish())
    }

    /// Returns the tree down to its cells, without parts.
    ///
    /// # Errors
    /// Those of [`GridTree::new`].
    fn without_parts(model: &BezierModel, grid: usize) -> Result<Self> {
        let cells_of =
            |patches: &PatchGrid| Axis::BOTH.map(|axis| patches.share(axis, grid)).iter().product::<usize>();
        let cells = model.grids.iter().map(cells_of).sum::<usize>();
        if cells > MAX_CELLS {
            let expected = "at most 4194304 cells on all surfaces";
            return Err(Error::OptionOutOfRange { option: "grid", found: grid.to_string(), expected });
        }
        let mut tree = Self { grid, levels: Vec::new(), finest: 0, cells: Vec::new(), parts: Vec::new() };
        tree.add_surfaces(model);
        tree.add_grids(model);
        Ok(tree)
    }

    /// Returns the same tree over a model of the same patches with other control points:
    /// only the growth of the parts differs. O(cells + patches) times p q.
    pub(crate) fn refitted(&self, model: &BezierModel) -> Self {
        let patches = &model.patches;
        let bounds = map(patches.len(), |index| patches.patch(index).derivative_bounds());
        let part = |part: &CellPart| {
            CellPart::new(part.patch, &patches.patch(part.patch), &bounds[part.patch], part.s, part.t)
        };
        let parts = map(self.parts.len(), |index| part(&self.parts[index]));
        Self { parts, levels: self.levels.clone(), cells: self.cells.clone(), ..*self }
    }

    /// Returns the surface parameters of the middle of a cell, and the point there.
    #[must_use]
    pub fn middle(&self, model: &BezierModel, cell: usize) -> ([f64; 2], DVec3) {
        let GridCell { surface, row, column } = self.cells[cell];
        let grid = &model.grids[surface as usize];
        let at = |axis: Axis, index: u32| {
            let breaks = &grid.breaks[axis];
            let fraction = (f64::from(index) + 0.5) / grid.share(axis, self.grid) as f64;
            (1.0 - fraction) * breaks[0] + fraction * breaks[breaks.len() - 1]
        };
        let parameters = [at(Axis::U, row), at(Axis::V, column)];
        let [(i, s), (j, t)] = Axis::BOTH.map(|axis| grid.locate(axis, parameters[axis]));
        let patch = model.patches.patch(grid.first + i * grid.counts()[1] + j);
        (parameters, patch.point([s, t]))
    }

    /// Adds the levels above the surfaces, grouped in the order of a BVH over their boxes.
    fn add_surfaces(&mut self, model: &BezierModel) {
        let mut aabbs = vec![Aabb::EMPTY; model.grids.len()];
        for patch in model.patches.iter() {
            aabbs[patch.surface] = aabbs[patch.surface].union(patch.bounding_box());
        }
        let order = Bvh::new(&aabbs);
        self.cells = order.order().iter().map(|&surface| GridCell { surface, row: 0, column: 0 }).collect();
        let mut count = self.cells.len();
        while count > 1 {
            let starts = (0..count).step_by(BRANCHING);
            let children =
                |first| ChildRange { first: first as u32, count: BRANCHING.min(count - first) as u32 };
            self.levels.insert(0, starts.map(children).collect());
            count = count.div_ceil(BRANCHING);
        }
    }

    /// Adds the levels from one node per surface down to its cells, halving along both axes.
    fn add_grids(&mut self, model: &BezierModel) {
        let depth = self.grid.next_power_of_two().ilog2();
        for level in 1..=depth {
            let mut below = Vec::with_capacity(BRANCHING * self.cells.len());
            let mut children = Vec::with_capacity(self.cells.len());
            for &GridCell { surface, row, column } in &self.cells {
                let first = below.len() as u32;
                let grid = &model.grids[surface as usize];
                let [rows, columns] =
                    Axis::BOTH.map(|axis| grid.share(axis, self.grid).div_ceil(1 << (depth - level)) as u32);
                for row in 2 * row..(2 * row + 2).min(rows) {
                    for column in 2 * column..(2 * column + 2).min(columns) {
                        below.push(GridCell { surface, row, column });
                    }
                }
                children.push(ChildRange { first, count: below.len() as u32 - first });
            }
            self.levels.push(children);
            self.cells = below;
        }
        self.finest = self.levels.len();
    }
}

/// The number of patches or cells that one call of [`GridTreeBuilder::advance`] treats:
/// enough to keep all threads busy, and a few milliseconds on one.
const ITEMS: usize = 1024;

/// For every row or column of cells, the patches that it overlaps and its interval on each.
type Strips = Vec<Vec<(usize, [f64; 2])>>;

/// A tree that is built in short steps, between which an event loop can run.
pub(crate) struct GridTreeBuilder<'a> {
    model: &'a BezierModel,
    tree: GridTree,
    /// The intervals of every row and column of cells on the patches, one entry per surface.
    strips: Vec<[Strips; 2]>,
    /// The derivative bounds of the patches so far.
    bounds: Vec<DerivativeBounds>,
    /// The ranges of parts of the cells so far.
    level: Vec<ChildRange>,
}

impl<'a> GridTreeBuilder<'a> {
    /// Starts the tree of [`GridTree::new`].
    ///
    /// # Errors
    /// Those of [`GridTree::new`].
    pub(crate) fn new(model: &'a BezierModel, grid: usize) -> Result<Self> {
        let tree = GridTree::without_parts(model, grid)?;
        let cell_intervals = |surface: usize| {
            let patches = &model.grids[surface];
            Axis::BOTH.map(|axis| {
                let parameters = uniform(&patches.breaks[axis], patches.share(axis, grid) + 1);
                let locations: Vec<_> = parameters.into_iter().map(|at| patches.locate(axis, at)).collect();
                cell_pieces(&locations)
            })
        };
        let strips = map(model.grids.len(), cell_intervals);
        let (bounds, level) = (Vec::with_capacity(model.patches.len()), Vec::with_capacity(tree.cells.len()));
        Ok(Self { model, tree, strips, bounds, level })
    }

    /// Treats the next [`ITEMS`] patches or cells; returns whether any are left.
    pub(crate) fn advance(&mut self) -> bool {
        let patches = &self.model.patches;
        let bounded = self.bounds.len();
        if bounded < patches.len() {
            let count = ITEMS.min(patches.len() - bounded);
            let bound = |offset: usize| patches.patch(bounded + offset).derivative_bounds();
            self.bounds.append(&mut map(count, bound));
            return true;
        }
        let done = self.level.len();
        for index in done..(done + ITEMS).min(self.tree.cells.len()) {
            self.add_parts(self.tree.cells[index]);
        }
        self.level.len() < self.tree.cells.len()
    }

    /// Adds the parts of a cell.
    fn add_parts(&mut self, cell: GridCell) {
        let (patches, parts) = (&self.model.patches, &mut self.tree.parts);
        let first = parts.len() as u32;
        let grid = &self.model.grids[cell.surface as usize];
        let [rows, columns] = &self.strips[cell.surface as usize];
        for &(u, s) in &rows[cell.row as usize] {
            for &(v, t) in &columns[cell.column as usize] {
                let index = grid.first + u * grid.counts()[1] + v;
                parts.push(CellPart::new(index, &patches.patch(index), &self.bounds[index], s, t));
            }
        }
        self.level.push(ChildRange { first, count: parts.len() as u32 - first });
    }

    /// Returns the tree, with levels between cells and parts where a cell has many.
    pub(crate) fn finish(self) -> GridTree {
        let Self { mut tree, mut level, .. } = self;
        while level.iter().any(|children| children.count as usize > MAX_CHILDREN) {
            let (above, groups) = grouped(&level);
            tree.levels.insert(tree.finest, groups);
            level = above;
        }
        tree.levels.insert(tree.finest, level);
        tree
    }
}

/// Inserts a level: groups of at most [`MAX_CHILDREN`] children become the new
/// children of each node. Returns the nodes with their groups, and the groups.
fn grouped(level: &[ChildRange]) -> (Vec<ChildRange>, Vec<ChildRange>) {
    let (mut above, mut groups) = (Vec::with_capacity(level.len()), Vec::new());
    for children in level {
        let first = groups.len() as u32;
        for start in children.range().step_by(MAX_CHILDREN) {
            let count = MAX_CHILDREN.min(children.range().end - start);
            groups.push(ChildRange { first: start as u32, count: count as u32 });
        }
        above.push(ChildRange { first, count: groups.len() as u32 - first });
    }
    (above, groups)
}
