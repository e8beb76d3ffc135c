//! The torus.

use super::{circle, named, positive, revolve};
use crate::error::Result;
use crate::model::Model;

/// The exact torus: a circle of radius `minor`, `major` from the z axis,
/// revolved about it; rational biquadratic with outward normals.
///
/// Its points satisfy `(sqrt(x^2 + y^2) - major)^2 + z^2 = minor^2`.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless both radii are finite and above 0.
pub fn torus(major: f64, minor: f64) -> Result<Model> {
    let center = [positive("major", major)?, 0.0];
    named("torus", vec![revolve(&circle(center, positive("minor", minor)?)?)?])
}
