//! Whether two solids overlap.

use super::common_point::CommonPoint;
use crate::clearance::{Goal, Nearest};
use crate::engine::{PreparedModel, Stop};
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::solid::Side;
use glam::DVec3;
use serde::Serialize;

/// The way in which two solids share space.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case", rename_all_fields = "camelCase")]
#[non_exhaustive]
pub enum Overlap {
    /// The boundaries are certainly apart, and each solid is outside the other.
    None,
    /// The boundaries are nearer than the tolerance, and no point inside both was found: about the
    /// place where they are nearest, in the box that both reach into, behind some hundred patches of
    /// each, and behind each other patch whose middle is inside the other solid.
    Touching,
    /// The solids have common points inside both, and their boundaries may meet.
    Intersecting {
        /// A point certainly inside both.
        inside_both: [f64; 3],
    },
    /// The boundaries are certainly apart, and a shell of one lies inside the other.
    Contained {
        /// A point certainly inside both; where none was found, on the boundary of one and inside the other.
        inside_both: [f64; 3],
    },
}

impl Overlap {
    /// Returns whether the solids certainly have a common point.
    #[must_use]
    pub fn is_overlap(&self) -> bool {
        matches!(self, Self::Intersecting { .. } | Self::Contained { .. })
    }
}

/// Why nothing is stated of an overlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum OverlapUnknown {
    /// A is not closed: [`PreparedModel::solid`] has its free edges.
    AOpen,
    /// B is not closed.
    BOpen,
    /// Neither model is closed.
    BothOpen,
    /// A mesh has more triangles than are joined, 250,000.
    TooLarge,
    /// The side of a point, of a shell of one model or between both, is not decided: shells of one model
    /// lie within each other in a way that does not tell voids from bodies, or no ray avoids the edges.
    Side,
    /// The boundaries are nearer to each other than the cracks between their faces are wide, or than
    /// the error of their points.
    Cracks,
    /// The limit was decided before the boundaries were known to meet or to be apart.
    Limit,
    /// A budget ended the search before that was known.
    Budget,
    /// The rounding of the coordinates ended the search before that was known.
    Precision,
}

/// Two solids, the one of A moved.
pub(in crate::engine) struct Solids<'a> {
    pub(super) a: &'a PreparedModel,
    pub(super) b: &'a PreparedModel,
    pub(super) transform: RigidTransform,
}

impl<'a> Solids<'a> {
    /// # Errors
    /// Which of the models is not closed.
    pub(in crate::engine) fn new(
        [a, b]: [&'a PreparedModel; 2],
        transform: RigidTransform,
    ) -> Result<Self, OverlapUnknown> {
        if [a, b].iter().any(|model| model.facets().is_some_and(|mesh| !mesh.may_close())) {
            return Err(OverlapUnknown::TooLarge);
        }
        match [a, b].map(|model| model.boundary().is_closed()) {
            [true, true] => Ok(Self { a, b, transform }),
            [false, true] => Err(OverlapUnknown::AOpen),
            [true, false] => Err(OverlapUnknown::BOpen),
            [false, false] => Err(OverlapUnknown::BothOpen),
        }
    }

    /// Returns the overlap, for this interval of the boundaries' distance, which a search with this
    /// goal found when it ended. Once `is_late`, no further point inside both is looked for.
    ///
    /// # Errors
    /// Why it is not known.
    pub(in crate::engine) fn overlap(
        &self,
        interval: Interval,
        goal: Goal,
        stop: Stop,
        nearest: &Nearest,
        is_late: &dyn Fn() -> bool,
    ) -> Result<Overlap, OverlapUnknown> {
        // The cracks between faces are closed by strips, which must be apart too.
        let strips_apart = [self.a, self.b]
            .iter()
            .fold(interval.lower, |distance, model| model.boundary().clear_radius(distance));
        if strips_apart > self.error() {
            let overlap = self.of_disjoint().ok_or(OverlapUnknown::Side)?;
            let Overlap::Contained { .. } = overlap else { return Ok(overlap) };
            // The point known is on a boundary: one off it says more.
            return Ok(match self.common_point(nearest, goal.tolerance, is_late) {
                CommonPoint::Found(point) => Overlap::Contained { inside_both: point.to_array() },
                _ => overlap,
            });
        }
        match self.common_point(nearest, goal.tolerance, is_late) {
            CommonPoint::Found(point) => return Ok(Overlap::Intersecting { inside_both: point.to_array() }),
            CommonPoint::NotFound if interval.upper <= goal.tolerance => return Ok(Overlap::Touching),
            CommonPoint::Undecided if interval.upper <= goal.tolerance => return Err(OverlapUnknown::Side),
            CommonPoint::Late if interval.upper <= goal.tolerance => return Err(OverlapUnknown::Budget),
            _ => {}
        }
        let cracks = interval.lower - strips_apart + self.error();
        Err(match stop {
            _ if interval.upper <= cracks => OverlapUnknown::Cracks,
            Stop::Converged if goal.limit.is_some() => OverlapUnknown::Limit,
            Stop::Converged => OverlapUnknown::Cracks,
            Stop::Precision => OverlapUnknown::Precision,
            Stop::Cells | Stop::Time | Stop::Cancelled => OverlapUnknown::Budget,
        })
    }

    /// Returns the overlap of solids whose boundaries are apart: each shell lies on one side of the
    /// other solid, that of any of its points (lemma S4 of docs/solids.md).
    fn of_disjoint(&self) -> Option<Overlap> {
        let of_a = self.a.points_of_shells().into_iter().map(|point| self.transform.apply(point));
        let of_a = of_a.map(|point| (self.b.side_within(point, self.error()), point));
        let of_b = self.b.points_of_shells().into_iter().map(|point| (self.side_of_a(point), point));
        of_sides(of_a.chain(of_b))
    }

    /// Returns the side of the common part of both on which a point lies.
    pub(super) fn common_side(&self, point: DVec3) -> Side {
        match self.b.side_within(point, 0.0) {
            Side::Outside => Side::Outside,
            Side::Inside => self.side_of_a(point),
            Side::Undecided if self.side_of_a(point) == Side::Outside => Side::Outside,
            Side::Undecided => Side::Undecided,
        }
    }

    /// Returns the side of the moved A on which a point lies.
    pub(super) fn side_of_a(&self, point: DVec3) -> Side {
        let error = self.transform.rounding(point.length());
        self.a.side_within(self.transform.apply_inverse(point), error)
    }

    /// Returns an upper bound on the error of moved points of A.
    fn error(&self) -> f64 {
        self.transform.rounding(self.a.control_box().farthest_from_origin())
    }
}

/// Returns the overlap of solids whose boundaries are apart, by points of all shells of both with
/// their sides of the other solid; `None` if a side is not known and no point is inside.
fn of_sides(mut sides: impl Iterator<Item = (Side, DVec3)>) -> Option<Overlap> {
    let mut is_known = true;
    let inside = sides.find(|&(side, _)| {
        is_known &= side != Side::Undecided;
        side == Side::Inside
    });
    match inside {
        Some((_, point)) => Some(Overlap::Contained { inside_both: point.to_array() }),
        None => is_known.then_some(Overlap::None),
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::shapes::sphere;
    use glam::DQuat;

    #[test]
    fn solids_are_apart_only_if_the_side_of_every_shell_is_known() {
        let of = |sides: &[Side]| {
            let point = |index: usize| DVec3::splat(index as f64);
            of_sides(sides.iter().enumerate().map(|(index, &side)| (side, point(index))))
        };
        let inside = |index: f64| Some(Overlap::Contained { inside_both: [index; 3] });
        assert_eq!(of(&[Side::Outside, Side::Outside]), Some(Overlap::None));
        assert_eq!(of(&[Side::Outside, Side::Undecided]), None);
        assert_eq!(of(&[Side::Undecided, Side::Outside]), None);
        assert_eq!(of(&[Side::Outside, Side::Inside]), inside(1.0));
        assert_eq!(of(&[Side::Undecided, Side::Outside, Side::Inside]), inside(2.0));
    }

    /// Moved back by 1e8, a point is known up to 65 u (1e8 + 1e8), about 1.4e-6 (lemma R2).
    #[test]
    fn a_point_has_a_side_of_a_moved_solid_only_beyond_the_rounding_of_the_motion() {
        let ball = PreparedModel::new(&sphere(DVec3::ZERO, 1.0).unwrap()).unwrap();
        let offset = 1e8 * DVec3::X;
        let transform = RigidTransform::new(DQuat::IDENTITY, offset).unwrap();
        let solids = Solids::new([&ball, &ball], transform).unwrap();
        let side = |radius: f64| solids.side_of_a(offset + radius * DVec3::new(0.48, 0.6, 0.64));
        assert_eq!([0.99, 1.0 - 1e-5].map(side), [Side::Inside; 2]);
        assert_eq!([1.01, 1.0 + 1e-5].map(side), [Side::Outside; 2]);
        assert_eq!([1.0 - 5e-7, 1.0 + 5e-7].map(side), [Side::Undecided; 2]);
    }
}
