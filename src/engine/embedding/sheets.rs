//! Triangles near the faces of a body, by which places are found where it may meet itself.

use crate::engine::PreparedModel;
use crate::facets::Facet;
use crate::tessellate::for_each_triangle;
use glam::DVec3;

/// The distance of triangles from faces, relative to the body's diagonal.
const RELATIVE_TOLERANCE: f64 = 5e-4;

/// The distance of the triangles of a mesh from it, relative to its diagonal: rounding alone.
const RELATIVE_ROUNDING: f64 = 1e-12;

/// A triangle near a surface, anticlockwise about its normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct SheetTriangle {
    pub(super) corners: [DVec3; 3],
    pub(super) surface: u32,
}

/// Returns triangles near all faces, and how far they are from these.
pub(super) fn sheets(model: &PreparedModel) -> (Vec<SheetTriangle>, f64) {
    let diagonal = model.control_box().diagonal();
    let mut triangles = Vec::new();
    if let Some(facets) = model.facets() {
        for surface in 0..facets.target.len() as u32 {
            if let Facet::Triangle(corners) = facets.target.facet(surface) {
                triangles.push(SheetTriangle { corners, surface });
            }
        }
        return (triangles, RELATIVE_ROUNDING * diagonal);
    }
    let tolerance = RELATIVE_TOLERANCE * diagonal;
    for_each_triangle(model.bezier(), tolerance, |surface, corners| {
        triangles.push(SheetTriangle { corners, surface: surface as u32 });
    });
    (triangles, tolerance)
}
