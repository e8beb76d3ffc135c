//! Offset surfaces, approximated by interpolation.

use super::refit::interpolated;
use crate::axis::Axis;
use crate::bezier::{BezierModel, extract};
use crate::error::{Error, Result};
use crate::model::{Model, NurbsSurface};
use glam::DVec3;

/// The step towards the middle of the domain, relative to it, at which the normal
/// is taken where it is not defined, as at a pole.
const NUDGE: f64 = 1e-6;

/// Returns the polynomial bicubic B-spline surface over [0, 1]² that interpolates, at
/// `counts[0]` × `counts[1]` evenly spaced parameters, the points at `distance` from
/// `surface` along its normal (the direction of the derivative by u times that by v).
///
/// It approximates the offset surface, which is not rational in general, as CAD
/// systems do (Piegl and Tiller, *Computing offsets of NURBS curves and surfaces*,
/// Computer-Aided Design 31 (1999)); beyond the radius of curvature the offset folds,
/// and so does this surface. O(n² m + n m²) for n × m points.
///
/// # Errors
/// `TOO_FEW_CONTROL_POINTS` for a count below 4; `OPTION_OUT_OF_RANGE` where the
/// surface has no normal at a site or beside it.
pub fn offset_surface(surface: &NurbsSurface, distance: f64, counts: [usize; 2]) -> Result<NurbsSurface> {
    let bezier = extract(&Model::new(None, vec![surface.clone()])?);
    interpolated(counts, |fractions| {
        let (point, normal) = point_and_normal(&bezier, fractions);
        let nudged = || {
            let inside = fractions.map(|fraction| fraction + NUDGE * (0.5 - fraction));
            point_and_normal(&bezier, inside).1
        };
        let normal = normal.or_else(nudged);
        let normal = normal.ok_or_else(|| {
            Error::out_of_range("surface", fractions[0], "a surface with normals at all sites")
        })?;
        Ok(point + distance * normal)
    })
}

/// Returns the point at these fractions of the domain of a single surface, and its normal.
fn point_and_normal(bezier: &BezierModel, fractions: [f64; 2]) -> (DVec3, Option<DVec3>) {
    let grid = &bezier.grids[0];
    let [(row, s), (column, t)] = Axis::BOTH.map(|axis| {
        let breaks = &grid.breaks[axis];
        let (start, end) = (breaks[0], breaks[breaks.len() - 1]);
        grid.locate(axis, (1.0 - fractions[axis]) * start + fractions[axis] * end)
    });
    let jet = bezier.patches.patch(row * grid.counts()[1] + column).jet([s, t]);
    (jet.point, jet.normal())
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::shapes::shape;

    /// Offsets of a sphere and of a torus are a sphere and a torus: all points
    /// are at the distance, up to an error of fourth order.
    #[test]
    fn points_are_at_the_distance() {
        let torus = shape("torus").unwrap().surfaces()[0].clone();
        let original = extract(&Model::new(None, vec![torus.clone()]).unwrap());
        let mut last = f64::INFINITY;
        for count in [12, 24, 48] {
            let offset = offset_surface(&torus, 0.125, [count, count]).unwrap();
            let offset = extract(&Model::new(None, vec![offset]).unwrap());
            let mut largest = 0.0_f64;
            for k in 0..200 {
                let fractions = [(0.1 + 0.37 * f64::from(k)).fract(), (0.2 + 0.61 * f64::from(k)).fract()];
                let (point, normal) = point_and_normal(&original, fractions);
                let expected = point + 0.125 * normal.unwrap();
                largest = largest.max(point_and_normal(&offset, fractions).0.distance(expected));
            }
            assert!(largest < 0.2 * last, "{count}: {largest}, {last}");
            last = largest;
        }
        assert!(last < 1e-3, "{last}");
    }

    #[test]
    fn a_pole_has_the_normal_beside_it() {
        let sphere = shape("sphere").unwrap().surfaces()[0].clone();
        let offset = offset_surface(&sphere, 0.5, [9, 9]).unwrap();
        let [a, b] = [sphere, offset].map(|surface| extract(&Model::new(None, vec![surface]).unwrap()));
        for v in [0.0, 1.0] {
            let [from, to] = [&a, &b].map(|bezier| point_and_normal(bezier, [0.0, v]).0);
            assert!((from.distance(to) - 0.5).abs() < 1e-5, "{from} {to}");
        }
    }
}
