//! The sides along which a cell is halved that no bound decides.
//!
//! By default that is the longer one in space, which bounds of first order depend on. Taylor's bound
//! depends on how the difference of A and B varies instead: along the lines of a cylinder or of a ruled
//! surface that B follows it is the same everywhere, however long they are, and cells halved along them
//! have the bound of the whole. So a side is left as it is where halving it gains next to nothing, by
//! the bound's own terms, compared with halving the other one. Any choice is valid.

use super::CellContext;
use super::taylor::CellPair;

/// The ratio of the gains along both sides from which on only the one of the larger gain is halved.
const MIN_GAIN_RATIO: f64 = 8.0;

/// The ratio of a cell's sides in space beyond which it is halved along the longer side in any case.
const MAX_ASPECT: f64 = 64.0;

/// Whether to halve a cell along s and along t: at least one of them.
pub(in crate::certified) fn halved_axes(context: &CellContext<'_>) -> [bool; 2] {
    let lengths = context.patch_bounds().first;
    let by_length = context.cell.longer_sides(lengths);
    let pair = CellPair::new(context, &context.foot());
    let Some([s, t]) = pair.gains_of_halving() else { return by_length };
    let [h, k] = [0, 1].map(|axis| context.cell.half[axis] * lengths[axis]);
    // False for NaN.
    if s > MIN_GAIN_RATIO * t && h * MAX_ASPECT > k {
        [true, false]
    } else if t > MIN_GAIN_RATIO * s && k * MAX_ASPECT > h {
        [false, true]
    } else {
        by_length
    }
}
