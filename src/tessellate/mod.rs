//! Triangulation of models for display; no distance is measured on it.

mod divisions;
mod triangles;
mod vertex_grid;

use crate::bezier::{BezierModel, extract};
use crate::error::{Error, Result};
use crate::model::Model;
use crate::pieces::FacePieces;
use divisions::Divisions;
use glam::DVec3;
use std::ops::Range;
use vertex_grid::VertexGrid;

/// The default tolerance relative to the model's diagonal: a fifth of a pixel for a
/// model that fills a thousand pixels.
const DEFAULT_TOLERANCE: f64 = 2e-4;

/// A triangulation with normals.
#[derive(Debug, Clone, PartialEq)]
pub struct Tessellation {
    /// The vertices relative to `origin`, x y z each.
    pub positions: Vec<f32>,
    /// The unit normals, x y z each, in the direction s × t of the surface.
    pub normals: Vec<f32>,
    /// Three vertices per triangle, anticlockwise about the normal.
    pub indices: Vec<u32>,
    /// The point that positions are relative to, the centre of the model's box.
    pub origin: DVec3,
    /// The range of `indices` of each surface.
    pub surfaces: Vec<Range<usize>>,
}

/// Returns triangles whose Hausdorff distance from the model is at most `tolerance`
/// before rounding to float32; the tolerance is in model units, by default 2e-4 of
/// the model's diagonal.
///
/// Every vertex lies on its surface. Each surface, or piece of a trimmed face, is one grid, closed except along
/// creases and where the surface itself is discontinuous; vertices there are
/// doubled, so that each side has its own normal. Where the tolerance requires more
/// than about a million triangles, it is exceeded for the whole model; each patch
/// keeps at least two triangles. O(patches p q + triangles p q).
///
/// # Errors
/// [`Error::OptionOutOfRange`] if `tolerance` is not a positive finite number;
/// [`Error::FaceNotCut`].
pub fn tessellate(model: &Model, tolerance: Option<f64>) -> Result<Tessellation> {
    let (pieces, untrimmed) = FacePieces::new(model)?;
    tessellate_patches(&extract(&untrimmed), &pieces, tolerance)
}

/// Returns the triangles as [`tessellate`] does, for patches already extracted.
pub(crate) fn tessellate_patches(
    model: &BezierModel,
    pieces: &FacePieces,
    tolerance: Option<f64>,
) -> Result<Tessellation> {
    if let Some(found) = tolerance.filter(|tolerance| !(tolerance.is_finite() && *tolerance > 0.0)) {
        return Err(Error::out_of_range("tolerance", found, "a positive finite number"));
    }
    let aabb = model.patches.bounding_box();
    let tolerance = tolerance.unwrap_or(DEFAULT_TOLERANCE * aabb.diagonal());
    let mut tessellation = Tessellation {
        positions: Vec::new(),
        normals: Vec::new(),
        indices: Vec::new(),
        origin: aabb.center(),
        surfaces: Vec::with_capacity(pieces.face_count()),
    };
    let divisions = Divisions::of_model(model, tolerance);
    for face in pieces.faces() {
        let first = tessellation.indices.len();
        for piece in face.clone() {
            let vertices = VertexGrid::new(&model.patches, &model.grids[piece], &divisions[piece], tolerance);
            tessellation.append(&vertices);
        }
        tessellation.surfaces.push(first..tessellation.indices.len());
    }
    Ok(tessellation)
}
