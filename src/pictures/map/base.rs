//! The triangles of a model before their edges are split.

use super::placing::Placing;
use super::{Map, Vertex};
use glam::{DVec3, Vec3};

/// Triangles as [`crate::tessellate`] makes them, or those of a mesh; without triangles, points.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surface<'a> {
    /// x, y, z of each vertex, relative to the origin.
    pub(crate) positions: &'a [f32],
    /// x, y, z of the normal of each vertex; those of a mesh are not used.
    pub(crate) normals: &'a [f32],
    /// Three vertices a triangle. One that does not exist ends the list.
    pub(crate) indices: &'a [u32],
    /// The numbers of indices of the faces.
    pub(crate) counts: &'a [u32],
    pub(crate) origin: DVec3,
    /// Whether the triangles are the model, so that their normals and edges are those of the model.
    pub(crate) is_mesh: bool,
}

impl Surface<'_> {
    /// Returns the triangles where they are in a result, without deviations.
    pub(super) fn placed(&self, placing: &Placing) -> Map {
        let vectors = |all: &[f32]| -> Vec<DVec3> {
            all.as_chunks().0.iter().map(|&vector| Vec3::from_array(vector).as_dvec3()).collect()
        };
        let mut map = Map::default();
        let normals = vectors(self.normals);
        for (index, position) in vectors(self.positions).into_iter().enumerate() {
            let position = placing.placed(self.origin + position);
            let normal = if self.is_mesh { None } else { normals.get(index) };
            let normal = normal.map_or(DVec3::ZERO, |&normal| placing.turned(normal));
            map.vertices.push(Vertex { position, point: position, normal });
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
