//! Bounds on means over a cell, by the same quadratics: lemmas S1 and S2 of `docs/meshes.md`.

use super::{
    Bounds, CellPair, Linear, MOVED_JET_ROUNDINGS, Quadratic, REMAINDER_ROUNDINGS, UNIT_ROUNDOFF,
    coefficient_error, max_coefficient, mean_of_biquartic, taylor_remainder,
};
use crate::certified::cell_context::CellContext;
use glam::DVec3;

/// Upper bounds on a length over a cell, and about what halving the cell along s and along t takes off.
pub(in crate::certified) struct Lengths {
    /// On all its values.
    pub(in crate::certified) largest: f64,
    /// On the root of the mean of its square.
    pub(in crate::certified) root_mean_square: f64,
    /// A linear function that is at least the length; `None` if the length may vanish.
    pub(in crate::certified) linear: Option<Linear>,
    pub(in crate::certified) gains: [f64; 2],
}

/// Returns bounds on |A − B∘φ|, no distance of the cell's points from B being longer, for the map φ of the
/// nearest known foot. The mean has a density that is proportional to 1 + aσ + bτ, `tilt` = [a, b].
pub(in crate::certified) fn distance_above(context: &CellContext<'_>, tilt: [f64; 2]) -> Lengths {
    let foot = context.foot();
    let facing = CellPair::new(context, &foot);
    let difference = facing.difference();
    let gains = difference.gains_of_halving();
    Lengths::new(&difference.quadratic, difference.remainder(Bounds::Local), tilt, gains)
}

/// Returns bounds on the distances of the cell's points from one point.
pub(in crate::certified) fn distance_from(
    context: &CellContext<'_>,
    point: DVec3,
    tilt: [f64; 2],
) -> Lengths {
    let (a, half) = (&context.jet, context.cell.half);
    let [h, k] = half;
    let quadratic = Quadratic {
        value: a.point - point,
        s: h * a.s,
        t: k * a.t,
        ss: h * h * a.ss,
        st: h * k * a.st,
        tt: k * k * a.tt,
    };
    let remainder = taylor_remainder(context.local_bounds(), half)
        * (1.0 + REMAINDER_ROUNDINGS * UNIT_ROUNDOFF)
        + context.jet_scale.quadratic_error(half, MOVED_JET_ROUNDINGS);
    Lengths::new(&quadratic, remainder, tilt, quadratic.gains_of_halving())
}

impl Lengths {
    /// By Minkowski's inequality the root of a mean square grows by the remainder at most.
    fn new(quadratic: &Quadratic, remainder: f64, tilt: [f64; 2], gains: [f64; 2]) -> Self {
        let (squares, error) = (quadratic.length_squared(), coefficient_error(quadratic));
        Self {
            largest: (max_coefficient(&squares) + error).sqrt() + remainder,
            root_mean_square: (mean_of_biquartic(&squares, tilt) + error).sqrt() + remainder,
            linear: Linear::above_length(quadratic, &squares, remainder),
            gains,
        }
    }
}
