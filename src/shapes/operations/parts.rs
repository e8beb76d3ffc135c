//! Parts of surfaces and models.

use crate::axis::Axis;
use crate::error::{Error, Result};
use crate::model::{Model, NurbsSurface};
use crate::param_box::ParamBox;
use crate::refine::cut_surface;

/// Returns the part of `surface` over these fractions of its domain, intervals of
/// positive length in [0, 1].
///
/// # Errors
/// Those of [`cut_surface`].
pub fn part(surface: &NurbsSurface, fractions: ParamBox) -> Result<NurbsSurface> {
    let mut part = surface.clone();
    for axis in Axis::BOTH {
        let ([start, end], [from, to]) = (surface.domain()[axis], fractions[axis]);
        let at = |fraction: f64| (1.0 - fraction) * start + fraction * end;
        if to < 1.0 {
            let [below, _] = cut_surface(&part, axis, at(to))?;
            part = below;
        }
        if from > 0.0 {
            let [_, above] = cut_surface(&part, axis, at(from))?;
            part = above;
        }
    }
    Ok(part)
}

/// Returns `model` with every surface cut at these fractions of its domain in u and
/// v, each strictly between 0 and 1, in any order.
///
/// # Errors
/// Those of [`cut_surface`]; `MODEL_TRIMMED` for a model with a trimmed face.
pub fn cut_model(model: &Model, fractions: [&[f64]; 2]) -> Result<Model> {
    require_whole(model)?;
    let mut pieces = model.surfaces().to_vec();
    for axis in Axis::BOTH {
        let mut fractions = fractions[axis].to_vec();
        fractions.sort_by(f64::total_cmp);
        let mut cut = Vec::new();
        for mut remainder in pieces {
            let [start, end] = remainder.domain()[axis];
            for &fraction in &fractions {
                let [below, above] =
                    cut_surface(&remainder, axis, (1.0 - fraction) * start + fraction * end)?;
                cut.push(below);
                remainder = above;
            }
            cut.push(remainder);
        }
        pieces = cut;
    }
    Model::new(model.name().map(str::to_owned), pieces)
}

/// # Errors
/// [`Error::ModelTrimmed`] for a model with a trimmed face, which operations on whole
/// surfaces would lose.
pub(super) fn require_whole(model: &Model) -> Result<()> {
    let trimmed = model.faces().position(|face| face.trim().is_some());
    trimmed.map_or(Ok(()), |surface| Err(Error::ModelTrimmed { surface }))
}
