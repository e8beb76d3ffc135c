//! Surfaces, and their parameters in the file.

use super::joined::{joined, over, raised, spline};
use super::placement::{frame_before, placed};
use super::{MAX_NESTING, Scale, elementary, leaves, power_basis, splines};
use crate::iges::file::{Entity, File, Found};
use crate::nurbs::{Basis, Conic, Curve, Frame, Spline, SplineSurface, Surface};
use crate::report::FaceFault;
use glam::{DAffine2, DAffine3, DMat2, DVec2, DVec3, DVec4};
use std::f64::consts::TAU;

/// A surface where it is placed.
#[derive(Debug, Clone)]
pub(in crate::iges) struct Carrier {
    pub(in crate::iges) surface: Surface,
    pub(in crate::iges) location: DAffine3,
    /// The map from the file's parameters to ours, which keeps the side of the normal; `None`
    /// where the file has no parameters.
    pub(in crate::iges) parameters: Option<DAffine2>,
    /// The offset to the other side, of one whose side the file states.
    pub(in crate::iges) other_side: Option<Surface>,
}

/// Part of a turn by which a range of angles is a whole one.
const WHOLE_TURN: f64 = 1e-9;

/// The distance from a plane through the axis, relative to the profile's, that rounding explains.
const IN_PLANE: f64 = 1e-12;

/// Reads a surface.
///
/// # Errors
/// `IGES_ENTITY` for a type that is not read, `IGES_RULED` for a ruled surface that is not
/// rational, `IGES_NESTING`, and the errors of parameters.
pub(in crate::iges) fn carrier(file: &File<'_>, number: u64, scale: Scale) -> Found<Carrier> {
    nested(file, number, scale, 0)
}

fn nested(file: &File<'_>, number: u64, scale: Scale, nesting: usize) -> Found<Carrier> {
    let entity = file.entity(number)?;
    if nesting == MAX_NESTING {
        let why = format!("surface {number} is nested more than {MAX_NESTING} times");
        return Err(FaceFault::new("IGES_NESTING", why));
    }
    let location = placed(file, &entity.entry, scale)?;
    let same = Some(DAffine2::IDENTITY);
    let (surface, parameters) = match entity.entry.kind {
        114 => (power_basis::surface(&entity, scale)?, same),
        118 => (ruled(file, &entity, scale)?, same),
        120 => revolution(file, &entity, scale)?,
        122 => extrusion(file, &entity, scale)?,
        128 => (splines::surface(&entity, scale)?, same),
        140 => {
            let basis = nested(file, entity.reference(5)?, scale, nesting + 1)?;
            let [surface, other] = offset(&entity, &basis, scale)?;
            return Ok(Carrier {
                surface,
                location: location * basis.location,
                parameters: basis.parameters,
                other_side: Some(other),
            });
        }
        _ => elementary::surface(file, &entity, scale)?,
    };
    Ok(Carrier { surface, location, parameters, other_side: None })
}

/// Reads the curve that a parameter names, in the coordinates of the entity.
fn profile(file: &File<'_>, entity: &Entity, index: usize, scale: Scale) -> Found<(Curve, [f64; 2])> {
    let leaves = leaves(file, entity.reference(index)?, scale)?;
    joined(&leaves)?.ok_or_else(|| entity.fault(index, "a curve"))
}

/// Reads a surface of revolution, type 120: u of the file is the parameter of the generatrix, v
/// the angle. Ours is turned about the opposite axis, so that the normal's side is the same.
fn revolution(file: &File<'_>, entity: &Entity, scale: Scale) -> Found<(Surface, Option<DAffine2>)> {
    let (generatrix, range) = profile(file, entity, 2, scale)?;
    let Curve::Line { point, direction } = profile(file, entity, 1, scale)?.0 else {
        return Err(entity.fault(1, "a line"));
    };
    let [start, end] = [entity.real(3)?, entity.real(4)?];
    if !(start < end && end - start <= TAU * (1.0 + WHOLE_TURN)) {
        return Err(entity.fault(3, "an angle below the next one, by at most a turn"));
    }
    let frame = about(point, -direction, &generatrix, range);
    let frame = frame.ok_or_else(|| entity.fault(1, "a line with a direction"))?;
    let (profile, kind) = flat(generatrix.in_frame(&frame));
    let bounds = [[-end, -start], range];
    let surface = Surface::Revolution { frame, profile, kind };
    let parameters = DAffine2::from_mat2(DMat2::from_cols(DVec2::Y, -DVec2::X));
    Ok((Surface::Trimmed { bounds, basis: Box::new(surface) }, Some(parameters)))
}

/// The frame about an axis whose x axis points to the point of a curve that is farthest from it.
fn about(origin: DVec3, axis: DVec3, curve: &Curve, [start, end]: [f64; 2]) -> Option<Frame> {
    let z = axis.try_normalize()?;
    let across = |part: f64| {
        let from = curve.point(start + part * (end - start)) - origin;
        from - from.dot(z) * z
    };
    let farthest = [0.0, 0.25, 0.5, 0.75, 1.0].map(across).into_iter();
    let farthest = farthest.max_by(|a, b| a.length().total_cmp(&b.length()))?;
    let x = farthest.try_normalize()?;
    let x = (x - x.dot(z) * z).try_normalize()?;
    Some(Frame { origin, x, y: z.cross(x), z })
}

/// Returns a profile in the plane y = 0 if it lies there but for rounding, and the kind of its
/// surface.
fn flat(profile: Curve) -> (Curve, &'static str) {
    let in_plane = |vectors: &[DVec3]| {
        let size = vectors.iter().map(|vector| vector.length()).fold(0.0, f64::max);
        vectors.iter().all(|vector| vector.y.abs() <= IN_PLANE * size)
    };
    let level = |vector: DVec3| DVec3::new(vector.x, 0.0, vector.z);
    match profile {
        Curve::Line { point, direction } if in_plane(&[point, direction]) => {
            let (point, mut direction) = (level(point), level(direction));
            if direction.x.abs() <= IN_PLANE * direction.length() {
                direction.x = 0.0;
            }
            let kind = if direction.x == 0.0 { "cylinder" } else { "cone" };
            (Curve::Line { point, direction }, kind)
        }
        Curve::Conic { conic, center, x, y } if in_plane(&[center, x, y]) => {
            let [center, x, y] = [center, x, y].map(level);
            let is_torus = conic == Conic::Elliptic && center.x > x.length();
            (Curve::Conic { conic, center, x, y }, if is_torus { "torus" } else { "revolution" })
        }
        other => (other, "revolution"),
    }
}

/// Reads a tabulated cylinder, type 122: u of the file is the part of the directrix's range, v
/// that of the generatrix, which begins where the directrix does.
fn extrusion(file: &File<'_>, entity: &Entity, scale: Scale) -> Found<(Surface, Option<DAffine2>)> {
    let (profile, range) = profile(file, entity, 1, scale)?;
    let direction = scale.0 * entity.point(2)? - profile.point(range[0]);
    if !(direction.length() > 0.0) {
        return Err(entity.fault(2, "a point other than the start of the directrix"));
    }
    let parameters = DAffine2::from_scale_angle_translation(
        DVec2::new(range[1] - range[0], 1.0),
        0.0,
        DVec2::new(range[0], 0.0),
    );
    let surface = Surface::Extrusion { direction, profile };
    Ok((Surface::Trimmed { bounds: [range, [0.0, 1.0]], basis: Box::new(surface) }, Some(parameters)))
}

/// Reads a ruled surface, type 118, whose lines join points of equal parameters; u and v of the
/// file run from 0 to 1.
///
/// Both curves become rational over [0, 1], so that equal parameters are those of the file for
/// polynomials, rational B-splines and polygons, and for arcs of equal angles.
fn ruled(file: &File<'_>, entity: &Entity, scale: Scale) -> Found<Surface> {
    let fault = |why: &str| {
        let why = format!("the ruled surface {}: {why}", entity.number());
        FaceFault::new("IGES_RULED", why)
    };
    let mut sides = Vec::with_capacity(2);
    for index in [1, 2] {
        let leaves = leaves(file, entity.reference(index)?, scale)?;
        let [leaf] = leaves.as_slice() else { return Err(fault("composite curves are not read")) };
        sides.push(leaf.clone());
    }
    let angle = |curve: &Curve, range: [f64; 2]| match curve {
        Curve::Conic { conic: Conic::Elliptic, x, y, .. } if x.length() == y.length() => {
            Some(range[1] - range[0])
        }
        _ => None,
    };
    let angles = [0, 1].map(|side: usize| angle(&sides[side].curve, sides[side].range));
    let both_lines = sides.iter().all(|side| matches!(side.curve, Curve::Line { .. }));
    let arcs_agree = match angles {
        [None, None] => !sides.iter().any(|side| side.curve.is_conic()),
        [Some(a), Some(b)] => (a - b).abs() <= WHOLE_TURN * a,
        _ => false,
    };
    // Form 0 joins points at equal parts of the lengths, which are those of the parameters on
    // lines and circles.
    let by_length = entity.entry.form == 0 && !both_lines && angles[0].is_none();
    if !arcs_agree || by_length {
        return Err(fault("its lines join points whose parameters are not those of rational curves"));
    }
    let first = spline(&sides[0])?;
    let mut second = spline(&sides[1])?;
    if entity.count(3, 1)? == 1 {
        second = second.reversed();
    }
    let degree = first.degree.max(second.degree);
    let ruled = between([first, second].map(|side| raised(&over(side, [0.0, 1.0]), degree)));
    let error = sides.iter().map(|side| side.curve.error()).fold(0.0, f64::max);
    Ok(Surface::Spline(SplineSurface { error, ..ruled }))
}

/// Returns the surface ruled by homogeneous points of equal parameters: its lines are those of
/// the curves' points.
fn between([first, second]: [Spline; 2]) -> SplineSurface {
    let mut knots: Vec<f64> = first.knots.iter().chain(&second.knots).copied().collect();
    knots.sort_by(f64::total_cmp);
    knots.dedup();
    let degree = first.degree;
    let times = |knot: f64| if knot == 0.0 || knot == 1.0 { degree + 1 } else { degree };
    let knots: Vec<f64> = knots.iter().flat_map(|&knot| std::iter::repeat_n(knot, times(knot))).collect();
    let [first, second] = [first, second].map(|side| side.with_knots(&knots));
    let poles: Vec<DVec4> = first.controls.iter().zip(&second.controls).flat_map(|(&a, &b)| [a, b]).collect();
    let count = first.controls.len();
    let bases = [Basis::with_knots(degree, knots, count), Basis::with_knots(1, vec![0.0, 0.0, 1.0, 1.0], 2)];
    SplineSurface::new(bases, poles)
}

/// Reads an offset surface, type 140: to the side to which the vector stated points, and to the other one.
fn offset(entity: &Entity, basis: &Carrier, scale: Scale) -> Found<[Surface; 2]> {
    let distance = scale.0 * entity.real(4)?;
    let side = frame_before(&basis.location).vector(entity.point(1)?);
    let middle = basis.surface.natural_ranges().map(|range| range.map_or(0.0, |[a, b]| 0.5 * (a + b)));
    let offset = |distance: f64| basis.surface.clone().offset(distance);
    let moved = offset(distance).point(middle[0], middle[1]) - basis.surface.point(middle[0], middle[1]);
    if !(moved.length() > 0.0) {
        return Err(entity.fault(4, "a distance other than 0 from a surface with a normal"));
    }
    let away = moved.dot(side) * distance.signum() < 0.0;
    let distance = if away { -distance } else { distance };
    Ok([distance, -distance].map(offset))
}
