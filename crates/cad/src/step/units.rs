//! Units and accuracies that the contexts of representations state.

use super::exchange::{Exchange, Record, Value, number, reference};
use crate::digits::three_digits;
use crate::report::{FaceFault, Remark};
use glam::DVec3;
use std::f64::consts::PI;

/// Metres per unit of the model, whatever the units of the file: a millimetre. An assembly may
/// have parts in several units.
pub(super) const METRES: f64 = 1e-3;

/// The units of a representation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Units {
    /// Millimetres per unit of length; `None` if the context states none.
    pub(super) length: Option<f64>,
    /// Radians per unit of angle.
    pub(super) angle: f64,
    /// The stated uncertainty of distances in millimetres, or 0.
    pub(super) uncertainty: f64,
}

/// The deepest chain of units that are defined by others.
const MAX_NESTING: usize = 8;

/// The deviation from a degree, relative to it, below which a unit of angle is one: files state
/// it to 8 digits or more.
const DEGREE_DIGITS: f64 = 1e-7;

/// The largest uncertainty that is believed, relative to the diagonal of the file's points: vertices of that distance
/// from each other would be one, and so would be most of the part.
const LARGEST_UNCERTAINTY: f64 = 1e-2;

impl Units {
    pub(super) const NONE: Self = Self { length: None, angle: 1.0, uncertainty: 0.0 };

    /// Reads the units of a context; those that it does not state are `None`, radians and 0.
    ///
    /// # Errors
    /// `STEP_UNIT` for a unit of length or angle that is not known, and the errors of references.
    pub(super) fn of_context(file: &Exchange<'_>, context: u64) -> Result<Self, FaceFault> {
        let record = file.record(context)?;
        let mut units = Self::NONE;
        for unit in references(record.part("GLOBAL_UNIT_ASSIGNED_CONTEXT")) {
            let unit = file.record(unit)?;
            if unit.has("LENGTH_UNIT") {
                units.length = Some(factor(file, &unit, 0)?);
            } else if unit.has("PLANE_ANGLE_UNIT") {
                let angle = factor(file, &unit, 0)?;
                let degree = PI / 180.0;
                let is_degree = (angle - degree).abs() <= DEGREE_DIGITS * degree;
                units.angle = if is_degree { degree } else { angle };
            }
        }
        for uncertainty in references(record.part("GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT")) {
            let record = file.record(uncertainty)?;
            let Some((value, unit)) = measure(&record) else { continue };
            let unit = file.record(unit)?;
            if unit.has("LENGTH_UNIT") && value > 0.0 {
                units.uncertainty = units.uncertainty.max(value * factor(file, &unit, 0)?);
            }
        }
        Ok(units)
    }

    /// Returns the units on which all contexts of a file agree, for what stands in none; else none.
    pub(super) fn of_file(file: &Exchange<'_>) -> Self {
        let is_context = |number: &&u64| file.keyword(**number).ends_with("_CONTEXT");
        let contexts = file.numbers.iter().filter(is_context);
        let mut found = contexts.filter_map(|&context| Self::of_context(file, context).ok());
        let mut stated = found.by_ref().filter(|units| units.length.is_some());
        let Some(first) = stated.next() else { return Self::NONE };
        if stated.all(|units| units == first) { first } else { Self::NONE }
    }

    /// Returns what a context lists among its units and is none.
    pub(super) fn non_units(file: &Exchange<'_>, context: u64) -> Vec<Remark> {
        let Ok(record) = file.record(context) else { return Vec::new() };
        let listed = references(record.part("GLOBAL_UNIT_ASSIGNED_CONTEXT"));
        let is_unit = |instance: u64| {
            let kind = file.record(instance).map(|unit| unit.kind());
            // One that cannot be read is a fault of the context's representations.
            kind.is_ok_and(|kind| !kind.split(' ').any(|part| part.ends_with("_UNIT")))
        };
        let others = listed.into_iter().filter(|&instance| is_unit(instance));
        let remark = |instance: u64| {
            let kind = file.keyword(instance);
            let why = format!("#{instance}, {kind}, is listed among the units of #{context}, and is no unit");
            Remark::new("STEP_UNIT", why)
        };
        others.map(remark).collect()
    }

    /// Returns the units with an uncertainty that may be that of the file's points, and what is remarked of one
    /// that may not: then the file counts as stating none. O(points) for such a file, else most often O(1).
    pub(super) fn with_believable_uncertainty(
        self,
        file: &Exchange<'_>,
        context: u64,
    ) -> (Self, Option<Remark>) {
        let least = self.uncertainty / LARGEST_UNCERTAINTY;
        let diagonal = self.millimetres() * diagonal(file, least / self.millimetres());
        // Primitives and triangles have no vertices whose tolerance it is, and few points that span them.
        let has_vertices = || {
            file.numbers.iter().any(|&number| matches!(file.keyword(number), "VERTEX_POINT" | "POLY_LOOP"))
        };
        if !(diagonal < least && has_vertices()) {
            return (self, None);
        }
        let [stated, diagonal] = [self.uncertainty, diagonal].map(three_digits);
        let why = format!(
            "the uncertainty that #{context} states, {stated} mm, is more than {LARGEST_UNCERTAINTY} of the diagonal \
             of the file's points, {diagonal} mm, and counts as not stated"
        );
        (Self { uncertainty: 0.0, ..self }, Some(Remark::new("STEP_UNCERTAINTY", why)))
    }

    /// Millimetres per unit of length.
    pub(super) fn millimetres(&self) -> f64 {
        self.length.unwrap_or(1.0)
    }
}

/// Returns the references in the list that is an entity's first attribute.
fn references(attributes: Option<&[Value<'_>]>) -> Vec<u64> {
    match attributes {
        Some([Value::List(values), ..]) => values.iter().filter_map(reference).collect(),
        _ => Vec::new(),
    }
}

/// Returns the value and the unit of a measure.
fn measure(record: &Record<'_>) -> Option<(f64, u64)> {
    const KINDS: [&str; 4] = [
        "MEASURE_WITH_UNIT",
        "LENGTH_MEASURE_WITH_UNIT",
        "PLANE_ANGLE_MEASURE_WITH_UNIT",
        "UNCERTAINTY_MEASURE_WITH_UNIT",
    ];
    KINDS.iter().filter_map(|kind| record.part(kind)).find_map(|attributes| match attributes {
        [value, unit, ..] => Some((number(value)?, reference(unit)?)),
        _ => None,
    })
}

/// Returns a unit in millimetres or radians.
fn factor(file: &Exchange<'_>, unit: &Record<'_>, nesting: usize) -> Result<f64, FaceFault> {
    let unknown = || {
        let why = format!("#{}, {}, is not a known unit", unit.number, unit.kind());
        FaceFault::new("STEP_UNIT", why)
    };
    if nesting == MAX_NESTING {
        return Err(unknown());
    }
    if let Some([prefix, Value::Enumeration(name)]) = unit.part("SI_UNIT") {
        let power = match prefix {
            Value::Enumeration(prefix) => power(prefix).ok_or_else(unknown)?,
            _ => 0,
        };
        return match *name {
            // Powers of ten that float64 holds are exact.
            "METRE" => Ok(power_of_ten(power + 3)),
            "RADIAN" => Ok(power_of_ten(power)),
            _ => Err(unknown()),
        };
    }
    let Some([_, Value::Reference(definition)]) = unit.part("CONVERSION_BASED_UNIT") else {
        return Err(unknown());
    };
    let (value, base) = measure(&file.record(*definition)?).ok_or_else(unknown)?;
    let factor = value * factor(file, &file.record(base)?, nesting + 1)?;
    if factor > 0.0 && factor.is_finite() { Ok(factor) } else { Err(unknown()) }
}

/// Returns the diagonal of the box of the file's points in space, or of as many as have one of at least `enough`.
fn diagonal(file: &Exchange<'_>, enough: f64) -> f64 {
    let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let mut diagonal = 0.0;
    for &number in file.numbers.iter().filter(|&&number| file.keyword(number) == "CARTESIAN_POINT") {
        let coordinates = file.entity(number).and_then(|point| point.numbers(1)).unwrap_or_default();
        let &[x, y, z] = coordinates.as_slice() else { continue };
        let point = DVec3::new(x, y, z);
        bounds = [bounds[0].min(point), bounds[1].max(point)];
        diagonal = (bounds[1] - bounds[0]).length();
        if diagonal >= enough {
            break;
        }
    }
    diagonal
}

fn power_of_ten(power: i32) -> f64 {
    if power < 0 { 1.0 / 10.0_f64.powi(-power) } else { 10.0_f64.powi(power) }
}

/// Returns the power of ten of a prefix.
fn power(prefix: &str) -> Option<i32> {
    Some(match prefix {
        "EXA" => 18,
        "PETA" => 15,
        "TERA" => 12,
        "GIGA" => 9,
        "MEGA" => 6,
        "KILO" => 3,
        "HECTO" => 2,
        "DECA" => 1,
        "DECI" => -1,
        "CENTI" => -2,
        "MILLI" => -3,
        "MICRO" => -6,
        "NANO" => -9,
        "PICO" => -12,
        "FEMTO" => -15,
        "ATTO" => -18,
        _ => return None,
    })
}
