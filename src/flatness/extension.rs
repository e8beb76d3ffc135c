//! How far the controls of a flat piece tell points of the patch it was cut from.

use crate::bezier::{BEYOND, MAX_DEGREES, Patch, PatchSet};
use crate::param_box::ParamBox;

/// For every piece of `flat`, which [`flatten`](super::flatten) made of
/// `patches`, the parameters at which its controls tell points of `patches`:
/// [0, 1] by axis, and an eighth more where a sibling follows. O(pieces).
///
/// A piece's controls are those of its patch by other parameters, so that the
/// same polynomials go on beyond its edges. Its width is a part 2^-n of the
/// patch's, so a sibling that follows is at least as wide.
#[must_use]
pub fn rooms(patches: &PatchSet, flat: &PatchSet) -> Vec<ParamBox> {
    let mut rooms = Vec::with_capacity(flat.len());
    let mut whole = 0;
    for piece in flat.iter() {
        while whole + 1 < patches.len() && !is_part(&piece, &patches.patch(whole)) {
            whole += 1;
        }
        let patch = patches.patch(whole);
        let follows = is_part(&piece, &patch) && piece.degree[0] + piece.degree[1] <= MAX_DEGREES;
        let room = [0, 1].map(|axis| {
            let beyond = |cut: bool| if follows && cut { BEYOND } else { 0.0 };
            let ([start, end], [first, last]) = (piece.domain[axis], patch.domain[axis]);
            [-beyond(start > first), 1.0 + beyond(end < last)]
        });
        rooms.push(room.into());
    }
    rooms
}

fn is_part(piece: &Patch<'_>, patch: &Patch<'_>) -> bool {
    piece.surface == patch.surface && patch.domain.contains_box(&piece.domain)
}
