//! Surfaces of revolution.

use crate::error::Result;
use crate::model::NurbsSurface;
use crate::refine::net_surface;
use crate::shapes::PlaneCurve;
use crate::shapes::curves::{UNIT_CIRCLE, UNIT_CIRCLE_KNOTS};

/// Returns the surface that `profile`, with x as radius and y as height, sweeps in
/// a full turn about the z axis; u is the angle from the x axis, v runs along the
/// profile.
///
/// It is exact: the circle of every control point is rational quadratic (Piegl and
/// Tiller, *The NURBS Book*, algorithm A8.1). Normals `S_u × S_v` point to
/// the right of the profile's direction.
///
/// # Errors
/// Those of [`NurbsSurface::new`] if `profile` is not a valid NURBS curve.
pub fn revolve(profile: &PlaneCurve) -> Result<NurbsSurface> {
    net_surface(
        [2, profile.degree],
        [&UNIT_CIRCLE_KNOTS, &profile.knots],
        [UNIT_CIRCLE.len(), profile.control_points.len()],
        &|i, j| {
            let ([x, y, around], [radius, height, along]) = (UNIT_CIRCLE[i], profile.control_points[j]);
            [radius * x, radius * y, height, around * along]
        },
    )
}
