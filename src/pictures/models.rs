//! The pictures of two models, which are measured here.

use super::draw::{Drawn, draw};
use super::{KnownDeviation, PictureOptions, Pictures};
use crate::deviation::Fineness;
use crate::engine::{Engine, MapPair, PreparedModel, SignedMap};
use crate::error::{Error, Result};
use glam::DVec3;

/// Draws the models that the options show, in the same colours. `deflate` makes a zlib stream of
/// bytes, as flate2's `ZlibEncoder` does.
///
/// The vertices of each model's triangles, and at most 24,000 points between them, are measured.
/// O(points log patches) in general position.
///
/// # Errors
/// [`Error::UnitsDiffer`]; those of [`Engine::deviation_maps`] and of `deflate`.
pub fn pictures<E: From<Error>>(
    a: &PreparedModel,
    b: &PreparedModel,
    options: &PictureOptions,
    deflate: impl FnMut(&[u8]) -> std::result::Result<Vec<u8>, E>,
) -> std::result::Result<Pictures, E> {
    let pair = MapPair::new(a, b, options.transform, options.scale_units)?;
    let of_a = options.a.as_ref().map(|shown| map(&pair, true, shown)).transpose()?;
    let of_b = options.b.as_ref().map(|shown| map(&pair, false, shown)).transpose()?;
    let (maps, unit) = ([of_a.as_ref(), of_b.as_ref()], a.unit().or(b.unit()));
    draw(Drawn { maps, diagonal: pair.diagonal(), unit, allowed: options.allowed }, deflate)
}

/// Returns the map of A or of B, in the coordinates of a result; of a mesh with the normals of its triangles.
pub(super) fn map(pair: &MapPair<'_>, is_of_a: bool, shown: &KnownDeviation) -> Result<SignedMap> {
    let search = pair.search(is_of_a, shown, Fineness::PICTURE)?;
    let SignedMap { map, signs } = Engine::cpu().measured_map(search).wait()?;
    let mut map = map.placed(&pair.placing(is_of_a));
    if map.is_mesh {
        map.vertices.iter_mut().for_each(|vertex| vertex.normal = DVec3::ZERO);
    }
    Ok(SignedMap { map, signs })
}
