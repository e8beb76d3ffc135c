//! Two solids that are made ready for a search.

use super::shared::{RELATIVE_REACH, shared};
use super::shift::{plane, shift};
use super::solid::{BoundarySide, PlacedSolid};
use crate::rounding::{gamma, upper_max};
use glam::DVec3;

/// The roundings of the change of a volume, a product.
const CHANGE_ROUNDINGS: f64 = 8.0;

/// The roundings of a patch that is moved, relative to the largest coordinate.
const MOTION_ROUNDINGS: f64 = 4.0;

/// Two solids in a common frame, of which planes that lie on each other are moved apart by a little, and patches that
/// both have are paired.
#[derive(Debug)]
pub(crate) struct Pair {
    pub(super) solids: [PlacedSolid; 2],
    /// For each patch of both that the other one has, too, an upper bound on their distance.
    pub(super) partners: [Vec<Option<f64>>; 2],
    /// The vector by which the first solid was moved.
    pub(super) shift: DVec3,
    /// An upper bound on what that changes of the volume in common.
    pub(super) change: f64,
    /// The distances within which pieces of each solid may meet the other's boundary.
    pub(super) margins: [f64; 2],
}

impl Pair {
    /// Makes two solids ready, the first one moved by about `least` where that is not 0. O(n log n) in general position.
    pub(crate) fn new([a, b]: [PlacedSolid; 2], least: f64) -> Self {
        let diagonal = upper_max(a.aabb.diagonal(), b.aabb.diagonal());
        let mut partners = shared(&a.patches, &b.patches, RELATIVE_REACH * diagonal).partners;
        for (solid, partners) in [&a, &b].into_iter().zip(&mut partners) {
            for (whole, partner) in solid.patches.faces().zip(partners) {
                // To which side such a shell turns is not known.
                if whole.side == BoundarySide::Unknown {
                    *partner = None;
                }
            }
        }
        let margins = [b.margin(&a), a.margin(&b)];
        let margin = upper_max(margins[0], margins[1]);
        let are_all_shared = partners.iter().flatten().all(Option::is_some);
        let vector = if are_all_shared {
            DVec3::ZERO
        } else {
            shift([&a.patches, &b.patches], margin, least * moved_part(&a, &partners[0], diagonal))
        };
        let mut pair = Self { solids: [a, b], partners, shift: DVec3::ZERO, change: 0.0, margins };
        if vector != DVec3::ZERO {
            pair = pair.shifted(-vector, margin);
        }
        for (solid, partners) in pair.solids.iter_mut().zip(&pair.partners) {
            for (whole, partner) in solid.patches.wholes.iter_mut().zip(partners) {
                whole.reach = partner.unwrap_or(0.0);
            }
        }
        pair
    }

    /// Returns the length of a motion of the first solid that changes the volume in common by at most half of this width.
    pub(crate) fn motion(&self, width: f64) -> f64 {
        let [a, b] = &self.solids;
        width / if a.area < b.area { a.area } else { b.area }
    }

    /// Moves the first solid. Its plane patches are told from others then and need no partners.
    fn shifted(self, vector: DVec3, margin: f64) -> Self {
        let Self { solids: [a, b], mut partners, .. } = self;
        let area = if a.area < b.area { a.area } else { b.area };
        let length = vector.length();
        let change = 0.5 * length * area * (1.0 + gamma(CHANGE_ROUNDINGS));
        let rounding = gamma(MOTION_ROUNDINGS) * (a.aabb.farthest_from_origin() + length);
        for (solid, partners) in [&a, &b].into_iter().zip(&mut partners) {
            for (whole, partner) in solid.patches.faces().zip(partners) {
                *partner = partner
                    .filter(|_| plane(whole, margin).is_none())
                    .map(|partner| partner + length + rounding);
            }
        }
        let a = a.moved_by(vector, rounding);
        let margins = [b.margin(&a), a.margin(&b)];
        Self { solids: [a, b], partners, shift: vector, change, margins }
    }
}

/// Returns about the part of a motion for which what it changes of patches that are paired is no more than what it
/// changes of the volume.
fn moved_part(solid: &PlacedSolid, partners: &[Option<f64>], diagonal: f64) -> f64 {
    let paired = solid.patches.faces().zip(partners).filter(|(_, partner)| partner.is_some());
    // A patch of this radius has about this area and border.
    let change = |radius: f64| 4.0 * radius * radius + diagonal * 8.0 * radius / 3.0;
    let sum: f64 = paired.map(|(whole, _)| change(whole.root.radius)).sum();
    if sum > solid.area { solid.area / sum } else { 1.0 }
}
