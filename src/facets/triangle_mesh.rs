//! Meshes of triangles.

use super::point_cloud::{MAX_FACETS, validate};
use crate::error::{Error, Result};
use crate::one_line::one_line;
use glam::DVec3;
use std::collections::HashMap;

/// A valid mesh of triangles: at least one, at most 2^30; the coordinates are finite and at most
/// 1e100 in size, the indices those of vertices, and no two vertices equal.
///
/// It is measured as the set of all points of its triangles, the degenerate ones included: whether
/// they close, intersect or turn over makes no difference.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleMesh {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    groups: Vec<MeshGroup>,
    gap: f64,
    report: MeshReport,
}

/// Triangles that follow each other: an object, a primitive or a part of a file. It is a face of the
/// mesh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MeshGroup {
    /// The name in its source, if it has one.
    pub name: Option<String>,
    /// The number of triangles, at least 1.
    pub triangles: usize,
}

/// The findings about a mesh that do not make it invalid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct MeshReport {
    /// The number of vertices that were joined with an equal one.
    pub joined_vertices: usize,
    /// The number of vertices without a triangle, which are left out.
    pub unused_vertices: usize,
    /// The number of triangles with two equal corners.
    pub collapsed_triangles: usize,
    /// The number of other triangles whose corners lie on a line to the precision of float64.
    pub flat_triangles: usize,
}

impl TriangleMesh {
    /// Makes the mesh of these vertices and triangles. Vertices of equal coordinates are joined, and
    /// those that no triangle has are left out. O(n).
    ///
    /// # Errors
    /// [`Error::PointOutOfRange`] for a coordinate that is not finite or above 1e100 in size;
    /// [`Error::TriangleIndex`] for the index of no vertex; [`Error::NoFacets`] without
    /// triangles; [`Error::TooManyFacets`] for more than 2^30 triangles or vertices.
    pub fn new(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<Self> {
        if triangles.is_empty() {
            return Err(Error::NoFacets { expected: "triangles" });
        }
        if triangles.len() > MAX_FACETS {
            return Err(Error::TooManyFacets { found: triangles.len(), expected: MAX_FACETS });
        }
        validate(vertices)?;
        let mut joined = Joined { places: vec![None; vertices.len()], ..Joined::default() };
        let mut report = MeshReport::default();
        let mut kept = Vec::with_capacity(triangles.len());
        for (index, triangle) in triangles.iter().enumerate() {
            let mut corners = [0; 3];
            for (corner, &vertex) in corners.iter_mut().zip(triangle) {
                let found = Error::TriangleIndex {
                    triangle: index,
                    found: vertex as usize,
                    expected: vertices.len(),
                };
                *corner = joined.place(vertices, vertex as usize).ok_or(found)?;
            }
            kept.push(corners);
        }
        let Joined { places, vertices, .. } = joined;
        report.unused_vertices = places.iter().filter(|place| place.is_none()).count();
        report.joined_vertices = places.len() - report.unused_vertices - vertices.len();
        let groups = vec![MeshGroup { name: None, triangles: kept.len() }];
        let mut mesh = Self { vertices, triangles: kept, groups, gap: 0.0, report };
        mesh.report_degenerate_triangles();
        Ok(mesh)
    }

    /// Makes the mesh of a flat list of indices, three a triangle. As [`TriangleMesh::new`].
    ///
    /// # Errors
    /// Those of [`TriangleMesh::new`]; [`Error::TriangleIndex`] for a last triangle of fewer than
    /// three indices.
    pub fn of_indices(vertices: &[DVec3], indices: &[u32]) -> Result<Self> {
        let (triangles, rest) = indices.as_chunks();
        if !rest.is_empty() {
            let [triangle, found, expected] = [triangles.len(), vertices.len(), vertices.len()];
            return Err(Error::TriangleIndex { triangle, found, expected });
        }
        Self::new(vertices, triangles)
    }

    /// Returns the mesh with these groups as its faces, in the order of its triangles; a mesh that
    /// is given none is one face. Their names are shown as [`crate::one_line`] does. O(groups).
    ///
    /// # Errors
    /// [`Error::MeshGroups`] unless every group has triangles and all have those of the mesh together.
    pub fn with_groups(self, groups: Vec<MeshGroup>) -> Result<Self> {
        let found = groups.iter().fold(0_usize, |sum, group| sum.saturating_add(group.triangles));
        let expected = self.triangles.len();
        if found != expected || groups.iter().any(|group| group.triangles == 0) {
            return Err(Error::MeshGroups { found, expected });
        }
        let shown = |group: MeshGroup| MeshGroup { name: group.name.map(|name| one_line(&name)), ..group };
        Ok(Self { groups: groups.into_iter().map(shown).collect(), ..self })
    }

    /// Returns the mesh as one that stands for a surface at a Hausdorff distance of at most `gap`, in its units, as
    /// the triangles of polygons that are not plane do. It is 0 otherwise.
    ///
    /// # Errors
    /// [`Error::GapInvalid`] for a negative gap and one that is not finite.
    pub fn with_gap(self, gap: f64) -> Result<Self> {
        if !(gap >= 0.0 && gap.is_finite()) {
            return Err(Error::GapInvalid { surface: 0, found: gap });
        }
        Ok(Self { gap, ..self })
    }

    /// Returns the gap of [`TriangleMesh::with_gap`].
    #[must_use]
    pub fn gap(&self) -> f64 {
        self.gap
    }

    /// Returns the groups, at least one.
    #[must_use]
    pub fn groups(&self) -> &[MeshGroup] {
        &self.groups
    }

    /// Returns the vertices, no two of them equal.
    #[must_use]
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Returns the triangles, in the order given, by the indices of their corners in
    /// [`TriangleMesh::vertices`].
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Returns the findings about the mesh.
    #[must_use]
    pub fn report(&self) -> MeshReport {
        self.report
    }

    /// Returns the corners of a triangle, which must be below the number of triangles.
    #[must_use]
    pub fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|vertex| self.vertices[vertex as usize])
    }

    fn report_degenerate_triangles(&mut self) {
        for (index, [a, b, c]) in self.triangles.iter().enumerate() {
            if a == b || b == c || c == a {
                self.report.collapsed_triangles += 1;
            } else {
                let [a, b, c] = self.corners(index);
                let is_flat = (b - a).cross(c - a) == DVec3::ZERO;
                self.report.flat_triangles += usize::from(is_flat);
            }
        }
    }
}

/// Vertices without repetition, in the order of their first use.
#[derive(Default)]
struct Joined {
    /// The new index of each vertex that is used.
    places: Vec<Option<u32>>,
    by_position: HashMap<[u64; 3], u32>,
    vertices: Vec<DVec3>,
}

impl Joined {
    /// Returns the new index of a vertex, `None` if there is no such vertex.
    fn place(&mut self, vertices: &[DVec3], vertex: usize) -> Option<u32> {
        let known = self.places.get_mut(vertex)?;
        if let Some(place) = *known {
            return Some(place);
        }
        // The sum with 0 makes -0 and 0 equal.
        let key = vertices[vertex].to_array().map(|coordinate| (coordinate + 0.0).to_bits());
        let next = self.vertices.len() as u32;
        let place = *self.by_position.entry(key).or_insert(next);
        if place == next {
            self.vertices.push(vertices[vertex]);
        }
        *known = Some(place);
        Some(place)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    #[test]
    fn equal_vertices_are_joined_and_degenerate_triangles_reported() {
        let [a, b, c] = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let vertices = [a, b, c, DVec3::new(-0.0, 0.0, -0.0), b, DVec3::splat(7.0), 2.0 * b];
        let mesh = TriangleMesh::new(&vertices, &[[0, 1, 2], [3, 4, 2], [0, 3, 1], [0, 1, 6]]).unwrap();
        assert_eq!(mesh.vertices(), [a, b, c, 2.0 * b]);
        assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 1, 2], [0, 0, 1], [0, 1, 3]]);
        let report =
            MeshReport { joined_vertices: 2, unused_vertices: 1, collapsed_triangles: 1, flat_triangles: 1 };
        assert_eq!(mesh.report(), report);
    }

    #[test]
    fn invalid_meshes_are_refused_by_code() {
        let valid = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let code = |vertices: &[DVec3], triangles: &[[u32; 3]]| {
            TriangleMesh::new(vertices, triangles).unwrap_err().code()
        };
        assert_eq!(code(&valid, &[]), "NO_FACETS");
        assert_eq!(code(&valid, &[[0, 1, 3]]), "TRIANGLE_INDEX");
        assert_eq!(code(&[], &[[0, 1, 2]]), "NO_FACETS");
        for number in [f64::NAN, f64::INFINITY, 1e101] {
            let vertices = [DVec3::ZERO, DVec3::X, DVec3::new(0.0, number, 0.0)];
            assert_eq!(code(&vertices, &[[0, 1, 2]]), "POINT_OUT_OF_RANGE");
            assert_eq!(PointCloud::new(vertices.to_vec()).unwrap_err().code(), "POINT_OUT_OF_RANGE");
        }
    }

    #[test]
    fn groups_that_are_not_the_triangles_are_refused() {
        let vertices = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let group = |triangles| MeshGroup { name: None, triangles };
        let grouped = |groups| TriangleMesh::new(&vertices, &[[0, 1, 2]; 3]).unwrap().with_groups(groups);
        assert_eq!(grouped(vec![group(1), group(2)]).unwrap().groups().len(), 2);
        for groups in [vec![], vec![group(2)], vec![group(3), group(0)], vec![group(usize::MAX), group(4)]] {
            assert_eq!(grouped(groups).unwrap_err().code(), "MESH_GROUPS");
        }
    }

    use super::super::PointCloud;
}
