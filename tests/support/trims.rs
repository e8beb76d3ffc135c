//! Loops of trimming curves with known shapes.

use nurbs_hausdorff::SurfaceArrays;
use nurbs_hausdorff::model::trim::{FaceArrays, TrimCurveArrays};
use std::f64::consts::FRAC_1_SQRT_2;

/// A straight line.
pub fn line(from: [f64; 2], to: [f64; 2]) -> TrimCurveArrays {
    TrimCurveArrays {
        degree: 1,
        knots: vec![0.0, 0.0, 1.0, 1.0],
        control_points: vec![[from[0], from[1], 1.0], [to[0], to[1], 1.0]],
        ..TrimCurveArrays::default()
    }
}

/// The closed polygon through these points.
pub fn polygon(points: &[[f64; 2]]) -> Vec<TrimCurveArrays> {
    (0..points.len()).map(|index| line(points[index], points[(index + 1) % points.len()])).collect()
}

/// The boundary of a rectangle, counterclockwise.
pub fn rectangle([u0, v0]: [f64; 2], [u1, v1]: [f64; 2]) -> Vec<TrimCurveArrays> {
    polygon(&[[u0, v0], [u1, v0], [u1, v1], [u0, v1]])
}

/// An ellipse with axes along u and v as one rational curve of degree 2, counterclockwise
/// from its largest u.
pub fn ellipse([u, v]: [f64; 2], [a, b]: [f64; 2]) -> Vec<TrimCurveArrays> {
    let corners = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]];
    let control_points = corners.iter().enumerate().map(|(index, &[x, y])| {
        let weight = if index % 2 == 0 { 1.0 } else { FRAC_1_SQRT_2 };
        [u + a * f64::from(x), v + b * f64::from(y), weight]
    });
    vec![TrimCurveArrays {
        degree: 2,
        knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0],
        control_points: control_points.collect(),
        ..TrimCurveArrays::default()
    }]
}

/// A circle, counterclockwise.
pub fn circle(center: [f64; 2], radius: f64) -> Vec<TrimCurveArrays> {
    ellipse(center, [radius, radius])
}

/// The same loop in the other direction.
pub fn reversed(mut curves: Vec<TrimCurveArrays>) -> Vec<TrimCurveArrays> {
    curves.reverse();
    curves.iter_mut().for_each(TrimCurveArrays::reverse);
    curves
}

/// The plane `origin + u x + v y` over a rectangle of u and v.
pub fn plane(origin: [f64; 3], x: [f64; 3], y: [f64; 3], [u, v]: [[f64; 2]; 2]) -> SurfaceArrays {
    let corner = |s: f64, t: f64| {
        let at = |axis: usize| origin[axis] + s * x[axis] + t * y[axis];
        [at(0), at(1), at(2), 1.0]
    };
    SurfaceArrays {
        degree: [1, 1],
        knots: [u, v].map(|[low, high]| vec![low, low, high, high]),
        counts: [2, 2],
        control_points: vec![corner(u[0], v[0]), corner(u[0], v[1]), corner(u[1], v[0]), corner(u[1], v[1])],
    }
}

/// A face without names and gap.
pub fn face(surface: SurfaceArrays, trim: Vec<Vec<TrimCurveArrays>>) -> FaceArrays {
    FaceArrays { surface, trim: Some(trim), reversed: false, part: None, kind: None, gap: 0.0 }
}
