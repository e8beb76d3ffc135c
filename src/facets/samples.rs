//! Samples of the facets of a group, for fields and fits.

use super::{Facet, FacetTarget};
use glam::DVec3;
use std::collections::HashMap;

/// Samples of one group of facets.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct FacetSamples {
    /// The points of a cloud in their order; of a mesh its vertices in the order in which its
    /// triangles use them, and then points within large triangles.
    pub(crate) points: Vec<DVec3>,
    /// The area that each stands for; 1 for each point of a cloud.
    pub(crate) areas: Vec<f64>,
    /// The corners of triangles between the samples, which cover the mesh.
    pub(crate) triangles: Vec<u32>,
}

impl FacetSamples {
    /// Samples a group, with at least `count²` triangles between the samples of a mesh: a triangle
    /// of more than that part of the area is cut into equal ones. O(n + count²).
    pub(crate) fn of(facets: &FacetTarget, count: usize) -> Self {
        let mut samples = Self::default();
        let mut triangles = Vec::new();
        for place in facets.places() {
            match facets.facet(place) {
                Facet::Point(point) => {
                    samples.push(point, 1.0);
                }
                Facet::Triangle(corners) => triangles.push(corners),
            }
        }
        samples.add_triangles(&triangles, count);
        samples
    }

    fn push(&mut self, point: DVec3, area: f64) -> u32 {
        self.points.push(point);
        self.areas.push(area);
        self.points.len() as u32 - 1
    }

    fn add_triangles(&mut self, triangles: &[[DVec3; 3]], count: usize) {
        let mut known: HashMap<[u64; 3], u32> = HashMap::new();
        let mut corners: Vec<[u32; 3]> = Vec::with_capacity(triangles.len());
        for triangle in triangles {
            corners.push(triangle.map(|corner| {
                let key = corner.to_array().map(|coordinate| (coordinate + 0.0).to_bits());
                *known.entry(key).or_insert_with(|| self.push(corner, 0.0))
            }));
        }
        let area = |[a, b, c]: &[DVec3; 3]| 0.5 * (*b - *a).cross(*c - *a).length();
        let part = triangles.iter().map(area).sum::<f64>() / (count * count) as f64;
        for (triangle, corners) in triangles.iter().zip(corners) {
            let area = area(triangle);
            let sides = if part > 0.0 { (area / part).sqrt().ceil().clamp(1.0, count as f64) } else { 1.0 };
            self.cut(triangle, corners, sides as usize, area);
        }
    }

    /// Cuts a triangle into `sides²` equal ones.
    fn cut(&mut self, [a, b, c]: &[DVec3; 3], corners: [u32; 3], sides: usize, area: f64) {
        let mut rows: Vec<Vec<u32>> = Vec::with_capacity(sides + 1);
        for row in 0..=sides {
            // The row from the edge of the first corner towards that of the two others.
            let sample = |column: usize, samples: &mut Self| match (row, column) {
                (0, _) => corners[0],
                (row, 0) if row == sides => corners[1],
                (row, column) if row == sides && column == sides => corners[2],
                _ => {
                    let [s, t] = [row, column].map(|index| index as f64 / sides as f64);
                    samples.push(*a + (*b - *a) * (s - t) + (*c - *a) * t, 0.0)
                }
            };
            rows.push((0..=row).map(|column| sample(column, self)).collect());
        }
        let third = area / (3 * sides * sides) as f64;
        for row in 0..sides {
            let (near, far) = (&rows[row], &rows[row + 1]);
            for column in 0..=row {
                let upward = [near[column], far[column], far[column + 1]];
                let downward = (column < row).then(|| [near[column], far[column + 1], near[column + 1]]);
                for triangle in std::iter::once(upward).chain(downward) {
                    self.triangles.extend(triangle);
                    triangle.iter().for_each(|&corner| self.areas[corner as usize] += third);
                }
            }
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::facets::{PointCloud, TriangleMesh};

    #[test]
    fn large_triangles_are_cut_and_small_ones_have_their_vertices() {
        let vertices = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 2.0));
        let mesh = TriangleMesh::new(&vertices, &[[0, 1, 2], [0, 2, 3]]).unwrap();
        let target = FacetTarget::of_mesh(&mesh);
        let two = FacetSamples::of(&target, 1);
        assert_eq!((two.points.as_slice(), two.triangles), (vertices.as_slice(), vec![0, 1, 2, 0, 2, 3]));
        assert_eq!(two.areas, [1.0 / 3.0, 1.0 / 6.0, 1.0 / 3.0, 1.0 / 6.0]);
        let cut = FacetSamples::of(&target, 4);
        assert_eq!(&cut.points[..4], vertices);
        assert_eq!(cut.triangles.len(), 3 * 2 * 9);
        assert!((cut.areas.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        for corners in cut.triangles.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|corner| cut.points[corner as usize]);
            assert!((0.5 * (b - a).cross(c - a).z - 1.0 / 18.0).abs() < 1e-12);
        }
    }

    #[test]
    fn points_are_in_their_order() {
        let points: Vec<DVec3> = (0..100).map(|k| DVec3::splat(f64::from(k * 37 % 101))).collect();
        let target = FacetTarget::of_cloud(&PointCloud::new(points.clone()).unwrap());
        let samples = FacetSamples::of(&target, 9);
        assert_eq!((samples.points, samples.areas.len()), (points, 100));
        assert!(samples.triangles.is_empty());
    }
}
