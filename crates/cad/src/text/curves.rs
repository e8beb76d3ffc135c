//! The sections of curves, in the parameter plane and in space.

use super::lexer::{Dimension, Lexer};
use crate::nurbs::{Basis, Conic, Curve, SplineCurve};
use glam::{DVec3, DVec4};
use nurbs_hausdorff::Result;
use nurbs_hausdorff::workspace::MAX_FILE_DEGREE;

/// The deepest nesting of trimmed and offset curves and surfaces. OpenCASCADE writes
/// at most a few levels; the limit keeps a damaged file from exhausting the stack.
pub(super) const MAX_NESTING: usize = 32;

/// Reads the section `keyword` of curves; index 0 of the result is number 1 of the file.
pub(super) fn read(lexer: &mut Lexer<'_>, keyword: &str, dimension: Dimension) -> Result<Vec<Curve>> {
    lexer.keyword(keyword)?;
    let count = lexer.count("the number of curves")?;
    let mut curves = Vec::new();
    for _ in 0..count {
        curves.push(curve(lexer, dimension, 0)?);
    }
    Ok(curves)
}

/// Reads a curve at this level of nesting.
pub(super) fn curve(lexer: &mut Lexer<'_>, dimension: Dimension, nesting: usize) -> Result<Curve> {
    const KINDS: &str = "the kind of a curve, 1 to 9";
    let kind = lexer.word(KINDS)?;
    if nesting > MAX_NESTING {
        return Err(lexer.error(kind, "at most 32 nested curves"));
    }
    Ok(match kind {
        "1" => Curve::Line { point: lexer.point(dimension)?, direction: lexer.point(dimension)? },
        "2" | "3" | "4" | "5" => conic(lexer, dimension, kind)?,
        "6" => bezier(lexer, dimension)?,
        "7" => spline(lexer, dimension)?,
        "8" => {
            let range = [lexer.number("a parameter")?, lexer.number("a parameter")?];
            Curve::Trimmed { range, basis: Box::new(curve(lexer, dimension, nesting + 1)?) }
        }
        "9" => {
            let distance = lexer.number("an offset")?;
            let normal = if dimension == Dimension::Three { lexer.point(dimension)? } else { DVec3::Z };
            Curve::Offset { distance, normal, basis: Box::new(curve(lexer, dimension, nesting + 1)?) }
        }
        _ => return Err(lexer.error(kind, KINDS)),
    })
}

/// Reads a circle, ellipse, parabola or hyperbola: the centre, in space the axis, the
/// two directions of the plane, and one or two lengths.
fn conic(lexer: &mut Lexer<'_>, dimension: Dimension, kind: &str) -> Result<Curve> {
    let center = lexer.point(dimension)?;
    if dimension == Dimension::Three {
        lexer.point(dimension)?;
    }
    let (x, y) = (lexer.point(dimension)?, lexer.point(dimension)?);
    let length = lexer.number("a radius or focal length")?;
    let (conic, x, y) = match kind {
        "2" => (Conic::Elliptic, length * x, length * y),
        "3" => (Conic::Elliptic, length * x, lexer.number("the minor radius")? * y),
        "4" if length == 0.0 => return Err(lexer.error("0", "a focal length above 0")),
        "4" => (Conic::Parabolic, x / (4.0 * length), y),
        _ => (Conic::Hyperbolic, length * x, lexer.number("the minor radius")? * y),
    };
    Ok(Curve::Conic { conic, center, x, y })
}

fn bezier(lexer: &mut Lexer<'_>, dimension: Dimension) -> Result<Curve> {
    let rational = lexer.flag("1 for a rational curve, else 0")?;
    let degree = degree(lexer)?;
    let mut poles = Vec::new();
    for _ in 0..=degree {
        poles.push(pole(lexer, dimension, rational)?);
    }
    Ok(Curve::Spline(SplineCurve::new(Basis::bezier(degree), poles)))
}

fn spline(lexer: &mut Lexer<'_>, dimension: Dimension) -> Result<Curve> {
    let rational = lexer.flag("1 for a rational curve, else 0")?;
    let periodic = lexer.flag("1 for a periodic curve, else 0")?;
    let degree = degree(lexer)?;
    let count = lexer.count("the number of poles")?;
    let knots = lexer.count("the number of knots")?;
    let mut poles = Vec::new();
    for _ in 0..count {
        poles.push(pole(lexer, dimension, rational)?);
    }
    let basis = basis(lexer, degree, count, knots, periodic)?;
    Ok(Curve::Spline(SplineCurve::new(basis, poles)))
}

/// Reads a degree.
pub(super) fn degree(lexer: &mut Lexer<'_>) -> Result<usize> {
    let word = lexer.peek().unwrap_or_default();
    let degree = lexer.count("a degree")?;
    if (1..=MAX_FILE_DEGREE).contains(&degree) {
        Ok(degree)
    } else {
        Err(lexer.error(word, "a degree, 1 to 25"))
    }
}

/// Reads a control point, returned in homogeneous coordinates.
pub(super) fn pole(lexer: &mut Lexer<'_>, dimension: Dimension, rational: bool) -> Result<DVec4> {
    let point = lexer.point(dimension)?;
    let word = lexer.peek().unwrap_or_default();
    let weight = if rational { lexer.number("a weight above 0")? } else { 1.0 };
    if weight > 0.0 {
        Ok((weight * point).extend(weight))
    } else {
        Err(lexer.error(word, "a weight above 0"))
    }
}

/// Reads `knots` pairs of knot and multiplicity for `count` control points.
pub(super) fn basis(
    lexer: &mut Lexer<'_>,
    degree: usize,
    count: usize,
    knots: usize,
    periodic: bool,
) -> Result<Basis> {
    let mut pairs: Vec<(f64, usize)> = Vec::new();
    for _ in 0..knots {
        let word = lexer.peek().unwrap_or_default();
        let knot = lexer.number("a knot")?;
        if pairs.last().is_some_and(|&(last, _)| knot <= last) {
            return Err(lexer.error(word, "a knot above the one before it"));
        }
        let word = lexer.peek().unwrap_or_default();
        let multiplicity = lexer.count("the multiplicity of a knot")?;
        if !(1..=degree + 1).contains(&multiplicity) {
            return Err(lexer.error(word, "a multiplicity of 1 to the degree + 1"));
        }
        pairs.push((knot, multiplicity));
    }
    Basis::new(degree, count, &pairs, periodic)
        .ok_or_else(|| lexer.error("these knots", "knots that fit the degree and the number of poles"))
}
