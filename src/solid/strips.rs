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

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn line(start: [f64; 3], end: [f64; 3]) -> Curve {
        let controls = [start, end].map(|point| DVec3::from_array(point).extend(1.0)).to_vec();
        Curve { center: DVec3::ZERO, controls }
    }

    fn upwards(x: f64, y: f64) -> Ray {
        Ray::new(DVec3::new(x, y, 0.0), DVec3::Z, 1e-9)
    }

    /// A cone over the points of a corner is within their extent of each.
    #[test]
    fn a_corner_is_as_thick_as_its_points_are_apart() {
        let mut covering = Covering::default();
        covering.add_corner(vec![DVec3::ONE, DVec3::ONE + DVec3::new(3.0, 0.0, 4.0)]);
        covering.add_corner(vec![DVec3::ZERO]);
        assert_eq!(covering.thickness, 5.0);
    }

    #[test]
    fn a_ray_through_the_hull_of_a_corner_does_not_avoid_it() {
        let corner =
            Strip::Corner([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 2.0)).to_vec());
        assert!(!corner.is_avoided(&upwards(0.3, 0.3)));
        assert!(corner.is_avoided(&upwards(-0.1, 0.3)));
        assert!(corner.is_avoided(&upwards(0.6, 0.6)));
    }

    /// Two edges with a ray between them, far from both.
    #[test]
    fn a_ray_between_two_partners_does_not_avoid_their_strip() {
        let curves = [line([-1.0, -3.0, 2.0], [-1.0, 3.0, 2.0]), line([1.0, -3.0, 2.5], [1.0, 3.0, 2.5])];
        let strip = Strip::Pair(curves);
        assert!(!strip.is_avoided(&upwards(0.0, 0.1)));
        assert!(strip.is_avoided(&upwards(1.1, 0.1)) && strip.is_avoided(&upwards(0.0, 3.1)));
        let aabb = strip.bounding_box();
        assert_eq!([aabb.min, aabb.max], [DVec3::new(-1.0, -3.0, 2.0), DVec3::new(1.0, 3.0, 2.5)]);
        let leaves = upwards(1.0, 0.1).leaves(&crate::bvh::Bvh::new(&[aabb]));
        assert_eq!(leaves.len(), 1, "the box has both curves");
    }

    /// The points of a strip are within twice its tube of both curves (lemma S1).
    #[test]
    fn a_strip_is_twice_as_thick_as_its_tube() {
        let mut covering = Covering::default();
        let curves = [line([0.0; 3], [1.0, 0.0, 0.0]), line([0.0, 0.25, 0.0], [1.0, 0.25, 0.0])];
        covering.add_pair(curves, 0.5, 0);
        assert_eq!(covering.thickness, 0.5);
    }
}
