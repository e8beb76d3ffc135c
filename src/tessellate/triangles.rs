//! The triangles between the vertices of a grid.

use super::Tessellation;
use super::vertex_grid::{Vertex, VertexGrid};
use crate::axis::Axis;

impl Tessellation {
    /// Appends the triangles of a surface. Cells are divided along their shorter
    /// diagonal; triangles with two equal corners, as at poles, are left out.
    pub(super) fn append(&mut self, grid: &VertexGrid) {
        let first = self.positions.len() / 3;
        for Vertex { point, normal } in &grid.vertices {
            self.positions.extend_from_slice(&(*point - self.origin).as_vec3().to_array());
            self.normals.extend_from_slice(&normal.as_vec3().to_array());
        }
        let lines = |axis: Axis| {
            grid.joined[axis].iter().enumerate().filter(|&(_, &joined)| joined).map(|(line, _)| line)
        };
        for row in lines(Axis::U) {
            for column in lines(Axis::V) {
                let at = |i: usize, j: usize| (row + i) * grid.columns + column + j;
                let [a, b, c, d] = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
                let length =
                    |p: usize, q: usize| grid.vertices[p].point.distance_squared(grid.vertices[q].point);
                let triangles = if length(a, c) <= length(b, d) {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, b, d], [b, c, d]]
                };
                for triangle in triangles {
                    self.push_triangle(triangle.map(|vertex| first + vertex));
                }
            }
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
