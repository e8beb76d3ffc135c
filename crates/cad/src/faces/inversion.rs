//! Curves made from edges in space where the file has none in the parameters.

use super::found_curve::{FoundCurve, lifted};
use super::gap::Gap;
use super::projection::{Projector, Traced, angle, is_across_seam, on_meridian};
use crate::nurbs::{Curve, Frame, Spline, Surface, project};
use crate::report::FaceFault;
use crate::topology::{Edge, Face, Topology};
use glam::{DAffine3, DVec3};
use std::f64::consts::TAU;

/// The deviation of a parameter from a constant, in space and relative to the size of the
/// edge, within which an edge is a parameter line.
const LINE_TOLERANCE: f64 = 1e-7;

/// Makes the curve of an edge, in the direction of the edge: on planes the image of any
/// edge; on other surfaces the parameter line or the plane section that the edge is, else a
/// cubic fitted to its projection. OpenCASCADE leaves out the first alone.
///
/// `reversed` is whether the loop uses the edge against its direction.
///
/// # Errors
/// `BREP_NO_P_CURVE` if the edge does not lie on the surface, a plane or another one, else those of the edge's own
/// curve.
pub(super) fn invert(
    file: &Topology,
    face: &Face,
    surface: &Surface,
    edge: &Edge,
    location: &DAffine3,
    reversed: bool,
) -> Result<FoundCurve, FaceFault> {
    let Some(space) = &edge.curve else {
        return Err(FaceFault::new("BREP_NO_P_CURVE", "neither a curve in the parameters nor one in space"));
    };
    let curve = &file.curves[space.curve];
    let to_face = face.location.inverse() * *location * space.location;
    let scale = face.location.matrix3.determinant().abs().cbrt();
    let traced = Traced::new(curve, space, to_face, edge, 1.0 / scale)?;
    if let Surface::Plane(frame) = surface.elementary() {
        let distances = samples(space.range).map(|t| frame.local_point(traced.point(t)).z.abs());
        traced.check(distances.fold(0.0, f64::max))?;
        let (spline, _, error) = curve.spline(space.range)?;
        let (curve, gap) = on_plane(spline, frame, &to_face, scale);
        // The error is one of the edge's own coordinates.
        let error = scale * to_face.matrix3.determinant().abs().cbrt() * error;
        let approximation = if error > 0.0 { Gap::measured(error) } else { Gap::default() };
        let moved = scale * to_face.matrix3.determinant().abs().cbrt() * file.curves[space.curve].error();
        return Ok(FoundCurve {
            curve,
            gap: Gap::proven(gap + moved).plus(approximation),
            fitted: error > 0.0,
            section: None,
            deviation: 0.0,
            is_placed: false,
        });
    }
    let points: Vec<DVec3> = samples(space.range).map(|t| traced.point(t)).collect();
    let mut projector = Projector::new(surface, traced.size);
    let line = match surface.elementary() {
        Surface::Revolution { frame, profile, .. } => {
            revolution_parameters(&points, surface, frame, profile, traced.size)
        }
        _ => None,
    };
    let line = line.and_then(|parameters| parameter_line(&points, &parameters, surface, traced.size));
    let line = match line {
        Some(line) => Some(line),
        None => {
            let (parameters, _) = traced.parameters(&mut projector)?;
            parameter_line(&points, &parameters, surface, traced.size)
        }
    };
    if let Some(ends) = line {
        let [start, end] = on_side(surface, ends, reversed);
        let line = Curve::Line { point: start, direction: end - start };
        let gap = lifted(file, (face, surface), edge, location, (&line, [0.0, 1.0]));
        let gap = gap.as_ref().map_or_else(Gap::default, Gap::of);
        let curve = Spline::segment([0.0, 1.0], start, end);
        return Ok(FoundCurve { curve, gap, fitted: false, section: None, deviation: 0.0, is_placed: false });
    }
    let fit = traced.fit(surface, &mut projector)?;
    let on_surface = Curve::Spline(fit.clone().into());
    let lifted = lifted(file, (face, surface), edge, location, (&on_surface, space.range));
    let gap = lifted.as_ref().map_or_else(Gap::default, Gap::of);
    let found = FoundCurve { curve: fit, gap, fitted: true, section: None, deviation: 0.0, is_placed: false };
    Ok(match &lifted {
        Some(lifted) => found.with_section(&to_face, lifted),
        None => found,
    })
}

/// Moves a parameter line along a seam of a surface that is closed but not periodic to the
/// side on which the loop has the material on its left: a line with increasing v to the end
/// of u, one with increasing u to the start of v.
fn on_side(surface: &Surface, mut ends: [DVec3; 2], reversed: bool) -> [DVec3; 2] {
    let (closures, periods, natural) = (surface.closures(), surface.periods(), surface.natural_ranges());
    for axis in [0, 1] {
        let (Some(length), None, Some([low, high])) = (closures[axis], periods[axis], natural[axis]) else {
            continue;
        };
        let value = ends[0][axis];
        let at_seam = (value - low).min(high - value) <= LINE_TOLERANCE * length;
        if value == ends[1][axis] && at_seam {
            let rises = (ends[1][1 - axis] > ends[0][1 - axis]) != reversed;
            let side = if rises == (axis == 0) { high } else { low };
            ends[0][axis] = side;
            ends[1][axis] = side;
        }
    }
    ends
}

/// Returns the affine image of a curve in a plane, exact, and the gap, proven: the edge
/// lies in the convex hull of its control points, and no control point is farther from the plane.
fn on_plane(mut spline: Spline, frame: &Frame, to_face: &DAffine3, scale: f64) -> (Spline, f64) {
    let mut gap = 0.0_f64;
    for control in &mut spline.controls {
        let weight = control.w;
        let local = frame.local_point(to_face.transform_point3(project(*control)));
        gap = gap.max(scale * local.z.abs());
        *control = (weight * DVec3::new(local.x, local.y, 0.0)).extend(weight);
    }
    (spline, gap)
}

/// The points of an edge by which a parameter line is recognised.
const SAMPLES: usize = 17;

/// Returns equally spaced parameters of a range.
pub(super) fn samples([start, end]: [f64; 2]) -> impl Iterator<Item = f64> + Clone {
    (0..SAMPLES).map(move |sample| {
        let fraction = sample as f64 / (SAMPLES - 1) as f64;
        (1.0 - fraction) * start + fraction * end
    })
}

/// Returns the parameters of points of a surface of revolution in closed form, each beside
/// the one before it; `None` for profiles that are neither lines nor circles.
fn revolution_parameters(
    points: &[DVec3],
    surface: &Surface,
    frame: &Frame,
    profile: &Curve,
    size: f64,
) -> Option<Vec<DVec3>> {
    let mut parameters: Vec<DVec3> = Vec::with_capacity(points.len());
    for &point in points {
        let local = frame.local_point(point);
        let radius = local.x.hypot(local.y);
        let v = on_meridian(profile, radius, local.z)?;
        let mut found = DVec3::new(angle(local, profile.point(v)), v, 0.0);
        if let Some(last) = parameters.last() {
            // On the axis every angle is the point's.
            if radius <= LINE_TOLERANCE * size {
                found.x = last.x;
            }
            for axis in [0, 1] {
                if axis == 0 || surface.periods()[1].is_some() {
                    found[axis] += TAU * ((last[axis] - found[axis]) / TAU).round();
                }
            }
        }
        parameters.push(found);
    }
    // The angle of a first point on the axis is the next one's.
    if let [first, second, ..] = parameters.as_mut_slice() {
        let local = frame.local_point(points[0]);
        if local.x.hypot(local.y) <= LINE_TOLERANCE * size {
            first.x = second.x;
        }
    }
    Some(parameters)
}

/// Returns the ends of the parameter line through points with these parameters; `None` where
/// a point is farther from the line's point of equal parameter than the tolerance, or the points pass a
/// seam at which the parameters do not continue.
fn parameter_line(
    points: &[DVec3],
    parameters: &[DVec3],
    surface: &Surface,
    size: f64,
) -> Option<[DVec3; 2]> {
    if parameters.windows(2).any(|pair| is_across_seam(surface, pair[1] - pair[0])) {
        return None;
    }
    [0, 1].into_iter().find_map(|axis| {
        let value = parameters[parameters.len() / 2][axis];
        let on_line = |parameter: &DVec3| {
            let mut moved = *parameter;
            moved[axis] = value;
            moved
        };
        let distance = |(point, parameter): (&DVec3, &DVec3)| {
            let moved = on_line(parameter);
            point.distance(surface.point(moved.x, moved.y))
        };
        let gap = points.iter().zip(parameters).map(distance).fold(0.0, f64::max);
        let (start, end) = (on_line(&parameters[0]), on_line(&parameters[parameters.len() - 1]));
        (gap <= LINE_TOLERANCE * size && start != end).then_some([start, end])
    })
}
