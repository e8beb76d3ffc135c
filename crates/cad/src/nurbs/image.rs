//! Curves in space that are exact images of curves in the parameters of a surface.

use super::conic::Conic;
use super::curve::Curve;
use super::frame::Frame;
use super::surface::Surface;
use glam::DVec3;
use nurbs_hausdorff::Axis;

/// The part of a line's direction along one parameter below which it is along the other one: files state
/// directions to 15 digits.
const ALONG_AXIS: f64 = 1e-12;

impl Surface {
    /// Returns the curve in space that a curve in the parameters is, in its direction: of any curve of a plane,
    /// and of parameter lines of surfaces of revolution and extrusion. `None` for others, whose images are no
    /// curves of these kinds.
    pub(crate) fn image(&self, curve: &Curve) -> Option<Curve> {
        match self.elementary() {
            Self::Plane(frame) => Some(curve.clone().in_frame(&frame.inverse())),
            Self::Revolution { frame, profile, .. } => {
                let (axis, start, forward) = parameter_line(curve)?;
                Some(match axis {
                    Axis::U => circle(frame, profile.point(start.y), forward),
                    Axis::V => {
                        let meridian = profile.clone().in_frame(&frame.turned_by(start.x).inverse());
                        if forward { meridian } else { meridian.reversed() }
                    }
                })
            }
            Self::Extrusion { direction, profile } => {
                let (axis, start, forward) = parameter_line(curve)?;
                let along = if forward { *direction } else { -*direction };
                Some(match axis {
                    Axis::U => {
                        let origin = -start.y * *direction;
                        let moved = Frame { origin, x: DVec3::X, y: DVec3::Y, z: DVec3::Z };
                        let moved = profile.clone().in_frame(&moved);
                        if forward { moved } else { moved.reversed() }
                    }
                    Axis::V => Curve::Line { point: profile.point(start.x), direction: along },
                })
            }
            Self::Spline(_) | Self::Trimmed { .. } | Self::Offset { .. } => None,
        }
    }
}

/// Returns the parameter along which a line runs, a point of it, and whether that parameter grows.
fn parameter_line(curve: &Curve) -> Option<(Axis, DVec3, bool)> {
    let (point, direction) = match curve {
        Curve::Line { point, direction } => (*point, *direction),
        Curve::Trimmed { basis, .. } => return parameter_line(basis),
        _ => return None,
    };
    let [u, v] = [direction.x.abs(), direction.y.abs()];
    if v <= ALONG_AXIS * u {
        Some((Axis::U, point, direction.x > 0.0))
    } else if u <= ALONG_AXIS * v {
        Some((Axis::V, point, direction.y > 0.0))
    } else {
        None
    }
}

/// Returns the circle on which a point of a frame's coordinates turns about its z axis, from angle 0.
fn circle(frame: &Frame, local: DVec3, forward: bool) -> Curve {
    let x = frame.vector(DVec3::new(local.x, local.y, 0.0));
    let y = frame.vector(DVec3::new(-local.y, local.x, 0.0));
    let center = frame.point(DVec3::new(0.0, 0.0, local.z));
    Curve::Conic { conic: Conic::Elliptic, center, x, y: if forward { y } else { -y } }
}
