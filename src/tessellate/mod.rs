//! Triangles to show a model by. Nothing is measured on them.

mod divisions;
mod triangles;
mod vertex_grid;

use crate::bezier::{BezierModel, extract};
use crate::error::{Error, Result};
use crate::model::Model;
use divisions::Divisions;
use glam::DVec3;
use std::ops::Range;
use vertex_grid::Sheet;

/// Default tolerance relative to the model's diagonal: a fifth of a pixel of
/// a model that fills a thousand pixels.
const DEFAULT_TOLERANCE: f64 = 2e-4;

/// Triangles of shape and shading for display.
#[derive(Debug, Clone, PartialEq)]
pub struct Tessellation {
    /// Vertices relative to `origin`, x y z each.
    pub positions: Vec<f32>,
    /// Unit normals, x y z each: s x t of the surface.
    pub normals: Vec<f32>,
    /// Three vertices a triangle, anticlockwise seen against the normal.
    pub indices: Vec<u32>,
    /// The point that positions are relative to: the middle of the model's box.
    pub origin: DVec3,
    /// The part of `indices` that is each surface's.
    pub surfaces: Vec<Range<usize>>,
}

/// Triangles no farther than `tolerance` (in model units; by default 2e-4 of
/// the model's diagonal) from the model, and the model from them, before
/// rounding to float32.
///
/// Every vertex lies on its surface. Each surface is one grid, closed but
/// along creases and where the surface itself is torn; vertices there are
/// doubled, for each side to have its own normal. The tolerance is given up
/// for the whole model where it takes more than about a million triangles,
/// never less than two a patch.
///
/// # Errors
/// [`Error::OptionOutOfRange`] if `tolerance` is not a positive finite number.
pub fn tessellate(model: &Model, tolerance: Option<f64>) -> Result<Tessellation> {
    tessellate_patches(&extract(model), tolerance)
}

/// As [`tessellate`], of patches that are extracted already.
pub(crate) fn tessellate_patches(model: &BezierModel, tolerance: Option<f64>) -> Result<Tessellation> {
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
        surfaces: Vec::with_capacity(model.grids.len()),
    };
    for (grid, divisions) in model.grids.iter().zip(Divisions::of_model(model, tolerance)) {
        let sheet = Sheet::new(&model.patches, grid, &divisions, tolerance);
        let first = tessellation.indices.len();
        tessellation.append(&sheet);
        tessellation.surfaces.push(first..tessellation.indices.len());
    }
    Ok(tessellation)
}
