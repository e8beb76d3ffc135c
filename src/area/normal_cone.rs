//! A cone about the normals of a part of a patch: lemma N1 of docs/score.md.

use super::density::Density;
use crate::bezier::Patch;
use crate::param_box::ParamBox;
use crate::rounding::gamma;
use glam::DVec3;

/// Returns whether the mean of the normals of a patch is to the side of a vector; `None` where that is not shown. O(degree³).
pub(crate) fn is_to_side(patch: &Patch<'_>, side: DVec3) -> Option<bool> {
    let series = Density::new(patch).series(ParamBox::UNIT);
    let level = series.numerator.first()?.dot(side);
    let rounding =
        (series.rounding + gamma(SUM_ROUNDINGS) * series.numerator.first()?.length()) * side.length();
    (level.abs() > rounding).then_some(level > 0.0)
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
