//! Curves made from edges in space where the file has none in the parameters.

use super::uses::gap;
use crate::brep::nurbs::{Conic, Curve, Frame, Spline, Surface, project};
use crate::brep::report::FaceFault;
use crate::brep::text::{BrepFile, Edge, Face};
use glam::{DAffine3, DVec3};
use std::f64::consts::TAU;

/// The deviation of a parameter from a constant, in space and relative to the size of the
/// edge, within which an edge is a parameter line.
const LINE_TOLERANCE: f64 = 1e-7;

/// Makes the curve of an edge, in the direction of the edge, and its gap: on planes the
/// image of any edge, and on surfaces of revolution of lines and circles the parameter
/// lines. OpenCASCADE leaves out the former alone.
///
/// # Errors
/// `BREP_NO_P_CURVE` for another edge or surface, else those of the edge's own curve.
pub(super) fn invert(
    file: &BrepFile,
    face: &Face,
    surface: &Surface,
    edge: &Edge,
    location: &DAffine3,
) -> Result<(Spline, f64), FaceFault> {
    let Some(space) = &edge.curve else {
        return Err(FaceFault::new("BREP_NO_P_CURVE", "neither a curve in the parameters nor one in space"));
    };
    let curve = &file.curves[space.curve];
    let to_face = face.location.inverse() * *location * space.location;
    let scale = face.location.matrix3.determinant().abs().cbrt();
    match surface.elementary() {
        Surface::Plane(frame) => {
            let (spline, _) = curve.spline(space.range)?;
            Ok(on_plane(spline, frame, &to_face, scale))
        }
        Surface::Revolution { frame, profile, .. } => {
            let points = samples(space.range).map(|t| to_face.transform_point3(curve.point(t))).collect();
            let [start, end] = parameter_line(points, surface, frame, profile)
                .ok_or_else(|| FaceFault::new("BREP_NO_P_CURVE", "the edge is no parameter line"))?;
            let line = Curve::Line { point: start, direction: end - start };
            let gap = gap(file, face, edge, location, (&line, [0.0, 1.0]))?;
            Ok((Spline::segment([0.0, 1.0], start, end), gap))
        }
        _ => Err(FaceFault::new("BREP_NO_P_CURVE", format!("no curve on the {}", surface.kind()))),
    }
}

/// Returns the affine image of a curve in a plane, exact, and the gap, proven: the edge
/// lies in the convex hull of its control points, none of which is farther from the plane.
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
fn samples([start, end]: [f64; 2]) -> impl Iterator<Item = f64> + Clone {
    (0..SAMPLES).map(move |sample| {
        let fraction = sample as f64 / (SAMPLES - 1) as f64;
        (1.0 - fraction) * start + fraction * end
    })
}

/// Returns the ends of the parameter line through points of a surface of revolution; `None`
/// where the points do not lie on one parameter line.
fn parameter_line(
    points: Vec<DVec3>,
    surface: &Surface,
    frame: &Frame,
    profile: &Curve,
) -> Option<[DVec3; 2]> {
    let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let size = low.distance(high);
    let mut parameters: Vec<DVec3> = Vec::with_capacity(points.len());
    for &point in &points {
        let local = frame.local_point(point);
        let radius = local.x.hypot(local.y);
        let v = on_profile(profile, DVec3::new(radius, 0.0, local.z))?;
        let angle = local.y.atan2(local.x);
        let mut found = DVec3::new(angle, v, 0.0);
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
        let gap = points.iter().zip(&parameters).map(distance).fold(0.0, f64::max);
        let (start, end) = (on_line(&parameters[0]), on_line(&parameters[parameters.len() - 1]));
        (gap <= LINE_TOLERANCE * size && start != end).then_some([start, end])
    })
}

/// Returns the parameter of a profile's point nearest to a point of the plane y = 0, for
/// lines and circles.
fn on_profile(profile: &Curve, point: DVec3) -> Option<f64> {
    match profile {
        Curve::Line { point: origin, direction } => {
            Some((point - *origin).dot(*direction) / direction.length_squared())
        }
        Curve::Conic { conic: Conic::Elliptic, center, x, y } => {
            let from_center = point - *center;
            let [a, b] = [x, y].map(|axis| from_center.dot(*axis) / axis.length_squared());
            Some(b.atan2(a))
        }
        Curve::Trimmed { basis, .. } => on_profile(basis, point),
        _ => None,
    }
}
