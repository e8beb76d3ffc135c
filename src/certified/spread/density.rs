//! The density of area over a cell: lemma S3 of `docs/meshes.md`.

use super::Spreads;
use crate::certified::Cell;
use crate::certified::audit::points::{REGULAR, inner};
use crate::certified::cell_context::CellContext;
use crate::certified::rounding::{MOVED_JET_ROUNDINGS, UNIT_ROUNDOFF, gamma};
use crate::rounding::{upper_max, upper_min};

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
        let of_product = |u: f64, v: f64| product_error(context, [u, v]);
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

/// Returns an upper bound on the error of the product of two derivatives of these lengths.
fn product_error(context: &CellContext<'_>, [u, v]: [f64; 2]) -> f64 {
    let error = JET_ERRORS * context.jet_scale.quadratic_error([1.0; 2], MOVED_JET_ROUNDINGS);
    error * (u + v + error) + gamma(DENSITY_ROUNDINGS) * u * v
}

impl Spreads<'_> {
    /// Compares the density at the corners of a cell, its middle and `further` points with the weight of the cell. Returns the
    /// stated ratio of the largest quotient of both to the smallest, and a ratio that certainly is larger; `None` if the points
    /// do not contradict it.
    pub(crate) fn density_refutation(&self, cell: &Cell, further: usize) -> Option<[f64; 2]> {
        let context = CellContext::new(&self.pair, &self.nearest, *cell, &self.start().foot);
        self.refutes(&context, &Weight::new(self.density, &context), further)
    }

    fn refutes(&self, context: &CellContext<'_>, weight: &Weight, further: usize) -> Option<[f64; 2]> {
        let [mut least, mut largest] = [f64::INFINITY, 0.0];
        let rounding = product_error(context, context.local_bounds().first);
        for place in REGULAR.into_iter().chain(inner(further)) {
            let jet = self.pair.jet_of_a(context.cell.patch, context.cell.at(place));
            let density = jet.s.cross(jet.t).length();
            let weight = 1.0 + weight.tilt[0] * place[0] + weight.tilt[1] * place[1];
            // A weight of 0 bounds nothing, as at the corner of a triangle.
            if weight > 0.0 {
                least = upper_min(least, (density + rounding) / weight);
                largest = upper_max(largest, (density - rounding) / weight);
            }
        }
        let found = largest / least * (1.0 - DENSITY_ROUNDINGS * UNIT_ROUNDOFF);
        (found > weight.ratio).then_some([weight.ratio, found])
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::certified::Pair;
    use crate::certified::testing::Surfaces;
    use crate::model::RigidTransform;
    use crate::shapes::sphere;
    use glam::DVec3;

    /// The audit refutes the weight of a cell of a sphere without its tilt, and one with the ratio 1, and not the weight itself.
    #[test]
    fn an_audit_refutes_a_wrong_weight_and_nothing_else() {
        let ball = Surfaces::of(&sphere(DVec3::ZERO, 1.0).unwrap());
        let pair = Pair { a: ball.operand(), b: ball.operand(), transform: RigidTransform::IDENTITY };
        let spreads = Spreads::new(pair, Density::OfPatch, 1e-6);
        for patch in 0..8 {
            for half in [0.25, 0.0625] {
                let cell = Cell { patch, center: [0.5, 0.375], half: [half; 2] };
                assert_eq!(spreads.density_refutation(&cell, 8), None);
                let context = CellContext::new(&spreads.pair, &spreads.nearest, cell, &spreads.start().foot);
                let right = Weight::new(Density::OfPatch, &context);
                for wrong in [Weight { tilt: [0.0; 2], ratio: 1.0 + 1e-3 }, Weight { ratio: 1.0, ..right }] {
                    let [stated, found] = spreads.refutes(&context, &wrong, 8).unwrap();
                    assert!(stated == wrong.ratio && found > stated, "{wrong:?} {found}");
                }
            }
        }
    }
}
