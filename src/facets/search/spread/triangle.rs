//! Bounds on the distances of all points of a triangle, and on their means.

use super::Spread;
use crate::facets::search::cover::cover_with_means;
use crate::facets::{FacetFoot, FacetTarget};
use crate::rounding::{UNIT_ROUNDOFF, lower_min, upper_max, upper_min};
use glam::DVec3;

/// The number of facets near a part beyond which it is bounded by its middle alone: it is halved
/// before it is narrow.
const MAX_NEAR: usize = 128;

/// The roundings of the reach beyond which no facet matters.
const REACH_ROUNDINGS: f64 = 4.0;

/// Returns the bounds by the distance of a triangle's middle and its radius, and the facet nearest to the middle.
pub(super) fn spread_by_middle(b: &FacetTarget, corners: &[DVec3; 3], start: u32) -> (Spread, u32) {
    let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    let radius = corners.iter().fold(0.0, |radius, corner| upper_max(radius, corner.distance(middle)));
    let (foot, _, lower) = b.certified(middle, start);
    (Spread::exact([lower - radius, foot.distance_squared.sqrt() + radius]), foot.facet)
}

/// A triangle whose distances are bounded, which rounding has not been added to.
pub(super) struct TriangleBounds<'a> {
    pub(super) b: &'a FacetTarget,
    pub(super) corners: &'a [DVec3; 3],
    /// The rounding of distances.
    pub(super) allowance: f64,
    /// The distance within which all of the triangle is near enough.
    pub(super) sufficient: f64,
}

/// Upper bounds on the distances of all points of a triangle, on their mean and on that of their squares.
#[derive(Clone, Copy)]
struct Above {
    upper: f64,
    mean: f64,
    square: f64,
}

impl TriangleBounds<'_> {
    /// Returns the bounds, and the facet nearest to the triangle's middle (lemmas F5, F8 and F12 of
    /// docs/meshes.md).
    pub(super) fn spread(&self, start: u32) -> (Spread, u32) {
        let &Self { b, corners, allowance, sufficient } = self;
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let radius = corners.iter().fold(0.0, |radius, corner| upper_max(radius, corner.distance(middle)));
        let foot = b.nearest(middle, start, 0.0);
        let Above { upper, mean, square } = self.above(foot, radius);
        if upper <= sufficient {
            return (Spread { lower: 0.0, upper, mean: [0.0, mean], square: [0.0, square] }, foot.facet);
        }
        let least = least_at_corners(b, corners, middle, upper, radius, allowance).unwrap_or_else(|| {
            let (_, _, lower) = b.certified(middle, foot.facet);
            [lower - radius; 3]
        });
        let lower = least.into_iter().fold(f64::INFINITY, lower_min);
        let low_mean = (least[0] + least[1] + least[2]) / 3.0;
        let positive = |value: f64| if value > 0.0 { value } else { 0.0 };
        let low = positive(low_mean);
        let spread = Spread { lower: positive(lower), upper, mean: [low, mean], square: [low * low, square] };
        (spread, foot.facet)
    }

    /// Returns the least upper bounds by the facet nearest to the middle, by a cover and by the facets nearest to
    /// the corners.
    fn above(&self, foot: FacetFoot, radius: f64) -> Above {
        let &Self { b, corners, sufficient, .. } = self;
        let to_middle = foot.distance_squared.sqrt();
        let all = to_middle + radius;
        let mut above = Above { upper: all, mean: all, square: all * all };
        above.take(self.by_facet(foot.facet));
        if above.upper <= sufficient {
            return above;
        }
        if let Some((cover, means)) = cover_with_means(b, corners, foot.facet, sufficient) {
            above.take(Above { upper: cover.upper, mean: means.mean, square: means.square });
            return above;
        }
        let mut tried = [foot.facet; 3];
        for corner in 0..3 {
            let facet = b.nearest(corners[corner], foot.facet, 0.0).facet;
            if !tried[..corner].contains(&facet) && facet != foot.facet {
                above.take(self.by_facet(facet));
            }
            tried[corner] = facet;
        }
        above
    }

    /// Returns the bounds by one facet: the distance is convex, and so is its square.
    fn by_facet(&self, facet: u32) -> Above {
        let squares = self.corners.map(|corner| self.b.distance_squared(facet, corner));
        let distances = squares.map(f64::sqrt);
        Above {
            upper: distances.into_iter().fold(0.0, upper_max),
            mean: (distances[0] + distances[1] + distances[2]) / 3.0,
            square: (squares[0] + squares[1] + squares[2]) / 3.0,
        }
    }
}

impl Above {
    fn take(&mut self, other: Self) {
        self.upper = upper_min(self.upper, other.upper);
        self.mean = upper_min(self.mean, other.mean);
        self.square = upper_min(self.square, other.square);
    }
}

/// Returns the values at the corners of a concave function that no distance of a point of the
/// triangle is below, at most `upper`: the least of linear functions, one for each facet that may be
/// nearest to a point (lemma F8 of docs/meshes.md); `None` if too many may be.
fn least_at_corners(
    b: &FacetTarget,
    corners: &[DVec3; 3],
    middle: DVec3,
    upper: f64,
    radius: f64,
    allowance: f64,
) -> Option<[f64; 3]> {
    let reach = (upper + radius + allowance) * (1.0 + REACH_ROUNDINGS * UNIT_ROUNDOFF);
    let reach_squared = reach * reach;
    let (mut least, mut count) = ([upper; 3], 0);
    b.visit(middle, reach_squared, |place| {
        let facet = b.facet(place);
        let nearest = facet.nearest(middle);
        // Planes that overflowed bound nothing.
        let mut best = [f64::NEG_INFINITY; 3];
        let (mut farthest, mut largest) = (0.0, f64::NEG_INFINITY);
        facet.for_each_plane(middle, &nearest, |normal, distance| {
            if distance > farthest {
                farthest = distance;
            }
            let mut under = least;
            for (under, corner) in under.iter_mut().zip(corners) {
                *under = lower_min(*under, distance - normal.dot(*corner - middle));
            }
            // Any plane of the facet is valid: the one that takes least off.
            let sum = under[0] + under[1] + under[2];
            if sum > largest {
                (largest, best) = (sum, under);
            }
        });
        // A facet that far is nearest to no point of the triangle.
        if farthest <= reach {
            count += 1;
            least = best;
        }
        (reach_squared, count > MAX_NEAR)
    });
    (count <= MAX_NEAR).then_some(least)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::facets::{Facet, PointCloud, TriangleMesh};

    /// The sides of a triangle are cut into this many for its means.
    const CUTS: usize = 40;

    fn mesh(corners: &[DVec3]) -> FacetTarget {
        let triangles: Vec<[u32; 3]> =
            (0..corners.len() as u32 / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        FacetTarget::of_mesh(&TriangleMesh::new(corners, &triangles).unwrap())
    }

    fn spread_of_triangle(b: &FacetTarget, corners: &[DVec3; 3], sufficient: f64) -> Spread {
        TriangleBounds { b, corners, allowance: 0.0, sufficient }.spread(0).0
    }

    /// A sheet of 18 triangles that share their vertices, which are this far from their places at most.
    fn sheet(random: &mut fastrand::Rng, off: f64) -> FacetTarget {
        let grid = |k: u32| f64::from(k) / 3.0 - 0.5 + off * (random.f64() - 0.5);
        let mut grid = grid;
        let vertices: Vec<DVec3> = (0..16).map(|k| DVec3::new(grid(k / 4), grid(k % 4), grid(1))).collect();
        let square = |k: u32| {
            let first = (k / 3) * 4 + k % 3;
            [[first, first + 4, first + 5], [first, first + 5, first + 1]]
        };
        let triangles: Vec<[u32; 3]> = (0..9).flat_map(square).collect();
        FacetTarget::of_mesh(&TriangleMesh::new(&vertices, &triangles).unwrap())
    }

    /// Lemmas F8 and F12 against the distances in the middles of small triangles, to few facets and, where the
    /// bound is by the middle alone, to many.
    #[test]
    fn no_distance_of_a_triangle_is_beyond_its_bounds() {
        let random = &mut fastrand::Rng::with_seed(61);
        let point = |random: &mut fastrand::Rng| DVec3::from_array([0; 3].map(|_| random.f64() - 0.5));
        for round in 0..400 {
            let size = 0.5_f64.powi(random.i32(0..5));
            let corners = [0; 3].map(|_| size * point(random));
            let b = if round % 20 == 0 {
                let near: Vec<DVec3> = (0..2 * MAX_NEAR).map(|_| 0.1 * point(random)).collect();
                FacetTarget::of_cloud(&PointCloud::new(near).unwrap())
            } else if round % 2 == 0 {
                let off = [0.01, 0.2, 0.6][random.usize(0..3)];
                sheet(random, off)
            } else {
                mesh(&(0..3 * random.usize(1..4)).map(|_| point(random)).collect::<Vec<_>>())
            };
            let sufficient = [0.0, 0.05][round / 2 % 2];
            let spread = spread_of_triangle(&b, &corners, sufficient);
            let [mut sum, mut squares] = [0.0; 2];
            for i in 0..CUTS {
                for j in 0..CUTS - i {
                    for third in [1.0, 2.0].into_iter().take(if i + j + 1 < CUTS { 2 } else { 1 }) {
                        let [s, t] = [i, j].map(|k| (k as f64 + third / 3.0) / CUTS as f64);
                        let at = Facet::Triangle(corners).point([1.0 - s - t, s, t]);
                        let to = |facet| b.distance_squared(facet, at);
                        let squared = (0..b.len() as u32).map(to).fold(f64::INFINITY, f64::min);
                        let distance = squared.sqrt();
                        assert!(spread.lower - 1e-12 <= distance && distance <= spread.upper + 1e-12);
                        sum += distance;
                        squares += squared;
                    }
                }
            }
            let count = (CUTS * CUTS) as f64;
            let [mean, square] = [sum / count, squares / count];
            let slack = 2e-3 * size;
            assert!(spread.mean[0] - slack <= mean && mean <= spread.mean[1] + slack, "{mean} {spread:?}");
            assert!(
                spread.square[0] - slack <= square && square <= spread.square[1] + slack,
                "{square} {spread:?}"
            );
        }
    }

    /// Lemma F12, attained: in a valley the distance is linear on either side of its floor, so that its mean is that of
    /// the corners of either half of the triangle; one facet has a larger one.
    #[test]
    fn the_mean_of_a_triangle_in_a_valley_is_attained() {
        let valley =
            [[0.0, -4.0, 0.0], [0.0, 4.0, 0.0], [3.0, 0.0, 4.0], [-3.0, 0.0, 4.0]].map(DVec3::from_array);
        let b = FacetTarget::of_mesh(&TriangleMesh::new(&valley, &[[0, 1, 2], [1, 0, 3]]).unwrap());
        let corners = [[-0.25, 0.1, 1.0], [0.25, 0.1, 1.0], [0.0, -0.3, 1.0]].map(DVec3::from_array);
        // At x it is (3 − 4 |x|) / 5: at the corners of a half 0.6, 0.6 and 0.4.
        let spread = spread_of_triangle(&b, &corners, 0.0);
        let mean = 1.6 / 3.0;
        // The rounding of areas is relative to the square of the largest length, 25, and the area is 0.1.
        let rounding = 1e-10;
        assert!((spread.upper - 0.6).abs() <= 1e-12 && spread.mean[1] >= mean, "{spread:?}");
        assert!(spread.mean[1] <= mean + rounding, "{spread:?}");
        let square = mean * mean + (2.0 * (0.6 - mean).powi(2) + (0.4 - mean).powi(2)) / 12.0;
        assert!(spread.square[1] >= square && spread.square[1] <= (0.36 + 0.36 + 0.16) / 3.0 + rounding);
        let of_one = (0.8 + 0.4 + 0.6) / 3.0;
        assert!(spread.mean[1] < of_one - 0.05 && spread.mean[0] <= mean);
    }

    /// A triangle that is near enough is not looked at more closely.
    #[test]
    fn a_triangle_within_the_sufficient_distance_is_decided_whole() {
        let b = sheet(&mut fastrand::Rng::with_seed(3), 0.0);
        let height = 0.25;
        let corners =
            [[-0.4, -0.45], [0.45, -0.1], [-0.2, 0.4]].map(|[x, y]| DVec3::new(x, y, height - 1.0 / 6.0));
        for (sufficient, lower) in [(0.24, height), (0.26, 0.0)] {
            let spread = spread_of_triangle(&b, &corners, sufficient);
            assert!(spread.upper >= height - 1e-12 && spread.upper <= upper_max(sufficient, height + 1e-12));
            assert!((spread.lower - lower).abs() <= 1e-12, "{spread:?}");
        }
    }

    /// Of more facets than are looked at, the others may be nearer: here one near a corner, beyond
    /// many above the middle.
    #[test]
    fn a_facet_beyond_many_others_may_be_nearest() {
        let corners = [DVec3::ZERO, DVec3::X * 3.0, DVec3::Y * 3.0];
        let middle = DVec3::new(1.0, 1.0, 0.0);
        // As many near the corner, so that the halves of the tree are the two.
        let near = [middle + DVec3::Z, DVec3::Z * 0.25];
        let points: Vec<DVec3> =
            (0..4 * MAX_NEAR).map(|k| near[k % 2] + DVec3::X * 1e-6 * k as f64).collect();
        let b = FacetTarget::of_cloud(&PointCloud::new(points).unwrap());
        let spread = spread_of_triangle(&b, &corners, 0.0);
        assert!(spread.lower <= 0.25, "{spread:?}");
    }
}
