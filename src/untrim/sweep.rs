//! A face cut along one axis, with the proof of the cut.

use super::boundary::{self, Arc, Side};
use super::cells::ruling::{Mapped, Ruling, mapped};
use super::cells::{self, Cell, Cells};
use super::face::{UnitFace, transpose};
use super::patch::Composed;
use super::{ParameterMap, Piece, Ruled, Untrimmed, area, patch};
use crate::model::NurbsSurface;
use crate::rounding::upper_max;

/// The number of halvings of a cell.
const MAX_HALVINGS: usize = 32;

/// Cell limit: `MAX_CELLS` plus `MAX_CELLS_PER_CELL` for each cell of the sweep. Real faces take up to 20 a cell; a composition that converges as slowly as with
/// weights that differ by 10²⁵ would be halved for hours.
const MAX_CELLS: usize = 1024;
const MAX_CELLS_PER_CELL: usize = 64;

/// The cells of a face ruled along one axis.
pub(super) struct Sweep<'a> {
    face: &'a UnitFace,
    transposed: bool,
    cells: Cells,
    /// The moves of the boundary in u and v (lemma T2), and the error in u of graphs (lemma T3).
    moved: [f64; 2],
    graph_error: f64,
}

/// A cell that is cut no further, with its map and its patch.
struct Done {
    cell: Cell,
    ruling: Ruling,
    composed: Composed,
}

impl<'a> Sweep<'a> {
    pub(super) fn new(face: &'a UnitFace, transposed: bool) -> Result<Self, String> {
        let boundary = boundary::boundary(face)?;
        let cells = cells::cells(face, &boundary);
        let (moved, graph_error) = (boundary.moved, boundary.graph_error);
        Ok(Self { face, transposed, cells, moved, graph_error })
    }

    /// Returns an estimate of the patches that the cells take, times 2.
    pub(super) fn cost(&self) -> usize {
        let is_own = |&&arc: &&usize| matches!(self.cells.arcs[arc].side, Side::Own(_));
        let cell = |cell: &Cell| {
            if self.face.affine { 2 } else { 2 + cell.sides.iter().filter(is_own).count() }
        };
        self.cells.cells.iter().map(cell).sum()
    }

    /// Returns the pieces of all cells, after the proof that they cover the face.
    pub(super) fn untrimmed(&self) -> Result<Untrimmed, String> {
        if self.cells.cells.is_empty() {
            return Err("its loops enclose nothing".to_owned());
        }
        let mut arcs = self.cells.arcs.clone();
        let done = self.mapped(&mut arcs)?;
        let moved = self.proven(&arcs, &done)?;
        let deviation = moved + self.largest_deviation(&done);
        let pieces = done.into_iter().map(|done| self.piece(done.composed.surface, done.ruling));
        Ok(Untrimmed { pieces: pieces.collect::<Result<_, _>>()?, deviation })
    }

    /// Returns the largest deviation of a patch from its cell: of the map, and of the patch from the
    /// surface under it.
    fn largest_deviation(&self, done: &[Done]) -> f64 {
        let own = |done: &Done| self.face.moved(done.ruling.moved) + done.composed.deviation;
        done.iter().map(own).fold(0.0, upper_max)
    }

    /// Returns the maps and patches of all cells, which are cut where they have none.
    fn mapped(&self, arcs: &mut Vec<Arc>) -> Result<Vec<Done>, String> {
        let mut done = Vec::new();
        let mut open: Vec<(Cell, usize)> =
            self.cells.cells.iter().rev().map(|cell| (cell.clone(), 0)).collect();
        let max_cells = MAX_CELLS + MAX_CELLS_PER_CELL * open.len();
        let mut count = 0;
        while let Some((cell, depth)) = open.pop() {
            count += 1;
            match mapped(self.face, arcs, &cell) {
                Mapped::One(ruling) => {
                    if let Some(composed) = patch::composed(self.face, &ruling) {
                        done.push(Done { cell, ruling, composed });
                        continue;
                    }
                }
                Mapped::Divided(line) => {
                    let [left, right] = cell.sides;
                    arcs.push(line);
                    for sides in [[arcs.len() - 1, right], [left, arcs.len() - 1]] {
                        open.push((Cell { sides, ..cell.clone() }, depth));
                    }
                    continue;
                }
                Mapped::Halve => {}
            }
            let [low, high] = cell.v;
            let middle = 0.5 * (low + high);
            if depth == MAX_HALVINGS || count > max_cells || !(low < middle && middle < high) {
                let u = arcs[cell.sides[0]].side.at(middle);
                return Err(format!("a cell near ({u}, {middle}) of the unit domain does not converge"));
            }
            for v in [[low, middle], [middle, high]] {
                open.push((Cell { v, ..cell.clone() }, depth + 1));
            }
        }
        Ok(done)
    }

    /// Proves that the cells cover the face and nothing else, and returns the part of the
    /// deviation that is due to moves of the boundary.
    fn proven(&self, arcs: &[Arc], done: &[Done]) -> Result<f64, String> {
        let cells: Vec<&Cell> = done.iter().map(|done| &done.cell).collect();
        cells::balance(arcs, &cells)?;
        let crossing = self.crossing(arcs, done)?;
        let rulings: Vec<_> = done.iter().map(|done| (done.cell.winding, &done.ruling)).collect();
        area::check(self.face, &rulings, [self.moved[0] + self.graph_error, self.moved[1]])?;
        // A boundary that moves by δ moves the region by at most 2 δ (lemma T2).
        Ok(2.0 * self.face.moved(self.moved)
            + self.face.moved([self.graph_error + crossing, 0.0])
            + self.face.rounding)
    }

    /// Returns the largest width by which the sides of a cell cross (lemma T1), beside a loop.
    fn crossing(&self, arcs: &[Arc], done: &[Done]) -> Result<f64, String> {
        let is_within = |cell: &Cell| cell.sides.iter().all(|&arc| arcs[arc].change == 0);
        if let Some(crossed) = done.iter().find(|done| done.ruling.crossing > 0.0 && is_within(&done.cell)) {
            return Err(format!("lines within the face cross at v = {:?}", crossed.cell.v));
        }
        Ok(done.iter().map(|done| done.ruling.crossing).fold(0.0, upper_max))
    }

    fn piece(&self, surface: NurbsSurface, ruling: Ruling) -> Result<Piece, String> {
        let surface = if self.transposed {
            transpose(self.face.index, &surface).map_err(|error| error.to_string())?
        } else {
            surface
        };
        let Ruling { left, right, .. } = ruling;
        let ruled = Ruled { left, right, domain: self.face.domain, transposed: self.transposed };
        Ok(Piece { surface, map: ParameterMap::Ruled(ruled) })
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::untrim::boundary::graph::Graph;
    use crate::untrim::testing::{face_within, plane};

    /// A plane with a square hole in a square, both turned, as a face ruled along u.
    fn face() -> UnitFace {
        let ring = |radius: f64, sense: f64| {
            [0.0, 1.0, 2.0, 3.0].map(|k| {
                let angle = 0.3 + sense * std::f64::consts::FRAC_PI_2 * k;
                [0.5 + radius * angle.cos(), 0.5 + radius * angle.sin()]
            })
        };
        face_within(&plane(), &[&ring(0.4, 1.0), &ring(0.2, -1.0)])
    }

    #[test]
    fn a_cut_is_refused_without_one_of_its_cells_and_with_one_twice() {
        let face = face();
        let sweep = Sweep::new(&face, false).unwrap();
        assert!(sweep.untrimmed().is_ok());
        let count = sweep.cells.cells.len();
        assert!(count >= 8, "{count}");
        for index in 0..count {
            let mut without = Sweep::new(&face, false).unwrap();
            let cell = without.cells.cells.remove(index);
            let why = without.untrimmed().err().unwrap();
            assert!(why.contains("winding number"), "{why}");
            let mut twice = Sweep::new(&face, false).unwrap();
            twice.cells.cells.push(cell);
            assert!(twice.untrimmed().err().unwrap().contains("winding number"));
        }
    }

    #[test]
    fn a_cut_is_refused_whose_cell_is_shorter_or_between_other_arcs() {
        let face = face();
        for index in 0..Sweep::new(&face, false).unwrap().cells.cells.len() {
            let mut shorter = Sweep::new(&face, false).unwrap();
            let [low, high] = shorter.cells.cells[index].v;
            shorter.cells.cells[index].v = [low, high.next_down()];
            assert!(shorter.untrimmed().is_err());
            let mut reversed = Sweep::new(&face, false).unwrap();
            reversed.cells.cells[index].sides.reverse();
            assert!(reversed.untrimmed().is_err());
        }
    }

    /// Two lines in the hole that cross by less than the tolerance: their cells cancel each other.
    #[test]
    fn a_cut_is_refused_with_lines_within_the_face_that_cross() {
        let mut face = face();
        face.tolerances.crossing = 1e-9;
        let mut sweep = Sweep::new(&face, false).unwrap();
        let (v, first) = ([0.49, 0.51], sweep.cells.arcs.len());
        for u in [0.5, 0.5 + 1e-10] {
            let side = Side::Graph(Graph::line([u, u], v));
            sweep.cells.arcs.push(Arc { side, v, change: 0 });
        }
        for sides in [[first, first + 1], [first + 1, first]] {
            sweep.cells.cells.push(Cell { sides, v, rectangle: [0, 0], winding: 1 });
        }
        let why = sweep.untrimmed().err().unwrap();
        assert!(why.contains("cross"), "{why}");
    }

    /// Every part of the deviation counts, once or, for moves of the boundary, twice.
    #[test]
    fn the_deviation_is_the_sum_of_its_parts() {
        let face = face();
        let sweep = Sweep::new(&face, false).unwrap();
        let mut arcs = sweep.cells.arcs.clone();
        let mut done = sweep.mapped(&mut arcs).unwrap();
        let (base, pieces) = (sweep.proven(&arcs, &done).unwrap(), sweep.largest_deviation(&done));
        let added = |found: f64, base: f64, expected: f64| {
            assert!((found - base - expected).abs() <= 1e-12 * expected, "{found} {base} {expected}");
        };
        let of = |moved: [f64; 2]| face.moved(moved);
        let moved = Sweep { moved: [1e-3, 2e-3], ..Sweep::new(&face, false).unwrap() };
        added(moved.proven(&arcs, &done).unwrap(), base - 2.0 * of(sweep.moved), 2.0 * of([1e-3, 2e-3]));
        let fitted = Sweep { graph_error: 1e-3, ..Sweep::new(&face, false).unwrap() };
        added(fitted.proven(&arcs, &done).unwrap(), base - of([sweep.graph_error, 0.0]), of([1e-3, 0.0]));
        done[0].ruling.moved = [1e-3, 2e-3];
        let own = done[0].composed.deviation;
        added(sweep.largest_deviation(&done), own, of([1e-3, 2e-3]));
        done[0].composed.deviation = 0.5;
        added(sweep.largest_deviation(&done), of([1e-3, 2e-3]), 0.5);
        assert!(pieces < 1e-9, "{pieces}");
        done[0].ruling.crossing = 1e-3;
        added(sweep.proven(&arcs, &done).unwrap(), base, of([1e-3, 0.0]));
    }

    #[test]
    fn a_cut_is_refused_that_has_lost_a_loop() {
        let mut face = face();
        let hole = face.loops.pop().unwrap();
        let sweep = Sweep::new(&face, false).unwrap();
        assert!(sweep.untrimmed().is_ok());
        let cells = sweep.cells;
        face.loops.push(hole);
        let lost = Sweep { face: &face, transposed: false, cells, moved: [0.0; 2], graph_error: 0.0 };
        let why = lost.untrimmed().err().unwrap();
        assert!(why.contains("area"), "{why}");
    }
}
