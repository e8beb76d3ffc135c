//! Spheres.

use crate::error::Result;
use crate::model::{Model, RigidTransform};
use crate::shapes::operations::transformed;
use crate::shapes::{half_circle, named, revolve};
use glam::DVec3;

/// Returns the exact sphere: one rational biquadratic surface, a half circle revolved
/// about the z axis (Piegl and Tiller, *The NURBS Book*, section 8.5). Normals
/// point outwards; v = 0 and v = 1 are the poles, u = 0 the seam at y = 0.
///
/// [`transformed`] with a rotation moves seam and poles of a sphere at the origin.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless `radius` is finite and above 0,
/// `TRANSFORM_NOT_RIGID` unless `center` is finite.
pub fn sphere(center: DVec3, radius: f64) -> Result<Model> {
    let model = named("sphere", vec![revolve(&half_circle(radius)?)?])?;
    transformed(&model, &RigidTransform::translation(center)?)
}
