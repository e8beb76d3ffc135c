//! Boxes with cavities on a grid, apart, flush, in each other and in each other's cavities: their volumes, sides and common
//! volumes are numbers of cells.

use super::{block, check, of_solids, turned};
use crate::models::{Quad, of_quads, prepared};
use crate::overlap::overlap;
use nurbs_hausdorff::{PairState, Side};

/// The cells along each side of the grid.
const CELLS: i32 = 14;

/// The assemblies drawn.
const ASSEMBLIES: u64 = 60;

/// A box of cells, from the first to the last but one.
#[derive(Debug, Clone, Copy)]
struct Cells {
    min: [i32; 3],
    max: [i32; 3],
}

impl Cells {
    fn has(&self, cell: [i32; 3]) -> bool {
        (0..3).all(|axis| (self.min[axis]..self.max[axis]).contains(&cell[axis]))
    }

    fn quads(&self) -> Vec<Quad> {
        block(self.min.map(f64::from), self.max.map(f64::from))
    }
}

/// A box, and its cavity if it has one.
#[derive(Debug, Clone, Copy)]
struct Part {
    outer: Cells,
    cavity: Option<Cells>,
}

impl Part {
    fn draw(random: &mut fastrand::Rng) -> Self {
        let min = [0; 3].map(|_| random.i32(0..8));
        let size = [0; 3].map(|_| random.i32(1..7));
        let outer = Cells { min, max: [0, 1, 2].map(|axis| min[axis] + size[axis]) };
        let may_be_hollow = size.iter().all(|&size| size >= 3) && random.u8(0..5) < 3;
        let cavity = may_be_hollow.then(|| {
            let min = outer.min.map(|at| at + 1);
            let max = [0, 1, 2].map(|axis| random.i32(min[axis] + 1..outer.max[axis]));
            Cells { min, max }
        });
        Self { outer, cavity }
    }

    fn has(&self, cell: [i32; 3]) -> bool {
        self.outer.has(cell) && !self.cavity.is_some_and(|cavity| cavity.has(cell))
    }

    fn shells(&self) -> Vec<Vec<Quad>> {
        let cavity = self.cavity.map(|cavity| turned(&cavity.quads()));
        std::iter::once(self.outer.quads()).chain(cavity).collect()
    }
}

fn cells() -> impl Iterator<Item = [i32; 3]> {
    let along = || 0..CELLS;
    along().flat_map(move |x| along().flat_map(move |y| along().map(move |z| [x, y, z])))
}

#[test]
fn volumes_sides_and_clashes_are_those_of_cells() {
    let mut clashes = 0;
    for seed in 0..ASSEMBLIES {
        let random = &mut fastrand::Rng::with_seed(seed);
        let parts: Vec<Part> = (0..random.usize(2..6)).map(|_| Part::draw(random)).collect();
        let shells: Vec<Vec<Vec<Quad>>> = parts.iter().map(Part::shells).collect();
        let model = of_solids(&shells.iter().map(Vec::as_slice).collect::<Vec<_>>());
        let voids: Vec<usize> = model.bodies().iter().map(|body| body.voids).collect();
        let expected: Vec<usize> = parts.iter().map(|part| usize::from(part.cavity.is_some())).collect();
        assert_eq!(voids, expected, "{seed}: {parts:?}");
        let volume: usize = parts.iter().map(|part| cells().filter(|&cell| part.has(cell)).count()).sum();
        let found = model.facts().volume.unwrap();
        assert!(found.contains(volume as f64), "{seed}: {found:?} of {volume}");
        for _ in 0..8 {
            let cell = [0; 3].map(|_| random.i32(0..CELLS));
            let is_inside = parts.iter().any(|part| part.has(cell));
            let expected = if is_inside { Side::Inside } else { Side::Outside };
            let side = model.side(cell.map(|at| f64::from(at) + 0.5));
            assert_eq!(side, expected, "{seed}: {cell:?} of {parts:?}");
        }
        // All of it together with a cube about the middle: no volume is stated, or the number of cells that any part has.
        let tool = Cells { min: [4; 3], max: [9; 3] };
        let all = cells().filter(|&cell| tool.has(cell) && parts.iter().any(|part| part.has(cell))).count();
        let shared = overlap(&model, &prepared(&of_quads(&tool.quads())), 1e-3).volumes;
        let is_held = shared.is_none_or(|volumes| volumes.intersection.contains(all as f64));
        assert!(is_held, "{seed}: {shared:?} of {all} in {parts:?}");
        let result = check(&model);
        let place = |name: &str| result.bodies.iter().position(|body| body.name == name).unwrap();
        for (a, b) in (0..parts.len()).flat_map(|b| (0..b).map(move |a| (a, b))) {
            let common = cells().filter(|&cell| parts[a].has(cell) && parts[b].has(cell)).count();
            let pair = result.pairs.iter().find(|pair| (place(&pair.a), place(&pair.b)) == (a, b));
            let is_clash = pair.is_some_and(|pair| pair.state == PairState::Clash);
            assert_eq!(is_clash, common > 0, "{seed}: {a} and {b} of {parts:?}: {pair:?}");
            let volume = pair.and_then(|pair| pair.volume);
            assert!(volume.is_none_or(|volume| volume.contains(common as f64)), "{seed}: {pair:?}");
            clashes += usize::from(is_clash);
        }
    }
    assert!(clashes > ASSEMBLIES as usize / 2, "{clashes} clashes");
}
