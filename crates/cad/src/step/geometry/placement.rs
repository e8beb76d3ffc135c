//! Placements in space and in a plane (ISO 10303-42, 4.4).

use super::{Scale, direction, number, point};
use crate::nurbs::Frame;
use crate::report::FaceFault;
use crate::step::exchange::{Entity, Exchange, reference};
use glam::{DAffine3, DMat3, DVec3};

/// The sine of the angle between directions below which they are parallel.
const PARALLEL: f64 = 1e-9;

/// Reads a placement as a right-handed frame; one of a plane has the z axis (0, 0, 1).
pub(in crate::step) fn placement(
    file: &Exchange<'_>,
    instance: u64,
    scale: &Scale,
) -> Result<Frame, FaceFault> {
    let entity = file.entity(instance)?;
    let origin = point(file, entity.reference(1)?, scale)?;
    let (z, x) = match entity.kind.as_str() {
        "AXIS2_PLACEMENT_3D" => (optional(file, &entity, 2)?, optional(file, &entity, 3)?),
        "AXIS2_PLACEMENT_2D" => (None, optional(file, &entity, 2)?),
        "AXIS1_PLACEMENT" => (optional(file, &entity, 2)?, None),
        _ => return Err(entity.unknown("a placement")),
    };
    let z = z.unwrap_or(DVec3::Z);
    let x = across(z, x).ok_or_else(|| entity.fault(3, "a direction that is not parallel to the axis"))?;
    Ok(Frame { origin, x, y: z.cross(x), z })
}

/// Returns the part of a direction across an axis; without a direction, of (1, 0, 0), or of
/// (0, 1, 0) for an axis along that.
fn across(axis: DVec3, towards: Option<DVec3>) -> Option<DVec3> {
    let part = |direction: DVec3| direction - direction.dot(axis) * axis;
    let unit = |direction: DVec3| {
        let found = part(direction);
        // The second step removes the first one's rounding.
        (found.length() > PARALLEL).then(|| part(found.normalize_or_zero()).normalize_or_zero())
    };
    match towards {
        Some(direction) => unit(direction),
        None => unit(DVec3::X).or_else(|| unit(DVec3::Y)),
    }
}

/// Reads a direction that may be left out.
fn optional(file: &Exchange<'_>, entity: &Entity<'_>, attribute: usize) -> Result<Option<DVec3>, FaceFault> {
    reference(entity.value(attribute)).map(|instance| direction(file, instance)).transpose()
}

/// Reads a map of space: a placement as the map that takes the axes of space to it, or a
/// transformation with a scale, which may be a reflection.
pub(in crate::step) fn operator(
    file: &Exchange<'_>,
    instance: u64,
    scale: &Scale,
) -> Result<DAffine3, FaceFault> {
    let entity = file.entity(instance)?;
    if entity.kind != "CARTESIAN_TRANSFORMATION_OPERATOR_3D" {
        let Frame { origin, x, y, z } = placement(file, instance, scale)?;
        return Ok(DAffine3 { matrix3: DMat3::from_cols(x, y, z), translation: origin });
    }
    let factor = number(entity.value(6)).unwrap_or(1.0);
    if !(factor > 0.0 && factor.is_finite()) {
        return Err(entity.fault(6, "a factor above 0"));
    }
    let z = optional(file, &entity, 7)?.unwrap_or(DVec3::Z);
    let x = across(z, optional(file, &entity, 3)?);
    let x = x.ok_or_else(|| entity.fault(3, "a direction that is not parallel to the third axis"))?;
    let y = z.cross(x);
    let second = optional(file, &entity, 4)?;
    if second.is_none() && y.y < 0.0 {
        // `second_proj_axis` of ISO 10303-42 projects the axis of y then; others complete a right-handed frame.
        return Err(entity.fault(4, "a second axis, as the map is a reflection or a rotation without it"));
    }
    let side = if second.is_some_and(|second| second.dot(y) < 0.0) { -1.0 } else { 1.0 };
    let translation = point(file, entity.reference(5)?, scale)?;
    Ok(DAffine3 { matrix3: factor * DMat3::from_cols(x, side * y, z), translation })
}
