//! A cone about the normals of a part of a patch: lemma N1 of docs/score.md.

use super::Area;
use super::cell::part_size;
use super::density::Density;
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::param_box::ParamBox;
use crate::rounding::{gamma, upper_max};
use crate::sorting::ordered_by;
use glam::DVec3;
use std::collections::BinaryHeap;

/// The parts of a plane patch after which its side is left open: those that fold are a corner of it.
const MAX_PARTS_OF_PLANE: usize = 128;

/// Returns whether most of the area of a plane patch has its normals to the side of a unit vector; `None` where that is not
/// shown. The map of a piece's parameters may fold over itself at a corner, where its face does not. O(degree³) for each
/// part.
///
/// With the coefficients of N1, N along the vector is within `Σ' |c_kl|` of c_00 on a part; where it has one sign, its mean
/// by the largest and the least weight bounds the part's area to that side, and elsewhere `Σ |c_kl|` that to either.
pub(crate) fn is_to_side(patch: &Patch<'_>, side: DVec3) -> Option<bool> {
    let density = Density::new(patch);
    let heaviest = patch.controls.iter().map(|control| control.w).fold(0.0, upper_max);
    let new = |part| PlanePart::new(&density, part, side);
    let (mut against, mut along, mut parts) = (Area::default(), Area::default(), 1);
    let mut open = BinaryHeap::from([new(ParamBox::UNIT)]);
    while let Some(found) = open.pop() {
        let PlanePart { part, middle, spread, mean, .. } = found;
        if middle.abs() > spread {
            let size = part_size(part);
            let [least, most] = [-found.rounding, found.rounding].map(|error| mean.abs() + error);
            let lower = size * least / (heaviest * heaviest * heaviest) * (1.0 - gamma(SUM_ROUNDINGS));
            let area = Area { lower, upper: size * density.upper_bound(most) };
            let of_side = if middle > 0.0 { &mut along } else { &mut against };
            *of_side = *of_side + area;
        } else if parts < MAX_PARTS_OF_PLANE {
            parts += 1;
            open.extend(part.halves(found.axis).map(new));
        } else {
            return None;
        }
        let left: f64 = open.iter().map(|part| part.upper).sum::<f64>() * (1.0 + gamma(parts as f64));
        // Not "at most", so that NaN decides nothing.
        if along.lower > against.upper + left {
            return Some(true);
        }
        if against.lower > along.upper + left {
            return Some(false);
        }
    }
    None
}

/// A part of a plane patch with N along a unit vector.
struct PlanePart {
    part: ParamBox,
    /// N is along the vector within the spread of the middle.
    middle: f64,
    spread: f64,
    /// The mean of N along the vector, and an upper bound on its rounding.
    mean: f64,
    rounding: f64,
    /// An upper bound on the area.
    upper: f64,
    /// The axis along which N changes more.
    axis: Axis,
}

ordered_by!(PlanePart, |part| part.upper);

impl PlanePart {
    fn new(density: &Density<'_>, part: ParamBox, side: DVec3) -> Self {
        let series = density.series(part);
        let (mut middle, mut mean, mut changes, mut sizes) = (0.0, 0.0, [0.0; 2], 0.0);
        for (index, coefficient) in series.numerator.iter().enumerate() {
            let along = coefficient.dot(side);
            sizes += coefficient.length();
            let orders = [index / series.counts[1], index % series.counts[1]];
            mean += along * mean_of(orders[0]) * mean_of(orders[1]);
            match orders {
                [0, 0] => middle = along,
                [of_s, of_t] => changes[usize::from(of_s < of_t)] += along.abs(),
            }
        }
        let count = series.numerator.len() as f64;
        let rounding = count * series.rounding + gamma(SUM_ROUNDINGS + count) * sizes;
        let upper = part_size(part) * density.upper_bound(sizes + rounding);
        let axis = if changes[0] > changes[1] { Axis::U } else { Axis::V };
        let spread = changes[0] + changes[1] + rounding;
        Self { part, middle, spread, mean, rounding, upper, axis }
    }
}

/// Returns the mean of the Chebyshev polynomial T_k over [-1, 1].
fn mean_of(order: usize) -> f64 {
    if order.is_multiple_of(2) { 1.0 / (1.0 - (order * order) as f64) } else { 0.0 }
}

/// The roundings of the sums over coefficients, relative to the sum of their lengths.
const SUM_ROUNDINGS: f64 = 16.0;

/// Returns a unit vector and an upper bound on the tangent of its angle with the normal `S_s × S_t` at each point
/// of a part of [0, 1]², which is nowhere 0; `None` where that is not shown, as at a pole, and where a normal refutes it.
/// O(degree³).
///
/// With the Chebyshev coefficients c_kl of the normal's numerator, whose T_k T_l are at most 1, and the direction n
/// of c_00: along n it is at least `|c_00| - Σ |c_kl · n|`, and across n at most `Σ |c_kl - (c_kl · n) n|`.
pub(crate) fn normal_cone(patch: &Patch<'_>, part: ParamBox) -> Option<(DVec3, f64)> {
    let density = Density::new(patch);
    let series = density.series(part);
    let (&first, others) = series.numerator.split_first()?;
    let axis = first.try_normalize()?;
    let (mut along, mut across, mut sizes) = (0.0, 0.0, first.length());
    for coefficient in others {
        along += coefficient.dot(axis).abs();
        across += coefficient.reject_from_normalized(axis).length();
        sizes += coefficient.length();
    }
    let count = series.numerator.len() as f64;
    let rounding = count * series.rounding + gamma(SUM_ROUNDINGS + count) * sizes;
    let least = first.length() - along - rounding;
    // Not "at most 0", so that NaN is refused.
    if !(least > 0.0) {
        return None;
    }
    let tangent = (across + rounding) / least * (1.0 + gamma(SUM_ROUNDINGS));
    (tangent.is_finite() && !is_refuted(&density, part, (axis, tangent))).then_some((axis, tangent))
}

/// The audit of a cone: returns whether the normal's numerator at a corner of the part, in the middle of a side or in
/// its own middle, is certainly outside. It uses no series. O(degree²).
fn is_refuted(density: &Density<'_>, part: ParamBox, (axis, tangent): (DVec3, f64)) -> bool {
    let [in_s, in_t] = [0, 1].map(|of| {
        let [start, end] = part[of];
        [start, 0.5 * (start + end), end]
    });
    let is_outside = |numerator: DVec3| {
        let along = numerator.dot(axis);
        let across = numerator.reject_from_normalized(axis).length();
        let rounding = density.rounding + gamma(SUM_ROUNDINGS) * numerator.length();
        // Not "more than", so that NaN refutes.
        !(across <= tangent * along + (1.0 + tangent) * rounding)
    };
    density.values([&in_s, &in_t]).into_iter().any(|(numerator, _)| is_outside(numerator))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::bezier::quarter_of_cylinder;

    /// The normals of a quarter of a cylinder turn by 45 degrees from the middle one to either side.
    #[test]
    fn an_audit_refutes_cones_that_are_too_narrow_or_elsewhere() {
        let controls = quarter_of_cylinder();
        let patch = Patch::whole([2, 1], DVec3::ZERO, &controls);
        let density = Density::new(&patch);
        let refuted = |x: f64, y: f64, tangent: f64| {
            is_refuted(&density, ParamBox::UNIT, (DVec3::new(x, y, 0.0).normalize(), tangent))
        };
        assert!(!refuted(1.0, 1.0, 1.0) && refuted(1.0, 1.0, 1.0 - 1e-9), "the tangent of 45 degrees is 1");
        assert!(refuted(-1.0, -1.0, 1.0), "to the other side");
        assert!(refuted(1.0, 0.9, 1.0) && refuted(1.0, 1.0, f64::NAN));
    }

    /// A quadrilateral with a corner turned in folds there: its normals have the sizes 9, 1.5, 1.5 and −6 at the corners,
    /// linear between. With that corner at the first one as much is to either side, and none is known. With weights the
    /// sides have the areas 0.39 and 1.89, and 1.59 and 0.09, though the means of N over the parameters say the opposite: of
    /// the weights' range alone, up to 512 for the cubes, neither follows.
    #[test]
    fn the_side_of_a_plane_patch_that_folds_is_that_of_most_of_its_area() {
        let side_of = |corners: [[f64; 2]; 4], weights: [f64; 4], up: f64| {
            let controls = [0, 1, 2, 3].map(|index| {
                let [x, y] = corners[index];
                (weights[index] * DVec3::new(x, y, 1.0)).extend(weights[index])
            });
            is_to_side(&Patch::whole([1, 1], DVec3::ZERO, &controls), up * DVec3::Z)
        };
        let turned_in = |x: f64| [[0.0, 0.0], [0.0, 3.0], [3.0, 0.0], [x, x]];
        // Sides of 1 and −1.5 across: areas of 0.2 and 0.45.
        let crossed = [[0.0, 0.0], [1.25, 1.0], [1.0, 0.0], [-0.25, 1.0]];
        for (corners, weights, expected) in [
            (turned_in(3.0), [1.0; 4], Some(true)),
            (turned_in(0.5), [1.0; 4], Some(true)),
            (turned_in(0.0), [1.0; 4], None),
            (turned_in(-0.5), [1.0; 4], Some(false)),
            (turned_in(-0.5), [4.0, 1.0, 1.0, 1.0], None),
            (turned_in(0.5), [1.0, 1.0, 1.0, 8.0], None),
            (crossed, [1.0; 4], Some(false)),
            (crossed, [8.0, 1.0, 8.0, 1.0], None),
        ] {
            assert_eq!(side_of(corners, weights, 1.0), expected, "{corners:?} {weights:?}");
            let back = side_of(corners, weights, -1.0);
            assert_eq!(back, expected.map(|is_up| !is_up), "{corners:?} {weights:?}");
        }
        assert_eq!(side_of(turned_in(f64::NAN), [1.0; 4], 1.0), None);
    }
}
