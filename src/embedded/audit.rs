//! What lemma S8 states of two pieces, and its audit: while the search runs, it is compared with points of both.

use super::complex::Touch;
use super::piece::{Piece, Side};
use crate::bezier::PatchSet;
use glam::DVec3;

/// An upper bound on the ways along pieces from two points of them to what these share, or to each other: at a distance d
/// of the points it is `(d + rest) / margin` (lemma S8 of docs/solids.md).
#[derive(Debug, Clone, Copy)]
pub(super) struct Ways {
    /// Positive, and at most 1.
    pub(super) margin: f64,
    pub(super) rest: f64,
}

impl Ways {
    /// Returns the bound for points at most this far from each other.
    pub(super) fn at(self, distance: f64) -> f64 {
        (distance + self.rest) / self.margin
    }

    /// Returns whether no two points contradict the bound, each with the length that its way has at least, where distances of
    /// points are off by `slack` all together.
    pub(super) fn hold_between(self, [one, other]: [&[FromShared]; 2], slack: f64) -> bool {
        let pairs = one.iter().flat_map(|a| other.iter().map(move |b| (a, b)));
        pairs.into_iter().all(|(a, b)| a.way + b.way <= self.at(a.point.distance(b.point) + slack))
    }

    /// Returns whether no two points of a grid contradict the bound on the ways along its two parameters in turn.
    pub(super) fn hold_on(self, grid: &Grid, slack: f64) -> bool {
        let places = || (0..3).flat_map(|i| (0..3).map(move |j| [i, j]));
        places().flat_map(|from| places().map(move |to| (from, to))).all(|([i, j], [k, l])| {
            let [start, corner, end] = [grid[i][j], grid[i][l], grid[k][l]];
            start.distance(corner) + corner.distance(end) <= self.at(start.distance(end) + slack)
        })
    }
}

/// Points at the ends and the middles of both parameters, by the first one and the second one.
pub(super) type Grid = [[DVec3; 3]; 3];

/// A point of a piece, and the distance of the point from which its way begins: no way is shorter.
#[derive(Debug, Clone, Copy)]
pub(super) struct FromShared {
    pub(super) point: DVec3,
    pub(super) way: f64,
}

/// Returns the points of a piece, each with its way from a side along the other parameter.
pub(super) fn from_side(piece: &Piece, side: Side, patches: &PatchSet) -> Vec<FromShared> {
    let grid = piece.grid(patches);
    let at = |along: usize, across: usize| {
        if side.axis.index() == 0 { grid[across][along] } else { grid[along][across] }
    };
    let begin = 2 * side.end;
    let ways = (0..3).flat_map(|along| (0..3).map(move |across| [along, across]));
    ways.map(|[along, across]| {
        let point = at(along, across);
        FromShared { point, way: point.distance(at(along, begin)) }
    })
    .collect()
}

/// Returns the points of a piece, each with its way from a corner, or from a side that is a point.
pub(super) fn from_touch(piece: &Piece, touch: Touch, patches: &PatchSet) -> Vec<FromShared> {
    match touch {
        Touch::Side(side) => from_side(piece, side, patches),
        Touch::Corner([u, v]) => {
            let grid = piece.grid(patches);
            let corner = grid[2 * u][2 * v];
            grid.as_flattened()
                .iter()
                .map(|&point| FromShared { point, way: point.distance(corner) })
                .collect()
        }
    }
}

/// Returns the points of a piece, of whose ways nothing is known.
pub(super) fn points_of(piece: &Piece, patches: &PatchSet) -> Vec<FromShared> {
    piece.grid(patches).as_flattened().iter().map(|&point| FromShared { point, way: 0.0 }).collect()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Two points at a distance of 5 whose ways are 4 and 3 long: a margin of 5/7 is attained.
    #[test]
    fn the_bound_between_two_points_is_attained() {
        let one = [FromShared { point: DVec3::new(4.0, 0.0, 0.0), way: 4.0 }];
        let other = [FromShared { point: DVec3::new(0.0, 3.0, 0.0), way: 3.0 }];
        let holds = |margin: f64, rest: f64| Ways { margin, rest }.hold_between([&one, &other], 0.0);
        assert!(holds(5.0 / 7.0 - 1e-12, 0.0) && !holds(5.0 / 7.0 + 1e-12, 0.0));
        assert!(holds(1.0, 2.0) && !holds(1.0, 2.0 - 1e-9));
    }

    /// A quarter of a strip bent by a right angle: from one end to the other, the way through the middle is √2 times the
    /// distance. Folded onto itself, no margin holds.
    #[test]
    fn the_bound_on_a_grid_is_attained() {
        let along = |points: [[f64; 2]; 3]| -> Grid {
            points.map(|[x, y]| [0.0, 1.0, 2.0].map(|z| DVec3::new(x, y, z)))
        };
        // A way along one parameter is a chord, so that the diagonal of the squares of 2 x 2 is what is longest.
        let flat = along([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]);
        let half = 0.5_f64.sqrt();
        assert!(Ways { margin: half - 1e-12, rest: 0.0 }.hold_on(&flat, 0.0));
        assert!(!Ways { margin: half + 1e-12, rest: 0.0 }.hold_on(&flat, 0.0));
        // The last line is the first one again, moved along itself.
        let mut folded = along([[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]);
        folded[2].reverse();
        assert!(!Ways { margin: 1e-3, rest: 0.0 }.hold_on(&folded, 0.0));
    }
}
