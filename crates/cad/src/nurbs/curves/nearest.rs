//! Parameters of points on curves.

use crate::nurbs::conic::Conic;
use crate::nurbs::curve::Curve;
use glam::DVec3;

/// The samples of every polynomial piece of a curve among which the search begins.
const SAMPLES: usize = 16;

/// The most samples of a curve; of one with more pieces the pieces are passed over evenly.
const MAX_SAMPLES: usize = 1 << 16;

/// The most Gauss-Newton steps; about five suffice near the curve.
const MAX_STEPS: usize = 32;

/// The part of the range below which a step has converged.
const CONVERGED: f64 = 1e-16;

/// Returns the parameter of the point of a curve that is nearest to a given one, for points
/// near the curve: in closed form for lines and conics, by samples and Gauss-Newton steps for
/// others. `None` for a curve without a range. O(pieces).
pub(crate) fn nearest_parameter(curve: &Curve, point: DVec3) -> Option<f64> {
    match curve {
        Curve::Line { point: origin, direction } => {
            Some((point - *origin).dot(*direction) / direction.length_squared())
        }
        Curve::Conic { conic, center, x, y } => {
            let [a, b] = [x, y].map(|axis| (point - *center).dot(*axis) / axis.length_squared());
            Some(match conic {
                Conic::Elliptic => b.atan2(a),
                Conic::Parabolic => b,
                Conic::Hyperbolic => b.asinh(),
            })
        }
        Curve::Trimmed { basis, .. } => nearest_parameter(basis, point),
        Curve::Spline(_) | Curve::Offset { .. } => {
            let range = curve.natural_range()?;
            let distance = |t: f64| curve.point(t).distance_squared(point);
            let first = samples(curve, range).min_by(|&a, &b| distance(a).total_cmp(&distance(b)))?;
            let found = polished(curve, point, first, range);
            // The ends of a closed curve are one point, and the nearest one may be beside either.
            let [start, end] = range;
            let other = [(start, end), (end, start)].into_iter().find(|&(at, _)| at == found);
            let beside = other.map(|(_, other)| polished(curve, point, other, range));
            Some(beside.filter(|&beside| distance(beside) < distance(found)).unwrap_or(found))
        }
    }
}

/// Returns parameters of every polynomial piece, with both ends.
fn samples(curve: &Curve, [start, end]: [f64; 2]) -> impl Iterator<Item = f64> {
    let mut breaks = vec![start];
    let mut last = start;
    while last < end && breaks.len() <= MAX_SAMPLES / SAMPLES {
        // Just behind a knot begins the next piece.
        let next = curve.cell(last)[1].min(end);
        if next <= last {
            break;
        }
        last = next;
        breaks.push(last);
    }
    if last < end {
        breaks.push(end);
    }
    let pieces: Vec<[f64; 2]> = breaks.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let inside = pieces.into_iter().flat_map(|[low, high]| {
        (0..SAMPLES).map(move |sample| low + (high - low) * sample as f64 / SAMPLES as f64)
    });
    inside.chain([end])
}

/// Minimises the distance by Gauss-Newton steps, halved until it falls.
fn polished(curve: &Curve, point: DVec3, mut at: f64, [start, end]: [f64; 2]) -> f64 {
    let residual = |t: f64| point - curve.point(t);
    let mut distance = residual(at).length_squared();
    for _ in 0..MAX_STEPS {
        let tangent = curve.tangent(at);
        let step = residual(at).dot(tangent) / tangent.length_squared();
        if !step.is_finite() || step.abs() <= CONVERGED * (end - start) {
            break;
        }
        let mut factor = 1.0;
        let better = (0..8).find_map(|_| {
            let next = (at + factor * step).clamp(start, end);
            factor *= 0.5;
            let length = residual(next).length_squared();
            (length < distance).then_some((next, length))
        });
        let Some((next, length)) = better else { break };
        (at, distance) = (next, length);
    }
    at
}
