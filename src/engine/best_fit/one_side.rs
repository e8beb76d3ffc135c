//! Distances on one side of a closed model: how far points are outside of its body, or within it.

use super::clear::ToModel;
use super::options::FitNorm;
use crate::alignment::{Clear, Clearance, Field, FootField, Place, Residual};
use crate::engine::signs::{Known, SignRule};
use crate::model::RigidTransform;
use crate::rounding::upper_max;
use crate::solid::Side;
use crate::threads::parallel::map_ranges;
use glam::DVec3;

/// The distance, as a part of the model's size, at which the side of a point that touches the model is looked up.
const BESIDE: f64 = 1e-4;

/// The side that counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Counted {
    Outside,
    Inside,
}

impl Counted {
    /// Returns the side that a norm counts, if any.
    pub(super) fn of(norm: FitNorm) -> Option<Self> {
        match norm {
            FitNorm::Outside => Some(Self::Outside),
            FitNorm::Inside => Some(Self::Inside),
            _ => None,
        }
    }

    /// Returns the sign of distances on a side; `None` where that is not known.
    fn sign(self, side: Side) -> Option<f64> {
        match (side, self) {
            (Side::Undecided, _) => None,
            (Side::Outside, Self::Outside) | (Side::Inside, Self::Inside) => Some(1.0),
            _ => Some(-1.0),
        }
    }
}

/// The distances of points from a closed model, positive on the side that counts.
///
/// The faces of the model and the strips between its joined edges form the boundary of a body. The signed distance from this
/// boundary is a function with the Lipschitz constant 1. Its absolute value d is a lower bound on the distance from the
/// faces, and d plus the largest distance of a point of a strip from the faces is an upper bound on that distance.
pub(super) struct OneSide<'a> {
    pub(super) to: ToModel<'a>,
    pub(super) rule: SignRule<'a>,
    pub(super) counted: Counted,
}

impl Clearance for OneSide<'_> {
    type Memory = (Place, Known);

    const SIGNED: bool = true;

    fn clear(&self, point: DVec3, (place, known): &mut Self::Memory) -> Option<Clear> {
        self.with_side(point, self.to.clear(point, place)?, known)
    }
}

impl OneSide<'_> {
    /// Returns the bounds on the distance with its sign from those without.
    fn with_side(&self, point: DVec3, clear: Clear, known: &mut Known) -> Option<Clear> {
        let sign = self.counted.sign(self.rule.side(point, clear.lower, known)?);
        let least = upper_max(0.0, self.rule.clear_radius(clear.lower)?);
        let [lower, upper] = match sign {
            Some(sign) if sign > 0.0 => [least, clear.upper],
            Some(_) => [-clear.upper, -least],
            None => [-clear.upper, clear.upper],
        };
        Some(Clear { lower, upper, direction: sign.unwrap_or(1.0) * clear.direction })
    }

    /// Returns the largest upper bound of points under a motion, with its place. A point whose distance is not above that
    /// of another one needs no side. O(points log patches).
    pub(super) fn largest(&self, points: &[DVec3], motion: &RigidTransform) -> Option<(f64, usize)> {
        let parts = map_ranges(points.len(), |range| {
            let (mut place, mut known) = (None, Known::default());
            let mut most = (f64::NEG_INFINITY, 0);
            for index in range {
                let image = motion.apply(points[index]);
                let clear = self.to.clear(image, &mut place)?;
                if clear.upper <= most.0 {
                    continue;
                }
                let upper = self.with_side(image, clear, &mut known)?.upper;
                if upper > most.0 {
                    most = (upper, index);
                }
            }
            Some(most)
        });
        let of_parts = parts.into_iter().collect::<Option<Vec<_>>>()?;
        of_parts.into_iter().reduce(|most, part| if part.0 > most.0 { part } else { most })
    }
}

/// Residuals whose directions are those in which the distance on one side grows. They are estimates.
#[derive(Clone, Copy)]
pub(super) struct OneSideField<'a> {
    pub(super) foot: FootField<'a>,
    pub(super) rule: SignRule<'a>,
    pub(super) counted: Counted,
    /// The model's size.
    pub(super) size: f64,
}

impl Field for OneSideField<'_> {
    const SIGNED: bool = true;

    fn residual(&self, point: DVec3, place: &mut Place) -> Option<Residual> {
        let residual = self.foot.residual(point, place)?;
        let direction = residual.direction?;
        let sign =
            |at: DVec3, clear: f64| self.counted.sign(self.rule.side(at, clear, &mut Known::default())?);
        // Of a point that touches the model the direction is a normal, to either side.
        let beside = BESIDE * self.size;
        let sign = match residual.distance() > beside {
            true => sign(point, 0.0),
            false => sign(point + beside * direction, 0.0),
        };
        Some(Residual { direction: Some(sign.unwrap_or(1.0) * direction), ..residual })
    }
}
