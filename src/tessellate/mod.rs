//! Triangulation of models for display; no distance is measured on it.

mod divisions;
mod triangles;
mod vertex_grid;

use crate::bezier::{BezierModel, extract};
use crate::error::Result;
use crate::model::Model;
use crate::pieces::FacePieces;
use crate::tolerance::PermittedWidth;
#[cfg(all(feature = "wasm", target_arch = "wasm32"))]
use crate::untrim::Untrimmed;
use divisions::Divisions;
use glam::DVec3;
use serde::Deserialize;
use std::ops::Range;
use vertex_grid::VertexGrid;

/// The tolerance, as a fraction of the diagonal, unless the options state one: a fifth of a pixel for a
/// model that fills a thousand pixels.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 2e-4;

/// The tolerance of a draft, as a fraction of the face's diagonal: its edges look straight or round.
#[cfg(all(feature = "wasm", target_arch = "wasm32"))]
const DRAFT_TOLERANCE: f64 = 4e-3;

/// Options of [`tessellate`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct TessellationOptions {
    /// The permitted Hausdorff distance of the triangles from the model, in model units, positive.
    pub tolerance: Option<f64>,
    /// The same as a fraction of the diagonal of the model's control-net box; 2e-4 if
    /// neither is given. Both at once are an error.
    pub relative_tolerance: Option<f64>,
}

/// A triangulation with normals.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Tessellation {
    /// The vertices relative to `origin`, x y z each.
    pub positions: Vec<f32>,
    /// The unit normals, x y z each, in the direction s × t of the surface.
    pub normals: Vec<f32>,
    /// Three vertices per triangle, anticlockwise about the normal.
    pub indices: Vec<u32>,
    /// The point that positions are relative to, the centre of the model's box.
    pub origin: DVec3,
    /// The range of `indices` of each face.
    pub faces: Vec<Range<usize>>,
}

/// Returns triangles whose Hausdorff distance from the model is at most the options'
/// tolerance before rounding to float32.
///
/// Every vertex lies on its surface. Each surface, or piece of a trimmed face, is one grid, closed except along
/// creases and where the surface itself is discontinuous; vertices there are
/// doubled, so that each side has its own normal. Where the tolerance requires more
/// than about a million triangles, it is exceeded for the whole model; each patch
/// keeps at least two triangles. O(patches p q + triangles p q).
///
/// # Errors
/// [`crate::Error::OptionOutOfRange`] unless the tolerance is a positive finite number;
/// [`crate::Error::OptionInvalid`] if both tolerances are given;
/// [`crate::Error::FaceNotCut`].
pub fn tessellate(model: &Model, options: &TessellationOptions) -> Result<Tessellation> {
    let (pieces, untrimmed) = FacePieces::new(model)?;
    tessellate_patches(&extract(&untrimmed), &pieces, options)
}

/// Returns triangles of one face that was cut, to be drawn until the whole model is tessellated.
///
/// # Errors
/// Those of [`tessellate`], which a face that was cut does not cause.
#[cfg(all(feature = "wasm", target_arch = "wasm32"))]
pub(crate) fn draft(face: &Untrimmed) -> Result<Tessellation> {
    let surfaces = face.pieces.iter().map(|piece| piece.surface.clone()).collect();
    let relative_tolerance = Some(DRAFT_TOLERANCE);
    tessellate(&Model::new(None, surfaces)?, &TessellationOptions { tolerance: None, relative_tolerance })
}

/// Calls a function with the corners of each triangle of each surface of a model, by the index of the surface, in
/// float64; they are within the tolerance of it, as those of [`tessellate`].
pub(crate) fn for_each_triangle(
    model: &BezierModel,
    tolerance: f64,
    mut each: impl FnMut(usize, [DVec3; 3]),
) {
    let divisions = Divisions::of_model(model, tolerance);
    for (surface, (grid, divisions)) in model.grids.iter().zip(&divisions).enumerate() {
        let vertices = VertexGrid::new(&model.patches, grid, divisions, tolerance);
        for triangle in vertices.triangles() {
            each(surface, triangle.map(|vertex| vertices.vertices[vertex].point));
        }
    }
}

/// Returns the triangles as [`tessellate`] does, for patches already extracted.
pub(crate) fn tessellate_patches(
    model: &BezierModel,
    pieces: &FacePieces,
    options: &TessellationOptions,
) -> Result<Tessellation> {
    let TessellationOptions { tolerance, relative_tolerance } = *options;
    let permitted = PermittedWidth { tolerance, relative_tolerance };
    permitted.validate()?;
    let aabb = model.patches.bounding_box();
    let tolerance = permitted.in_units(aabb.diagonal(), DEFAULT_RELATIVE_TOLERANCE);
    let mut tessellation = Tessellation {
        positions: Vec::new(),
        normals: Vec::new(),
        indices: Vec::new(),
        origin: aabb.center(),
        faces: Vec::with_capacity(pieces.face_count()),
    };
    let divisions = Divisions::of_model(model, tolerance);
    for face in pieces.faces() {
        let first = tessellation.indices.len();
        for piece in face.clone() {
            let vertices = VertexGrid::new(&model.patches, &model.grids[piece], &divisions[piece], tolerance);
            tessellation.append(&vertices);
        }
        tessellation.faces.push(first..tessellation.indices.len());
    }
    Ok(tessellation)
}
