//! Flat discs.

use crate::error::Result;
use crate::model::NurbsSurface;
use crate::shapes::{PlaneCurve, positive, revolve};

/// Returns the disc of this radius about the z axis at `height`: exact, rational,
/// of degree 2 around the axis and 1 along the radius. Its normal points along z
/// if `upward`, else against z.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless `radius` is finite and above 0.
pub fn disc(radius: f64, height: f64, upward: bool) -> Result<NurbsSurface> {
    let (center, rim) = ([0.0, height], [positive("radius", radius)?, height]);
    revolve(&if upward { PlaneCurve::line(rim, center) } else { PlaneCurve::line(center, rim) })
}
