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

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::untrim::testing::{face_within, plane};

    /// A square as one cell between two lines, the right one farther right by `beyond`.
    fn square(beyond: f64) -> (UnitFace, Ruling) {
        let face = face_within(&plane(), &[&[[0.25, 0.25], [0.75, 0.25], [0.75, 0.75], [0.25, 0.75]]]);
        let line = |u: f64| Curve::line(DVec2::new(u, 0.25), DVec2::new(u, 0.75));
        (face, Ruling::between_lines([line(0.25), line(0.75 + beyond)], [0, 0]))
    }

    #[test]
    fn an_area_that_no_move_explains_is_refused() {
        let (face, exact) = square(0.0);
        assert_eq!(check(&face, &[(1, &exact)], [0.0; 2]), Ok(()));
        for beyond in [1e-3, 1e-6, 1e-11] {
            let (face, ruling) = square(beyond);
            assert!(check(&face, &[(1, &ruling)], [0.0; 2]).is_err(), "{beyond}");
            assert_eq!(check(&face, &[(1, &ruling)], [beyond, 0.0]), Ok(()));
            // A move along the boundary explains nothing of it.
            assert!(check(&face, &[(1, &ruling)], [0.0, 0.1 * beyond]).is_err(), "{beyond}");
        }
        assert!(check(&face, &[(2, &exact)], [0.0; 2]).is_err());
    }
}
