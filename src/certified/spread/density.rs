//! The density of area over a cell: lemma S3 of `docs/meshes.md`.

use crate::certified::cell_context::CellContext;
use crate::certified::rounding::{MOVED_JET_ROUNDINGS, UNIT_ROUNDOFF, gamma};

/// The roundings of the density at a cell's centre and of its derivatives, relative to products of derivatives.
const DENSITY_ROUNDINGS: f64 = 16.0;

/// The largest error of a second derivative, in those of a Taylor quadratic over steps of length 1.
const JET_ERRORS: f64 = 2.0;

/// The area of a cell for each of its parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Density {
    /// Proportional to s, as that of a triangle whose side s = 0 is a corner.
    OfTriangle,
    /// That of a patch, by its derivatives.
    OfPatch,
}

/// A weight that is nearly proportional to the density over a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Weight {
    /// a and b of the weight 1 + aσ + bτ, which is positive on the square.
    pub(super) tilt: [f64; 2],
    /// An upper bound on the ratio of the largest quotient of density and weight to the smallest; +∞ if none is known.
    pub(super) ratio: f64,
}

impl Weight {
    pub(super) fn new(density: Density, context: &CellContext<'_>) -> Self {
        match density {
            Density::OfTriangle => {
                let cell = &context.cell;
                Self { tilt: [cell.half[0] / cell.center[0], 0.0], ratio: 1.0 }
            }
            Density::OfPatch => {
                Self::of_patch(context).unwrap_or(Self { tilt: [0.0; 2], ratio: f64::INFINITY })
            }
        }
    }

    /// The linear part of the density at the cell's centre; `None` if the density may vanish beside it.
    fn of_patch(context: &CellContext<'_>) -> Option<Self> {
        let (jet, [h, k]) = (&context.jet, context.cell.half);
        let normal = jet.s.cross(jet.t);
        let density = normal.length();
        let direction = normal / density;
        // The derivatives of A_s × A_t along σ and along τ.
        let turns = [
            h * (jet.ss.cross(jet.t) + jet.s.cross(jet.st)),
            k * (jet.st.cross(jet.t) + jet.s.cross(jet.tt)),
        ];
        let along = turns.map(|turn| direction.dot(turn));
        let across: f64 =
            turns.iter().zip(along).map(|(turn, along)| (*turn - along * direction).length()).sum();

        let local = context.local_bounds();
        let ([s, t], [ss, st, tt], [sss, sst, stt, ttt]) = (local.first, local.second, local.third);
        let change = [h * ss + k * st, h * st + k * tt];
        let rest = [(sss, sst, stt), (sst, stt, ttt)]
            .map(|(hh, hk, kk)| 0.5 * (h * h * hh + 2.0 * h * k * hk + k * k * kk));
        let error = JET_ERRORS * context.jet_scale.quadratic_error([1.0; 2], MOVED_JET_ROUNDINGS);
        let of_product = |u: f64, v: f64| error * (u + v + error) + gamma(DENSITY_ROUNDINGS) * u * v;
        let rounding = of_product(s, t)
            + h * (of_product(ss, t) + of_product(s, st))
            + k * (of_product(st, t) + of_product(s, tt));
        let remainder = (change[0] * change[1] + rest[0] * t + (s + rest[0]) * rest[1])
            * (1.0 + DENSITY_ROUNDINGS * UNIT_ROUNDOFF)
            + rounding;

        let least = density - along[0].abs() - along[1].abs();
        let across = across + rounding;
        let above = remainder + across * across / (2.0 * least);
        // A NaN is no bound.
        (least > remainder).then(|| Self {
            tilt: along.map(|along| along / density),
            ratio: (least + above) / (least - remainder) * (1.0 + DENSITY_ROUNDINGS * UNIT_ROUNDOFF),
        })
    }
}
