//! The bricks of a grid, which are measured one by one.

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

use super::grid::Grid;
use super::query::{Known, PointQuery};
use crate::rounding::{gamma, upper_max};
use glam::DVec3;

/// The number of points along a side of a brick: 512 of them pay for the one at its middle, and near a surface
/// a brick is small enough that most are outside a band of some spacings.
pub(super) const SIDE: usize = 8;

/// The number of points along a side of the parts of a brick whose points share a list of patches.
const CELL_SIDE: usize = 4;

/// The roundings of a brick's radius, relative to the length of the grid's points: those of two points, of their
/// difference, its length and the half.
const RADIUS_ROUNDINGS: f64 = 16.0;

/// The roundings of three differences, relative to the largest number in them.
const DIFFERENCE_ROUNDINGS: f64 = 3.0;

/// A part of a grid, with up to [`SIDE`] points along each axis.
#[derive(Clone, Copy)]
pub(super) struct Brick {
    first: [usize; 3],
    counts: [usize; 3],
}

/// The signed distances of a brick's points, x fastest.
pub(super) struct Filled {
    pub(super) values: Vec<f64>,
    /// The points whose side is not decided.
    pub(super) undecided: Vec<usize>,
    /// An upper bound on the errors of the values within the band.
    pub(super) bound: f64,
    /// The number of measured points: the middle of the brick, and its points unless they are beyond the band.
    pub(super) measured: usize,
}

/// Returns the bricks of a grid, x fastest.
pub(super) fn bricks(grid: &Grid) -> Vec<Brick> {
    Brick { first: [0; 3], counts: grid.counts }.divided(SIDE).collect()
}

impl Brick {
    /// Returns the places of the brick's points in the whole grid, x fastest.
    pub(super) fn places(self, grid: &Grid) -> impl Iterator<Item = usize> {
        let whole = Self { first: [0; 3], counts: grid.counts };
        self.indices().map(move |index| whole.place(index))
    }

    /// Returns parts with up to `side` points along each axis, x fastest.
    fn divided(self, side: usize) -> impl Iterator<Item = Self> {
        let Self { first, counts } = self;
        let along = counts.map(|count| count.div_ceil(side));
        (0..along.iter().product()).map(move |index: usize| {
            let place = [index % along[0], index / along[0] % along[1], index / along[0] / along[1]];
            let offset = place.map(|place| side * place);
            Self {
                first: std::array::from_fn(|axis| first[axis] + offset[axis]),
                counts: std::array::from_fn(|axis| side.min(counts[axis] - offset[axis])),
            }
        })
    }

    /// Returns the place of a point of the whole grid among the brick's, x fastest.
    fn place(self, index: [usize; 3]) -> usize {
        let [i, j, k] = std::array::from_fn(|axis| index[axis] - self.first[axis]);
        i + self.counts[0] * (j + self.counts[1] * k)
    }

    /// Returns the indices of the points in the whole grid, x fastest.
    fn indices(self) -> impl Iterator<Item = [usize; 3]> {
        let Self { first, counts: [width, depth, height] } = self;
        let local = move |index: usize| [index % width, index / width % depth, index / width / depth];
        (0..width * depth * height)
            .map(local)
            .map(move |local| std::array::from_fn(|axis| first[axis] + local[axis]))
    }

    /// Returns the middle of the brick, and an upper bound on the distance of its points from it.
    fn ball(self, grid: &Grid) -> (DVec3, f64) {
        let last = std::array::from_fn(|axis| self.first[axis] + self.counts[axis] - 1);
        let [start, end] = [self.first, last].map(|index| grid.point(index));
        let rounding = gamma(RADIUS_ROUNDINGS) * (start.length() + end.length()) + grid.rounding();
        (0.5 * (start + end), 0.5 * start.distance(end) + rounding)
    }

    /// Measures the points; `None` of a model without patches. Values beyond `band`, +∞ for none, are the band's width with
    /// their sign.
    ///
    /// Lemma P1 (bricks, docs/points.md). Distances of two points differ at most by how far the points are apart: where the
    /// distance at the middle less the radius is above the band, that of every point is. If no point of the
    /// boundary is within the radius, all points have the side of the middle.
    pub(super) fn fill(self, query: &PointQuery<'_>, grid: &Grid, band: f64) -> Option<Filled> {
        let (middle, radius) = self.ball(grid);
        let mut known = Known::default();
        let count = self.counts.iter().product();
        let found = query.closest(middle, 0.0, &mut known)?;
        let rounding = gamma(DIFFERENCE_ROUNDINGS) * found.distance;
        let least = found.distance - found.bound - radius - rounding;
        if least > band && query.is_clear(&found, radius) {
            let signed = query.signed(middle, &found, &mut known);
            // Neither zero nor NaN: the side is decided.
            if signed.abs() > 0.0 {
                let values = vec![band.copysign(signed); count];
                return Some(Filled { values, undecided: Vec::new(), bound: 0.0, measured: 1 });
            }
        }
        let mut filled =
            Filled { values: vec![0.0; count], undecided: Vec::new(), bound: 0.0, measured: 1 + count };
        for cell in self.divided(CELL_SIDE) {
            let (middle, radius) = cell.ball(grid);
            query.list_nearby(middle, radius, &mut known)?;
            for index in cell.indices() {
                self.measure(query, index, (grid, band), &mut known, &mut filled)?;
            }
        }
        filled.undecided.sort_unstable();
        Some(filled)
    }

    /// Sets the signed distance of one point.
    fn measure(
        self,
        query: &PointQuery<'_>,
        index: [usize; 3],
        (grid, band): (&Grid, f64),
        known: &mut Known,
        filled: &mut Filled,
    ) -> Option<()> {
        let (point, place) = (grid.point(index), self.place(index));
        let found = query.closest(point, grid.rounding(), known)?;
        let signed = query.signed(point, &found, known);
        // NaN, and 0 on the boundary, whose distance may be its error.
        let is_decided = signed.abs() > 0.0;
        if !is_decided {
            filled.undecided.push(place);
        }
        let is_within = found.distance < band;
        let size = if is_within { found.distance } else { band };
        filled.values[place] = if is_decided { size.copysign(signed) } else { size };
        filled.bound = upper_max(filled.bound, found.bound);
        Some(())
    }
}
