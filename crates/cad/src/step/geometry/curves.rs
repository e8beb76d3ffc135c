//! Curves of the file, in space or in a parameter plane.

use super::{MAX_NESTING, Scale, direction, length, placement, point, splines, vector};
use crate::nurbs::{Conic, Curve, Spline, nearest_parameter};
use crate::report::FaceFault;
use crate::step::exchange::{Entity, Exchange, Value, number, reference};
use glam::DVec3;

/// Reads a curve. The curve on a surface is its curve in space.
///
/// # Errors
/// `STEP_ENTITY` for an entity that is not read, `STEP_NESTING`, and the errors of attributes
/// and references.
pub(in crate::step) fn curve(file: &Exchange<'_>, instance: u64, scale: &Scale) -> Result<Curve, FaceFault> {
    nested(file, instance, scale, 0)
}

fn nested(file: &Exchange<'_>, instance: u64, scale: &Scale, nesting: usize) -> Result<Curve, FaceFault> {
    let entity = file.entity(instance)?;
    if nesting == MAX_NESTING {
        let why = format!("#{instance}, {}, is nested more than {MAX_NESTING} times", entity.kind);
        return Err(FaceFault::new("STEP_NESTING", why));
    }
    let inner = |attribute| nested(file, entity.reference(attribute)?, scale, nesting + 1);
    match entity.kind.as_str() {
        "LINE" => Ok(Curve::Line {
            point: point(file, entity.reference(1)?, scale)?,
            direction: scale.coordinates * vector(file, entity.reference(2)?)?,
        }),
        "CIRCLE" | "ELLIPSE" | "PARABOLA" | "HYPERBOLA" => conic(file, &entity, scale),
        "B_SPLINE_CURVE_WITH_KNOTS" | "BEZIER_CURVE" | "QUASI_UNIFORM_CURVE" | "UNIFORM_CURVE" => {
            Ok(Curve::Spline(splines::curve(file, &entity, scale)?))
        }
        "POLYLINE" => polyline(file, &entity, scale),
        "TRIMMED_CURVE" => {
            let (range, basis) = trims(file, &entity, &inner(1)?, scale)?;
            Ok(Curve::Trimmed { range, basis: Box::new(basis) })
        }
        "SURFACE_CURVE" | "SEAM_CURVE" | "INTERSECTION_CURVE" | "BOUNDED_SURFACE_CURVE" => inner(1),
        // Offset along ref_direction × C', ours along C' × normal.
        "OFFSET_CURVE_3D" => Ok(Curve::Offset {
            distance: -entity.number(2)? * scale.length(),
            normal: direction(file, entity.reference(4)?)?,
            basis: Box::new(inner(1)?),
        }),
        _ => Err(entity.unknown("a curve")),
    }
}

/// Returns the basis curve of a trimmed curve.
pub(in crate::step) fn trimmed(curve: Curve) -> Curve {
    match curve {
        Curve::Trimmed { basis, .. } => trimmed(*basis),
        other => other,
    }
}

fn conic(file: &Exchange<'_>, entity: &Entity<'_>, scale: &Scale) -> Result<Curve, FaceFault> {
    // Lengths times directions are scaled as coordinates are.
    let in_file = Scale { coordinates: DVec3::ONE, angle: scale.angle };
    let frame = placement(file, entity.reference(1)?, &in_file)?;
    let first = length(entity, 2, &in_file)?;
    let second = || length(entity, 3, &in_file);
    let (conic, x, y) = match entity.kind.as_str() {
        "CIRCLE" => (Conic::Elliptic, first, first),
        "ELLIPSE" => (Conic::Elliptic, first, second()?),
        // `C + f (t² x + 2 t y)` of focal length f.
        "PARABOLA" => (Conic::Parabolic, first, 2.0 * first),
        _ => (Conic::Hyperbolic, first, second()?),
    };
    let scaled = |vector: DVec3| scale.coordinates * vector;
    Ok(Curve::Conic { conic, center: scaled(frame.origin), x: scaled(x * frame.x), y: scaled(y * frame.y) })
}

/// Reads a polyline; its parameter is the number of the point.
fn polyline(file: &Exchange<'_>, entity: &Entity<'_>, scale: &Scale) -> Result<Curve, FaceFault> {
    let points = entity.references(1)?;
    if points.len() < 2 {
        return Err(entity.fault(1, "a list of at least two points"));
    }
    let controls: Result<Vec<_>, FaceFault> =
        points.iter().map(|&instance| Ok(point(file, instance, scale)?.extend(1.0))).collect();
    let last = points.len() - 1;
    let inner = (0..=last).map(|knot| knot as f64);
    let knots = std::iter::once(0.0).chain(inner).chain([last as f64]).collect();
    Ok(Curve::Spline(Spline { degree: 1, knots, controls: controls? }.into()))
}

/// Returns the range of a trimmed curve, and the curve that increases along it.
fn trims(
    file: &Exchange<'_>,
    entity: &Entity<'_>,
    basis: &Curve,
    scale: &Scale,
) -> Result<([f64; 2], Curve), FaceFault> {
    let forward = entity.flag(4)?;
    let start = trim(file, entity, 2, basis, scale)?;
    let end = trim(file, entity, 3, basis, scale)?;
    let (basis, [start, mut end]) =
        if forward { (basis.clone(), [start, end]) } else { (basis.clone().reversed(), [-start, -end]) };
    if let Some(period) = basis.period()
        && end <= start
    {
        end += period * ((start - end) / period).floor() + period;
    }
    if start < end && end.is_finite() {
        Ok(([start, end], basis))
    } else {
        Err(entity.fault(3, "behind the first trim along the curve"))
    }
}

/// Reads the parameter of a trim, or finds that of its point.
fn trim(
    file: &Exchange<'_>,
    entity: &Entity<'_>,
    attribute: usize,
    basis: &Curve,
    scale: &Scale,
) -> Result<f64, FaceFault> {
    let values = entity.list(attribute)?;
    let parameter = values.iter().find_map(|value| match value {
        Value::Typed("PARAMETER_VALUE", _) => number(value),
        _ => None,
    });
    let at = values.iter().find_map(reference);
    let by_point = matches!(entity.value(5), Value::Enumeration("CARTESIAN"));
    match (parameter, at) {
        (Some(parameter), None) => Ok(in_radians(parameter, basis, scale)),
        (Some(parameter), Some(_)) if !by_point => Ok(in_radians(parameter, basis, scale)),
        (_, Some(at)) => {
            let at = point(file, at, scale)?;
            nearest_parameter(basis, at).ok_or_else(|| entity.fault(attribute, "a point of the curve"))
        }
        (None, None) => Err(entity.fault(attribute, "a parameter or a point")),
    }
}

/// Returns a parameter of the file as one of the curve: those of ellipses are angles.
fn in_radians(parameter: f64, basis: &Curve, scale: &Scale) -> f64 {
    match basis {
        Curve::Conic { conic: Conic::Elliptic, .. } => parameter * scale.angle,
        _ => parameter,
    }
}
