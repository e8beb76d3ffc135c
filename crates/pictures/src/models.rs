//! The pictures of two models, which are measured here.

use super::draw::{Drawn, draw};
use super::{PictureOptions, Pictures};
use nurbs_hausdorff::workspace::MapPair;
use nurbs_hausdorff::{Error, PreparedModel};

/// Draws the models that the options show, in the same colours. `deflate` makes a zlib stream of
/// bytes, as flate2's `ZlibEncoder` does.
///
/// The vertices of each model's triangles, and at most 24,000 points between them, are measured.
/// O(points log patches) in general position.
///
/// # Errors
/// [`Error::UnitsDiffer`]; those of [`nurbs_hausdorff::Engine::deviation_maps`] and of `deflate`.
pub fn pictures<E: From<Error>>(
    a: &PreparedModel,
    b: &PreparedModel,
    options: &PictureOptions,
    deflate: impl FnMut(&[u8]) -> Result<Vec<u8>, E>,
) -> Result<Pictures, E> {
    let pair = MapPair::new(a, b, options.transform, options.scale_units)?;
    let of_a = options.a.as_ref().map(|shown| pair.drawn(true, shown)).transpose()?;
    let of_b = options.b.as_ref().map(|shown| pair.drawn(false, shown)).transpose()?;
    let (maps, unit) = ([of_a.as_ref(), of_b.as_ref()], a.unit().or(b.unit()));
    draw(Drawn { maps, diagonal: pair.diagonal(), unit, allowed: options.allowed }, deflate)
}
