//! Surfaces of the file.

use super::curves::curve;
use super::{MAX_NESTING, Scale, length, number, placement, splines, vector};
use crate::nurbs::{Conic, Curve, Frame, Surface};
use crate::report::FaceFault;
use crate::step::exchange::{Entity, Exchange};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Reads a surface.
///
/// # Errors
/// `STEP_ENTITY` for an entity that is not read, `STEP_NESTING`, and the errors of attributes
/// and references.
pub(in crate::step) fn surface(
    file: &Exchange<'_>,
    instance: u64,
    scale: &Scale,
) -> Result<Surface, FaceFault> {
    nested(file, instance, scale, 0)
}

fn nested(file: &Exchange<'_>, instance: u64, scale: &Scale, nesting: usize) -> Result<Surface, FaceFault> {
    let entity = file.entity(instance)?;
    if nesting == MAX_NESTING {
        let why = format!("#{instance}, {}, is nested more than {MAX_NESTING} times", entity.kind);
        return Err(FaceFault::new("STEP_NESTING", why));
    }
    let inner = || nested(file, entity.reference(1)?, scale, nesting + 1);
    match entity.kind.as_str() {
        "PLANE" => Ok(Surface::Plane(placement(file, entity.reference(1)?, scale)?)),
        "CYLINDRICAL_SURFACE"
        | "CONICAL_SURFACE"
        | "SPHERICAL_SURFACE"
        | "TOROIDAL_SURFACE"
        | "DEGENERATE_TOROIDAL_SURFACE" => elementary(file, &entity, scale),
        "SURFACE_OF_LINEAR_EXTRUSION" => Ok(Surface::Extrusion {
            profile: curve(file, entity.reference(1)?, scale)?,
            direction: scale.coordinates * vector(file, entity.reference(2)?)?,
        }),
        "SURFACE_OF_REVOLUTION" => {
            let frame = placement(file, entity.reference(2)?, scale)?;
            let profile = curve(file, entity.reference(1)?, scale)?.in_frame(&frame);
            Ok(Surface::Revolution { frame, profile, kind: "revolution" })
        }
        "B_SPLINE_SURFACE_WITH_KNOTS" | "BEZIER_SURFACE" | "QUASI_UNIFORM_SURFACE" | "UNIFORM_SURFACE" => {
            Ok(Surface::Spline(splines::surface(file, &entity, scale)?))
        }
        "RECTANGULAR_TRIMMED_SURFACE" => rectangle(&entity, inner()?, scale),
        "OFFSET_SURFACE" => {
            let distance = entity.number(2)? * scale.length();
            if distance.is_finite() {
                Ok(inner()?.offset(distance))
            } else {
                Err(entity.fault(2, "a length"))
            }
        }
        _ => Err(entity.unknown("a surface")),
    }
}

/// Reads a cylinder, cone, sphere or torus as the revolution of a line or circle of the
/// frame's plane y = 0.
fn elementary(file: &Exchange<'_>, entity: &Entity<'_>, scale: &Scale) -> Result<Surface, FaceFault> {
    let frame = placement(file, entity.reference(1)?, scale)?;
    let (profile, kind) = match entity.kind.as_str() {
        "CYLINDRICAL_SURFACE" => return Ok(cylinder(frame, length(entity, 2, scale)?)),
        "CONICAL_SURFACE" => {
            let half_angle = entity.number(3)? * scale.angle;
            // A cone may begin at its apex, of radius 0.
            let radius = entity.number(2)? * scale.length();
            if !(half_angle.abs() < FRAC_PI_2 && half_angle != 0.0) {
                return Err(entity.fault(3, "the half angle of a cone, below a right angle"));
            }
            if !(radius >= 0.0 && radius.is_finite()) {
                return Err(entity.fault(2, "a length"));
            }
            (line(radius, half_angle.tan()), "cone")
        }
        "SPHERICAL_SURFACE" => (circle(0.0, length(entity, 2, scale)?), "sphere"),
        _ => return torus(entity, frame, scale),
    };
    Ok(Surface::Revolution { frame, profile, kind })
}

/// The cylinder about the z axis of a frame.
pub(in crate::step) fn cylinder(frame: Frame, radius: f64) -> Surface {
    Surface::Revolution { frame, profile: line(radius, 0.0), kind: "cylinder" }
}

/// A line of the plane y = 0 from a point of the x axis, which leaves the axis by `slope`.
pub(in crate::step) fn line(radius: f64, slope: f64) -> Curve {
    Curve::Line { point: radius * DVec3::X, direction: DVec3::new(slope, 0.0, 1.0) }
}

/// A circle of the plane y = 0 about a point of the x axis, which begins along x.
pub(in crate::step) fn circle(center: f64, radius: f64) -> Curve {
    let (center, x, y) = (center * DVec3::X, radius * DVec3::X, radius.abs() * DVec3::Z);
    Curve::Conic { conic: Conic::Elliptic, center, x, y }
}

/// Reads a torus. Systems state a major radius below 0, which the standard excludes.
fn torus(entity: &Entity<'_>, frame: Frame, scale: &Scale) -> Result<Surface, FaceFault> {
    let (major, minor) = (entity.number(2)? * scale.length(), length(entity, 3, scale)?);
    let ratio = major / minor;
    let whole = circle(major, minor);
    let kind = "torus";
    if entity.kind == "TOROIDAL_SURFACE" && ratio <= -1.0 && major.is_finite() {
        // The same formula with radii above 0: each meridian is the one across the axis, from its inner side.
        let frame = Frame { x: -frame.x, y: -frame.y, ..frame };
        return Ok(Surface::Revolution { frame, profile: circle(-major, -minor), kind });
    }
    let profile = match entity.kind.as_str() {
        // The inner sheet of a degenerate torus: the part on the positive side of the axis.
        "TOROIDAL_SURFACE" if -1.0 < ratio && ratio < 0.0 => sheet(whole, ratio, true),
        _ if !(major > 0.0 && major.is_finite()) => return Err(entity.fault(2, "a length above 0")),
        "DEGENERATE_TOROIDAL_SURFACE" if ratio < 1.0 => sheet(whole, ratio, entity.flag(4)?),
        _ => whole,
    };
    Ok(Surface::Revolution { frame, profile, kind })
}

/// Returns the part of a circle that passes the axis which makes the outer sheet of a degenerate
/// torus, or the inner one, between its ends on the axis. `ratio` is that of the radii.
fn sheet(circle: Curve, ratio: f64, is_outer: bool) -> Curve {
    let end = (-ratio).acos();
    let range = if is_outer { [-end, end] } else { [end, TAU - end] };
    Curve::Trimmed { range, basis: Box::new(circle) }
}

/// Reads the bounds of a trimmed surface. The parameters of one traversed backwards in u or v
/// are those of its basis.
fn rectangle(entity: &Entity<'_>, basis: Surface, scale: &Scale) -> Result<Surface, FaceFault> {
    let factors = parameter_factors(&basis, scale);
    let mut bounds = [[0.0; 2]; 2];
    for axis in [0, 1] {
        for end in [0, 1] {
            let attribute = 2 + 2 * axis + end;
            let value = number(entity.value(attribute)).map(|value| value * factors[axis]);
            bounds[axis][end] = value.ok_or_else(|| entity.fault(attribute, "a parameter"))?;
        }
        let [start, end] = &mut bounds[axis];
        match basis.periods()[axis] {
            Some(period) if !entity.flag(6 + axis)? => {
                std::mem::swap(start, end);
                *end += if end <= start { period } else { 0.0 };
            }
            Some(period) if end <= start => *end += period * ((*start - *end) / period).floor() + period,
            None if end < start => std::mem::swap(start, end),
            _ => {}
        }
        if !(start < end && end.is_finite()) {
            return Err(entity.fault(2 + 2 * axis, "a range of parameters"));
        }
    }
    Ok(Surface::Trimmed { bounds, basis: Box::new(basis) })
}

/// The unit of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Parameter {
    Angle,
    Length,
    Number,
}

/// Returns the factors of u and v from the units of the file, those of `scale` in space.
pub(super) fn parameter_factors(surface: &Surface, scale: &Scale) -> [f64; 2] {
    parameter_units(surface).map(|unit| match unit {
        Parameter::Angle => scale.angle,
        Parameter::Length => scale.length(),
        Parameter::Number => 1.0,
    })
}

/// Returns the units of u and v.
fn parameter_units(surface: &Surface) -> [Parameter; 2] {
    fn of_curve(curve: &Curve) -> Parameter {
        match curve {
            Curve::Conic { conic: Conic::Elliptic, .. } => Parameter::Angle,
            Curve::Trimmed { basis, .. } => of_curve(basis),
            _ => Parameter::Number,
        }
    }
    match surface {
        Surface::Plane(_) => [Parameter::Length; 2],
        Surface::Revolution { kind: "cylinder" | "cone", .. } => [Parameter::Angle, Parameter::Length],
        Surface::Revolution { profile, .. } => [Parameter::Angle, of_curve(profile)],
        Surface::Extrusion { profile, .. } => [of_curve(profile), Parameter::Number],
        Surface::Spline(_) => [Parameter::Number; 2],
        Surface::Trimmed { basis, .. } | Surface::Offset { basis, .. } => parameter_units(basis),
    }
}

/// The frame of a plane through a polygon, by Newell's sum of its projected areas; `None` if
/// they are all 0.
pub(in crate::step) fn plane_through(points: &[DVec3]) -> Option<Frame> {
    let origin = *points.first()?;
    let next = points.iter().cycle().skip(1);
    let area: DVec3 = points.iter().zip(next).map(|(&a, &b)| (a - origin).cross(b - origin)).sum();
    Frame::about(origin, area)
}
