//! Pieces over a part of a knot rectangle of their surface, with its degrees: compared by control points.
//!
//! With X/w the piece about a centre, Y/ω the surface's patch restricted to the part, |Y/ω| at most ρ:
//! |X/w - Y/ω| = |(X - Y) - (Y/ω)(w - ω)|/w is at most (max |X_i - Y_i| + ρ max |w_i - ω_i|)/min w_i,
//! as polynomials are convex combinations of their control points.

use super::Face;
use super::values::rectangle;
use crate::proof::bezier::{Homogeneous, Net};
use crate::proof::interval::Interval;
use crate::proof::vector::{Vector, difference, exactly, middle, norm};

/// Whether a patch over this box of the face's parameters is the surface there, to the limit; no answer
/// where degrees or weights differ.
pub(super) fn is_same(face: &Face<'_>, net: &Net, ranges: [[f64; 2]; 2]) -> bool {
    let Some(number) = rectangle(face, ranges.map(|[low, high]| 0.5 * (low + high))) else { return false };
    let patch = &face.patches[number];
    if patch.net.degree != net.degree {
        return false;
    }
    let (mut own, mut moved) = (patch.net.clone(), Interval::ZERO);
    for (axis, ends) in ranges.into_iter().enumerate() {
        let [start, end] = patch.ranges[axis].map(Interval::point);
        let local = ends.map(|at| (Interval::point(at) - start) / (end - start));
        let range = local.map(|at| at.mid().clamp(0.0, 1.0));
        own = own.restrict(axis, range);
        let slips = [0, 1].map(|k| Interval::point((local[k] - Interval::point(range[k])).magnitude()));
        moved = moved + Interval::point(face.bends[number].first[axis]) * slips[0].hull(slips[1]);
    }
    distance(net, &own).is_some_and(|distance| (distance + moved).hi <= face.limit)
}

/// An upper bound on the distance of two patches of the same degrees at the same parameters.
fn distance(net: &Net, own: &Net) -> Option<Interval> {
    let center = exactly(middle(&own.corners()[0]));
    let about = |point: &Homogeneous| -> Vector { std::array::from_fn(|k| point[k] - center[k] * point[3]) };
    let largest = |values: &mut dyn Iterator<Item = Interval>| {
        values.map(|value| Interval::point(value.magnitude())).fold(Interval::ZERO, Interval::hull)
    };
    let pairs = || net.points.iter().zip(&own.points);
    let apart = largest(&mut pairs().map(|(a, b)| norm(&difference(&about(a), &about(b)))));
    let weights = largest(&mut pairs().map(|(a, b)| a[3] - b[3]));
    let radius = largest(&mut own.hull_points().map(|point| norm(&difference(&point, &center))));
    let least = net.points.iter().map(|point| point[3]).reduce(Interval::hull)?.lo;
    (least > 0.0).then(|| (apart + radius * weights) / Interval::point(least))
}
