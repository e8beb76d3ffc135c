//! The triangles between the vertices of a grid.

use super::Tessellation;
use super::vertex_grid::{Sheet, Vertex};

impl Tessellation {
    /// Appends a surface. Cells are cut along their shorter diagonal, and
    /// triangles with two equal corners, as at poles, left out.
    pub(super) fn append(&mut self, sheet: &Sheet) {
        let first = self.positions.len() / 3;
        for Vertex { point, normal } in &sheet.vertices {
            self.positions.extend_from_slice(&(*point - self.origin).as_vec3().to_array());
            self.normals.extend_from_slice(&normal.as_vec3().to_array());
        }
        let lines = |axis: usize| {
            sheet.joined[axis].iter().enumerate().filter(|&(_, &joined)| joined).map(|(line, _)| line)
        };
        for row in lines(0) {
            for column in lines(1) {
                let at = |i: usize, j: usize| (row + i) * sheet.columns + column + j;
                let [a, b, c, d] = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
                let length =
                    |p: usize, q: usize| sheet.vertices[p].point.distance_squared(sheet.vertices[q].point);
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

    fn push_triangle(&mut self, [a, b, c]: [usize; 3]) {
        let position = |vertex: usize| &self.positions[3 * vertex..3 * vertex + 3];
        let equal = |p: usize, q: usize| position(p) == position(q);
        if !(equal(a, b) || equal(b, c) || equal(c, a)) {
            self.indices.extend_from_slice(&[a, b, c].map(|vertex| vertex as u32));
        }
    }
}
