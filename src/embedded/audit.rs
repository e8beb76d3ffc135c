//! What lemma S8 states of two pieces, and its audit: while the search runs, it is compared with points of both.

use super::complex::Touch;
use super::piece::{Piece, Side};
use crate::bezier::PatchSet;
use glam::DVec3;
use std::cell::Cell;

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

    /// Returns whether the ends and the middle of an arc do not contradict the bound on the way along it.
    pub(super) fn hold_along(self, [from, middle, to]: [DVec3; 3], slack: f64) -> bool {
        from.distance(middle) + middle.distance(to) <= self.at(from.distance(to) + slack)
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

/// The number of distances of computed points that an audit adds and compares. Each is off by the error of two points at
/// most, and so by the nearness.
const AUDITED_DISTANCES: f64 = 3.0;

/// What a search states of points that are near each other, and whether other points have contradicted it.
#[derive(Debug)]
pub(super) struct Audited {
    apart: f64,
    is_refuted: Cell<bool>,
}

impl Audited {
    /// `apart` is the distance up to which points are near each other, with the rounding of distances of computed points.
    pub(super) fn new(apart: f64) -> Self {
        Self { apart, is_refuted: Cell::new(false) }
    }

    /// Returns the distance up to which points are near each other.
    pub(super) fn apart(&self) -> f64 {
        self.apart
    }

    /// Returns whether points contradicted what was stated.
    pub(super) fn is_refuted(&self) -> bool {
        self.is_refuted.get()
    }

    /// Returns the bound on the ways between points that are near each other, if it is at most `most` and no points
    /// contradict it. `holds` compares it with points whose distances are off by a length all together.
    pub(super) fn stated(&self, ways: Ways, most: f64, holds: impl FnOnce(f64) -> bool) -> Option<f64> {
        let within = ways.at(self.apart);
        if within > most {
            return None;
        }
        if !holds(AUDITED_DISTANCES * self.apart) {
            self.is_refuted.set(true);
            return None;
        }
        Some(within)
    }

    /// As [`Self::stated`], of the ways from points of two pieces.
    pub(super) fn stated_between(
        &self,
        ways: Ways,
        most: f64,
        points: impl FnOnce() -> [Vec<FromShared>; 2],
    ) -> Option<f64> {
        self.stated(ways, most, |slack| {
            let [one, other] = points();
            ways.hold_between([&one, &other], slack)
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

    /// Of an arc that is bent by a right angle in its middle the way is √2 times the distance of its ends.
    #[test]
    fn the_bound_along_an_arc_is_attained() {
        let arc = [DVec3::X, DVec3::ZERO, DVec3::Y];
        let half = 0.5_f64.sqrt();
        let holds = |margin: f64, rest: f64| Ways { margin, rest }.hold_along(arc, 0.0);
        assert!(holds(half - 1e-12, 0.0) && !holds(half + 1e-12, 0.0));
        assert!(holds(1.0, 0.59) && !holds(1.0, 0.58));
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
