//! One facet: the closest point of it, and a plane that separates it from a point.

use crate::bvh::Aabb;
use crate::rounding::{lower_min, unit, upper_max};
use glam::DVec3;

/// A convex piece of a model: a point, or a triangle, which may be degenerate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Facet {
    /// A point.
    Point(DVec3),
    /// The convex hull of three points.
    Triangle([DVec3; 3]),
}

/// A point of a facet near a target point, as a convex combination of its corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Nearest {
    /// The weights of the corners: at least 0, with the sum 1 up to rounding.
    pub(crate) weights: [f64; 3],
    /// The vector from the target to the point.
    pub(crate) offset: DVec3,
    /// Its squared length.
    pub(crate) distance_squared: f64,
}

impl Nearest {
    /// Returns the point of these weights; the corners are relative to the target.
    fn new(corners: &[DVec3; 3], weights: [f64; 3]) -> Self {
        let offset = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        Self { weights, offset, distance_squared: offset.length_squared() }
    }
}

impl Facet {
    /// Returns the box around the facet.
    pub(crate) fn bounding_box(&self) -> Aabb {
        match self {
            Self::Point(point) => Aabb::EMPTY.with(*point),
            Self::Triangle(corners) => corners.iter().fold(Aabb::EMPTY, |aabb, &corner| aabb.with(corner)),
        }
    }

    /// Returns a normal of the facet, by the order of its corners; `None` for a point, and for
    /// corners on a line.
    pub(crate) fn normal(&self) -> Option<DVec3> {
        let Self::Triangle([a, b, c]) = self else { return None };
        let normal = (*b - *a).cross(*c - *a);
        (normal != DVec3::ZERO).then_some(normal)
    }

    /// Returns the point of these weights.
    pub(crate) fn point(&self, weights: [f64; 3]) -> DVec3 {
        match self {
            Self::Point(point) => *point,
            Self::Triangle([a, b, c]) => *a * weights[0] + *b * weights[1] + *c * weights[2],
        }
    }

    /// Returns the point of the facet that is nearest to `target` up to rounding.
    ///
    /// It is a point of the facet whatever the rounding (lemma F1 of docs/meshes.md), so that its
    /// distance is an upper bound: the nearest of three points of the edges and, where the
    /// target lies above the triangle, one of the interior.
    #[inline]
    pub(crate) fn nearest(&self, target: DVec3) -> Nearest {
        match self {
            Self::Point(point) => {
                let offset = *point - target;
                Nearest { weights: [1.0, 0.0, 0.0], offset, distance_squared: offset.length_squared() }
            }
            Self::Triangle(corners) => {
                let corners = corners.map(|corner| corner - target);
                let mut nearest = on_edges(&corners);
                if let Some(inside) = in_interior(&corners)
                    && inside.distance_squared < nearest.distance_squared
                {
                    nearest = inside;
                }
                nearest
            }
        }
    }

    /// Returns a lower bound on the distance from `target` to the facet, which rounding has not
    /// been taken off: the largest found of the distances to planes that separate the two, so
    /// that it holds whatever `nearest` is (lemma F2 of docs/meshes.md).
    pub(crate) fn distance_of_planes(&self, target: DVec3, nearest: &Nearest) -> f64 {
        if let Self::Point(_) = self {
            return nearest.distance_squared.sqrt();
        }
        let mut bound = 0.0;
        self.for_each_plane(target, nearest, |_, distance| {
            // NaN bounds nothing.
            if distance > bound {
                bound = distance;
            }
        });
        bound
    }

    /// Calls a function with planes that may separate the facet from `target`: the unit normal,
    /// towards the facet, and the least of n·(x − target) over the facet's points x, which is
    /// negative where the plane does not separate the two.
    pub(crate) fn for_each_plane(&self, target: DVec3, nearest: &Nearest, mut plane: impl FnMut(DVec3, f64)) {
        let Self::Triangle(corners) = self else {
            let normal = unit(nearest.offset);
            return plane(normal, normal.dot(nearest.offset));
        };
        let corners = corners.map(|corner| corner - target);
        let mut beyond = |normal: DVec3| {
            let normal = unit(normal);
            plane(
                normal,
                corners.iter().fold(f64::INFINITY, |least, corner| lower_min(least, normal.dot(*corner))),
            );
        };
        let across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        beyond(if across.dot(corners[0]) < 0.0 { -across } else { across });
        beyond(nearest.offset);
        for index in 0..3 {
            // At an edge the plane is parallel to it.
            if nearest.weights[index] == 0.0 {
                let edge = unit(corners[(index + 2) % 3] - corners[(index + 1) % 3]);
                let offset = corners[(index + 1) % 3];
                beyond(offset - edge * edge.dot(offset));
            }
        }
    }
}

/// Returns the nearest point to the origin of the edges of a triangle.
#[inline]
fn on_edges(corners: &[DVec3; 3]) -> Nearest {
    let mut nearest: Option<Nearest> = None;
    for start in 0..3 {
        let end = (start + 1) % 3;
        let edge = corners[end] - corners[start];
        let fraction = -corners[start].dot(edge) / edge.length_squared();
        // An edge of length 0 gives NaN, which is its start.
        let fraction = if fraction > 0.0 { fraction.min(1.0) } else { 0.0 };
        let mut weights = [0.0; 3];
        weights[start] = 1.0 - fraction;
        weights[end] = fraction;
        let found = Nearest::new(corners, weights);
        if nearest.is_none_or(|nearest| found.distance_squared < nearest.distance_squared) {
            nearest = Some(found);
        }
    }
    nearest.unwrap_or_else(|| Nearest::new(corners, [1.0, 0.0, 0.0]))
}

/// Returns the foot of the origin on a triangle's plane if it lies in the triangle.
#[inline]
fn in_interior(corners: &[DVec3; 3]) -> Option<Nearest> {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let area = |a: DVec3, b: DVec3| normal.dot(a.cross(b));
    let parts = [area(corners[1], corners[2]), area(corners[2], corners[0]), area(corners[0], corners[1])];
    let sum = parts[0] + parts[1] + parts[2];
    let is_inside = sum > 0.0 && parts.iter().all(|&part| part >= 0.0);
    is_inside.then(|| {
        let nearest = Nearest::new(corners, parts.map(|part| part / sum));
        let moved = moved_along_longest_edge(corners, &nearest);
        if moved.distance_squared < nearest.distance_squared { moved } else { nearest }
    })
}

/// Returns the point moved to the nearest one along the longest edge: the normal of a sliver is off
/// by its rounding over its width, which moves the point along it by many widths.
#[inline]
fn moved_along_longest_edge(corners: &[DVec3; 3], nearest: &Nearest) -> Nearest {
    let edge = |start: usize| corners[(start + 1) % 3] - corners[start];
    let lengths = [0, 1, 2].map(|start| edge(start).length_squared());
    let longest =
        (1..3).fold(0, |longest, start| if lengths[start] > lengths[longest] { start } else { longest });
    let mut weights = nearest.weights;
    let step = -nearest.offset.dot(edge(longest)) / lengths[longest];
    let [start, end] = [longest, (longest + 1) % 3];
    // Both stay positive.
    let step = upper_max(lower_min(step, weights[start]), -weights[end]);
    weights[start] -= step;
    weights[end] += step;
    Nearest::new(corners, weights)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::facets::rounding::facet_rounding;
    use num_rational::BigRational;
    use num_traits::{ToPrimitive, Zero};

    /// A point of a size from 2^-20 to 1 about a far one, or of the size of a sliver.
    fn random_corners(random: &mut fastrand::Rng, far: DVec3) -> [DVec3; 3] {
        let point = |random: &mut fastrand::Rng| DVec3::from_array([0; 3].map(|_| random.f64() - 0.5));
        let size = 0.5_f64.powi(random.i32(0..20));
        let [a, b, c] = [0; 3].map(|_| far + size * point(random));
        match random.u32(0..4) {
            // A sliver, a doubled corner, corners on a line.
            0 => [a, b, a.lerp(b, random.f64()) + 1e-12 * size * point(random)],
            1 => [a, b, b],
            2 => [a, a + (b - a) * 0.5, b],
            _ => [a, b, c],
        }
    }

    fn exact(number: f64) -> BigRational {
        BigRational::from_float(number).unwrap()
    }

    /// The exact distance between a point and the convex combination of these weights, divided by
    /// their sum.
    fn exact_distance(corners: &[DVec3; 3], weights: [f64; 3], target: DVec3) -> f64 {
        let sum: BigRational = weights.iter().map(|&weight| exact(weight)).sum();
        let mut squared = BigRational::zero();
        for axis in 0..3 {
            let at: BigRational =
                (0..3).map(|corner| exact(weights[corner]) * exact(corners[corner][axis])).sum();
            let difference = at / &sum - exact(target[axis]);
            squared += &difference * &difference;
        }
        squared.to_f64().unwrap().sqrt()
    }

    /// Lemma F1: the distance is that of a point of the triangle, up to the allowance.
    #[test]
    fn the_nearest_point_is_a_point_of_the_triangle() {
        let random = &mut fastrand::Rng::with_seed(41);
        let mut largest: f64 = 0.0;
        for round in 0..4000 {
            let far = DVec3::from_array([0; 3].map(|_| random.f64() * 4.0));
            let corners = random_corners(random, far);
            // Beside the triangle, or opposite to it, where the difference is rounded most.
            let target = if round % 2 == 0 { random_corners(random, far)[0] } else { -corners[1] };
            let nearest = Facet::Triangle(corners).nearest(target);
            assert!(nearest.weights.iter().all(|&weight| weight >= 0.0), "{nearest:?}");
            let length = corners.iter().fold(target.length(), |length, corner| length.max(corner.length()));
            let error = nearest.distance_squared.sqrt() - exact_distance(&corners, nearest.weights, target);
            assert!(error.abs() <= facet_rounding(length), "{error:e} for {corners:?} {target}");
            largest = largest.max(error.abs() / facet_rounding(length));
        }
        assert!(largest >= 0.02, "{largest}");
    }

    /// In slivers too: at a height above any of their points that is far below their width.
    #[test]
    fn points_above_slivers_have_their_height() {
        let random = &mut fastrand::Rng::with_seed(44);
        for _ in 0..4000 {
            let point = |random: &mut fastrand::Rng| DVec3::from_array([0; 3].map(|_| random.f64() - 0.5));
            let [a, b] = [point(random), point(random)];
            let along = (b - a).normalize();
            let across = along.cross(point(random)).normalize();
            let width = 10.0_f64.powf(-12.0 + 12.0 * random.f64());
            let mut corners = [a, b, a.lerp(b, random.f64()) + width * across];
            corners.rotate_left(random.usize(0..3));
            // Near an end too, where a foot that is moved along the sliver would leave it.
            let [s, t] = [random.f64(), random.f64()].map(|at| at.powi(random.i32(1..40)));
            let inside = Facet::Triangle(corners).point([1.0 - s, s * (1.0 - t), s * t]);
            let height = 1e-3 * width * random.f64();
            let found = Facet::Triangle(corners).nearest(inside + height * along.cross(across));
            assert!(found.weights.iter().all(|&weight| weight >= 0.0), "{found:?}");
            let distance = found.distance_squared.sqrt();
            assert!((distance - height).abs() <= facet_rounding(2.0), "{distance:e} {height:e} {width:e}");
        }
    }

    /// Lemma F2, attained: a separating plane gives the distance, so that each proves the other.
    #[test]
    fn planes_attain_the_distance() {
        let random = &mut fastrand::Rng::with_seed(42);
        for round in 0..20_000 {
            let corners = random_corners(random, DVec3::ZERO);
            let target = 2.0 * random_corners(random, DVec3::ZERO)[0];
            let facet = Facet::Triangle(corners);
            let nearest = facet.nearest(target);
            let (lower, upper) =
                (facet.distance_of_planes(target, &nearest), nearest.distance_squared.sqrt());
            let rounding = facet_rounding(2.0);
            assert!(lower <= upper + 2.0 * rounding, "{round}: {lower} {upper}");
            assert!(upper - lower <= 1e-9, "{round}: {lower} {upper} for {corners:?} {target}");
        }
    }

    /// Weights of any other points are farther.
    #[test]
    fn no_point_of_the_triangle_is_nearer_than_the_planes() {
        let random = &mut fastrand::Rng::with_seed(43);
        for _ in 0..2000 {
            let corners = random_corners(random, DVec3::ZERO);
            let target = 2.0 * random_corners(random, DVec3::ZERO)[0];
            let facet = Facet::Triangle(corners);
            let lower = facet.distance_of_planes(target, &facet.nearest(target)) - facet_rounding(2.0);
            for _ in 0..20 {
                let [s, t] = [random.f64(), random.f64()];
                let point = facet.point([1.0 - s, s * (1.0 - t), s * t]);
                assert!(point.distance(target) >= lower);
            }
        }
    }
}
