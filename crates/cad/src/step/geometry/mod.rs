//! Points, placements, curves and surfaces of the file.

mod curves;
mod placement;
mod splines;
mod surfaces;

pub(super) use curves::{curve, trimmed};
pub(super) use placement::{operator, placement};
pub(super) use surfaces::{circle, cylinder, line, plane_through, surface};

use super::exchange::{Exchange, number};
use super::units::Units;
use crate::nurbs::Surface;
use crate::report::FaceFault;
use glam::DVec3;

/// The deepest nesting of curves and surfaces that are made of others. Files have at most a few
/// levels; the limit keeps a damaged one from exhausting the stack.
const MAX_NESTING: usize = 32;

/// The scales of coordinates and angles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale {
    /// The factor of each coordinate: of lengths in space, of parameters in a parameter plane.
    pub(super) coordinates: DVec3,
    /// Radians per unit of angle.
    pub(super) angle: f64,
}

impl Scale {
    /// The scale of geometry in space.
    pub(super) fn of_space(units: &Units) -> Self {
        Self { coordinates: DVec3::splat(units.millimetres()), angle: units.angle }
    }

    /// The scale of geometry in the parameter plane of a surface.
    pub(super) fn of_parameters(surface: &Surface, units: &Units) -> Self {
        let in_space = Self::of_space(units);
        let [u, v] = surfaces::parameter_factors(surface, &in_space);
        Self { coordinates: DVec3::new(u, v, 1.0), ..in_space }
    }

    /// The factor of lengths in space.
    pub(super) fn length(&self) -> f64 {
        self.coordinates.x
    }
}

/// Reads a point; a third coordinate that it has not is 0.
pub(super) fn point(file: &Exchange<'_>, instance: u64, scale: &Scale) -> Result<DVec3, FaceFault> {
    let entity = file.entity(instance)?;
    if entity.kind != "CARTESIAN_POINT" {
        return Err(entity.unknown("a point"));
    }
    let found = triple(&entity.numbers(1)?).map(|point| scale.coordinates * point);
    let found = found.filter(|point| point.abs().max_element() <= LARGEST_COORDINATE);
    found.ok_or_else(|| entity.fault(1, "2 or 3 coordinates of at most 1e100"))
}

/// The largest coordinate of a point and the largest length: squares and products of a few of
/// them are finite.
const LARGEST_COORDINATE: f64 = 1e100;

/// Reads a direction as a unit vector.
fn direction(file: &Exchange<'_>, instance: u64) -> Result<DVec3, FaceFault> {
    let entity = file.entity(instance)?;
    if entity.kind != "DIRECTION" {
        return Err(entity.unknown("a direction"));
    }
    let found = triple(&entity.numbers(1)?).and_then(DVec3::try_normalize);
    found.ok_or_else(|| entity.fault(1, "2 or 3 numbers that are not all 0"))
}

/// Reads a vector, a direction times a length, in units of the file.
fn vector(file: &Exchange<'_>, instance: u64) -> Result<DVec3, FaceFault> {
    let entity = file.entity(instance)?;
    if entity.kind != "VECTOR" {
        return Err(entity.unknown("a vector"));
    }
    let magnitude = entity.number(2)?;
    if magnitude > 0.0 && magnitude <= LARGEST_COORDINATE {
        Ok(magnitude * direction(file, entity.reference(1)?)?)
    } else {
        Err(entity.fault(2, "a length above 0"))
    }
}

fn triple(numbers: &[f64]) -> Option<DVec3> {
    match *numbers {
        [x, y] => Some(DVec3::new(x, y, 0.0)),
        [x, y, z] => Some(DVec3::new(x, y, z)),
        _ => None,
    }
}

/// Reads a length above 0.
pub(super) fn length(
    entity: &super::exchange::Entity<'_>,
    attribute: usize,
    scale: &Scale,
) -> Result<f64, FaceFault> {
    let found = number(entity.value(attribute)).map(|length| length * scale.length());
    let found = found.filter(|&length| length > 0.0 && length <= LARGEST_COORDINATE);
    found.ok_or_else(|| entity.fault(attribute, "a length above 0"))
}
