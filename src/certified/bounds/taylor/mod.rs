//! The bound by Taylor's theorem, of third order in the cell's size.
//!
//! For any map φ of the cell into the parameters of a patch of B,
//! `max d(a, B) <= max |A - B∘φ|`, so no global minimum is needed. Let `Q` be
//! the Taylor quadratic of `D = A - B∘φ` at the centre. Then `|D - Q| <= R_A +
//! R_B`, the remainders of third order, and `|Q|` is bounded by its Bernstein
//! coefficients ([`Quadratic`]). Where a patch was cut from its neighbour, φ may
//! leave it by a little: its control net represents the neighbour's points too.
//!
//! φ is the linearization of the foot, constant where that is singular. The
//! bound is of third order where the distance is positive, as what D does along
//! B then counts by its square only.

mod halving;
mod linear;
mod means;
mod quadratic;

pub(in crate::certified) use halving::halved_sides;
pub(in crate::certified) use linear::Linear;
pub(in crate::certified) use means::{Lengths, distance_above, distance_from};
pub use quadratic::Quadratic;
pub(super) use quadratic::max_coefficient;
use quadratic::mean_of_biquartic;

use super::super::cell_context::{CellContext, TaylorBound, UpperBound};
use super::super::nearest::Foot;
use super::super::reparametrization::Reparametrization;
use super::super::rounding::{JET_ROUNDINGS, MOVED_JET_ROUNDINGS, UNIT_ROUNDOFF};
use super::super::sheets::{Chart, Over, Reach};
use crate::axis::Axis;
use crate::bezier::{DerivativeBounds, Jet};
use crate::certified::audit::Lemma;
use crate::param_box::ParamBox;
use glam::DVec3;

/// The bound from the nearest known foot over one patch of B.
pub(super) struct Taylor;

impl UpperBound for Taylor {
    fn lemma(&self) -> Lemma {
        Lemma::Taylor
    }

    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64> {
        let foot = context.foot();
        if let Some(known) = context.taylor.filter(|known| known.foot == foot) {
            return Some(known.bound);
        }
        let facing = CellPair::new(context, &foot);
        let difference = facing.difference();
        let bound = difference.upper_bound(threshold);
        // NaN is no bound.
        let is_decided = bound <= threshold;
        let may_cross_seams = !is_decided && difference.is_near_beyond(threshold);
        context.taylor = Some(TaylorBound { foot, jet: facing.jet, bound, may_cross_seams });
        Some(bound)
    }
}

/// The same over the seams of B's patch, after [`Taylor`] and where its map left the patch.
pub(super) struct TaylorAcrossSeams;

impl UpperBound for TaylorAcrossSeams {
    fn lemma(&self) -> Lemma {
        Lemma::TaylorAcrossSeams
    }

    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64> {
        let known = context.taylor.filter(|known| known.may_cross_seams)?;
        let facing = CellPair::with_jet(context, known.foot, known.jet);
        let across = facing.across_seams().map(|difference| difference.upper_bound(threshold));
        let bound = match across {
            Some(across) if across < known.bound || known.bound.is_nan() => across,
            _ => known.bound,
        };
        context.taylor = Some(TaylorBound { bound, may_cross_seams: false, ..known });
        across
    }
}

/// By how much about the latest Taylor bound falls if the cell is halved about its centre along s, and
/// along t; over seams where the map leaves B's patch.
fn gains_of_halving(context: &CellContext<'_>) -> Option<[f64; 2]> {
    let TaylorBound { foot, jet, .. } = context.taylor?;
    let facing = CellPair::with_jet(context, foot, jet);
    let difference = facing.difference();
    let across = if difference.is_clamped { facing.across_seams() } else { None };
    Some(across.unwrap_or(difference).gains_of_halving())
}

/// Roundings of a sum of remainders, relative to it.
const REMAINDER_ROUNDINGS: f64 = 64.0;

/// Roundings of a coefficient of `|Q|²`, relative to the square of the size of
/// Q's terms (lemma R8).
const COEFFICIENT_ROUNDINGS: f64 = 40.0;

/// An upper bound on the rounding error of the coefficients of `|Q|²`.
pub(super) fn coefficient_error(quadratic: &Quadratic) -> f64 {
    COEFFICIENT_ROUNDINGS * UNIT_ROUNDOFF * quadratic.size().powi(2)
}

/// An upper bound on `|Q|` over the square, with the rounding of its squared coefficients.
fn max_length(quadratic: &Quadratic) -> f64 {
    (quadratic.max_length_squared() + coefficient_error(quadratic)).sqrt()
}

/// Derivative bounds over whole patches, or over the parts of them that are
/// touched, which are closer and cost more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bounds {
    Patch,
    Local,
}

/// A cell of A and a foot of its centre, from which maps into B's patch are made.
pub(super) struct CellPair<'a> {
    context: &'a CellContext<'a>,
    foot: Foot,
    /// B's jet at the foot.
    jet: Jet,
    /// Where B's patch and its extension end.
    domain: ParamBox,
    /// The parameters that are constant under the map: the foot is on an edge
    /// beyond which B would be nearer.
    frozen: [bool; 2],
}

impl<'a> CellPair<'a> {
    pub(super) fn new(context: &'a CellContext<'a>, foot: &Foot) -> Self {
        let b = &context.pair.b;
        Self::with_jet(context, *foot, b.patch(foot.patch).jet(foot.parameters))
    }

    /// The same, given B's jet at the foot.
    fn with_jet(context: &'a CellContext<'a>, foot: Foot, jet: Jet) -> Self {
        let residual = jet.point - context.jet.point;
        let domain = context.pair.b.room(foot.patch);
        let frozen = [0, 1].map(|axis| {
            let [low, high] = domain[axis];
            let gradient = residual.dot(if axis == 0 { jet.s } else { jet.t });
            let parameter = foot.parameters[axis];
            (parameter <= low && gradient > 0.0) || (parameter >= high && gradient < 0.0)
        });
        Self { context, foot, jet, domain, frozen }
    }

    /// The foot's linearization, or the constant map where that is singular.
    pub(super) fn linearized(&self) -> Reparametrization {
        let (a, [h, k]) = (&self.context.jet, self.context.cell.half);
        let residual = self.jet.point - a.point;
        Reparametrization::linearized(&self.jet, residual, [h * a.s, k * a.t], self.frozen)
            .unwrap_or(Reparametrization::CONSTANT)
    }

    /// `A - B∘φ` with φ the foot's linearization clamped to B's patch.
    pub(super) fn difference(&self) -> Difference<'_> {
        let linear = self.linearized();
        let map = linear.clamped_to(self.domain, self.foot.parameters);
        let quadratic = taylor_quadratic(&self.context.jet, &self.jet, self.context.cell.half, &map);
        Difference { pair: self, map, is_clamped: map != linear, quadratic, sheet: None }
    }

    /// `A - B∘φ` with B the surface of the foot's patch; `None` where it ends or
    /// has a crease at an edge to which the foot is bound.
    fn across_seams(&self) -> Option<Difference<'_>> {
        let chart = Chart::new(self.context.pair.b.sheets?, self.foot.patch, self.foot.parameters);
        let jet = chart.jet();
        let (a, [h, k]) = (&self.context.jet, self.context.cell.half);
        let residual = jet.point - a.point;
        let frozen = Axis::BOTH.map(|axis| {
            let gradient = residual.dot(if axis == Axis::U { jet.s } else { jet.t });
            let parameter = chart.parameters[axis];
            (parameter <= 0.0 && gradient > 0.0 && !chart.continues(axis, 0))
                || (parameter >= 1.0 && gradient < 0.0 && !chart.continues(axis, 1))
        });
        let map = Reparametrization::linearized(&jet, residual, [h * a.s, k * a.t], frozen)?;
        let reach = chart.reach(map.extent().to_array());
        let map = map.clamped_to(reach.domain, chart.parameters);
        let quadratic = taylor_quadratic(a, &jet, [h, k], &map);
        Some(Difference { pair: self, map, is_clamped: false, quadratic, sheet: Some((chart, reach)) })
    }
}

/// `A - B∘φ` over a cell.
pub(super) struct Difference<'a> {
    pair: &'a CellPair<'a>,
    map: Reparametrization,
    /// Whether the map is another than the linearization, which leaves B's patch.
    is_clamped: bool,
    /// The Taylor quadratic at the centre.
    pub(super) quadratic: Quadratic,
    /// The surface of B that the map runs over, if that is not the foot's patch alone.
    sheet: Option<(Chart<'a>, Reach)>,
}

impl Difference<'_> {
    /// Whether the linearization leaves B's patch, and the distance to the polynomial of the patch
    /// beyond it is at most the threshold to second order.
    fn is_near_beyond(&self, threshold: f64) -> bool {
        let CellPair { context, foot, jet, .. } = self.pair;
        let quadratic = || taylor_quadratic(&context.jet, jet, context.cell.half, &self.pair.linearized());
        self.is_clamped && foot.distance() <= threshold && quadratic().max_control() <= threshold
    }

    /// By how much about the bound falls if the cell is halved about its centre along s, and along t:
    /// by whole patches, without rounding.
    fn gains_of_halving(&self) -> [f64; 2] {
        let CellPair { context, .. } = self.pair;
        let ([h, k], [p, q]) = (context.cell.half, [self.map.p, self.map.q]);
        let remainder = |[s, t]: [f64; 2]| {
            let map = Reparametrization { p: s * p, q: t * q };
            taylor_remainder(context.patch_bounds(), [s * h, t * k])
                + self.remainder_of_b(&map, Bounds::Patch)
        };
        let whole = remainder([1.0; 2]);
        let of_remainder = [[0.5, 1.0], [1.0, 0.5]].map(|part| whole - remainder(part));
        let of_quadratic = self.quadratic.gains_of_halving();
        [0, 1].map(|axis| of_quadratic[axis] + of_remainder[axis])
    }

    /// An upper bound on Taylor's remainder of B under the map, or one that is shorter.
    fn remainder_of_b(&self, map: &Reparametrization, bounds: Bounds) -> f64 {
        let CellPair { context, foot, .. } = self.pair;
        let (b, extent) = (&context.pair.b, map.extent().to_array());
        if let Some((chart, reach)) = &self.sheet {
            let over = if bounds == Bounds::Local { Over::Parts } else { Over::Patches };
            return chart.remainder(reach, extent, over);
        }
        let [low, high] = map.image(foot.parameters);
        let of_b = match bounds {
            Bounds::Patch => *b.extended_bounds(foot.patch, low, high),
            Bounds::Local => b.bounds(foot.patch, low, high),
        };
        taylor_remainder(&of_b, extent)
    }

    /// An upper bound on its length over the cell, with local derivative bounds
    /// where these may bring it to the threshold.
    fn upper_bound(&self, threshold: f64) -> f64 {
        let length = max_length(&self.quadratic);
        let bound = length + self.remainder(Bounds::Patch);
        if length <= threshold && bound > threshold {
            return length + self.remainder(Bounds::Local);
        }
        bound
    }

    /// An upper bound on the distance between the difference and its computed
    /// quadratic: Taylor's remainders and the rounding of the derivatives (lemma R8).
    pub(super) fn remainder(&self, bounds: Bounds) -> f64 {
        let CellPair { context, foot, .. } = self.pair;
        let b = &context.pair.b;
        let (half, extent) = (context.cell.half, self.map.extent().to_array());
        let of_a = match bounds {
            Bounds::Patch => context.patch_bounds(),
            Bounds::Local => context.local_bounds(),
        };
        let scale_of_b = match &self.sheet {
            Some((chart, _)) => chart.jet_scale(),
            None => b.jet_scale(foot.patch),
        };
        remainders(taylor_remainder(of_a, half), self.remainder_of_b(&self.map, bounds))
            + context.jet_scale.quadratic_error(half, MOVED_JET_ROUNDINGS)
            + scale_of_b.quadratic_error(extent, JET_ROUNDINGS)
    }
}

/// The sum of the remainders of A and B, with its rounding.
fn remainders(of_a: f64, of_b: f64) -> f64 {
    (1.0 + REMAINDER_ROUNDINGS * UNIT_ROUNDOFF) * (of_a + of_b)
}

/// An upper bound on Taylor's remainder of third order of a surface over a box
/// of half-widths `[h, k]` about the centre: a sixth of the largest third
/// derivative along a step.
fn taylor_remainder(bounds: &DerivativeBounds, [h, k]: [f64; 2]) -> f64 {
    let [sss, sst, stt, ttt] = bounds.third;
    (h * h * h * sss + 3.0 * h * h * k * sst + 3.0 * h * k * k * stt + k * k * k * ttt) / 6.0
}

/// The Taylor quadratic of `A - B∘φ` at the cell's centre, by the chain rule.
fn taylor_quadratic(a: &Jet, b: &Jet, [h, k]: [f64; 2], map: &Reparametrization) -> Quadratic {
    let Reparametrization { p, q } = *map;
    let second = |uu: f64, uv: f64, vv: f64| -> DVec3 { uu * b.ss + uv * b.st + vv * b.tt };
    Quadratic {
        value: a.point - b.point,
        s: h * a.s - (p.x * b.s + p.y * b.t),
        t: k * a.t - (q.x * b.s + q.y * b.t),
        ss: h * h * a.ss - second(p.x * p.x, 2.0 * p.x * p.y, p.y * p.y),
        st: h * k * a.st - second(p.x * q.x, p.x * q.y + p.y * q.x, p.y * q.y),
        tt: k * k * a.tt - second(q.x * q.x, 2.0 * q.x * q.y, q.y * q.y),
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Lemma R8: 40 u S² under the root, of a constant quadratic of length S.
    #[test]
    fn the_length_has_the_rounding_of_its_square() {
        let size = 3.0;
        let quadratic = Quadratic {
            value: DVec3::new(0.0, size, 0.0),
            s: DVec3::ZERO,
            t: DVec3::ZERO,
            ss: DVec3::ZERO,
            st: DVec3::ZERO,
            tt: DVec3::ZERO,
        };
        let allowance = max_length(&quadratic) - size;
        let lemma = 20.0 * UNIT_ROUNDOFF * size;
        assert!(0.9 * lemma <= allowance && allowance <= 1.1 * lemma, "{allowance:e} and {lemma:e}");
    }

    /// 64 roundings of the sum.
    #[test]
    fn the_sum_of_the_remainders_has_its_rounding() {
        assert_eq!((remainders(3.0, 5.0) - 8.0) / UNIT_ROUNDOFF, 8.0 * 64.0);
    }
}
