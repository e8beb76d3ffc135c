//! One of the two solids.

use super::piece::Patches;
use crate::bezier::{PatchSet, PointError};
use crate::bvh::Aabb;
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::rounding::{VANISHING_LENGTH, gamma};
use crate::solid::{Enclosing, Ruled, Side};
use crate::threads::MaybeSync;
use glam::DVec3;

/// The largest number of halvings of a piece.
pub(super) const MAX_DEPTH: u32 = 64;

/// The roundings of distances and heights of control points, and of points that are moved back, relative to the largest
/// coordinate.
const DISTANCE_ROUNDINGS: f64 = 256.0;

/// The largest distance from the origin of a centre together with a control point from it, relative to that of a patch.
const CENTER_PART: f64 = 3.0;

/// The side to which the normals of a surface's patches are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BoundarySide {
    /// Out of the solid.
    Outward,
    /// Into it.
    Inward,
    /// Not known: the volume of the shell is too small to tell.
    Unknown,
}

/// The sides of points.
pub(crate) trait Sides: MaybeSync {
    /// Returns the shells of the first or the second solid about a point in the common frame, and its side, which may
    /// be found from another point about which the shells are known.
    fn side(
        &self,
        solid: usize,
        point: DVec3,
        beside: Option<&(DVec3, Enclosing)>,
    ) -> Option<(Enclosing, Side)>;
}

/// A solid in the common frame.
#[derive(Debug)]
pub(crate) struct PlacedSolid {
    pub(super) patches: Patches,
    /// A box around it.
    pub(super) aabb: Aabb,
    /// Its volume.
    pub(crate) volume: Interval,
    /// An upper bound on the area of the strips and cones that close its shells.
    pub(super) cracks: f64,
    /// An upper bound on the area of its boundary with them.
    pub(super) area: f64,
    /// Upper bounds on the distance of a computed point from the exact one, with that of trimmed faces.
    point_error: PointError,
    /// The distance of trimmed faces from their patches, which volumes are without.
    deviation: f64,
    /// The error of the motion.
    motion: f64,
    /// Upper bound on the distance of the patches and strips from computed ones.
    rounding: f64,
}

/// What is known of a solid in its own frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Known {
    pub(crate) volume: Interval,
    pub(crate) area: Interval,
    pub(crate) cracks: f64,
    pub(crate) point_error: PointError,
    pub(crate) deviation: f64,
    pub(crate) rounding: f64,
}

impl PlacedSolid {
    /// Moves the patches of a solid and its strips; `side` states to which side the normals of a surface are. O(n log n).
    pub(crate) fn new(
        patches: &PatchSet,
        strips: impl Iterator<Item = Ruled>,
        transform: Option<&RigidTransform>,
        side: impl Fn(usize) -> BoundarySide,
        known: Known,
    ) -> Self {
        let own = patches.bounding_box().farthest_from_origin();
        let motion = transform.map_or(0.0, |transform| transform.rounding(CENTER_PART * own));
        let patches = Patches::new(patches, strips, transform, side);
        let aabb = patches.bounding_box();
        let Known { volume, area, cracks, point_error, deviation, rounding } = known;
        let area = (area.upper + cracks).next_up();
        Self { patches, aabb, volume, area, cracks, point_error, deviation, motion, rounding }
    }

    /// Moves the solid by a vector; its points are off by at most `rounding` then.
    pub(super) fn moved_by(self, vector: DVec3, rounding: f64) -> Self {
        let patches = self.patches.moved_by(vector);
        let aabb = patches.bounding_box();
        Self { patches, aabb, motion: self.motion + rounding, ..self }
    }

    /// Returns an upper bound on the distance of points of a piece, after this many halvings, from those of the faces.
    pub(super) fn error(&self, depth: u32) -> f64 {
        self.point_error.after(depth) + self.motion
    }

    /// The same from the exact points of the patches.
    pub(super) fn moved(&self, depth: u32) -> f64 {
        self.error(depth) - self.deviation
    }

    /// Returns the distance that the hull of a piece of `other` and those of all pieces and strips of this one must
    /// exceed for the piece to be off this boundary.
    pub(super) fn margin(&self, other: &Self) -> f64 {
        let [a, b] = [self, other].map(|solid| solid.aabb.farthest_from_origin());
        let length = if a > b { a } else { b };
        let errors = self.error(MAX_DEPTH) + other.error(MAX_DEPTH) + self.motion;
        errors + self.rounding + gamma(DISTANCE_ROUNDINGS) * length + VANISHING_LENGTH
    }
}
