//! Removal of knots across which a surface is one polynomial up to rounding, as
//! refined copies and exact refits have them.
//!
//! Lemma (R15 of docs/rounding.md). Let the homogeneous curve (X, w) of every line of control points along
//! an axis, over each span, have Bézier controls that differ from those of
//! another polynomial (X', w') restricted to the span by at most `e` in space and
//! `f` in weight. Then the surface of the other polynomials is within
//! `(e + f r) / ω` of the surface at equal parameters, with r the largest distance of its
//! control points from the origin of X and ω > 0 the smallest weight.
//!
//! So a polynomial over several spans may come from anywhere; here it
//! interpolates the spline at the extrema of a Chebyshev polynomial, and the
//! differences are measured. The removal of knots with a measured error is that
//! of L. Piegl and W. Tiller, *The NURBS Book*, section 5.4.

mod common_polynomial;
mod net;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;

use crate::axis::Axis;
use crate::model::{Model, NurbsSurface};
use crate::rounding::{UNIT_ROUNDOFF, upper_max};
use crate::threads::parallel::map;
use net::Net;

/// The largest error of a surface with fewer knots, in units of the rounding of the model's
/// largest coordinate: four times the error of a bicubic patch's extraction, halving and evaluation.
const MAX_ERROR: f64 = 1024.0;

/// A model with fewer knots.
pub(crate) struct Reduced {
    /// Surfaces with the parameters of the model's own.
    pub(crate) model: Model,
    /// An upper bound on the distance between points of equal parameters.
    pub(crate) error: f64,
}

/// Returns `model` without its removable knots; `None` where it has none.
/// O(control points p²) for surfaces with removable knots; for most others two
/// lines of control points are examined.
pub(crate) fn without_removable_knots(model: &Model) -> Option<Reduced> {
    let surfaces = model.surfaces();
    let reduced: Vec<Option<(NurbsSurface, f64)>> =
        map(surfaces.len(), |index| reduced_surface(index, &surfaces[index]));
    if reduced.iter().all(Option::is_none) {
        return None;
    }
    let mut largest = 0.0_f64;
    let surfaces = reduced.into_iter().zip(model.surfaces()).map(|(reduced, surface)| match reduced {
        Some((reduced, error)) => {
            largest = upper_max(largest, error);
            reduced
        }
        None => surface.clone(),
    });
    let surfaces = surfaces.collect();
    Some(Reduced { model: Model::new(model.name().map(str::to_owned), surfaces).ok()?, error: largest })
}

/// Returns the surface without its removable knots, and its error.
fn reduced_surface(index: usize, surface: &NurbsSurface) -> Option<(NurbsSurface, f64)> {
    let mut net = Net::new(surface);
    let is_reduced = Axis::BOTH.map(|axis| net.reduce(axis));
    if is_reduced == [false; 2] {
        return None;
    }
    let error = net.error();
    if !(net.lightest > 0.0 && error <= MAX_ERROR * UNIT_ROUNDOFF * net.largest()) {
        return None;
    }
    Some((NurbsSurface::new(index, net.into_arrays()).ok()?, error))
}
