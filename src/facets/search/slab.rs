//! Two triangles in a plane that a cell is near, seen along the normal of its diagonals (lemma F13 of docs/meshes.md).
//!
//! Unlike the triangles between a cell's corners they hold all of it: a cell in a plane whose sides are curved is
//! within rounding of them, at any size.

use super::super::rounding::{sag_rounding, slab_rounding};
use super::patch_cell::Net;
use crate::rounding::{lower_min, unit, upper_max};
use glam::{DVec2, DVec3};

/// The least sine of the angle between two neighbouring sides of the quadrangle: the error of a corner is that of a
/// side, divided by this.
const MIN_SINE: f64 = 1.0 / 16.0;

/// The length of a side, relative to the longest, below which its direction is that between its neighbours.
const MIN_SIDE: f64 = 1e-3;

/// The largest length of a corner, relative to that of any point: what rounding takes is relative to it.
const MAX_BEYOND: f64 = 2.0;

/// Two triangles with the distance within which all points of a cell are of one of them.
pub(super) struct Slab {
    pub(super) triangles: [[DVec3; 3]; 2],
    pub(super) height: f64,
}

/// A half-plane that all control points are in, and one on its border.
#[derive(Clone, Copy)]
struct Side {
    outwards: DVec2,
    /// The largest component of a control point along it.
    reach: f64,
}

impl Net {
    /// Returns the triangles between the corners, or those of a quadrangle around the cell where they are nearer.
    pub(super) fn slab(&self, length: f64) -> Slab {
        let corners = self.corner_triangles(length);
        match self.around(length) {
            Some(around) if around.height < corners.height => around,
            _ => corners,
        }
    }

    /// Returns the triangles between the corners (lemma F6).
    pub(super) fn corner_triangles(&self, length: f64) -> Slab {
        let [a, b, c, d] = self.corners();
        Slab { triangles: [[a, b, c], [a, c, d]], height: self.sag() + sag_rounding(length) }
    }

    /// Returns the triangles of the quadrangle whose sides are parallel to those of the cell, or of a rectangle.
    fn around(&self, length: f64) -> Option<Slab> {
        let [a, b, c, d] = self.corners();
        let normal = unit((c - a).cross(d - b));
        let along = unit(normal.cross(longer(c - a, d - b)));
        if normal == DVec3::ZERO || along == DVec3::ZERO {
            return None;
        }
        let axes = [along, normal.cross(along)];
        let image = |point: DVec3| DVec2::from_array(axes.map(|axis| axis.dot(point - a)));
        let images: Vec<DVec2> = self.points().iter().map(|&point| image(point)).collect();
        let [mut low, mut high] = [0.0; 2];
        for &point in self.points() {
            let height = normal.dot(point - a);
            (low, high) = (lower_min(low, height), upper_max(high, height));
        }
        let middle = 0.5 * (low + high);
        let height = upper_max(high - middle, middle - low) + slab_rounding(length);
        let corners = quadrangle([a, b, c, d].map(image), &images)?;
        let [a, b, c, d] =
            corners.map(|corner| a + axes[0] * corner.x + axes[1] * corner.y + normal * middle);
        let farthest = [a, b, c, d].into_iter().fold(0.0, |far, corner| upper_max(far, corner.length()));
        (farthest <= MAX_BEYOND * length).then_some(Slab { triangles: [[a, b, c], [a, c, d]], height })
    }
}

fn longer(one: DVec3, other: DVec3) -> DVec3 {
    if other.length_squared() > one.length_squared() { other } else { one }
}

/// Returns the corners of a quadrangle with all points in it, with sides along those between the corners of the cell,
/// else of a rectangle along the longest one.
fn quadrangle(cell: [DVec2; 4], points: &[DVec2]) -> Option<[DVec2; 4]> {
    let sides = [0, 1, 2, 3].map(|index| cell[(index + 1) % 4] - cell[index]);
    let lengths = sides.map(DVec2::length);
    let longest = (1..4).fold(0, |long, side| if lengths[side] > lengths[long] { side } else { long });
    if !(lengths[longest] > 0.0) {
        return None;
    }
    let direction = |index: usize| sides[index] / lengths[index];
    let directions = [0, 1, 2, 3].map(|index| {
        if lengths[index] > MIN_SIDE * lengths[longest] {
            return direction(index);
        }
        (direction((index + 3) % 4) + direction((index + 1) % 4)).normalize_or_zero()
    });
    let of = |directions| corners_between(directions, points);
    of(directions).or_else(|| {
        let along = direction(longest);
        of([along, along.perp(), -along, -along.perp()])
    })
}

/// Returns the corners between neighbouring sides with these directions, to whose left all points are; `None` if two
/// sides are nearly parallel or turn to the right.
fn corners_between(directions: [DVec2; 4], points: &[DVec2]) -> Option<[DVec2; 4]> {
    let sides = directions.map(|direction| {
        let outwards = -direction.perp();
        let reach =
            points.iter().fold(f64::NEG_INFINITY, |reach, point| upper_max(reach, outwards.dot(*point)));
        Side { outwards, reach }
    });
    let mut corners = [DVec2::ZERO; 4];
    for index in 0..4 {
        let [one, other] = [sides[(index + 3) % 4], sides[index]];
        let sine = one.outwards.perp_dot(other.outwards);
        if !(sine >= MIN_SINE) {
            return None;
        }
        // Along the normals of both sides by their reach.
        corners[index] = (other.outwards.perp() * -one.reach + one.outwards.perp() * other.reach) / sine;
    }
    Some(corners)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::facets::Facet;

    /// What the lengths of these nets are below.
    const LENGTH: f64 = 4.0;

    fn distance(slab: &Slab, point: DVec3) -> f64 {
        let to = |triangle: [DVec3; 3]| Facet::Triangle(triangle).nearest(point).distance_squared.sqrt();
        slab.triangles.map(to).into_iter().fold(f64::INFINITY, f64::min)
    }

    /// A part of a ring in a plane that is tilted, as a net of degree (2, 1).
    fn part_of_ring(turn: f64) -> Net {
        let frame = glam::DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), turn);
        let on = |radius: f64| {
            [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
                .map(|[x, y]| frame * DVec3::new(radius * x, radius * y, 0.25))
        };
        let [inner, outer] = [on(1.0), on(1.5)];
        Net::new((0..3).flat_map(|i| [outer[i], inner[i]]).collect(), [2, 1])
    }

    /// Lemma F13: convex combinations of control points are within the height, of nets that are nearly flat, any, and
    /// in a plane.
    #[test]
    fn no_point_of_a_patch_is_beyond_its_slab() {
        let random = &mut fastrand::Rng::with_seed(13);
        let (mut around, mut largest) = (0, 0.0_f64);
        for round in 0..3000 {
            let degree = [random.usize(1..4), random.usize(1..4)];
            let bend = [DVec3::splat(0.05), DVec3::ONE, DVec3::new(1.0, 1.0, 0.0)][round % 3];
            let mut points = Vec::new();
            for k in 0..(degree[0] + 1) * (degree[1] + 1) {
                let [i, j] = [k / (degree[1] + 1), k % (degree[1] + 1)];
                let at = DVec3::new(i as f64 / degree[0] as f64, j as f64 / degree[1] as f64, 0.0);
                points.push(at + bend * DVec3::from_array([0; 3].map(|_| random.f64() - 0.5)));
            }
            let net = Net::new(points, degree);
            let Some(slab) = net.around(LENGTH) else { continue };
            around += 1;
            for _ in 0..20 {
                let weights: Vec<f64> = net.points().iter().map(|_| random.f64().powi(8)).collect();
                let sum: f64 = weights.iter().sum();
                let point = net.points().iter().zip(&weights).map(|(&point, weight)| point * (weight / sum));
                let found = distance(&slab, point.sum());
                assert!(found <= slab.height, "round {round}: {found} {}", slab.height);
                largest = largest.max(found / slab.height);
            }
            for &point in net.points() {
                assert!(distance(&slab, point) <= slab.height, "round {round}");
            }
        }
        assert!(around > 2500 && largest > 0.9, "{around} {largest}");
    }

    /// Attained: a part of a plane has no height, whatever its sides, and an arch is as far below the plane at its feet.
    #[test]
    fn a_part_of_a_plane_has_no_height_and_that_of_an_arch_is_attained() {
        for turn in [0.0, 0.7, 2.9] {
            let slab = part_of_ring(turn).slab(LENGTH);
            assert!(slab.height <= slab_rounding(LENGTH) + 1e-15);
            assert!(part_of_ring(turn).sag() > 0.1);
        }
        let arch = [[0.0, 0.0], [0.5, 0.125], [1.0, 0.0]];
        let points = arch.into_iter().flat_map(|[x, z]| [0.0, 1.0].map(|y| DVec3::new(x, y, z))).collect();
        let slab = Net::new(points, [2, 1]).slab(LENGTH);
        assert!((distance(&slab, DVec3::ZERO) - 0.0625).abs() < 1e-15 && slab.height - 0.0625 <= 1e-11);
    }

    /// Where two neighbouring sides are nearly parallel a rectangle has all points; a side without a length has the
    /// direction between its neighbours.
    #[test]
    fn cells_with_parallel_or_vanishing_sides_have_quadrangles() {
        let cells = [
            [[0.0, 0.0], [1.0, 0.0], [2.0, 0.01], [0.0, 1.0]],
            [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.5, 1.0]],
        ];
        for cell in cells.map(|cell| cell.map(DVec2::from_array)) {
            let corners = quadrangle(cell, &cell).unwrap();
            for index in 0..4 {
                let [from, to] = [corners[index], corners[(index + 1) % 4]];
                for point in cell {
                    assert!((to - from).perp_dot(point - from) >= -1e-14, "{cell:?} {corners:?}");
                }
            }
        }
        let point = [DVec2::ZERO; 4];
        assert_eq!(quadrangle(point, &point), None);
    }
}
