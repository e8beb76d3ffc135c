//! Surfaces extended to the trimming curves that leave their domain.

use super::TrimCurveArrays;
use super::confinement::{MAX_CLAMPED, extents};
use super::curve::Place;
use crate::error::TrimFault;
use crate::model::NurbsSurface;
use crate::param_box::ParamBox;

/// The largest distance outside the domain, as a fraction of its range, to which a surface
/// is extended. Curves of real files leave it by up to 2 %.
const MAX_EXTENSION: f64 = 0.05;

/// Returns the surface extended to the curves by its polynomial continuation, which is what
/// CAD kernels evaluate there; `None` where they leave its domain by at most [`MAX_CLAMPED`].
///
/// # Errors
/// [`TrimFault::OutsideDomain`] beyond [`MAX_EXTENSION`], or where a weight of the
/// continuation is not positive; [`TrimFault::CurveInvalid`] and
/// [`TrimFault::WeightNotPositive`].
pub(in crate::model) fn extended_surface(
    surface: &NurbsSurface,
    loops: &[Vec<TrimCurveArrays>],
) -> Result<Option<NurbsSurface>, TrimFault> {
    let domain = surface.domain();
    let (mut needed, mut largest) = (domain, (0.0, Place { loop_index: 0, curve: 0 }));
    for (loop_index, curves) in loops.iter().enumerate() {
        for (curve, arrays) in curves.iter().enumerate() {
            let place = Place { loop_index, curve };
            arrays.validate(place)?;
            let extents = extents(arrays.pieces(curve as u32).iter(), &domain);
            let excess = excess(&extents, &domain);
            if excess > largest.0 {
                largest = (excess, place);
            }
            for axis in 0..2 {
                let ([low, high], [from, to]) = (extents[axis], needed[axis]);
                needed[axis] = [low.min(from), high.max(to)];
            }
        }
    }
    let (found, Place { loop_index, curve }) = largest;
    if found <= MAX_CLAMPED {
        return Ok(None);
    }
    let extended = if found <= MAX_EXTENSION { surface.extended(&needed) } else { None };
    extended.map(Some).ok_or(TrimFault::OutsideDomain { loop_index, curve, found, expected: MAX_EXTENSION })
}

/// Returns the largest distance of a box's edges outside another, as a fraction of its range.
fn excess(extents: &ParamBox, domain: &ParamBox) -> f64 {
    let along = |axis: usize| {
        let ([low, high], [start, end]) = (extents[axis], domain[axis]);
        (start - low).max(high - end) / (end - start)
    };
    along(0).max(along(1))
}
