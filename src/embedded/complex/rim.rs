//! The rims of trimmed faces, and lines of surfaces that are points.

use super::edge::image;
use super::{Piece, Side, ascending, side};
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::param_box::ParamBox;
use crate::solid::Arc;
use glam::DVec3;

/// A part of a side of a patch at which a trimmed face ends.
#[derive(Debug, Clone, Copy)]
pub(in crate::embedded) struct RimArc {
    pub(in crate::embedded) sheet: usize,
    pub(in crate::embedded) patch: u32,
    pub(in crate::embedded) side: Side,
    /// The parameters along the side, the lesser first.
    pub(in crate::embedded) range: [f64; 2],
    /// The corners at its ends.
    pub(in crate::embedded) corners: [Option<u32>; 2],
}

/// Adds the arcs of an edge at which trimmed faces end, with corners that are not known yet.
pub(super) fn add_rims(
    rims: &mut Vec<RimArc>,
    arcs: [Option<&Arc>; 2],
    sheet: impl Fn(u32) -> Option<usize>,
    near: f64,
) {
    let sheets = arcs.map(|arc| sheet(arc?.place.index));
    if let [Some(one), Some(other)] = arcs
        && sheets[0] == sheets[1]
        && is_within(one, other, near)
    {
        return;
    }
    for (arc, sheet) in arcs.into_iter().zip(sheets) {
        let Some((arc, sheet)) = arc.zip(sheet) else { continue };
        let range = ascending(arc.range);
        rims.push(RimArc { sheet, patch: arc.place.index, side: side(arc.place), range, corners: [None; 2] });
    }
}

/// Returns whether the points of two arcs that correspond are known to be at most `near` apart.
fn is_within(one: &Arc, other: &Arc, near: f64) -> bool {
    let widths = [[one, other], [other, one]].map(|[inner, outer]| {
        let (_, width) = image(inner, ascending(inner.range), outer, near)?;
        Some(width)
    });
    widths.into_iter().flatten().any(|width| width <= near)
}

/// Returns the point that the last side of a patch along an axis is, if it is one.
pub(in crate::embedded) fn pinch_of(patch: &Patch<'_>, axis: Axis) -> Option<DVec3> {
    let piece = Piece::new(patch, 0, ParamBox::UNIT, 0, std::iter::empty());
    let side = Side { axis, end: 1 };
    piece
        .along_side(side)
        .list
        .is_empty()
        .then(|| piece.corner([usize::from(axis == Axis::U), usize::from(axis == Axis::V)]))
}
