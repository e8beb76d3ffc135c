//! The extensions of flat pieces beyond the edges at which they were cut.

use crate::bezier::{BEYOND, MAX_DEGREES, Patch, PatchSet};
use crate::param_box::ParamBox;

/// Returns, for every piece of `flat`, which [`flatten`](super::flatten) made of
/// `patches`, the parameters at which its controls give points of its patch:
/// [0, 1] along each axis, and an eighth more where a sibling follows. O(pieces).
///
/// A piece has the same polynomials as its patch, in other parameters, so they
/// continue beyond the edges of the piece. Its width is 2^-n of the patch's, so a
/// sibling that follows is at least as wide.
#[must_use]
pub fn extensions(patches: &PatchSet, flat: &PatchSet) -> Vec<ParamBox> {
    let mut extensions = Vec::with_capacity(flat.len());
    let mut parent = 0;
    for piece in flat.iter() {
        while parent + 1 < patches.len() && !is_part(&piece, &patches.patch(parent)) {
            parent += 1;
        }
        let patch = patches.patch(parent);
        let extrapolated = is_part(&piece, &patch) && piece.degree[0] + piece.degree[1] <= MAX_DEGREES;
        let extension = [0, 1].map(|axis| {
            let beyond = |cut: bool| if extrapolated && cut { BEYOND } else { 0.0 };
            let ([start, end], [first, last]) = (piece.domain[axis], patch.domain[axis]);
            [-beyond(start > first), 1.0 + beyond(end < last)]
        });
        extensions.push(extension.into());
    }
    extensions
}

/// Returns whether the piece lies on the patch, by its domain.
fn is_part(piece: &Patch<'_>, patch: &Patch<'_>) -> bool {
    piece.surface == patch.surface && patch.domain.contains_box(&piece.domain)
}
