//! The cells of a regular grid on every surface, and the tree above them.

use super::Part;
use crate::bezier::BezierModel;
use crate::bvh::{Aabb, Bvh};
use crate::error::{Error, Result};
use crate::iteration::{cell_pieces, uniform};
use crate::parallel::map;
use glam::DVec3;

/// A cell of the grid of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cell {
    /// Index of the surface.
    pub surface: u32,
    /// Its place along u.
    pub row: u32,
    /// Its place along v.
    pub column: u32,
}

/// A node's children: neighbours on the level below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Children {
    /// The first.
    pub first: u32,
    /// How many; at least 1.
    pub count: u32,
}

impl Children {
    /// Their indices.
    #[must_use]
    pub fn range(self) -> std::ops::Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// Cells of a model, at most: what their boxes take then fits one binding of the GPU.
pub const MAX_CELLS: usize = 1 << 22;

/// The most parts below a node: a thread loops over them, and its neighbours
/// wait. Cells with more parts get levels in between.
pub const MAX_CHILDREN: usize = 64;

/// The most children of a node above the cells: two by two, or four surfaces.
pub(crate) const BRANCHING: usize = 4;

/// The tree over a model's cells.
#[derive(Debug, Clone)]
pub struct GridTree {
    /// Cells along each direction of a surface.
    pub grid: usize,
    /// Levels from the root's down; the children of the last are parts.
    pub levels: Vec<Vec<Children>>,
    /// The level of the cells.
    pub finest: usize,
    /// The cells, in the order of their level.
    pub cells: Vec<Cell>,
    /// The parts of all cells.
    pub parts: Vec<Part>,
}

impl GridTree {
    /// `grid` x `grid` cells, 1 or more, on every surface, even in the
    /// parameters. Near surfaces come under a common node.
    ///
    /// O(cells + patches), times p q.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`] for more than [`MAX_CELLS`].
    pub fn new(model: &BezierModel, grid: usize) -> Result<Self> {
        if model.grids.len() * grid * grid > MAX_CELLS {
            let expected = "at most 4194304 cells on all surfaces";
            return Err(Error::OptionOutOfRange { option: "grid", found: grid.to_string(), expected });
        }
        let mut tree = Self { grid, levels: Vec::new(), finest: 0, cells: Vec::new(), parts: Vec::new() };
        tree.add_surfaces(model);
        tree.add_grids();
        tree.add_parts(model);
        Ok(tree)
    }

    /// The surface's parameters at the middle of a cell, and the point there.
    #[must_use]
    pub fn middle(&self, model: &BezierModel, cell: usize) -> ([f64; 2], DVec3) {
        let Cell { surface, row, column } = self.cells[cell];
        let grid = &model.grids[surface as usize];
        let at = |axis: usize, place: u32| {
            let breaks = &grid.breaks[axis];
            let fraction = (f64::from(place) + 0.5) / self.grid as f64;
            (1.0 - fraction) * breaks[0] + fraction * breaks[breaks.len() - 1]
        };
        let parameters = [at(0, row), at(1, column)];
        let [(i, s), (j, t)] = [0, 1].map(|axis| grid.locate(axis, parameters[axis]));
        let patch = model.patches.patch(grid.first + i * grid.counts()[1] + j);
        (parameters, patch.point([s, t]))
    }

    /// The levels above the surfaces, in the order of a tree over their boxes.
    fn add_surfaces(&mut self, model: &BezierModel) {
        let mut aabbs = vec![Aabb::EMPTY; model.grids.len()];
        for patch in model.patches.iter() {
            aabbs[patch.surface] = aabbs[patch.surface].union(patch.bounding_box());
        }
        let order = Bvh::new(&aabbs);
        self.cells = order.order().iter().map(|&surface| Cell { surface, row: 0, column: 0 }).collect();
        let mut count = self.cells.len();
        while count > 1 {
            let starts = (0..count).step_by(BRANCHING);
            let children =
                |first| Children { first: first as u32, count: BRANCHING.min(count - first) as u32 };
            self.levels.insert(0, starts.map(children).collect());
            count = count.div_ceil(BRANCHING);
        }
    }

    /// The levels from one node a surface to its cells, halving both sides.
    fn add_grids(&mut self) {
        let depth = self.grid.next_power_of_two().ilog2();
        for level in 1..=depth {
            let side = self.grid.div_ceil(1 << (depth - level)) as u32;
            let mut below = Vec::with_capacity(BRANCHING * self.cells.len());
            let mut children = Vec::with_capacity(self.cells.len());
            for &Cell { surface, row, column } in &self.cells {
                let first = below.len() as u32;
                for row in 2 * row..(2 * row + 2).min(side) {
                    for column in 2 * column..(2 * column + 2).min(side) {
                        below.push(Cell { surface, row, column });
                    }
                }
                children.push(Children { first, count: below.len() as u32 - first });
            }
            self.levels.push(children);
            self.cells = below;
        }
        self.finest = self.levels.len();
    }

    /// The parts of every cell, and levels in between where they are many.
    fn add_parts(&mut self, model: &BezierModel) {
        let patches = &model.patches;
        let bounds = map(patches.len(), |index| patches.patch(index).derivative_bounds());
        let of_surface = |surface: usize| {
            let grid = &model.grids[surface];
            [0, 1].map(|axis| {
                let parameters = uniform(&grid.breaks[axis], self.grid + 1);
                let places: Vec<_> = parameters.into_iter().map(|at| grid.locate(axis, at)).collect();
                cell_pieces(&places)
            })
        };
        let strips = map(model.grids.len(), of_surface);
        let mut level = Vec::with_capacity(self.cells.len());
        for cell in &self.cells {
            let first = self.parts.len() as u32;
            let grid = &model.grids[cell.surface as usize];
            let [rows, columns] = &strips[cell.surface as usize];
            for &(u, s) in &rows[cell.row as usize] {
                for &(v, t) in &columns[cell.column as usize] {
                    let index = grid.first + u * grid.counts()[1] + v;
                    self.parts.push(Part::new(index, &patches.patch(index), &bounds[index], s, t));
                }
            }
            level.push(Children { first, count: self.parts.len() as u32 - first });
        }
        while level.iter().any(|children| children.count as usize > MAX_CHILDREN) {
            let (above, groups) = grouped(&level);
            self.levels.insert(self.finest, groups);
            level = above;
        }
        self.levels.insert(self.finest, level);
    }
}

/// A level between: the children of each node in groups of [`MAX_CHILDREN`],
/// which are the node's new children.
fn grouped(level: &[Children]) -> (Vec<Children>, Vec<Children>) {
    let (mut above, mut groups) = (Vec::with_capacity(level.len()), Vec::new());
    for children in level {
        let first = groups.len() as u32;
        for start in children.range().step_by(MAX_CHILDREN) {
            let count = MAX_CHILDREN.min(children.range().end - start);
            groups.push(Children { first: start as u32, count: count as u32 });
        }
        above.push(Children { first, count: groups.len() as u32 - first });
    }
    (above, groups)
}
