//! Cells of a surface between its knots that a part of a curve enters.

use super::Lifted;
use glam::DVec3;

/// Part of the length between knots by which a part of a curve may pass one without a cut: the
/// allowance for it counts in the bound.
const NEAR_KNOT: f64 = 1e-11;

/// Maximum cells entered within `NEAR_KNOT`; knots may be that close together.
const MAX_CELLS: usize = 4;

/// The knots by which a part of a curve leaves the cell of its middle, along one parameter.
pub(super) struct Crossed {
    /// The length by which it leaves the cell.
    pub(super) by: f64,
    /// A parameter of each cell that it enters, that of its middle first.
    pub(super) cells: Vec<f64>,
    /// The knot to cut at, if it leaves the cell by more than [`NEAR_KNOT`].
    pub(super) far: Option<f64>,
}

impl Crossed {
    /// Returns the crossings, along an axis, of a part all of whose points are within `reach` of
    /// `center` by coordinate.
    pub(super) fn new(lifted: &Lifted<'_>, center: DVec3, reach: DVec3, axis: usize) -> Self {
        let cell = |parameter: f64| {
            let mut at = [center.x, center.y];
            at[axis] = parameter;
            lifted.surface.cells(at)[axis]
        };
        let (middle, reach) = (center[axis], reach[axis]);
        let [low, high] = cell(middle);
        let (below, above) = (low - (middle - reach), middle + reach - high);
        let by = below.max(above).max(0.0);
        let mut crossed = Self { by, cells: vec![middle], far: None };
        if by == 0.0 {
            return crossed;
        }
        let length = if (high - low).is_finite() {
            high - low
        } else {
            lifted.range.map(|t| lifted.curve.point(t)[axis].abs()).into_iter().fold(middle.abs(), f64::max)
        };
        let knot = if above > below { high } else { low };
        crossed.far = (by > NEAR_KNOT * length).then_some(knot);
        if crossed.far.is_some() {
            return crossed;
        }
        let mut end = high;
        while middle + reach > end && crossed.cells.len() <= MAX_CELLS {
            crossed.cells.push(end);
            end = cell(end)[1];
        }
        let mut start = low;
        while middle - reach < start && crossed.cells.len() <= 2 * MAX_CELLS {
            crossed.cells.push(start.next_down());
            start = cell(start.next_down())[0];
        }
        if middle + reach > end || middle - reach < start {
            crossed.far = Some(knot);
        }
        crossed
    }
}
