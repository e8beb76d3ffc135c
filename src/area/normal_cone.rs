//! A cone about the normals of a part of a patch: lemma N1 of docs/score.md.

use super::density::Density;
use super::planar::Planar;
use crate::bezier::Patch;
use crate::param_box::ParamBox;
use crate::rounding::gamma;
use glam::DVec3;

/// Returns whether the normals of a plane patch are to the side of a vector; `None` where that is not shown, as where it
/// folds over itself: against their mean they are at most the part of it that areas of planes neglect (lemma A4 of
/// docs/area.md). O(degree³).
pub(crate) fn is_to_side(patch: &Patch<'_>, side: DVec3) -> Option<bool> {
    let plane = Planar::of(&Density::new(patch).series(ParamBox::UNIT))?;
    let along = plane.direction.dot(side);
    (along != 0.0).then_some(along > 0.0)
}

/// The roundings of the sums over coefficients, relative to the sum of their lengths.
const SUM_ROUNDINGS: f64 = 16.0;

/// Returns a unit vector and an upper bound on the tangent of its angle with the normal `S_s × S_t` at each point
/// of a part of [0, 1]², which is nowhere 0; `None` where that is not shown, as at a pole. O(degree³).
///
/// With the Chebyshev coefficients c_kl of the normal's numerator, whose T_k T_l are at most 1, and the direction n
/// of c_00: along n it is at least `|c_00| - Σ |c_kl · n|`, and across n at most `Σ |c_kl - (c_kl · n) n|`.
pub(crate) fn normal_cone(patch: &Patch<'_>, part: ParamBox) -> Option<(DVec3, f64)> {
    let series = Density::new(patch).series(part);
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
    tangent.is_finite().then_some((axis, tangent))
}
