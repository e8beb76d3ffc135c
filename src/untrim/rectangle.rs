//! Faces trimmed by parameter lines on all four sides, cut by knot insertion.

use super::curve::Curve;
use super::face::UnitFace;
use crate::axis::Axis;
use crate::error::Result;
use crate::model::NurbsSurface;
use crate::param_box::ParamBox;
use crate::refine::cut_surface;
use glam::DVec2;

/// The largest relative error of the loop's area against the rectangle's, which only
/// loops that run back on themselves exceed.
const AREA_TOLERANCE: f64 = 1e-6;

/// Returns the rectangle in normalised parameters whose four sides the face's only loop
/// runs along, and the distances in u and v by which the loop leaves them.
pub(super) fn rectangle(face: &UnitFace) -> Option<(ParamBox, [f64; 2])> {
    let [curves] = &face.loops[..] else { return None };
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for [from, to] in curves.iter().map(Curve::hull) {
        (low, high) = (low.min(from), high.max(to));
    }
    let mut moved = [0.0_f64; 2];
    for [from, to] in curves.iter().map(Curve::hull) {
        let distance = |axis: usize| (to[axis] - low[axis]).min(high[axis] - from[axis]);
        let axis = (0..2).find(|&axis| distance(axis) <= face.tolerances.snap[axis])?;
        moved[axis] = moved[axis].max(distance(axis));
    }
    let area: f64 = curves.iter().map(|curve| 0.5 * curve.start().perp_dot(curve.end())).sum();
    let expected = (high - low).element_product();
    if (area - expected).abs() > AREA_TOLERANCE * expected {
        return None;
    }
    let mut sides = [[0.0; 2]; 2];
    for axis in 0..2 {
        for (side, value) in [low[axis], high[axis]].into_iter().enumerate() {
            let end = side as f64;
            let near = (value - end).abs() <= face.tolerances.snap[axis];
            sides[axis][side] = if near { end } else { value };
            moved[axis] = moved[axis].max((sides[axis][side] - value).abs());
        }
    }
    Some((ParamBox::from(sides), moved))
}

/// Returns the part of `surface` over a rectangle of normalised parameters.
pub(super) fn cut(surface: &NurbsSurface, part: ParamBox) -> Result<NurbsSurface> {
    let mut cut = surface.clone();
    for axis in Axis::BOTH {
        let [start, end] = surface.domain()[axis];
        let at = |share: f64| (1.0 - share) * start + share * end;
        let [from, to] = part[axis];
        for (share, side) in [(to, 0), (from, 1)] {
            let [low, high] = cut.domain()[axis];
            let parameter = at(share);
            if parameter > low && parameter < high {
                let pieces = cut_surface(&cut, axis, parameter)?;
                cut = if side == 0 { pieces[0].clone() } else { pieces[1].clone() };
            }
        }
    }
    Ok(cut)
}
