//! The thin sets that close the cracks between the faces of a solid.

use super::curve::Curve;
use super::ray::Ray;
use crate::bvh::Aabb;
use glam::DVec3;

/// The largest number of times that a strip is divided: its parts are then shorter than rounding.
const MAX_DEPTH: u32 = 40;

/// A set that no ray may come near.
#[derive(Debug, Clone)]
pub(super) enum Strip {
    /// The hull of some points about a corner.
    Corner(Vec<DVec3>),
    /// A strip between two partners, which run in one direction (lemma S1 of docs/solids.md).
    Pair([Curve; 2]),
}

impl Strip {
    /// Returns a box around the strip.
    pub(super) fn bounding_box(&self) -> Aabb {
        match self {
            Self::Corner(points) => points.iter().copied().fold(Aabb::EMPTY, Aabb::with),
            Self::Pair(curves) => curves.iter().flat_map(Curve::points).fold(Aabb::EMPTY, Aabb::with),
        }
    }

    /// Returns true only if the ray certainly avoids the strip.
    pub(super) fn is_avoided(&self, ray: &Ray) -> bool {
        match self {
            Self::Corner(points) => ray.avoids(points.iter().copied()),
            Self::Pair(curves) => avoids(curves, ray, 0),
        }
    }
}

/// Returns true only if the ray avoids a strip between two curves that lies in the hulls of
/// corresponding parts; any correspondence will do, as long as it is monotone.
fn avoids(curves: &[Curve; 2], ray: &Ray, depth: u32) -> bool {
    if ray.avoids(curves.iter().flat_map(Curve::points)) {
        return true;
    }
    if depth == MAX_DEPTH {
        return false;
    }
    let [a_low, a_high] = curves[0].split(0.5);
    let [b_low, b_high] = curves[1].split(curves[1].partner(curves[0].point(0.5)));
    avoids(&[a_low, b_low], ray, depth + 1) && avoids(&[a_high, b_high], ray, depth + 1)
}

/// The range in which a curve is divided: no part is empty.
const INTERIOR: [f64; 2] = [0.05, 0.95];

impl Curve {
    /// Returns where to divide the curve for a point near its middle.
    fn partner(&self, point: DVec3) -> f64 {
        let (t, _) = self.closest(point);
        t.clamp(INTERIOR[0], INTERIOR[1])
    }
}
