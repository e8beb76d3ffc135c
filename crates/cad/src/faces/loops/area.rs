//! Signed areas in the parameters.

use crate::faces::uses::TrimUse;
use crate::nurbs::{Spline, Surface};
use glam::{DVec2, DVec3, DVec4, Vec3Swizzles};
use nurbs_hausdorff::trim::TrimPiece;

/// The part of a closed surface's area below which an area is a sum of rounding errors.
pub(super) const NO_AREA: f64 = 1e-12;

/// The deviation of areas, relative to the whole surface's, from those of curves which meet
/// exactly: ends may miss each other by 1e-7 of the surface.
pub(super) const AREA_TOLERANCE: f64 = 1e-6;

/// Returns the signed area within curves head to tail, positive if they turn counterclockwise:
/// up to rounding for polynomial curves, else an estimate to about its digits.
pub(super) fn of_loop(uses: &[TrimUse]) -> f64 {
    let Some(first) = uses.first() else { return 0.0 };
    let origin = first.curve.start().xy();
    uses.iter().map(|trim_use| of_curve(&trim_use.curve, origin)).sum()
}

/// Returns the signed area between a curve and a point.
fn of_curve(curve: &Spline, origin: DVec2) -> f64 {
    let control = |control: &DVec4| DVec3::new(control.x, control.y, control.w);
    let piece =
        |piece: &Spline| TrimPiece { controls: piece.controls.iter().map(control).collect(), curve: 0 };
    curve.pieces().iter().map(|part| piece(part).signed_area(origin)).sum()
}

/// Returns the area W of the parameters of a surface without boundary, which is closed in u,
/// and in v closed or ended by poles; `None` for other surfaces.
pub(super) fn of_closed(surface: &Surface) -> Option<f64> {
    let [u, v] = surface.closures();
    let across = v.or_else(|| match surface.poles().as_slice() {
        [south, north] => Some((north - south).abs()),
        _ => None,
    });
    Some(u? * across?)
}
