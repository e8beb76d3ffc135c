//! Surfaces of revolution.

use super::PlaneCurve;
use super::circle::{UNIT_CIRCLE, UNIT_CIRCLE_KNOTS};
use crate::error::Result;
use crate::model::{NurbsSurface, SurfaceArrays};

/// The surface that `profile`, with x as radius and y as height, sweeps in a
/// full turn about the z axis; u goes round from the x axis, v along the profile.
///
/// Exact: the circle of every control point is rational quadratic (Piegl and
/// Tiller, *The NURBS Book*, algorithm A8.1). Normals `S_u x S_v` point to the
/// right of the profile's direction.
///
/// # Errors
/// As [`NurbsSurface::new`] if `profile` is not a valid NURBS curve.
pub fn revolve(profile: &PlaneCurve) -> Result<NurbsSurface> {
    let control_points = UNIT_CIRCLE
        .iter()
        .flat_map(|&[x, y, around]| {
            profile
                .control_points
                .iter()
                .map(move |&[radius, height, along]| [radius * x, radius * y, height, around * along])
        })
        .collect();
    NurbsSurface::new(
        0,
        SurfaceArrays {
            degree: [2, profile.degree],
            knots: [UNIT_CIRCLE_KNOTS.to_vec(), profile.knots.clone()],
            counts: [UNIT_CIRCLE.len(), profile.control_points.len()],
            control_points,
        },
    )
}
