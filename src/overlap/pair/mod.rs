//! Two solids that are made ready for a search.

mod shared;
mod shift;

use super::piece::Whole;
use super::solid::{BoundarySide, PlacedSolid};
use crate::rounding::{gamma, upper_max};
use glam::DVec3;
use shared::{Partners, RELATIVE_REACH, shared};
use shift::{is_parted_by, lie_on_each_other, plane, shift};

/// A motion may change the volume in common by this part of half of the permitted width. Patches that lie on each other are
/// separated by the motion; the longer it is, the larger are the pieces that are separated.
const PART_OF_MOTION: f64 = 0.25;

/// The roundings of the change of a volume, a product.
const CHANGE_ROUNDINGS: f64 = 8.0;

/// The roundings of a patch that is moved, relative to the largest coordinate.
const MOTION_ROUNDINGS: f64 = 4.0;

/// Two solids in a common frame. A short motion of the first one has parted their coincident planes and curved patches,
/// and the patches that both solids have are paired.
#[derive(Debug)]
pub(crate) struct Pair {
    pub(super) solids: [PlacedSolid; 2],
    pub(super) partners: Partners,
    /// The vector by which the first solid was moved.
    pub(super) shift: DVec3,
    /// An upper bound on what that changes of the volume in common.
    pub(super) change: f64,
    /// The distances within which pieces of each solid may meet the other's boundary.
    pub(super) margins: [f64; 2],
}

impl Pair {
    /// Makes two solids ready for a volume of this width. The first one is moved if curved patches lie on each other, or if
    /// `has_stalled` states that a search without a motion has stalled. O(n log n) in general position.
    pub(crate) fn new([a, b]: [PlacedSolid; 2], width: f64, has_stalled: bool) -> Self {
        let diagonal = upper_max(a.aabb.diagonal(), b.aabb.diagonal());
        let mut partners = shared(&a.patches, &b.patches, RELATIVE_REACH * diagonal);
        partners.retain([&a.patches, &b.patches], |whole| whole.side != BoundarySide::Unknown);
        let margins = [b.margin(&a), a.margin(&b)];
        let margin = upper_max(margins[0], margins[1]);
        let (vector, parts_curved) = if partners.are_all() {
            (DVec3::ZERO, false)
        } else {
            // Half of this times the area is the width.
            let most = width / if a.area < b.area { a.area } else { b.area };
            let length = PART_OF_MOTION * most;
            let length = length * moved_part(&a, &partners, length);
            let patches = [&a.patches, &b.patches];
            let parts_curved = has_stalled || lie_on_each_other(patches, &partners, length);
            (shift(patches, margin, if parts_curved { length } else { 0.0 }), parts_curved)
        };
        let mut pair = Self { solids: [a, b], partners, shift: DVec3::ZERO, change: 0.0, margins };
        if vector != DVec3::ZERO {
            let length = vector.length();
            let is_parted =
                |whole: &Whole| plane(whole, margin).is_some() || parts_curved && is_parted_by(whole, length);
            pair = pair.shifted(-vector, is_parted);
        }
        for (solid, placed) in pair.solids.iter_mut().enumerate() {
            for (index, whole) in placed.patches.wholes.iter_mut().enumerate() {
                whole.reach = pair.partners.of(solid, index).map_or(0.0, |partner| partner.distance);
            }
        }
        pair
    }

    /// Moves the first solid. Patches that the motion parts need no partners then.
    fn shifted(self, vector: DVec3, is_parted: impl Fn(&Whole) -> bool) -> Self {
        let Self { solids: [a, b], mut partners, .. } = self;
        let area = if a.area < b.area { a.area } else { b.area };
        let length = vector.length();
        let change = 0.5 * length * area * (1.0 + gamma(CHANGE_ROUNDINGS));
        let rounding = gamma(MOTION_ROUNDINGS) * (a.aabb.farthest_from_origin() + length);
        partners.retain([&a.patches, &b.patches], |whole| !is_parted(whole));
        partners.add(length + rounding);
        let a = a.moved_by(vector, rounding);
        let margins = [b.margin(&a), a.margin(&b)];
        Self { solids: [a, b], partners, shift: vector, change, margins }
    }
}

/// Returns about the largest part of a motion of this length that changes the patches which stay paired by no more than it
/// changes the volume.
fn moved_part(first: &PlacedSolid, partners: &Partners, length: f64) -> f64 {
    let faces = first.patches.faces().enumerate();
    let paired =
        faces.filter(|&(index, whole)| partners.of(0, index).is_some() && !is_parted_by(whole, length));
    let change = |whole: &Whole| {
        let weight = first.patches.weight(whole, &whole.root, first.aabb.center(), 0.0);
        weight.displacement(1.0, first.patches.slopes(whole, &whole.root).border())
    };
    let sum: f64 = paired.map(|(_, whole)| change(whole)).sum();
    if sum > first.area { first.area / sum } else { 1.0 }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::super::solid::Known;
    use super::*;
    use crate::bezier::{PointError, extract};
    use crate::interval::Interval;
    use crate::model::RigidTransform;
    use crate::shapes::{cylinder, torus};
    use glam::DQuat;
    use std::f64::consts::PI;

    fn placed(radius: f64, height: f64, up: f64) -> PlacedSolid {
        let known = Known {
            volume: Interval::exactly(PI * radius * radius * height),
            area: Interval::exactly(2.0 * PI * radius * (radius + height)),
            cracks: 0.0,
            point_error: PointError::default(),
            deviation: 0.0,
            rounding: 0.0,
        };
        let patches = extract(&cylinder(radius, height).unwrap()).patches;
        let transform = RigidTransform::new(DQuat::IDENTITY, up * DVec3::Z).unwrap();
        PlacedSolid::new(&patches, std::iter::empty(), Some(&transform), |_| BoundarySide::Outward, known)
    }

    /// Lemma O4, nearly attained: a thin disc that a plane halves moves by v across it, so that v times its face
    /// changes sides, and its whole area is little more than twice that.
    #[test]
    fn the_volume_in_common_of_a_disc_changes_by_nearly_all_of_the_bound() {
        let (disc, block) = (placed(1.0, 0.01, 0.0), placed(3.0, 2.0, 0.005));
        let pair = Pair::new([disc, block], 1e-3, false);
        assert_eq!((pair.shift, pair.change), (DVec3::ZERO, 0.0));
        let length = 0.004;
        let Pair { change, shift, .. } = pair.shifted(length * DVec3::Z, |_| false);
        assert_eq!(shift, length * DVec3::Z);
        assert!((PI * length..1.03 * PI * length).contains(&change), "{change}");
    }

    /// Lemma O2 for a body that is moved: points of patches that stay paired are farther apart by the motion.
    #[test]
    fn patches_that_stay_paired_are_farther_apart_by_a_motion() {
        let pair = Pair::new([placed(1.0, 2.0, 0.0), placed(1.0, 2.0, 0.0)], 1e-3, false);
        let count = pair.solids[0].patches.faces().count();
        let length = 0.004;
        let moved = pair.shifted(length * DVec3::X, |_| false);
        for solid in [0, 1] {
            for index in 0..count {
                let partner = moved.partners.of(solid, index).unwrap();
                assert!((length..1.000_001 * length).contains(&partner.distance), "{partner:?}");
            }
        }
    }

    /// A motion parts patches of cylinders, whose quadric is exact, and of a torus only if it is far longer than what these
    /// are off theirs.
    #[test]
    fn patches_on_quadrics_are_parted() {
        let parted = |model: crate::model::Model, length: f64| {
            let patches = extract(&model).patches;
            let known = Known {
                volume: Interval::exactly(1.0),
                area: Interval::exactly(1.0),
                cracks: 0.0,
                point_error: PointError::default(),
                deviation: 0.0,
                rounding: 0.0,
            };
            let solid =
                PlacedSolid::new(&patches, std::iter::empty(), None, |_| BoundarySide::Outward, known);
            let faces = || solid.patches.faces();
            (faces().filter(|whole| is_parted_by(whole, length)).count(), faces().count())
        };
        for (model, length, are_parted) in [
            (cylinder(1.0, 2.0).unwrap(), 1e-6, true),
            (torus(2.0, 0.5).unwrap(), 1e-6, false),
            (torus(2.0, 0.5).unwrap(), 100.0, true),
        ] {
            let (count, all) = parted(model, length);
            assert_eq!(count, if are_parted { all } else { 0 }, "{length}");
        }
    }
}
