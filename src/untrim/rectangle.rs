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

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::untrim::testing::{face_within, plane};

    /// A face whose only loop runs through these points in normalised parameters.
    fn face(points: &[[f64; 2]]) -> UnitFace {
        let mut face = face_within(&plane(), &[&[[0.1, 0.1], [0.9, 0.1], [0.5, 0.9]]]);
        let line = |k: usize| Curve::line(points[k].into(), points[(k + 1) % points.len()].into());
        face.loops = vec![(0..points.len()).map(line).collect()];
        face.tolerances.snap = [1e-10, 2e-10];
        face
    }

    #[test]
    fn a_loop_that_runs_back_on_itself_bounds_no_rectangle() {
        let [a, b, c, d] = [[0.2, 0.2], [0.7, 0.2], [0.7, 0.6], [0.2, 0.6]];
        assert!(rectangle(&face(&[a, b, c, d])).is_some());
        assert!(rectangle(&face(&[a, b, c, d, c, b])).is_none());
        assert!(rectangle(&face(&[a, d, c, b])).is_none());
        assert!(rectangle(&face(&[a, b, c, d, a, b, c, d])).is_none());
    }

    #[test]
    fn a_rectangle_states_by_what_its_loop_leaves_it() {
        let moved = |off: [f64; 2]| {
            let points = [[0.2, 0.2], [0.7, 0.2 + off[1]], [0.7 + off[0], 0.6], [0.2, 0.6]];
            rectangle(&face(&points)).map(|(_, moved)| moved)
        };
        let [in_u, in_v] = moved([5e-11, 1.5e-10]).unwrap_or_default();
        assert!((in_u - 5e-11).abs() < 1e-15 && (in_v - 1.5e-10).abs() < 1e-15, "{in_u} {in_v}");
        assert!(moved([1.5e-10, 0.0]).is_none() && moved([0.0, 2.5e-10]).is_none());
        // Sides that take the place of the domain's.
        let near = [[5e-11, 0.2], [1.0, 0.2], [1.0, 1.0 - 1.5e-10], [5e-11, 1.0 - 1.5e-10]];
        let (sides, [in_u, in_v]) = rectangle(&face(&near)).unwrap_or((ParamBox::UNIT, [0.0; 2]));
        assert_eq!(sides.intervals(), [[0.0, 1.0], [0.2, 1.0]]);
        assert!(in_u >= 5e-11 && in_v >= 1.4999e-10, "{in_u} {in_v}");
    }
}
