//! Halved along the side whose halving reduces Taylor's bound more.
//!
//! Bounds of first order depend on the cell's longer side in space. Taylor's bound depends on how the
//! difference of A and B varies instead: along the lines of a cylinder or of a ruled surface that B
//! follows it is the same everywhere, however long they are, and cells halved along them have the bound
//! of the whole. So the cell is halved along the side whose halving reduces Taylor's bound more, by
//! that bound's own terms. Any choice is valid: it decides only how many cells there are.

use super::gains_of_halving;
use crate::certified::cell_context::CellContext;

/// The ratio of the gains of halving along both sides from which on only the one of the larger gain is
/// halved; with gains that are closer, the longer side in space. Ratios of 1 to 1.5 take about the same
/// number of cells, larger ones more.
const MIN_GAIN_RATIO: f64 = 1.5;

/// The ratio of a cell's sides in space up to which the shorter one is halved on account of its gain:
/// bounds of first order, which may be needed after all, depend on the longer one.
const MAX_ELONGATION: f64 = 256.0;

/// Whether to halve a cell along s and along t: along at least one of them.
pub(in crate::certified) fn halved_sides(context: &CellContext<'_>) -> [bool; 2] {
    let speeds = context.patch_bounds().first;
    let by_length = context.cell.longer_sides(speeds);
    let Some([of_s, of_t]) = gains_of_halving(context) else { return by_length };
    let [length_s, length_t] = [0, 1].map(|axis| context.cell.half[axis] * speeds[axis]);
    if of_s > MIN_GAIN_RATIO * of_t && length_t <= MAX_ELONGATION * length_s {
        [true, false]
    } else if of_t > MIN_GAIN_RATIO * of_s && length_s <= MAX_ELONGATION * length_t {
        [false, true]
    } else {
        by_length
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::super::Taylor;
    use super::*;
    use crate::certified::cell_context::UpperBound;
    use crate::certified::nearest::{Foot, NearestPoint};
    use crate::certified::testing::{Surfaces, clamped};
    use crate::certified::{Cell, Pair};
    use crate::flatness::Flatness;
    use crate::model::{RigidTransform, SurfaceArrays};

    /// A sheet `length` long in x and 1 wide in y that rises to these heights along y; with
    /// `swapped` parameters u is along y.
    fn sheet(length: f64, heights: [f64; 3], swapped: bool) -> Surfaces {
        let at = |i: usize, j: usize| [0.5 * length * i as f64, 0.5 * j as f64, heights[j], 1.0];
        let points = (0..9).map(|index| {
            let [i, j] = [index / 3, index % 3];
            if swapped { at(j, i) } else { at(i, j) }
        });
        let arrays = SurfaceArrays {
            degree: [2, 2],
            counts: [3, 3],
            knots: [clamped(2, &[]), clamped(2, &[])],
            control_points: points.collect(),
        };
        Surfaces::new(vec![arrays], Flatness::None)
    }

    /// Whether the longer side and whether the shorter one is halved of a sheet that bends along
    /// the latter, over a plane.
    fn halved(length: f64, bend: f64, swapped: bool) -> [bool; 2] {
        let [a, b] = [[0.0, bend, 0.0], [0.0; 3]].map(|heights| sheet(length, heights, swapped));
        let pair = Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY };
        let nearest = NearestPoint::new(pair.b);
        let mut context = CellContext::new(&pair, &nearest, Cell::whole(0), &Foot::start(0, [0.5; 2]));
        assert!(Taylor.evaluate(&mut context, 0.0).unwrap() > 0.0);
        let [s, t] = halved_sides(&context);
        if swapped { [t, s] } else { [s, t] }
    }

    /// The side along which the distance changes is halved although it is shorter, up to the limit;
    /// where the distance is the same everywhere the longer one is.
    #[test]
    fn the_side_along_which_the_distance_changes_is_halved() {
        for swapped in [false, true] {
            assert_eq!(halved(10.0, 0.1, swapped), [false, true]);
            assert_eq!(halved(0.99 * MAX_ELONGATION, 0.1, swapped), [false, true]);
            assert_eq!(halved(1.1 * MAX_ELONGATION, 0.1, swapped), [true, false]);
            assert_eq!(halved(10.0, 0.0, swapped), [true, false]);
        }
    }
}
