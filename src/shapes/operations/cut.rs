//! Cuts of surfaces along parameter lines.

use super::insert_knot;
use crate::axis::Axis;
use crate::error::{Error, Result};
use crate::model::{Model, NurbsSurface};
use crate::param_box::ParamBox;
use crate::shapes::net_surface;

/// Returns the two pieces of `surface` below and above `parameter` along `axis`,
/// with unchanged parameters.
///
/// The knot is inserted until the surface splits there (Piegl and Tiller, *The
/// NURBS Book*, section 5.3), so the pieces are the surface up to rounding.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless `parameter` lies strictly inside the domain.
pub fn cut_surface(surface: &NurbsSurface, axis: Axis, parameter: f64) -> Result<[NurbsSurface; 2]> {
    let [start, end] = surface.domain()[axis];
    if !(parameter > start && parameter < end) {
        return Err(Error::out_of_range("parameter", parameter, "a parameter inside the domain"));
    }
    let degree = surface.degree()[axis];
    let present = surface.knots(axis).iter().filter(|&&knot| knot == parameter).count();
    let refined = insert_knot(surface, axis, parameter, degree.saturating_sub(present))?;
    let knots = refined.knots(axis);
    let first = knots.partition_point(|&knot| knot < parameter);
    let after = knots.partition_point(|&knot| knot <= parameter);
    let full = vec![parameter; degree + 1];
    let count = refined.counts()[axis];
    Ok([
        piece(&refined, axis, &[&knots[..first], full.as_slice()].concat(), 0, first)?,
        piece(&refined, axis, &[full.as_slice(), &knots[after..]].concat(), after - degree - 1, count)?,
    ])
}

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
    model.require_whole()?;
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

/// Returns the surface of the control points `first..end` along `axis` with these knots.
fn piece(
    surface: &NurbsSurface,
    axis: Axis,
    knots: &[f64],
    first: usize,
    end: usize,
) -> Result<NurbsSurface> {
    let columns = surface.counts()[1];
    let mut all: [&[f64]; 2] = Axis::BOTH.map(|axis| surface.knots(axis));
    let (mut counts, mut skipped) = (surface.counts(), [0; 2]);
    (all[axis], counts[axis], skipped[axis]) = (knots, end - first, first);
    net_surface(surface.degree(), all, counts, &|i, j| {
        surface.control_points()[(skipped[0] + i) * columns + skipped[1] + j]
    })
}
