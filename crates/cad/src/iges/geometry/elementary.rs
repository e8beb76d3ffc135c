//! Planes, cylinders, cones, spheres and tori, types 108 and 190 to 198.

use super::Scale;
use super::placement::{direction, point};
use crate::iges::file::{Entity, File, Found};
use crate::nurbs::{Conic, Curve, Frame, Surface};
use glam::{DAffine2, DVec2, DVec3};
use std::f64::consts::PI;

/// Radians per degree, in which these surfaces have their angles.
const DEGREE: f64 = PI / 180.0;

/// Reads a surface, and the map from the file's parameters of it to ours, if it has any.
pub(super) fn surface(file: &File<'_>, entity: &Entity, scale: Scale) -> Found<(Surface, Option<DAffine2>)> {
    let of_scales = |u: f64, v: f64| (entity.entry.form == 1).then(|| DAffine2::from_scale(DVec2::new(u, v)));
    // The indices of location, axis and reference direction.
    let frame = |indices: [usize; 3]| frame(file, entity, indices, scale);
    let found = match entity.entry.kind {
        108 => (Surface::Plane(plane(entity, scale)?), None),
        190 => (Surface::Plane(frame([1, 2, 3])?), of_scales(scale.0, scale.0)),
        192 => {
            let profile = line(length(entity, 3, scale)?, 0.0);
            (
                Surface::Revolution { frame: frame([1, 2, 4])?, profile, kind: "cylinder" },
                of_scales(DEGREE, scale.0),
            )
        }
        194 => {
            let (radius, angle) = (scale.0 * entity.real(3)?, entity.real(4)?);
            if !(angle > 0.0 && angle < 90.0 && radius >= 0.0) {
                return Err(entity.fault(4, "the half angle of a cone, below 90 degrees"));
            }
            let profile = line(radius, (angle * DEGREE).tan());
            (
                Surface::Revolution { frame: frame([1, 2, 5])?, profile, kind: "cone" },
                of_scales(DEGREE, scale.0),
            )
        }
        196 => {
            let profile = circle(0.0, length(entity, 2, scale)?);
            (
                Surface::Revolution { frame: frame([1, 3, 4])?, profile, kind: "sphere" },
                of_scales(DEGREE, DEGREE),
            )
        }
        198 => {
            let profile = circle(length(entity, 3, scale)?, length(entity, 4, scale)?);
            // Writers differ in the parameters of a torus.
            (Surface::Revolution { frame: frame([1, 2, 5])?, profile, kind: "torus" }, None)
        }
        _ => return Err(entity.unknown("a surface")),
    };
    Ok(found)
}

fn line(radius: f64, slope: f64) -> Curve {
    Curve::Line { point: radius * DVec3::X, direction: DVec3::new(slope, 0.0, 1.0) }
}

fn circle(center: f64, radius: f64) -> Curve {
    let center = center * DVec3::X;
    Curve::Conic { conic: Conic::Elliptic, center, x: radius * DVec3::X, y: radius * DVec3::Z }
}

/// Reads a length above 0.
fn length(entity: &Entity, index: usize, scale: Scale) -> Found<f64> {
    let length = scale.0 * entity.real(index)?;
    if length > 0.0 { Ok(length) } else { Err(entity.fault(index, "a length above 0")) }
}

/// Reads a frame by its origin, axis and reference direction. Form 0 has no reference direction, and
/// of a sphere no axis.
fn frame(file: &File<'_>, entity: &Entity, indices: [usize; 3], scale: Scale) -> Found<Frame> {
    let origin = point(file, entity.reference(indices[0])?, scale)?;
    let given = |index: usize| -> Found<Option<DVec3>> {
        let is_stated = entity.entry.form == 1 || index == 2;
        match if is_stated { entity.optional(index)? } else { 0 } {
            0 => Ok(None),
            number => direction(file, number).map(Some),
        }
    };
    let z = given(indices[1])?.unwrap_or(DVec3::Z);
    let fault = || entity.fault(indices[2], "a direction that is not parallel to the axis");
    let Some(towards) = given(indices[2])? else {
        return Frame::about(origin, z).ok_or_else(fault);
    };
    let across = towards - towards.dot(z) * z;
    let x = across.try_normalize().filter(|_| across.length() > PARALLEL).ok_or_else(fault)?;
    Ok(Frame { origin, x, y: z.cross(x), z })
}

/// The sine of the angle between directions below which they are parallel.
const PARALLEL: f64 = 1e-9;

/// Reads the plane `A x + B y + C z = D`.
fn plane(entity: &Entity, scale: Scale) -> Found<Frame> {
    let normal = entity.point(1)?;
    let origin = entity.real(4)? / normal.length_squared() * normal;
    let frame = Frame::about(scale.0 * origin, normal).filter(|frame| frame.origin.is_finite());
    frame.ok_or_else(|| entity.fault(1, "the equation of a plane"))
}
