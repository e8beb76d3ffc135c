//! Triangles that cross each other.

use super::sheets::SheetTriangle;
use crate::bvh::{Aabb, Bvh};
use crate::sorting::sort_by_number;
use glam::DVec3;
use std::collections::HashMap;

/// The largest number of places that are returned, and of one pair of surfaces.
const MAX_PLACES: usize = 64;
const MAX_PLACES_OF_PAIR: usize = 2;

/// The least depth of a crossing, in distances of the triangles from the surfaces: neighbours cross each other by as
/// much along their common edge.
const MIN_DEPTH: f64 = 3.0;

/// A place where two triangles cross.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    pub(super) point: DVec3,
    /// The normals of the triangles, of length 1.
    pub(super) normals: [DVec3; 2],
    pub(super) surfaces: [u32; 2],
    /// The least of the length of the crossing and of the distances of corners of both on both sides of the other one.
    pub(super) depth: f64,
}

/// Returns places where triangles cross, the deepest first. `tolerance` is how far the triangles are from surfaces.
pub(super) fn crossings(triangles: &[SheetTriangle], tolerance: f64) -> Vec<Crossing> {
    let boxes: Vec<Aabb> =
        triangles.iter().map(|triangle| triangle.corners.into_iter().fold(Aabb::EMPTY, Aabb::with)).collect();
    let normals: Vec<Option<DVec3>> = triangles.iter().map(normal).collect();
    let sheet = |index: u32| {
        let index = index as usize;
        Some(Sheet { triangle: &triangles[index], normal: normals[index]? })
    };
    let mut found = Vec::new();
    Bvh::new(&boxes).for_each_pair(|a, b| {
        let Some(sheets) = sheet(a).zip(sheet(b)) else { return };
        found.extend(crossing(sheets, MIN_DEPTH * tolerance));
    });
    sort_by_number(&mut found, |crossing: &Crossing| -crossing.depth);
    let mut counts: HashMap<[u32; 2], usize> = HashMap::new();
    found.retain(|crossing| {
        let [a, b] = crossing.surfaces;
        let count = counts.entry([a.min(b), a.max(b)]).or_default();
        *count += 1;
        *count <= MAX_PLACES_OF_PAIR
    });
    found.truncate(MAX_PLACES);
    found
}

/// A triangle with its normal.
#[derive(Clone, Copy)]
struct Sheet<'a> {
    triangle: &'a SheetTriangle,
    normal: DVec3,
}

impl Sheet<'_> {
    /// Returns the heights of the corners of another triangle above the plane of this one.
    fn heights(&self, other: &Self) -> [f64; 3] {
        other.triangle.corners.map(|corner| self.normal.dot(corner - self.triangle.corners[0]))
    }
}

/// Returns where two triangles cross by more than a depth, if each has corners as far on both sides of the other one.
fn crossing((a, b): (Sheet<'_>, Sheet<'_>), least: f64) -> Option<Crossing> {
    // Most pairs are neighbours, and end here.
    let heights_of_a = b.heights(&a);
    let depth_of_a = depth(heights_of_a).filter(|&depth| depth > least)?;
    let heights_of_b = a.heights(&b);
    let depth_of_b = depth(heights_of_b).filter(|&depth| depth > least)?;
    let along = a.normal.cross(b.normal).try_normalize()?;
    let (point, of_a) = cut(a.triangle, heights_of_a, along)?;
    let (_, of_b) = cut(b.triangle, heights_of_b, along)?;
    let [start, end] = [of_a[0].max(of_b[0]), of_a[1].min(of_b[1])];
    let depth = (end - start).min(depth_of_a).min(depth_of_b);
    let middle = 0.5 * (start + end);
    (depth > least).then_some(Crossing {
        point: point + (middle - along.dot(point)) * along,
        normals: [a.normal, b.normal],
        surfaces: [a.triangle.surface, b.triangle.surface],
        depth,
    })
}

/// Returns the lesser of the largest heights on both sides of a plane, if both are positive.
fn depth(heights: [f64; 3]) -> Option<f64> {
    let above = heights.iter().fold(0.0, |most: f64, &height| most.max(height));
    let below = heights.iter().fold(0.0, |most: f64, &height| most.max(-height));
    let depth = above.min(below);
    (depth > 0.0).then_some(depth)
}

fn normal(triangle: &SheetTriangle) -> Option<DVec3> {
    let [a, b, c] = triangle.corners;
    (b - a).cross(c - a).try_normalize()
}

/// Returns the cut of a triangle by a plane above which its corners have these heights: a point, and the places of both
/// ends along its direction.
fn cut(triangle: &SheetTriangle, heights: [f64; 3], along: DVec3) -> Option<(DVec3, [f64; 2])> {
    let mut ends = (0..3).filter_map(|k| {
        let [from, to] = [k, (k + 1) % 3];
        let is_cut = (heights[from] < 0.0) != (heights[to] < 0.0);
        let part = heights[from] / (heights[from] - heights[to]);
        is_cut.then(|| triangle.corners[from].lerp(triangle.corners[to], part))
    });
    let [first, second] = [ends.next()?, ends.next()?];
    let [a, b] = [along.dot(first), along.dot(second)];
    Some((first, [a.min(b), a.max(b)]))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn triangle(corners: [[f64; 3]; 3], surface: u32) -> SheetTriangle {
        SheetTriangle { corners: corners.map(DVec3::from_array), surface }
    }

    #[test]
    fn triangles_that_pass_through_each_other_cross_in_the_middle_of_their_common_segment() {
        let flat = triangle([[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [0.0, 2.0, 0.0]], 0);
        let upright = triangle([[0.0, -0.5, -1.0], [0.0, 0.5, -1.0], [0.0, 0.0, 1.0]], 1);
        let found = crossings(&[flat, upright], 0.0);
        let [Crossing { point, normals, surfaces, depth }] = found[..] else { panic!("{found:?}") };
        assert!(point.length() < 1e-12, "{point}");
        let [a, b] = normals.map(|normal| normal.abs());
        // Either may come first.
        assert!((a == DVec3::Z && b == DVec3::X) || (a == DVec3::X && b == DVec3::Z));
        assert_eq!(surfaces[0] + surfaces[1], 1);
        assert_eq!(depth, 0.5, "the length of the common segment");
    }

    #[test]
    fn triangles_that_touch_or_lie_beside_each_other_do_not_cross() {
        let flat = triangle([[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [0.0, 2.0, 0.0]], 0);
        let above = triangle([[0.0, -0.5, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 1.0]], 1);
        let beside = triangle([[3.0, -0.5, -1.0], [3.0, 0.5, -1.0], [3.0, 0.0, 1.0]], 2);
        let shallow = triangle([[0.0, -0.5, -1e-3], [0.0, 0.5, -1e-3], [0.0, 0.0, 1.0]], 3);
        assert!(crossings(&[flat, above, beside], 0.0).is_empty());
        assert_eq!(crossings(&[flat, shallow], 1e-4).len(), 1);
        assert!(crossings(&[flat, shallow], 1e-3).is_empty(), "no deeper than what the triangles tell");
    }
}
