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

use super::super::nearest::Foot;
use super::super::reparametrization::Reparametrization;
use super::super::rounding::{JET_ROUNDINGS, MOVED_JET_ROUNDINGS, UNIT_ROUNDOFF};
use super::{CellContext, Quadratic, UpperBound};
use crate::bezier::{DerivativeBounds, Jet};
use crate::param_box::ParamBox;
use glam::DVec3;

/// The bound from the nearest known foot: by Lipschitz continuity where that
/// suffices, else by Taylor's theorem.
pub(super) struct Taylor;

impl UpperBound for Taylor {
    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64> {
        let foot = context.foot();
        let lipschitz = foot.distance() + context.radius;
        if lipschitz <= threshold {
            return Some(lipschitz);
        }
        let facing = CellPair::new(context, &foot);
        let difference = facing.difference(&facing.linearized());
        let quadratic = &difference.quadratic;
        let length = (quadratic.max_length_squared() + coefficient_error(quadratic)).sqrt();
        let mut bound = length + difference.remainder(Bounds::Patch);
        if length <= threshold && bound > threshold {
            bound = length + difference.remainder(Bounds::Local);
        }
        Some(if bound < lipschitz { bound } else { lipschitz })
    }
}

/// Roundings of a sum of remainders, relative to it.
const REMAINDER_ROUNDINGS: f64 = 32.0;

/// Roundings of a coefficient of `|Q|²`, relative to the square of the size of
/// Q's terms (lemma R8).
const COEFFICIENT_ROUNDINGS: f64 = 40.0;

/// An upper bound on the rounding error of the coefficients of `|Q|²`.
pub(super) fn coefficient_error(quadratic: &Quadratic) -> f64 {
    COEFFICIENT_ROUNDINGS * UNIT_ROUNDOFF * quadratic.size().powi(2)
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
        let jet = b.patch(foot.patch).jet(foot.parameters);
        let residual = jet.point - context.jet.point;
        let domain = b.room(foot.patch);
        let frozen = [0, 1].map(|axis| {
            let [low, high] = domain[axis];
            let gradient = residual.dot(if axis == 0 { jet.s } else { jet.t });
            let parameter = foot.parameters[axis];
            (parameter <= low && gradient > 0.0) || (parameter >= high && gradient < 0.0)
        });
        Self { context, foot: *foot, jet, domain, frozen }
    }

    /// The foot's linearization, or the constant map where that is singular.
    pub(super) fn linearized(&self) -> Reparametrization {
        let (a, [h, k]) = (&self.context.jet, self.context.cell.half);
        let residual = self.jet.point - a.point;
        Reparametrization::linearized(&self.jet, residual, [h * a.s, k * a.t], self.frozen)
            .unwrap_or(Reparametrization::CONSTANT)
    }

    /// `A - B∘φ` with φ the map clamped to B's patch.
    pub(super) fn difference(&self, map: &Reparametrization) -> Difference<'_> {
        let map = map.clamped_to(self.domain, self.foot.parameters);
        let quadratic = taylor_quadratic(&self.context.jet, &self.jet, self.context.cell.half, &map);
        Difference { pair: self, map, quadratic }
    }
}

/// `A - B∘φ` over a cell.
pub(super) struct Difference<'a> {
    pair: &'a CellPair<'a>,
    map: Reparametrization,
    /// The Taylor quadratic at the centre.
    pub(super) quadratic: Quadratic,
}

impl Difference<'_> {
    /// An upper bound on the distance between the difference and its computed
    /// quadratic: Taylor's remainders and the rounding of the derivatives (lemma R8).
    pub(super) fn remainder(&self, bounds: Bounds) -> f64 {
        let CellPair { context, foot, .. } = self.pair;
        let b = &context.pair.b;
        let [low, high] = self.map.image(foot.parameters);
        let (of_a, of_b) = match bounds {
            Bounds::Patch => (context.patch_bounds(), *b.extended_bounds(foot.patch, low, high)),
            Bounds::Local => (context.local_bounds(), b.bounds(foot.patch, low, high)),
        };
        let (half, extent) = (context.cell.half, self.map.extent().to_array());
        let remainder = taylor_remainder(of_a, half) + taylor_remainder(&of_b, extent);
        (1.0 + REMAINDER_ROUNDINGS * UNIT_ROUNDOFF) * remainder
            + context.jet_scale.quadratic_error(half, MOVED_JET_ROUNDINGS)
            + b.jet_scale(foot.patch).quadratic_error(extent, JET_ROUNDINGS)
    }
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
