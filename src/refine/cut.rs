//! Cuts of surfaces along parameter lines.

use super::control_net::net_surface;
use super::knot_insertion::insert_knot;
use crate::axis::Axis;
use crate::error::{Error, Result};
use crate::model::NurbsSurface;

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
