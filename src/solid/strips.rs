//! The thin sets that close the cracks between the faces of a solid.

use super::curve::Curve;
use super::ray::Ray;
use crate::bvh::Aabb;
use crate::rounding::upper_max;
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

/// Strips that cover all, with an upper bound on the distance of their points from the faces.
#[derive(Debug, Default)]
pub(super) struct Covering {
    pub(super) strips: Vec<Strip>,
    pub(super) thickness: f64,
}

impl Covering {
    /// Adds the hull of points about a corner, ends of edges all of them.
    pub(super) fn add_corner(&mut self, points: Vec<DVec3>) {
        let extent = points.iter().copied().fold(Aabb::EMPTY, Aabb::with).diagonal();
        self.thickness = upper_max(self.thickness, extent);
        self.strips.push(Strip::Corner(points));
    }

    /// Adds the strip between two curves in parts, each in a tube of about this radius, if that
    /// takes few.
    pub(super) fn add_pair(&mut self, curves: [Curve; 2], radius: f64, depth: u32) {
        let found = tube(&curves);
        if found <= radius || depth == MAX_DIVISIONS {
            // Lemma S1: a point of the strip is as near to the chord, which is as near to the curve.
            self.thickness = upper_max(self.thickness, 2.0 * found);
            self.strips.push(Strip::Pair(curves));
            return;
        }
        let [low, high] = halves(&curves);
        self.add_pair(low, radius, depth + 1);
        self.add_pair(high, radius, depth + 1);
    }
}

/// The largest number of times that a strip is divided before any ray meets it.
const MAX_DIVISIONS: u32 = 8;

/// Returns the largest distance of a control point of both curves from the chord of the first.
fn tube(curves: &[Curve; 2]) -> f64 {
    let [start, end] = curves[0].ends();
    let chord = end - start;
    let distance = |point: DVec3| {
        let along = (point - start).dot(chord) / chord.length_squared();
        // NaN comes from a chord without length.
        let along = if along.is_nan() { 0.0 } else { along.clamp(0.0, 1.0) };
        point.distance(start + along * chord)
    };
    curves.iter().flat_map(Curve::points).map(distance).fold(0.0, upper_max)
}

/// Returns the two halves of a strip: the first curve is divided in its middle.
fn halves(curves: &[Curve; 2]) -> [[Curve; 2]; 2] {
    let [a_low, a_high] = curves[0].split(0.5);
    let [b_low, b_high] = curves[1].split(curves[1].partner(curves[0].point(0.5)));
    [[a_low, b_low], [a_high, b_high]]
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
    halves(curves).iter().all(|half| avoids(half, ray, depth + 1))
}

/// The range in which a curve is divided: no part is empty.
const INTERIOR: [f64; 2] = [0.05, 0.95];

/// The number of steps toward the partner of a middle: any place is valid, and nearer ones make
/// thinner strips.
const PARTNER_STEPS: u32 = 2;

impl Curve {
    /// Returns where to divide the curve for a point near its middle.
    fn partner(&self, point: DVec3) -> f64 {
        (0..PARTNER_STEPS).fold(0.5, |t, _| {
            let next = self.step(t, point);
            // NaN comes from a cusp.
            if next.is_nan() { t } else { next.clamp(INTERIOR[0], INTERIOR[1]) }
        })
    }
}
