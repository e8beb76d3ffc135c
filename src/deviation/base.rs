//! The triangles of a model on which its deviations are measured, whatever its position is.

use super::triangles::Edge;
use super::{Map, Vertex};
use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// The longest edge, in the model's diagonals: what is larger than it is seen before edges are split for their
/// deviation.
const MAX_EDGE: f64 = 1.0 / 30.0;

/// The number of vertices after which edges are no longer split for their length.
const MAX_VERTICES: usize = 60_000;

/// Rounds of splitting: each halves the longest edges.
const MAX_ROUNDS: usize = 8;

/// Triangles as [`crate::tessellate`] makes them, or those of a mesh; without triangles, points.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surface<'a> {
    /// x, y, z of each vertex, relative to the origin.
    pub(crate) positions: &'a [f32],
    /// x, y, z of the normal of each vertex.
    pub(crate) normals: &'a [f32],
    /// Three vertices a triangle. One that does not exist ends the list.
    pub(crate) indices: &'a [u32],
    /// The numbers of indices of the faces.
    pub(crate) counts: &'a [u32],
    pub(crate) origin: DVec3,
    /// The most that a point of the triangles is from the model.
    pub(crate) flatness: f64,
    /// Whether the triangles are the model, so that its edges are straight.
    pub(crate) is_mesh: bool,
}

impl Map {
    /// Returns the triangles of a model of this diagonal without deviations, its longest edges split.
    /// O(n log n) in the number of vertices that there are then.
    pub(crate) fn base(surface: &Surface<'_>, diagonal: f64) -> Self {
        let mut map = surface.triangles();
        for _ in 0..MAX_ROUNDS {
            if map.vertices.len() > MAX_VERTICES {
                break;
            }
            let is_long = |&edge: &Edge| map.length(edge) > MAX_EDGE * diagonal;
            let edges: Vec<Edge> = map.triangles.edges().into_iter().filter(is_long).collect();
            if edges.is_empty() {
                break;
            }
            let mut added = HashMap::new();
            for edge in edges {
                added.insert(edge, map.vertices.len() as u32);
                map.vertices.push(map.middle(edge));
            }
            map.triangles.split(&added);
        }
        map
    }

    pub(super) fn length(&self, edge: Edge) -> f64 {
        let [from, to] = edge.map(|end| self.vertices[end as usize].point);
        from.distance(to)
    }

    /// Returns the middle of an edge: drawn on the edge, so that no crack opens, and measured where the
    /// surface is, by the cubic curve with the tangents that the normals at both ends leave; of a mesh,
    /// on the edge. The drawn point is on a triangle, so that the model is within the flatness of it.
    pub(super) fn middle(&self, edge: Edge) -> Vertex {
        let [from, to] = edge.map(|end| self.vertices[end as usize]);
        let way = to.point - from.point;
        // A straight way has no part along the normals at its ends.
        let bulge = (to.normal * to.normal.dot(way) - from.normal * from.normal.dot(way)) / 8.0;
        let bulge = if self.is_mesh { DVec3::ZERO } else { bulge };
        let position = 0.5 * (from.position + to.position);
        let point = 0.5 * (from.point + to.point) + bulge;
        let normal = (from.normal + to.normal).normalize_or_zero();
        Vertex { position, point, normal, slack: self.flatness + position.distance(point) }
    }
}

impl Surface<'_> {
    /// Returns the triangles as they are.
    fn triangles(&self) -> Map {
        let vectors = |all: &[f32]| -> Vec<DVec3> {
            all.as_chunks().0.iter().map(|&vector| Vec3::from_array(vector).as_dvec3()).collect()
        };
        let Self { origin, flatness, is_mesh, .. } = *self;
        let mut map = Map { origin, flatness, is_mesh, ..Map::default() };
        let normals = vectors(self.normals);
        for (index, position) in vectors(self.positions).into_iter().enumerate() {
            let position = origin + position;
            let normal = normals.get(index).copied().unwrap_or(DVec3::ZERO);
            map.vertices.push(Vertex { position, point: position, normal, slack: 0.0 });
        }
        let count = map.vertices.len();
        let exists = |corners: &&[u32; 3]| corners.iter().all(|&corner| (corner as usize) < count);
        map.triangles.corners = self.indices.as_chunks().0.iter().take_while(exists).copied().collect();
        for (face, &count) in self.counts.iter().enumerate() {
            let end = map.triangles.faces.len() + count as usize / 3;
            map.triangles.faces.resize(end.min(map.triangles.corners.len()), face as u32);
        }
        map.triangles.corners.truncate(map.triangles.faces.len());
        map
    }
}
