//! The section of surfaces.

use super::curves::{MAX_NESTING, basis, curve, degree, pole};
use super::lexer::{Dimension, Lexer};
use crate::nurbs::{Basis, Conic, Curve, Frame, SplineSurface, Surface};
use glam::DVec3;
use nurbs_hausdorff::Result;

/// Reads the surfaces; index 0 of the result is number 1 of the file.
pub(super) fn read(lexer: &mut Lexer<'_>) -> Result<Vec<Surface>> {
    lexer.keyword("Surfaces")?;
    let count = lexer.count("the number of surfaces")?;
    let mut surfaces = Vec::new();
    for _ in 0..count {
        surfaces.push(surface(lexer, 0)?);
    }
    Ok(surfaces)
}

fn surface(lexer: &mut Lexer<'_>, nesting: usize) -> Result<Surface> {
    const KINDS: &str = "the kind of a surface, 1 to 11";
    let kind = lexer.word(KINDS)?;
    if nesting > MAX_NESTING {
        return Err(lexer.error(kind, "at most 32 nested surfaces"));
    }
    Ok(match kind {
        "1" => Surface::Plane(frame(lexer)?),
        "2" | "3" | "4" | "5" => elementary(lexer, kind)?,
        "6" => {
            let direction = lexer.point(Dimension::Three)?;
            Surface::Extrusion { direction, profile: curve(lexer, Dimension::Three, nesting + 1)? }
        }
        "7" => {
            let origin = lexer.point(Dimension::Three)?;
            let axis = lexer.point(Dimension::Three)?;
            let frame = Frame::about(origin, axis)
                .ok_or_else(|| lexer.error("a zero vector", "the direction of an axis"))?;
            let profile = curve(lexer, Dimension::Three, nesting + 1)?.in_frame(&frame);
            Surface::Revolution { frame, profile, kind: "revolution" }
        }
        "8" => bezier(lexer)?,
        "9" => spline(lexer)?,
        "10" => {
            let mut bounds = [[0.0; 2]; 2];
            for bound in bounds.as_flattened_mut() {
                *bound = lexer.number("a bound of a trimmed surface")?;
            }
            Surface::Trimmed { bounds, basis: Box::new(surface(lexer, nesting + 1)?) }
        }
        "11" => {
            let distance = lexer.number("an offset")?;
            surface(lexer, nesting + 1)?.offset(distance)
        }
        _ => return Err(lexer.error(kind, KINDS)),
    })
}

/// Reads an origin, an axis and the two directions orthogonal to it.
fn frame(lexer: &mut Lexer<'_>) -> Result<Frame> {
    let origin = lexer.point(Dimension::Three)?;
    let z = lexer.point(Dimension::Three)?;
    Ok(Frame { origin, z, x: lexer.point(Dimension::Three)?, y: lexer.point(Dimension::Three)? })
}

/// Reads a cylinder, cone, sphere or torus as the revolution of a line or circle of
/// the frame's plane y = 0.
fn elementary(lexer: &mut Lexer<'_>, kind: &str) -> Result<Surface> {
    let frame = frame(lexer)?;
    let radius = lexer.number("a radius")?;
    let line = |direction| Curve::Line { point: radius * DVec3::X, direction };
    let circle = |center: f64, radius: f64| Curve::Conic {
        conic: Conic::Elliptic,
        center: center * DVec3::X,
        x: radius * DVec3::X,
        y: radius * DVec3::Z,
    };
    let (profile, kind) = match kind {
        "2" => (line(DVec3::Z), "cylinder"),
        "3" => {
            let (sin, cos) = lexer.number("the half angle of a cone")?.sin_cos();
            (line(DVec3::new(sin, 0.0, cos)), "cone")
        }
        "4" => (circle(0.0, radius), "sphere"),
        _ => (circle(radius, lexer.number("the minor radius of a torus")?), "torus"),
    };
    Ok(Surface::Revolution { frame, profile, kind })
}

fn bezier(lexer: &mut Lexer<'_>) -> Result<Surface> {
    let rational = lexer.flag("1 for rational in u, else 0")? | lexer.flag("1 for rational in v, else 0")?;
    let degrees = [degree(lexer)?, degree(lexer)?];
    let mut poles = Vec::new();
    for _ in 0..(degrees[0] + 1) * (degrees[1] + 1) {
        poles.push(pole(lexer, Dimension::Three, rational)?);
    }
    Ok(Surface::Spline(SplineSurface::new(degrees.map(Basis::bezier), poles)))
}

fn spline(lexer: &mut Lexer<'_>) -> Result<Surface> {
    let rational = lexer.flag("1 for rational in u, else 0")? | lexer.flag("1 for rational in v, else 0")?;
    let periodic = [lexer.flag("1 for periodic in u, else 0")?, lexer.flag("1 for periodic in v, else 0")?];
    let degrees = [degree(lexer)?, degree(lexer)?];
    let counts = [lexer.count("the number of poles in u")?, lexer.count("the number of poles in v")?];
    let knots = [lexer.count("the number of knots in u")?, lexer.count("the number of knots in v")?];
    let mut poles = Vec::new();
    // A bogus product ends at the first missing word.
    for _ in 0..counts[0].saturating_mul(counts[1]) {
        poles.push(pole(lexer, Dimension::Three, rational)?);
    }
    let u = basis(lexer, degrees[0], counts[0], knots[0], periodic[0])?;
    let v = basis(lexer, degrees[1], counts[1], knots[1], periodic[1])?;
    Ok(Surface::Spline(SplineSurface::new([u, v], poles)))
}
