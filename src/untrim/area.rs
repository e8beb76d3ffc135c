//! The area of cells against the area within the loops.

use super::cells::ruling::Ruling;
use super::curve::Curve;
use super::face::UnitFace;
use crate::model::trim::TrimPiece;
use glam::DVec2;

/// The error of an area beyond what moves of the boundary explain, a curve, in parts of the
/// domain: a few hundred roundings of the quadrature.
const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// The number of halvings of a rational curve for its quadrature.
const MAX_HALVINGS: usize = 12;

/// Checks that the areas of cells in the parameters, each counted with its winding number, add up
/// to that of the loops by Green's theorem, within what moves of the boundary in u and v explain.
///
/// The balance of the cells is a proof about arcs; this finds a loss between loops and arcs, as of
/// a curve or a loop. O(curves + cells).
pub(super) fn check(face: &UnitFace, rulings: &[(i32, &Ruling)], moved: [f64; 2]) -> Result<(), String> {
    let (mut expected, mut allowed) = (0.0, 0.0);
    for curve in face.loops.iter().flatten() {
        expected += under(curve);
        allowed += change(curve, moved) + ROUNDING;
    }
    let mut found = 0.0;
    for (winding, ruling) in rulings {
        found += f64::from(*winding) * image(ruling);
        for side in [&ruling.left, &ruling.right] {
            allowed += f64::from(winding.abs()) * change(side, ruling.moved) + ROUNDING;
        }
    }
    if (found - expected).abs() <= allowed {
        return Ok(());
    }
    Err(format!("its cells have the area {found:e} of the domain, its loops {expected:e}"))
}

/// Returns an upper bound on the change of the area beside a curve whose points move.
fn change(curve: &Curve, [in_u, in_v]: [f64; 2]) -> f64 {
    let points: Vec<DVec2> = curve.controls.iter().map(|&control| super::curve::divided(control)).collect();
    let extent = points.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum::<DVec2>();
    // The ends move, too.
    2.0 * (in_u * (extent.y + in_v) + in_v * (extent.x + in_u))
}

/// Returns the signed area of a map's image.
fn image(ruling: &Ruling) -> f64 {
    let segment = |from: DVec2, to: DVec2| 0.5 * from.perp_dot(to);
    let Ruling { left, right, .. } = ruling;
    under(right) - under(left) + segment(left.start(), right.start()) + segment(right.end(), left.end())
}

/// Returns the signed area that the line from the origin to a curve's points passes over.
fn under(curve: &Curve) -> f64 {
    let whole = rule(curve);
    if curve.is_polynomial() {
        return whole;
    }
    let mut total = 0.0;
    let mut open = vec![(curve.clone(), whole, 0)];
    while let Some((curve, whole, depth)) = open.pop() {
        let halves = [curve.restricted(0.0, 0.5), curve.restricted(0.5, 1.0)];
        let areas = halves.each_ref().map(rule);
        if depth == MAX_HALVINGS || (areas[0] + areas[1] - whole).abs() <= ROUNDING {
            total += areas[0] + areas[1];
            continue;
        }
        open.extend(halves.into_iter().zip(areas).map(|(half, area)| (half, area, depth + 1)));
    }
    total
}

/// Returns the same by one application of Gauss's rule, which is exact for polynomial curves.
fn rule(curve: &Curve) -> f64 {
    TrimPiece { controls: curve.controls.clone(), curve: 0 }.signed_area(DVec2::ZERO)
}
