//! Strips within holes of a closed surface that are cut out over its seam or at its pole.

use super::super::surfaces::magnitude;
use super::loops::{Ring, polygon};
use super::{DrawnFace, Faces, first};
use fastrand::Rng;
use glam::DVec2;
use nurbs_hausdorff::SurfaceArrays;
use nurbs_hausdorff::shapes::{lateral, sphere, torus};
use std::f64::consts::TAU;

/// The decimal exponents of the width of a hole on its narrow side of the seam, relative to the domain.
const NARROW: [f64; 2] = [-3.0, -1.2];

/// Relative to that, those of the width on the other side, and of the distances of strips from the seam and of their
/// widths. In most draws the nearest border of the hole is beyond the seam.
const WIDE: [f64; 2] = [0.0, 1.5];
const DISTANCES: [f64; 2] = [-2.0, 0.3];
const WIDTHS: [f64; 2] = [-2.0, 0.0];

/// The largest width of a hole on one side.
const MAX_WIDTH: f64 = 0.4;

/// Returns narrow strips of a closed surface, and the surface less holes about the strips.
pub(super) fn faces(rng: &mut Rng) -> [Faces; 2] {
    let surface = closed_surface(rng);
    let [low, high] = [0.1 + 0.4 * rng.f64(), 0.6 + 0.35 * rng.f64()];
    let is_pole = rng.u8(0..4) == 0;
    // The ends of the hole along u before and after the seam, at its wider end.
    let narrow = magnitude(rng, NARROW[0], NARROW[1]);
    let wide = (narrow * magnitude(rng, WIDE[0], WIDE[1])).min(MAX_WIDTH);
    let is_before = rng.bool();
    let [before, after] = if is_before { [wide, narrow] } else { [narrow, wide] };
    let whole = if is_pole {
        notch(low, before, after)
    } else {
        let is_notch = rng.bool();
        over_seam([low, high], if is_notch { [before; 2] } else { [0.0, before] }, [0.0, after])
    };
    let top = if is_pole { 1.0 } else { high };
    let strips = (0..rng.usize(1..=2)).map(|_| {
        let near = narrow * magnitude(rng, DISTANCES[0], DISTANCES[1]);
        let far = near + narrow * magnitude(rng, WIDTHS[0], WIDTHS[1]);
        // A strip may begin where the surface is whole.
        let start = 0.5 * low + (top - 0.5 * low) * 0.9 * rng.f64();
        let end = start + (top - start) * (0.05 + 0.95 * rng.f64());
        let ends = if is_pole { [0.5 + near, 0.5 + far] } else { [near, far] };
        let ends = ends.map(|end| if is_before { 1.0 - end } else { end });
        rectangle([ends[0].min(ends[1]), ends[0].max(ends[1])], [start, end])
    });
    let face = |ring: Ring| DrawnFace { surface: surface.clone(), rings: Some(vec![ring]) };
    [strips.map(face).collect(), vec![face(whole)]]
}

/// A surface that is closed along u.
fn closed_surface(rng: &mut Rng) -> SurfaceArrays {
    match rng.u8(0..4) {
        0 | 1 => lateral([1.0; 2], [0.0, TAU]).unwrap().into_arrays(),
        2 => lateral([1.0, 0.3 + 0.5 * rng.f64()], [0.0, 1.0 + rng.f64()]).unwrap().into_arrays(),
        _ if rng.bool() => first(&sphere(glam::DVec3::ZERO, 1.0).unwrap()),
        _ => first(&torus(2.0, 0.5).unwrap()),
    }
}

fn rectangle([x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> Ring {
    polygon(&[DVec2::new(x0, y0), DVec2::new(x1, y0), DVec2::new(x1, y1), DVec2::new(x0, y1)])
}

/// The domain less a hole over the seam: of these widths at its start and at its end, before the seam and after it.
fn over_seam([low, high]: [f64; 2], before: [f64; 2], after: [f64; 2]) -> Ring {
    let mut corners = vec![DVec2::ZERO, DVec2::X, DVec2::new(1.0, low)];
    corners.extend([(before[0], low), (before[1], high)].map(|(width, v)| DVec2::new(1.0 - width, v)));
    corners.extend([DVec2::new(1.0, high), DVec2::ONE, DVec2::Y, DVec2::new(0.0, high)]);
    corners.extend([(after[1], high), (after[0], low)].map(|(width, v)| DVec2::new(width, v)));
    corners.push(DVec2::new(0.0, low));
    corners.dedup();
    polygon(&corners)
}

/// The domain less a triangle with a side on the end of v, where a sphere has its pole.
fn notch(low: f64, before: f64, after: f64) -> Ring {
    let [x0, x1] = [(0.5 - before).max(0.05), (0.5 + after).min(0.95)];
    polygon(&[
        DVec2::ZERO,
        DVec2::X,
        DVec2::ONE,
        DVec2::new(x1, 1.0),
        DVec2::new(0.5, low),
        DVec2::new(x0, 1.0),
        DVec2::Y,
    ])
}
