//! Areas of trimmed faces by Green's theorem, from the definition of B-splines.

use crate::support::evaluator::{Vector, evaluate, length};
use nurbs_hausdorff::internals::model::Face;
use nurbs_hausdorff::internals::model::trim::TrimPiece;
use nurbs_hausdorff::{Axis, NurbsSurface};

/// Gauss's rule of 8 points on [-1, 1]: nodes and weights of the positive half.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_5],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
];

/// Parts of every piece of a curve, which may cross knots of the surface, and of every
/// span of the surface.
const PARTS: usize = 8;
const SPAN_PARTS: usize = 2;

/// The ends of the parts of the spans between two parameters.
fn breaks(knots: &[f64], [start, end]: [f64; 2]) -> Vec<f64> {
    let inner = knots.iter().copied().filter(|&knot| knot > start && knot < end);
    let mut spans: Vec<f64> = std::iter::once(start).chain(inner).chain([end]).collect();
    spans.dedup();
    let parts = spans.windows(2).flat_map(|pair| {
        (0..SPAN_PARTS).map(move |part| pair[0] + (pair[1] - pair[0]) * part as f64 / SPAN_PARTS as f64)
    });
    parts.chain([end]).collect()
}

fn integral([start, end]: [f64; 2], f: &mut dyn FnMut(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
    let pairs =
        GAUSS.iter().map(|&[node, weight]| weight * (f(middle - half * node) + f(middle + half * node)));
    half * pairs.sum::<f64>()
}

/// The point (u, v) of a piece and its derivative by u and v.
pub(crate) fn on_piece(piece: &TrimPiece, t: f64) -> [[f64; 2]; 2] {
    let mut controls = piece.controls.clone();
    let degree = controls.len() - 1;
    while controls.len() > 2 {
        controls = controls.windows(2).map(|pair| (1.0 - t) * pair[0] + t * pair[1]).collect();
    }
    let value = (1.0 - t) * controls[0] + t * controls[1];
    let slope = degree as f64 * (controls[1] - controls[0]);
    let point = [value.x / value.z, value.y / value.z];
    [point, [(slope.x - slope.z * point[0]) / value.z, (slope.y - slope.z * point[1]) / value.z]]
}

/// The density of area at (u, v).
fn density(surface: &NurbsSurface, u: f64, v: f64) -> f64 {
    let jet = evaluate(surface, u, v, [0.0; 3]);
    let [a, b] = [jet.u, jet.v];
    let cross: Vector = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    length(cross)
}

/// The area of a face: the integral over its loops of F dv, where F is the integral of
/// the density from the least u.
pub(crate) fn area(face: &Face<'_>) -> f64 {
    let surface = face.surface();
    let knots = surface.knots(Axis::U);
    let start = surface.domain()[Axis::U][0];
    let primitive = |u: f64, v: f64| -> f64 {
        let breaks = breaks(knots, [start, u]);
        breaks.windows(2).map(|pair| integral([pair[0], pair[1]], &mut |u| density(surface, u, v))).sum()
    };
    let Some(trim) = face.trim() else {
        let [[_, u1], v] = [surface.domain()[Axis::U], surface.domain()[Axis::V]];
        return breaks(surface.knots(Axis::V), v)
            .windows(2)
            .map(|pair| integral([pair[0], pair[1]], &mut |v| primitive(u1, v)))
            .sum();
    };
    let mut area = 0.0;
    for piece in trim.loops().iter().flatten() {
        for part in 0..PARTS {
            let range = [part as f64 / PARTS as f64, (part + 1) as f64 / PARTS as f64];
            area += integral(range, &mut |t| {
                let [[u, v], [_, dv]] = on_piece(piece, t);
                if dv == 0.0 { 0.0 } else { primitive(u, v) * dv }
            });
        }
    }
    area
}

/// Points of a face's loops in space, with their loop.
pub(crate) fn loop_points(face: &Face<'_>) -> Vec<(usize, Vector)> {
    let mut points = Vec::new();
    for (index, pieces) in face.trim().unwrap().loops().iter().enumerate() {
        for piece in pieces {
            for step in 0..=8 {
                let [[u, v], _] = on_piece(piece, f64::from(step) / 8.0);
                points.push((index, evaluate(face.surface(), u, v, [0.0; 3]).point));
            }
        }
    }
    points
}

/// Points of a face's surface over its whole domain.
pub(crate) fn surface_points(face: &Face<'_>) -> Vec<Vector> {
    crate::support::evaluator::parameters(face.surface(), 17)
        .into_iter()
        .map(|[u, v]| evaluate(face.surface(), u, v, [0.0; 3]).point)
        .collect()
}
