//! Points of surfaces of revolution by their profiles.

use crate::nurbs::{Conic, Curve};
use glam::DVec3;

/// The distance of a meridian from a point, relative to the size of the point's coordinates, within which it
/// passes the point.
const PASSING_TOLERANCE: f64 = 1e-7;

/// Returns the parameter of the profile's point nearest to a meridian's point at this radius and
/// height: that on the same side of the axis, unless the surface passes the point on the other
/// side alone, as the second half of a cone does.
pub(in crate::faces) fn on_meridian(profile: &Curve, radius: f64, height: f64) -> Option<f64> {
    let [near, far] = [radius, -radius].map(|x| {
        let point = DVec3::new(x, 0.0, height);
        on_profile(profile, point).map(|v| (v, profile.point(v).distance(point)))
    });
    let ((near, distance), (far, other)) = (near?, far?);
    let passes = PASSING_TOLERANCE * radius.hypot(height);
    Some(if distance > passes && other < OTHER_SIDE * distance { far } else { near })
}

/// The part of a distance that another one must be below to be clearly less.
const OTHER_SIDE: f64 = 0.5;

/// Returns the angle by which a point of the profile is turned to a point of the surface.
pub(in crate::faces) fn angle(local: DVec3, on_profile: DVec3) -> f64 {
    local.y.atan2(local.x) - on_profile.y.atan2(on_profile.x)
}

/// Returns the parameter of a profile's point nearest to a point of the plane y = 0, for
/// lines and circles.
fn on_profile(profile: &Curve, point: DVec3) -> Option<f64> {
    match profile {
        Curve::Line { point: origin, direction } => {
            Some((point - *origin).dot(*direction) / direction.length_squared())
        }
        Curve::Conic { conic: Conic::Elliptic, center, x, y } => {
            let from_center = point - *center;
            let [a, b] = [x, y].map(|axis| from_center.dot(*axis) / axis.length_squared());
            Some(b.atan2(a))
        }
        Curve::Trimmed { basis, range: [start, end] } => {
            let found = on_profile(basis, point)?;
            let later = basis.period().map_or(found, |period| found + period);
            // Of a periodic parameter the value in the range, or nearest to it.
            Some(if later - end < start - found { later } else { found })
        }
        _ => None,
    }
}
