//! Circular cylinders and cones.

use crate::error::Result;
use crate::model::{Model, NurbsSurface};
use crate::shapes::{PlaneCurve, disc, named, positive, revolve};

/// Returns the lateral surface of the cylinder or cone about the z axis with radius
/// `radii[0]` at height `heights[0]` and `radii[1]` at `heights[1]`: exact,
/// rational, of degree 2 around the axis and 1 along it.
///
/// # Errors
/// Those of [`NurbsSurface::new`] if a number is not finite.
pub fn lateral(radii: [f64; 2], heights: [f64; 2]) -> Result<NurbsSurface> {
    revolve(&PlaneCurve::line([radii[0], heights[0]], [radii[1], heights[1]]))
}

/// Returns the closed cylinder about the z axis between -height/2 and height/2: lateral
/// surface, bottom, top, all with outward normals.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless both sizes are finite and above 0.
pub fn cylinder(radius: f64, height: f64) -> Result<Model> {
    let half = 0.5 * positive("height", height)?;
    let bottom = disc(radius, -half, false)?;
    let top = disc(radius, half, true)?;
    named("cylinder", vec![lateral([radius, radius], [-half, half])?, bottom, top])
}

/// Returns the closed cone about the z axis with its base at -height/2 and its apex at
/// height/2: lateral surface, base, both with outward normals.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless both sizes are finite and above 0.
pub fn cone(radius: f64, height: f64) -> Result<Model> {
    let half = 0.5 * positive("height", height)?;
    let base = disc(radius, -half, false)?;
    named("cone", vec![lateral([radius, 0.0], [-half, half])?, base])
}
