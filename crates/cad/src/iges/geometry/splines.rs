//! Rational B-splines of curves and surfaces, types 126 and 128.

use super::Scale;
use crate::iges::file::{Entity, Found};
use crate::nurbs::{Basis, Curve, SplineCurve, SplineSurface, Surface};
use glam::{DVec3, DVec4};
use nurbs_hausdorff::workspace::MAX_FILE_DEGREE;

/// The highest upper index of control points. The parameters that follow bound it further.
const MAX_INDEX: usize = 1 << 24;

/// Part of a domain by which the range that is stated may leave it.
const SAME_RANGE: f64 = 1e-9;

/// Reads a curve and the range of it that is used.
pub(super) fn curve(entity: &Entity, scale: Scale) -> Found<(Curve, [f64; 2])> {
    let (count, degree) = (entity.count(1, MAX_INDEX)? + 1, degree(entity, 2)?);
    let knots = entity.reals(7, count + degree + 1)?;
    let weights = 7 + knots.len();
    let basis = basis(entity, 7, degree, count, &knots)?;
    let points = weights + count;
    let poles = poles(entity, [weights, points], count, scale, |index| index)?;
    let range = range(entity, points + 3 * count, basis.domain())?;
    Ok((Curve::Spline(SplineCurve::new(basis, poles)), range))
}

/// Reads a surface within the bounds that are used.
pub(super) fn surface(entity: &Entity, scale: Scale) -> Found<Surface> {
    let counts = [entity.count(1, MAX_INDEX)? + 1, entity.count(2, MAX_INDEX)? + 1];
    let degrees = [degree(entity, 3)?, degree(entity, 4)?];
    let first = 10;
    let second = first + counts[0] + degrees[0] + 1;
    let weights = second + counts[1] + degrees[1] + 1;
    let knots_u = entity.reals(first, second - first)?;
    let knots_v = entity.reals(second, weights - second)?;
    let count = counts[0] * counts[1];
    let points = weights + count;
    // In the file u runs fastest, in ours v.
    let in_file = |index: usize| (index % counts[1]) * counts[0] + index / counts[1];
    let poles = poles(entity, [weights, points], count, scale, in_file)?;
    let bases = [
        basis(entity, first, degrees[0], counts[0], &knots_u)?,
        basis(entity, second, degrees[1], counts[1], &knots_v)?,
    ];
    let domains = bases.each_ref().map(Basis::domain);
    let ends = points + 3 * count;
    let bounds = [range(entity, ends, domains[0])?, range(entity, ends + 2, domains[1])?];
    let surface = Surface::Spline(SplineSurface::new(bases, poles));
    if bounds == domains { Ok(surface) } else { Ok(Surface::Trimmed { bounds, basis: Box::new(surface) }) }
}

fn degree(entity: &Entity, index: usize) -> Found<usize> {
    match entity.count(index, MAX_FILE_DEGREE)? {
        0 => Err(entity.fault(index, "a degree from 1 to 25")),
        degree => Ok(degree),
    }
}

/// Returns the basis of knots that begin at an index.
fn basis(entity: &Entity, index: usize, degree: usize, count: usize, knots: &[f64]) -> Found<Basis> {
    let fault = || entity.fault(index, "the first of increasing knots that fit the control points");
    if !knots.is_sorted() {
        return Err(fault());
    }
    let pairs: Vec<(f64, usize)> =
        knots.chunk_by(|a, b| a == b).map(|equal| (equal[0], equal.len())).collect();
    let fits = pairs.iter().all(|&(_, times)| times <= degree + 1);
    fits.then(|| Basis::new(degree, count, &pairs, false)).flatten().ok_or_else(fault)
}

/// Reads control points in homogeneous coordinates, in the order in which `in_file` gives their
/// places in the file's.
fn poles(
    entity: &Entity,
    [weights, points]: [usize; 2],
    count: usize,
    scale: Scale,
    in_file: impl Fn(usize) -> usize,
) -> Found<Vec<DVec4>> {
    let first = weights;
    let weights = entity.reals(weights, count)?;
    let numbers = entity.reals(points, 3 * count)?;
    if let Some(index) = weights.iter().position(|&weight| weight <= 0.0) {
        return Err(entity.fault(first + index, "a weight above 0"));
    }
    let pole = |index: usize| {
        let at = in_file(index);
        let point = scale.0 * DVec3::new(numbers[3 * at], numbers[3 * at + 1], numbers[3 * at + 2]);
        (weights[at] * point).extend(weights[at])
    };
    Ok((0..count).map(pole).collect())
}

/// Reads the two ends of a range inside a domain.
fn range(entity: &Entity, index: usize, [low, high]: [f64; 2]) -> Found<[f64; 2]> {
    let [start, end] = [entity.real(index)?, entity.real(index + 1)?];
    let margin = SAME_RANGE * (high - low);
    if !(start < end && start >= low - margin && end <= high + margin) {
        return Err(entity.fault(index, "the start of a range of the knots"));
    }
    let start = if start <= low + margin { low } else { start };
    Ok([start, if end >= high - margin { high } else { end }])
}
