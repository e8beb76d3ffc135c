//! Curves, in space or in a parameter plane.

use super::conics::range_of;
use super::placement::placed;
use super::{MAX_NESTING, Scale, conics, power_basis, splines};
use crate::iges::file::{Entity, File, Found};
use crate::nurbs::{Conic, Curve, Spline};
use crate::report::FaceFault;
use glam::{DAffine3, DVec3};

/// A curve that is made of no others, with its range and place.
#[derive(Debug, Clone)]
pub(in crate::iges) struct Leaf {
    pub(in crate::iges) curve: Curve,
    pub(in crate::iges) range: [f64; 2],
    pub(in crate::iges) location: DAffine3,
}

/// The most curves of a composite one. A curve may stand in many others, so that a short file
/// could describe more than memory holds.
const MAX_LEAVES: usize = 1 << 16;

/// Reads a curve as the curves that it is made of, head to tail.
///
/// # Errors
/// `IGES_ENTITY` for a type that is not read, `IGES_NESTING`, and the errors of parameters.
pub(in crate::iges) fn leaves(file: &File<'_>, number: u64, scale: Scale) -> Found<Vec<Leaf>> {
    let mut leaves = Vec::new();
    collect(file, number, scale, &DAffine3::IDENTITY, 0, &mut leaves)?;
    Ok(leaves)
}

fn collect(
    file: &File<'_>,
    number: u64,
    scale: Scale,
    above: &DAffine3,
    nesting: usize,
    leaves: &mut Vec<Leaf>,
) -> Found<()> {
    let entity = file.entity(number)?;
    if nesting == MAX_NESTING || leaves.len() >= MAX_LEAVES {
        let why = format!("curve {number} has more than {MAX_NESTING} levels or {MAX_LEAVES} parts");
        return Err(FaceFault::new("IGES_NESTING", why));
    }
    let location = *above * placed(file, &entity.entry, scale)?;
    if entity.entry.kind == 102 {
        for part in entity.references(1)? {
            collect(file, part, scale, &location, nesting + 1, leaves)?;
        }
        return Ok(());
    }
    let (curve, range) = simple(&entity, scale)?;
    leaves.push(Leaf { curve, range, location });
    Ok(())
}

/// Reads a curve in the coordinates of its parameters, with its range.
fn simple(entity: &Entity, scale: Scale) -> Found<(Curve, [f64; 2])> {
    match (entity.entry.kind, entity.entry.form) {
        (100, _) => arc(entity, scale),
        (104, _) => conics::conic(entity, scale),
        (106, 11..=13 | 63) => polyline(entity, scale),
        (110, 0) => {
            let [start, end] = [scale.0 * entity.point(1)?, scale.0 * entity.point(4)?];
            Ok((Curve::Line { point: start, direction: end - start }, [0.0, 1.0]))
        }
        (112, _) => {
            let curve = Curve::Spline(power_basis::curve(entity, scale)?);
            let range = curve.natural_range().ok_or_else(|| entity.unknown("a curve"))?;
            Ok((curve, range))
        }
        (126, _) => splines::curve(entity, scale),
        _ => Err(entity.unknown("a curve")),
    }
}

/// Returns a B-spline and its domain.
fn whole(spline: Spline) -> Found<(Curve, [f64; 2])> {
    let range = spline.domain();
    Ok((Curve::Spline(spline.into()), range))
}

/// Reads an arc of a circle, counter-clockwise; its parameter is the angle.
fn arc(entity: &Entity, scale: Scale) -> Found<(Curve, [f64; 2])> {
    let height = entity.real(1)?;
    let at = |index: usize| -> Found<DVec3> {
        Ok(DVec3::new(entity.real(index)?, entity.real(index + 1)?, height))
    };
    let center = at(2)?;
    let [start, end] = [at(4)? - center, at(6)? - center];
    let radius = scale.0 * start.length();
    let curve = Curve::Conic {
        conic: Conic::Elliptic,
        center: scale.0 * center,
        x: radius * DVec3::X,
        y: radius * DVec3::Y,
    };
    Ok((curve, range_of(start.y.atan2(start.x), end.y.atan2(end.x))))
}

/// Reads a polygon; its parameter is the number of the point.
fn polyline(entity: &Entity, scale: Scale) -> Found<(Curve, [f64; 2])> {
    let (size, first) = match entity.count(1, 3)? {
        1 => (2, 4),
        2 => (3, 3),
        3 => (6, 3),
        _ => return Err(entity.fault(1, "1, 2 or 3")),
    };
    let count = entity.items(2, size)?;
    if count < 2 {
        return Err(entity.fault(2, "at least two points"));
    }
    let height = if size == 2 { entity.real(3)? } else { 0.0 };
    let numbers = entity.reals(first, count * size)?;
    let point = |values: &[f64]| DVec3::new(values[0], values[1], if size == 2 { height } else { values[2] });
    let mut points: Vec<DVec3> = numbers.chunks_exact(size).map(|values| scale.0 * point(values)).collect();
    points.dedup();
    let last = points.len() - 1;
    if last == 0 {
        return Err(entity.fault(2, "two points that differ"));
    }
    let knots = std::iter::once(0.0).chain((0..=last).map(|knot| knot as f64)).chain([last as f64]).collect();
    let controls = points.iter().map(|point| point.extend(1.0)).collect();
    whole(Spline { degree: 1, knots, controls })
}
