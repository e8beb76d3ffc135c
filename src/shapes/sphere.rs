//! The sphere.

use super::operations::transformed;
use super::{half_circle, named, revolve};
use crate::error::Result;
use crate::model::{Model, RigidTransform};
use glam::DVec3;

/// The exact sphere: one rational biquadratic surface, a half circle revolved
/// about the z axis (Piegl and Tiller, *The NURBS Book*, section 8.5). Normals
/// point outwards; v = 0 and v = 1 are the poles, u = 0 the seam at y = 0.
///
/// For another seam and other poles make it at the origin and use
/// [`transformed`] with a rotation.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless `radius` is finite and above 0,
/// `TRANSFORM_NOT_RIGID` unless `center` is finite.
pub fn sphere(center: DVec3, radius: f64) -> Result<Model> {
    let model = named("sphere", vec![revolve(&half_circle(radius)?)?])?;
    transformed(&model, &RigidTransform::translation(center)?)
}
