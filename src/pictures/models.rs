//! The pictures of two models, which are measured here.

use super::draw::{Drawn, draw};
use super::map::{FLOOR, Map, MapBuilder, Placing, Surface};
use super::{PictureOptions, Pictures, Shown};
use crate::engine::{ClosestPointOptions, Engine, PreparedModel, Signs};
use crate::error::{Error, Result};
use crate::facets::FacetSamples;
use crate::tessellate::{Tessellation, TessellationOptions, tessellate_patches};

/// The distance of triangles from their model, in its diagonals: half a pixel of a picture.
const FLATNESS: f64 = 1e-3;

/// The permitted excess of a distance, in diagonals: a tenth of the least deviation that has a colour.
const EXCESS: f64 = 5e-8;

/// Draws the models that the options show, in the same colours. `deflate` makes a zlib stream of
/// bytes, as flate2's `ZlibEncoder` does.
///
/// The vertices of each model's triangles, and at most 24,000 points between them, are measured.
/// O(points log patches) in general position.
///
/// # Errors
/// [`Error::UnitsDiffer`]; those of [`Engine::closest_points`] and of `deflate`.
pub fn pictures<E: From<Error>>(
    a: &PreparedModel,
    b: &PreparedModel,
    options: &PictureOptions,
    deflate: impl FnMut(&[u8]) -> std::result::Result<Vec<u8>, E>,
) -> std::result::Result<Pictures, E> {
    let scale = match (a.unit(), b.unit()) {
        (Some(of_a), Some(of_b)) if of_a != of_b && !options.scale_units => {
            return Err(Error::UnitsDiffer { a: of_a, b: of_b }.into());
        }
        (Some(of_a), Some(of_b)) => of_b / of_a,
        _ => 1.0,
    };
    let diagonal = a.bounding_box().diagonal().max(scale * b.bounding_box().diagonal());
    let placing = |is_of_a| Placing { transform: options.transform, scale, is_of_a };
    let of_a = options.a.as_ref().map(|shown| map(a, b, placing(true), diagonal, shown)).transpose()?;
    let of_b = options.b.as_ref().map(|shown| map(b, a, placing(false), diagonal, shown)).transpose()?;
    let (maps, unit) = ([of_a.as_ref(), of_b.as_ref()], a.unit().or(b.unit()));
    draw(Drawn { maps, diagonal, unit, allowed: options.allowed }, deflate)
}

/// Returns the map of a model, whose points are measured from another one.
pub(super) fn map(
    model: &PreparedModel,
    other: &PreparedModel,
    placing: Placing,
    diagonal: f64,
    shown: &Shown,
) -> Result<Map> {
    let Tessellation { positions, normals, indices, origin, faces } = triangles(model)?;
    let counts: Vec<u32> = faces.iter().map(|range| range.len() as u32).collect();
    let surface = Surface {
        positions: &positions,
        normals: &normals,
        indices: &indices,
        counts: &counts,
        origin,
        is_mesh: model.facets().is_some(),
    };
    let mut builder = MapBuilder::new(&surface, shown, placing, diagonal);
    let (engine, mut signs) = (Engine::cpu(), Signs::default());
    // Deviations without a colour need no sign.
    let unit = if placing.is_of_a { placing.scale } else { 1.0 };
    let sign_tolerance = FLOOR * diagonal / unit;
    let options = ClosestPointOptions {
        relative_tolerance: Some(EXCESS),
        sign_tolerance,
        ..ClosestPointOptions::default()
    };
    loop {
        let points = builder.pending();
        if points.is_empty() {
            return Ok(builder.finish(signs));
        }
        let found = engine.closest_points(other, &points, &options).wait()?;
        signs = found.signs;
        builder.measured(&found.signed, &found.distances);
    }
}

/// Returns the triangles of a model; those of a mesh as one face.
fn triangles(model: &PreparedModel) -> Result<Tessellation> {
    let Some(facets) = model.facets() else {
        let options = TessellationOptions { tolerance: None, relative_tolerance: Some(FLATNESS) };
        return tessellate_patches(model.bezier(), model.pieces(), &options);
    };
    let origin = model.bounding_box().center();
    let (mut positions, mut indices): (Vec<f32>, Vec<u32>) = (Vec::new(), Vec::new());
    for group in facets.targets() {
        let first = positions.len() as u32 / 3;
        // Its triangles as they are.
        let FacetSamples { points, triangles, .. } = FacetSamples::of(group, 1);
        positions.extend(points.iter().flat_map(|&point| (point - origin).as_vec3().to_array()));
        indices.extend(triangles.iter().map(|corner| first + corner));
    }
    let all = 0..indices.len();
    Ok(Tessellation { positions, normals: Vec::new(), indices, origin, faces: vec![all] })
}
