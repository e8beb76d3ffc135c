//! The cuts of the library's faces as plain numbers, for the proof.

use crate::proof::Surface;
use crate::proof::cut::{Cut, Map, Piece, Ruled};
use nurbs_hausdorff::internals::model::Face;
use nurbs_hausdorff::internals::untrim::{ParameterMap, untrim};
use nurbs_hausdorff::{Axis, NurbsSurface};

/// Cuts face `index`, or returns why it is not cut; `None` for a face that is not trimmed.
pub(crate) fn cut(index: usize, face: &Face<'_>, max_deviation: f64) -> Option<Result<Cut, String>> {
    let trim = face.trim()?;
    let untrimmed = match untrim(index, face.surface(), trim, max_deviation) {
        Ok(untrimmed) => untrimmed,
        Err(error) => return Some(Err(error.to_string())),
    };
    let loops = trim.loops().iter().map(|pieces| {
        pieces.iter().map(|piece| piece.controls.iter().map(glam::DVec3::to_array).collect()).collect()
    });
    let pieces = untrimmed.pieces.iter().map(|piece| {
        let map = match &piece.map {
            ParameterMap::Identity => Map::Identity { domain: piece.surface.domain().intervals() },
            ParameterMap::Ruled(ruled) => Map::Ruled(Ruled::new(
                ruled.sides().map(|side| side.iter().map(glam::DVec3::to_array).collect()),
                face.surface().domain().intervals(),
                ruled.is_transposed(),
            )),
        };
        Piece { surface: surface(&piece.surface), map }
    });
    Some(Ok(Cut {
        surface: surface(face.surface()),
        loops: loops.collect(),
        pieces: pieces.collect(),
        deviation: untrimmed.deviation + trim.rounding(),
    }))
}

fn surface(surface: &NurbsSurface) -> Surface {
    let columns = surface.counts()[1];
    Surface {
        degree: surface.degree(),
        knots_u: surface.knots(Axis::U).to_vec(),
        knots_v: surface.knots(Axis::V).to_vec(),
        ctrl: surface.control_points().chunks_exact(columns).map(<[_]>::to_vec).collect(),
        trim: None,
    }
}
