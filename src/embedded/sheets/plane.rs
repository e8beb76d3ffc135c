//! Planes that the surfaces of faces lie in.

use crate::bvh::Aabb;
use crate::embedded::directions::{Direction, PRODUCT_ROUNDINGS};
use crate::rounding::{gamma, lower_min, upper_max};
use glam::DVec3;

/// A plane that a surface lies in.
#[derive(Debug, Clone, Copy)]
pub(in crate::embedded) struct Plane {
    point: DVec3,
    /// Of length 1.
    normal: DVec3,
    /// The distance of the surface from it, at most.
    off: f64,
}

/// The distance of the control points of a surface from a plane, relative to their extent, up to which it counts as plane.
const PLANE: f64 = 1e-10;

impl Plane {
    /// Returns the plane of some points, if they are all near one.
    pub(super) fn of(points: &[DVec3]) -> Option<Self> {
        let aabb = points.iter().copied().fold(Aabb::EMPTY, Aabb::with);
        let start = *points.first()?;
        let far =
            |from: &dyn Fn(DVec3) -> f64| points.iter().copied().max_by(|a, b| from(*a).total_cmp(&from(*b)));
        let end = far(&|point| point.distance(start))?;
        let aside = far(&|point| (point - start).cross(end - start).length())?;
        let normal = (end - start).cross(aside - start).try_normalize()?;
        let plane = Self { point: start, normal, off: 0.0 };
        let off = plane.distance(points);
        (off <= PLANE * aabb.diagonal()).then_some(Self { off, ..plane })
    }

    /// Returns the largest distance of points from the plane.
    pub(in crate::embedded) fn distance(&self, points: &[DVec3]) -> f64 {
        points.iter().map(|point| self.normal.dot(*point - self.point).abs()).fold(0.0, upper_max)
    }

    /// Returns the margin of the ways along pieces with these directions back to the plane, and in the plane from there to a
    /// point of it, if the directions leave it all to one side: with μ their least part away from it, points at most γ apart
    /// have ways of γ/μ on the piece and γ + γ/μ in the plane.
    pub(in crate::embedded) fn leaving(&self, directions: &[Direction]) -> Option<f64> {
        let least = self.least_height(directions)?;
        Some(least / (2.0 + least))
    }

    /// Returns the least part of directions away from the plane, all to one side, if they all leave it.
    fn least_height(&self, directions: &[Direction]) -> Option<f64> {
        let heights = directions.iter().map(|&Direction { unit, error }| (self.normal.dot(unit), error));
        let to_side = |sign: f64| {
            let least =
                heights.clone().map(|(height, error)| sign * height - error).fold(f64::INFINITY, lower_min);
            (least < f64::INFINITY).then_some(least - gamma(PRODUCT_ROUNDINGS)).filter(|&least| least > 0.0)
        };
        to_side(1.0).or_else(|| to_side(-1.0))
    }

    /// Returns how far the surface is from the plane.
    pub(in crate::embedded) fn off(&self) -> f64 {
        self.off
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    fn exact(vectors: &[DVec3]) -> Vec<Direction> {
        vectors.iter().map(|vector| Direction { unit: vector.normalize(), error: 0.0 }).collect()
    }

    /// The sine of the least angle to the plane, on either side; none where directions go to both.
    #[test]
    fn directions_leave_a_plane_by_the_sine_of_their_angle() {
        let plane = Plane::of(&[DVec3::Z, DVec3::X + DVec3::Z, DVec3::Y + DVec3::Z]).unwrap();
        assert_eq!(plane.off(), 0.0);
        assert_eq!(plane.distance(&[DVec3::new(7.0, 8.0, 1.25), DVec3::ZERO]), 1.0);
        let at = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            DVec3::new(cos, 0.0, sin)
        };
        for sign in [1.0, -1.0] {
            let margin = plane.leaving(&exact(&[at(sign * 30.0), at(sign * 90.0)])).unwrap();
            assert!((margin - 0.2).abs() < 1e-12, "{margin}");
        }
        for both in [[30.0, -30.0], [30.0, 0.0], [0.0, 180.0]] {
            assert_eq!(plane.leaving(&exact(&both.map(at))), None, "{both:?}");
        }
        let mut uncertain = exact(&[at(30.0)]);
        uncertain[0].error = 0.2;
        assert!((plane.least_height(&uncertain).unwrap() - 0.3).abs() < 1e-12);
        let bent = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 1e-6)];
        assert!(Plane::of(&bent).is_none());
    }
}
