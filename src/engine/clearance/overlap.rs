//! Whether two solids overlap.

use crate::bezier::Patch;
use crate::certified::Interval;
use crate::clearance::Nearest;
use crate::engine::PreparedModel;
use crate::model::RigidTransform;
use crate::solid::Side;
use glam::DVec3;
use serde::Serialize;

/// The distances along both parameters of a patch at which its points are tried, from those where
/// the boundaries meet.
const STEPS: [f64; 6] = [0.5, 0.2, 5e-2, 1e-2, 1e-3, 1e-4];

/// The directions of the steps.
const DIRECTIONS: [[f64; 2]; 8] =
    [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [0.7, 0.7], [-0.7, 0.7], [0.7, -0.7], [-0.7, -0.7]];

/// The distances from the boundary of one solid, relative to the diagonal, at which points inside
/// both are tried.
const DEPTHS: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-6];

/// The way in which two solids share space.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case", rename_all_fields = "camelCase")]
#[non_exhaustive]
pub enum Overlap {
    /// The boundaries are certainly apart, and each solid is outside the other.
    None,
    /// The boundaries are nearer than the tolerance, and no common point was found.
    Touching,
    /// The solids have common points inside both, and their boundaries may meet.
    Intersecting {
        /// A point certainly inside both.
        inside_both: [f64; 3],
    },
    /// The boundaries are certainly apart, and a shell of one lies inside the other.
    Contained {
        /// A point certainly inside both, or on one and inside the other.
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

/// Two solids, the one of A moved.
pub(super) struct Solids<'a> {
    a: &'a PreparedModel,
    b: &'a PreparedModel,
    transform: RigidTransform,
    diagonal: f64,
}

impl<'a> Solids<'a> {
    /// Returns `None` unless both models are closed.
    pub(super) fn new(
        [a, b]: [&'a PreparedModel; 2],
        transform: RigidTransform,
        diagonal: f64,
    ) -> Option<Self> {
        let closed = [a, b].iter().all(|model| model.boundary().is_closed());
        closed.then_some(Self { a, b, transform, diagonal })
    }

    /// Returns the overlap, for this interval of the boundaries' distance; `None` if it is not
    /// known, as after a limit that was decided early.
    pub(super) fn overlap(&self, interval: Interval, tolerance: f64, nearest: &Nearest) -> Option<Overlap> {
        // The cracks between faces are closed by strips, which must be apart too.
        let strips_apart = [self.a, self.b]
            .iter()
            .fold(interval.lower, |distance, model| model.boundary().clear_radius(distance));
        if strips_apart > self.error() {
            return self.of_disjoint();
        }
        if let Some(point) = self.inside_both(nearest) {
            return Some(Overlap::Intersecting { inside_both: point.to_array() });
        }
        (interval.upper <= tolerance).then_some(Overlap::Touching)
    }

    /// Returns the overlap of solids whose boundaries are apart: each shell lies on one side of the
    /// other solid, that of any of its points (lemma S4 of docs/solids.md).
    fn of_disjoint(&self) -> Option<Overlap> {
        let of_a = self.a.points_of_shells().into_iter().map(|point| self.transform.apply(point));
        let of_a = of_a.map(|point| (self.b.side_within(point, self.error()), point));
        let of_b = self.b.points_of_shells().into_iter().map(|point| (self.side_of_a(point), point));
        of_sides(of_a.chain(of_b))
    }

    /// Returns a point inside both solids, looked for about the place where they are nearest.
    fn inside_both(&self, nearest: &Nearest) -> Option<DVec3> {
        let patch = |model: &PreparedModel, side: usize| {
            let target = model.certified_target();
            let patch = target.target.patches.patch(nearest.patches[side] as usize);
            around(&patch, nearest.parameters[side])
        };
        let moved = |points: Vec<(DVec3, Option<DVec3>)>| {
            let rotate = |normal: DVec3| self.transform.rotate(normal);
            points.into_iter().map(move |(point, normal)| (self.transform.apply(point), normal.map(rotate)))
        };
        let of_a = moved(patch(self.a, 0)).map(|(point, normal)| (point, normal, true));
        let of_b = patch(self.b, 1).into_iter().map(|(point, normal)| (point, normal, false));
        for (point, normal, is_of_a) in of_a.chain(of_b) {
            let other = if is_of_a { self.b.side_within(point, 0.0) } else { self.side_of_a(point) };
            let (Side::Inside, Some(normal)) = (other, normal) else { continue };
            let steps = DEPTHS.iter().flat_map(|depth| [depth * self.diagonal, -depth * self.diagonal]);
            let mut inner = steps.map(|step| point + step * normal);
            if let Some(found) = inner.find(|&point| self.is_inside_both(point)) {
                return Some(found);
            }
        }
        None
    }

    fn is_inside_both(&self, point: DVec3) -> bool {
        self.b.side_within(point, 0.0) == Side::Inside && self.side_of_a(point) == Side::Inside
    }

    /// Returns the side of the moved A on which a point lies.
    fn side_of_a(&self, point: DVec3) -> Side {
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

/// Returns points of a patch about these parameters, with their normals.
fn around(patch: &Patch<'_>, at: [f64; 2]) -> Vec<(DVec3, Option<DVec3>)> {
    let steps = STEPS.iter().flat_map(|&step| DIRECTIONS.map(|direction| direction.map(|part| step * part)));
    let places = steps.map(|step| [0, 1].map(|axis| (at[axis] + step[axis]).clamp(0.0, 1.0)));
    places.map(|place| patch.jet(place)).map(|jet| (jet.point, jet.normal())).collect()
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
        let solids = Solids::new([&ball, &ball], transform, 2.0).unwrap();
        let side = |radius: f64| solids.side_of_a(offset + radius * DVec3::new(0.48, 0.6, 0.64));
        assert_eq!([0.99, 1.0 - 1e-5].map(side), [Side::Inside; 2]);
        assert_eq!([1.01, 1.0 + 1e-5].map(side), [Side::Outside; 2]);
        assert_eq!([1.0 - 5e-7, 1.0 + 5e-7].map(side), [Side::Undecided; 2]);
    }
}
