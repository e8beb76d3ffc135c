//! NURBS surfaces by definition: the Cox-de Boor recursion, written down as it
//! stands in the textbook and with nothing of the crate's own evaluation.

use nurbs_hausdorff::{Axis, NurbsSurface};

pub type Vector = [f64; 3];

/// A point, relative to the given origin, and derivatives by u and v.
#[derive(Debug, Clone, Copy)]
pub struct Evaluation {
    pub point: Vector,
    pub u: Vector,
    pub v: Vector,
    pub uu: Vector,
    pub uv: Vector,
    pub vv: Vector,
}

/// `numerator / denominator`, where 0/0 counts as 0 as in the definition.
fn quotient(numerator: f64, denominator: f64) -> f64 {
    if denominator == 0.0 { 0.0 } else { numerator / denominator }
}

/// N_{i,p}(t), with N_{i,0} the indicator of span i (The NURBS Book, eq. 2.5).
fn basis(knots: &[f64], span: usize, i: usize, p: usize, t: f64) -> f64 {
    if p == 0 {
        return if i == span { 1.0 } else { 0.0 };
    }
    if i > span || span > i + p {
        return 0.0;
    }
    quotient(t - knots[i], knots[i + p] - knots[i]) * basis(knots, span, i, p - 1, t)
        + quotient(knots[i + p + 1] - t, knots[i + p + 1] - knots[i + 1])
            * basis(knots, span, i + 1, p - 1, t)
}

/// The `order`-th derivative of N_{i,p} at t (The NURBS Book, eq. 2.9).
fn derivative(knots: &[f64], span: usize, i: usize, p: usize, order: usize, t: f64) -> f64 {
    if order == 0 {
        return basis(knots, span, i, p, t);
    }
    if p == 0 {
        return 0.0;
    }
    let lower = |i: usize| derivative(knots, span, i, p - 1, order - 1, t);
    p as f64
        * (quotient(lower(i), knots[i + p] - knots[i])
            - quotient(lower(i + 1), knots[i + p + 1] - knots[i + 1]))
}

/// The non-empty span of the domain [knots[p], knots[n]] that `t` lies in.
fn span(knots: &[f64], degree: usize, count: usize, t: f64) -> usize {
    let mut found = degree;
    for index in degree..count {
        if knots[index] < knots[index + 1] && knots[index] <= t {
            found = index;
        }
    }
    found
}

/// The surface at (u, v); `origin` is taken off the control points first.
///
/// At a knot the span above it is meant, at the domain's end the last one.
pub fn evaluate(surface: &NurbsSurface, u: f64, v: f64, origin: Vector) -> Evaluation {
    let at =
        |axis: Axis, t: f64| span(surface.knots(axis), surface.degree()[axis], surface.counts()[axis], t);
    evaluate_on_span(surface, [at(Axis::U, u), at(Axis::V, v)], u, v, origin)
}

/// As [`evaluate`], by the polynomial piece of the spans that begin at knots `spans`.
pub fn evaluate_on_span(
    surface: &NurbsSurface,
    spans: [usize; 2],
    u: f64,
    v: f64,
    origin: Vector,
) -> Evaluation {
    let degree = surface.degree();
    let of_axis = |axis: Axis, order: usize, t: f64| -> Vec<f64> {
        (spans[axis] - degree[axis]..=spans[axis])
            .map(|i| derivative(surface.knots(axis), spans[axis], i, degree[axis], order, t))
            .collect()
    };
    let in_u = [0, 1, 2].map(|order| of_axis(Axis::U, order, u));
    let in_v = [0, 1, 2].map(|order| of_axis(Axis::V, order, v));
    let sum = |a: usize, b: usize| {
        let mut sum = [0.0; 4];
        for (i, n) in in_u[a].iter().enumerate() {
            for (j, m) in in_v[b].iter().enumerate() {
                let row = spans[0] - degree[0] + i;
                let column = spans[1] - degree[1] + j;
                let [x, y, z, w] = surface.control_points()[row * surface.counts()[1] + column];
                for (sum, value) in sum.iter_mut().zip([x - origin[0], y - origin[1], z - origin[2], 1.0]) {
                    *sum += n * m * w * value;
                }
            }
        }
        sum
    };
    let [a, au, av, auu, auv, avv] = [sum(0, 0), sum(1, 0), sum(0, 1), sum(2, 0), sum(1, 1), sum(0, 2)];
    // The quotient rule, by hand from S w = A.
    let w = a[3];
    let each = |value: &dyn Fn(usize) -> f64| [0, 1, 2].map(value);
    let point = each(&|k| a[k] / w);
    let du = each(&|k| (au[k] - au[3] * point[k]) / w);
    let dv = each(&|k| (av[k] - av[3] * point[k]) / w);
    Evaluation {
        point,
        u: du,
        v: dv,
        uu: each(&|k| (auu[k] - auu[3] * point[k] - 2.0 * au[3] * du[k]) / w),
        uv: each(&|k| (auv[k] - auv[3] * point[k] - au[3] * dv[k] - av[3] * du[k]) / w),
        vv: each(&|k| (avv[k] - avv[3] * point[k] - 2.0 * av[3] * dv[k]) / w),
    }
}

/// The point alone, in the model's own coordinates.
pub fn point(surface: &NurbsSurface, u: f64, v: f64) -> Vector {
    evaluate(surface, u, v, [0.0; 3]).point
}

/// `count` x `count` parameters evenly over the domain, its ends included.
pub fn parameters(surface: &NurbsSurface, count: usize) -> Vec<[f64; 2]> {
    let [u, v] = surface.domain().intervals();
    let at = |[start, end]: [f64; 2], index: usize| {
        let fraction = index as f64 / (count - 1) as f64;
        (1.0 - fraction) * start + fraction * end
    };
    (0..count * count).map(|index| [at(u, index / count), at(v, index % count)]).collect()
}

pub fn length(vector: Vector) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

pub fn distance(a: Vector, b: Vector) -> f64 {
    length([a[0] - b[0], a[1] - b[1], a[2] - b[2]])
}
