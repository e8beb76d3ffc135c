//! Tori.

use crate::error::Result;
use crate::model::Model;
use crate::shapes::{circle, named, positive, revolve};

/// Returns the exact torus: a circle of radius `minor`, `major` from the z axis,
/// revolved about it; rational biquadratic with outward normals.
///
/// Its points satisfy `(sqrt(x² + y²) - major)² + z² = minor²`.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless both radii are finite and above 0.
pub fn torus(major: f64, minor: f64) -> Result<Model> {
    let center = [positive("major", major)?, 0.0];
    named("torus", vec![revolve(&circle(center, positive("minor", minor)?)?)?])
}
