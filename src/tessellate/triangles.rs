//! The triangles between the vertices of a grid.

use super::Tessellation;
use super::vertex_grid::{Vertex, VertexGrid};

impl Tessellation {
    /// Appends the triangles of a surface; those with two equal corners, as at poles, are left out.
    pub(super) fn append(&mut self, grid: &VertexGrid) {
        let first = self.positions.len() / 3;
        for Vertex { point, normal } in &grid.vertices {
            self.positions.extend_from_slice(&(*point - self.origin).as_vec3().to_array());
            self.normals.extend_from_slice(&normal.as_vec3().to_array());
        }
        for triangle in grid.triangles() {
            self.push_triangle(triangle.map(|vertex| first + vertex));
        }
    }

    /// Appends a triangle unless two of its corners coincide.
    fn push_triangle(&mut self, [a, b, c]: [usize; 3]) {
        let position = |vertex: usize| &self.positions[3 * vertex..3 * vertex + 3];
        let equal = |p: usize, q: usize| position(p) == position(q);
        if !(equal(a, b) || equal(b, c) || equal(c, a)) {
            self.indices.extend_from_slice(&[a, b, c].map(|vertex| vertex as u32));
        }
    }
}
