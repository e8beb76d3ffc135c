//! B-splines of curves and surfaces.

use super::{Scale, point};
use crate::nurbs::{Basis, SplineCurve, SplineSurface};
use crate::report::FaceFault;
use crate::step::exchange::{Entity, Exchange, Value, count, number, reference};
use glam::{DVec3, DVec4};
use nurbs_hausdorff::workspace::MAX_FILE_DEGREE;

/// The knots of an entity that states none.
enum DefaultKnots {
    /// The ends as often as the degree and one more, knots inside as often as the degree.
    Bezier,
    /// The ends as often as the degree and one more.
    QuasiUniform,
    /// Every knot once.
    Uniform,
}

/// Returns the knots that follow from an entity's kind; `None` for one that states them.
fn default_knots(kind: &str) -> Option<DefaultKnots> {
    match kind.split_once('_')?.0 {
        "BEZIER" => Some(DefaultKnots::Bezier),
        "QUASI" => Some(DefaultKnots::QuasiUniform),
        "UNIFORM" => Some(DefaultKnots::Uniform),
        _ => None,
    }
}

/// Reads a B-spline curve.
pub(super) fn curve(
    file: &Exchange<'_>,
    entity: &Entity<'_>,
    scale: &Scale,
) -> Result<SplineCurve, FaceFault> {
    let degree = degree(entity, 1)?;
    let weights = match &entity.weights {
        None => Vec::new(),
        Some(weights) => vec![weights.clone()],
    };
    let poles = poles(file, entity, &[entity.value(2)], &weights.iter().collect::<Vec<_>>(), scale)?;
    let basis = match default_knots(&entity.kind) {
        Some(knots) => uniform(degree, poles.len(), &knots),
        None => basis(entity, degree, poles.len(), [6, 7])?,
    };
    let basis = basis.ok_or_else(|| entity.fault(2, "control points that fit the degree and the knots"))?;
    Ok(SplineCurve::new(basis, poles))
}

/// Reads a B-spline surface.
pub(super) fn surface(
    file: &Exchange<'_>,
    entity: &Entity<'_>,
    scale: &Scale,
) -> Result<SplineSurface, FaceFault> {
    let degrees = [degree(entity, 1)?, degree(entity, 2)?];
    let rows: Vec<&Value<'_>> = entity.list(3)?.iter().collect();
    let weights: Vec<&Value<'_>> = match &entity.weights {
        None => Vec::new(),
        Some(Value::List(rows)) => rows.iter().collect(),
        Some(_) => return Err(entity.fault(3, "a net of points with a list of lists of weights")),
    };
    let poles = poles(file, entity, &rows, &weights, scale)?;
    let columns = match rows.first() {
        Some(Value::List(row)) => row.len(),
        _ => 0,
    };
    let even = rows.iter().all(|row| matches!(row, Value::List(row) if row.len() == columns));
    let counts = [rows.len(), columns];
    let bases = match default_knots(&entity.kind) {
        Some(knots) => [0, 1].map(|axis| uniform(degrees[axis], counts[axis], &knots)),
        None => {
            [basis(entity, degrees[0], counts[0], [8, 10])?, basis(entity, degrees[1], counts[1], [9, 11])?]
        }
    };
    match bases {
        [Some(u), Some(v)] if even => Ok(SplineSurface::new([u, v], poles)),
        _ => Err(entity.fault(3, "a net of control points that fits the degrees and the knots")),
    }
}

fn degree(entity: &Entity<'_>, attribute: usize) -> Result<usize, FaceFault> {
    match entity.count(attribute, MAX_FILE_DEGREE)? {
        0 => Err(entity.fault(attribute, "a degree from 1 to 25")),
        degree => Ok(degree),
    }
}

/// Reads lists of control points with lists of weights, or none, in homogeneous coordinates.
fn poles(
    file: &Exchange<'_>,
    entity: &Entity<'_>,
    rows: &[&Value<'_>],
    weights: &[&Value<'_>],
    scale: &Scale,
) -> Result<Vec<DVec4>, FaceFault> {
    let fault = || entity.fault(2, "control points with as many weights above 0");
    let flat = |rows: &[&Value<'_>]| -> Option<Vec<f64>> {
        let mut numbers = Vec::new();
        for row in rows {
            let Value::List(row) = row else { return None };
            numbers.extend(row.iter().map(number).collect::<Option<Vec<f64>>>()?);
        }
        Some(numbers)
    };
    let mut points: Vec<DVec3> = Vec::new();
    for row in rows {
        let Value::List(row) = row else { return Err(fault()) };
        for value in row {
            points.push(point(file, reference(value).ok_or_else(fault)?, scale)?);
        }
    }
    if weights.is_empty() {
        return Ok(points.into_iter().map(|point| point.extend(1.0)).collect());
    }
    let weights = flat(weights).filter(|weights| weights.len() == points.len()).ok_or_else(fault)?;
    if !weights.iter().all(|&weight| weight > 0.0) {
        return Err(fault());
    }
    Ok(points.iter().zip(weights).map(|(&point, weight)| (weight * point).extend(weight)).collect())
}

/// Reads lists of multiplicities and knots. Equal knots count as one.
fn basis(
    entity: &Entity<'_>,
    degree: usize,
    poles: usize,
    [multiplicities, knots]: [usize; 2],
) -> Result<Option<Basis>, FaceFault> {
    const EXPECTED: &str = "increasing knots with multiplicities of 1 to the degree + 1";
    let values = entity.numbers(knots)?;
    let times = entity.list(multiplicities)?.iter().map(|value| count(value, degree + 1));
    let times = times.collect::<Option<Vec<usize>>>().filter(|times| times.len() == values.len());
    let times = times.ok_or_else(|| entity.fault(multiplicities, EXPECTED))?;
    let mut pairs: Vec<(f64, usize)> = Vec::with_capacity(values.len());
    for (knot, times) in values.into_iter().zip(times) {
        match pairs.last_mut() {
            Some((last, _)) if knot < *last => return Err(entity.fault(knots, EXPECTED)),
            Some((last, before)) if knot == *last => *before += times,
            _ => pairs.push((knot, times)),
        }
    }
    if pairs.iter().any(|&(_, times)| !(1..=degree + 1).contains(&times)) {
        return Err(entity.fault(multiplicities, EXPECTED));
    }
    Ok(Basis::new(degree, poles, &pairs, false))
}

/// Returns the basis of an entity without knots; `None` if the number of control points does
/// not fit.
fn uniform(degree: usize, poles: usize, knots: &DefaultKnots) -> Option<Basis> {
    let pairs: Vec<(f64, usize)> = match knots {
        DefaultKnots::Uniform => (0..=poles + degree).map(|knot| (knot as f64 - degree as f64, 1)).collect(),
        DefaultKnots::Bezier | DefaultKnots::QuasiUniform => {
            let inner = if matches!(knots, DefaultKnots::Bezier) { degree } else { 1 };
            let spans = poles.checked_sub(degree + 1)? / inner + 1;
            let times = |knot: usize| if knot == 0 || knot == spans { degree + 1 } else { inner };
            (0..=spans).map(|knot| (knot as f64, times(knot))).collect()
        }
    };
    Basis::new(degree, poles, &pairs, false)
}
