//! The extensions of flat pieces beyond the edges at which they were cut.

use crate::bezier::{BEYOND, MAX_DEGREES};
use crate::param_box::ParamBox;

/// Returns the parameters at which the controls of a piece of a patch give points of
/// the patch: [0, 1] along each axis, and an eighth more beyond an edge that is cut.
/// `cuts` states of the start and the end of each axis whether the piece was cut
/// there from its patch.
///
/// Lemma (3.10 of docs/method.md). A piece of width 2^-n of a patch, after n halvings along an axis, may be
/// followed by its own width beyond an edge at which it was cut.
///
/// The cutting itself must state the cuts: the domains of pieces in the surface's
/// parameters are rounded, and between knots some units in the last place apart a
/// middle may be rounded onto an end of its span.
pub(super) fn extension(degree: [usize; 2], cuts: [[bool; 2]; 2]) -> ParamBox {
    let beyond = if degree[0] + degree[1] <= MAX_DEGREES { BEYOND } else { 0.0 };
    let at = |cut: bool| if cut { beyond } else { 0.0 };
    cuts.map(|[start, end]| [-at(start), 1.0 + at(end)]).into()
}
