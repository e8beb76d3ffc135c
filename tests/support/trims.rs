//! Loops of trimming curves with known shapes.

use nurbs_hausdorff::SurfaceArrays;
use nurbs_hausdorff::internals::model::trim::{FaceArrays, TrimCurveArrays};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// A Bézier curve with control points `[u, v, w]`.
pub fn bezier(control_points: &[[f64; 3]]) -> TrimCurveArrays {
    let degree = control_points.len() - 1;
    TrimCurveArrays {
        degree,
        knots: [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat(),
        control_points: control_points.to_vec(),
        ..TrimCurveArrays::default()
    }
}

/// A straight line.
pub fn line(from: [f64; 2], to: [f64; 2]) -> TrimCurveArrays {
    bezier(&[[from[0], from[1], 1.0], [to[0], to[1], 1.0]])
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

/// A circle of `count` rational quadratic arcs, counterclockwise from the angle `start`.
pub fn arcs(center: [f64; 2], radius: f64, start: f64, count: usize) -> Vec<TrimCurveArrays> {
    let half = PI / count as f64;
    let at = |angle: f64, radius: f64| [center[0] + radius * angle.cos(), center[1] + radius * angle.sin()];
    let corner = |k: usize| at(start + 2.0 * half * (k % count) as f64, radius);
    let arc = |k: usize| {
        let middle = at(start + half * (2 * k + 1) as f64, radius / half.cos());
        let ([a, b], [c, d]) = (corner(k), corner(k + 1));
        bezier(&[[a, b, 1.0], [middle[0], middle[1], half.cos()], [c, d, 1.0]])
    };
    (0..count).map(arc).collect()
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
    FaceArrays::new(surface, Some(trim))
}

/// The quarter circles of radius 1 from angle 0, as control points `[cos, sin, w]` of a
/// rational B-spline curve of degree 2 with knots at 0, 1, 2, …
pub fn quarters(count: usize) -> (Vec<[f64; 3]>, Vec<f64>) {
    let unit = [
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [-1.0, 1.0],
        [-1.0, 0.0],
        [-1.0, -1.0],
        [0.0, -1.0],
        [1.0, -1.0],
    ];
    let points = (0..=2 * count).map(|index| {
        let [x, y] = unit[index % 8];
        [x, y, if index % 2 == 0 { 1.0 } else { FRAC_1_SQRT_2 }]
    });
    let mut knots = vec![0.0; 3];
    for knot in 1..count {
        knots.extend([knot as f64; 2]);
    }
    knots.extend([count as f64; 3]);
    (points.collect(), knots)
}

/// Returns the parameter of an angle, 0 or more, on [`quarters`]: on a quarter of middle m
/// and half angle a, `t = m + a tan((angle - m) / 2) / tan(a / 2)` scaled to length 1.
pub fn quarter_parameter(angle: f64) -> f64 {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, FRAC_PI_8};
    let quarter = (angle / FRAC_PI_2).floor();
    let from_middle = angle - quarter * FRAC_PI_2 - FRAC_PI_4;
    quarter + 0.5 + 0.5 * (0.5 * from_middle).tan() / FRAC_PI_8.tan()
}

/// The surface swept by [`quarters`] of `radius` in the plane of `x` and `y` about `center`
/// along `axis`, over heights from `low` to `high`: u is the quarters' parameter, v the height.
pub fn cylinder(
    center: [f64; 3],
    [x, y, axis]: [[f64; 3]; 3],
    radius: f64,
    [low, high]: [f64; 2],
    count: usize,
) -> SurfaceArrays {
    let (points, knots) = quarters(count);
    let mut control_points = Vec::new();
    for [c, s, w] in points {
        for height in [low, high] {
            let at = |k: usize| center[k] + radius * (c * x[k] + s * y[k]) + height * axis[k];
            control_points.push([at(0), at(1), at(2), w]);
        }
    }
    SurfaceArrays {
        degree: [2, 1],
        knots: [knots, vec![low, low, high, high]],
        counts: [2 * count + 1, 2],
        control_points,
    }
}

/// The sphere about the origin with its poles at `∓axis`: u is the longitude's parameter
/// from 0 to 4, v that of the angle from the south pole, from 0 to 2, both by [`quarters`].
pub fn ball(radius: f64, [x, y, axis]: [[f64; 3]; 3]) -> SurfaceArrays {
    let ((longitudes, knots_u), (meridian, knots_v)) = (quarters(4), quarters(2));
    let mut control_points = Vec::new();
    for &[c, s, w] in &longitudes {
        for &[height, reach, of_meridian] in &meridian {
            let at = |k: usize| radius * (reach * (c * x[k] + s * y[k]) - height * axis[k]);
            control_points.push([at(0), at(1), at(2), w * of_meridian]);
        }
    }
    SurfaceArrays { degree: [2, 2], knots: [knots_u, knots_v], counts: [9, 5], control_points }
}

/// A cubic B-spline curve through `segments` + 1 points of `curve` over [0, 1] with its
/// tangents there: the error is that of cubic Hermite interpolation.
pub fn fitted(segments: usize, curve: impl Fn(f64) -> [f64; 2]) -> TrimCurveArrays {
    /// The step of the central differences, whose error is of its second order.
    const STEP: f64 = 1e-5;
    let length = 1.0 / segments as f64;
    let mut control_points = Vec::new();
    let mut knots = vec![0.0; 4];
    for segment in 0..=segments {
        let t = segment as f64 * length;
        let (point, low, high) = (curve(t), curve(t - STEP), curve(t + STEP));
        let third = [0, 1].map(|axis| (high[axis] - low[axis]) / (2.0 * STEP) * length / 3.0);
        if segment > 0 {
            control_points.push([point[0] - third[0], point[1] - third[1], 1.0]);
        }
        control_points.push([point[0], point[1], 1.0]);
        if segment < segments {
            control_points.push([point[0] + third[0], point[1] + third[1], 1.0]);
        }
        if segment > 0 {
            knots.extend(vec![t; if segment == segments { 4 } else { 3 }]);
        }
    }
    TrimCurveArrays { degree: 3, knots, control_points, ..TrimCurveArrays::default() }
}
