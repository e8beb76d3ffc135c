//! Triangles near the faces of a body, by which places are found where it may meet itself.

use crate::bezier::Patch;
use crate::engine::PreparedModel;
use crate::facets::Facet;
use crate::rounding::upper_max;
use glam::{DVec3, Vec4Swizzles};

/// The distance of triangles from patches that is aimed at, relative to the body's diagonal.
const RELATIVE_TOLERANCE: f64 = 5e-4;

/// The largest number of parts of a patch along each parameter.
const MAX_PARTS: usize = 24;

/// The distance of the triangles of a mesh from it, relative to its diagonal: rounding alone.
const RELATIVE_ROUNDING: f64 = 1e-12;

/// A triangle near a surface, anticlockwise about its normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct SheetTriangle {
    pub(super) corners: [DVec3; 3],
    pub(super) surface: u32,
}

/// Returns triangles near all faces, and about how far they are from these.
pub(super) fn sheets(model: &PreparedModel) -> (Vec<SheetTriangle>, f64) {
    let diagonal = model.control_box().diagonal();
    if let Some(facets) = model.facets() {
        let triangle = |place: u32| match facets.target.facet(place) {
            Facet::Triangle(corners) => Some(SheetTriangle { corners, surface: place }),
            Facet::Point(_) => None,
        };
        let triangles = (0..facets.target.len() as u32).filter_map(triangle).collect();
        return (triangles, RELATIVE_ROUNDING * diagonal);
    }
    let tolerance = RELATIVE_TOLERANCE * diagonal;
    let mut triangles = Vec::new();
    model.bezier().patches.iter().for_each(|patch| add_patch(&patch, tolerance, &mut triangles));
    (triangles, tolerance)
}

fn add_patch(patch: &Patch<'_>, tolerance: f64, triangles: &mut Vec<SheetTriangle>) {
    let [rows, columns] = parts(patch, tolerance);
    let at = |i: usize, j: usize| patch.point([i as f64 / rows as f64, j as f64 / columns as f64]);
    for i in 0..rows {
        for j in 0..columns {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            for corners in [[a, b, c], [a, c, d]] {
                triangles.push(SheetTriangle { corners, surface: patch.surface as u32 });
            }
        }
    }
}

/// Returns the numbers of parts of a patch along its parameters at which bilinear parts are about as near as this.
fn parts(patch: &Patch<'_>, tolerance: f64) -> [usize; 2] {
    let [p, q] = patch.degree;
    let columns = q + 1;
    let point = |i: usize, j: usize| {
        let control = patch.controls[i * columns + j];
        control.xyz() / control.w
    };
    let bend = |a: DVec3, b: DVec3, c: DVec3| (a - 2.0 * b + c).length();
    let along_u =
        (0..=q).flat_map(|j| (1..p).map(move |i| bend(point(i - 1, j), point(i, j), point(i + 1, j))));
    let along_v =
        (0..=p).flat_map(|i| (1..q).map(move |j| bend(point(i, j - 1), point(i, j), point(i, j + 1))));
    // The second derivative of a curve of degree p is at most p (p - 1) bends, and its distance from a chord of n parts
    // an eighth of it over n².
    let count = |degree: usize, bend: f64| {
        let second = (degree * degree.saturating_sub(1)) as f64 * bend;
        ((second / (8.0 * tolerance)).sqrt().ceil() as usize).clamp(1, MAX_PARTS)
    };
    [count(p, along_u.fold(0.0, upper_max)), count(q, along_v.fold(0.0, upper_max))]
}
