//! Triangles that are split at the middles of edges, so that no vertex lies on an edge.

use super::Triangles;
use std::collections::HashMap;

/// An edge by its vertices, the smaller index first.
pub(crate) type Edge = [u32; 2];

pub(super) fn edge(one: u32, other: u32) -> Edge {
    [one.min(other), one.max(other)]
}

impl Triangles {
    /// Returns every edge once, in order. O(n log n).
    pub(super) fn edges(&self) -> Vec<Edge> {
        let of = |&[a, b, c]: &[u32; 3]| [edge(a, b), edge(b, c), edge(c, a)];
        let mut edges: Vec<Edge> = self.corners.iter().flat_map(of).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// Splits all triangles at these vertices in the middles of edges: into two, three or four for one,
    /// two or three of its edges.
    pub(super) fn split(&mut self, middles: &HashMap<Edge, u32>) {
        let old = std::mem::take(self);
        for (corners, face) in old.corners.into_iter().zip(old.faces) {
            self.push_parts(corners, middles);
            self.faces.resize(self.corners.len(), face);
        }
    }

    fn push_parts(&mut self, [a, b, c]: [u32; 3], middles: &HashMap<Edge, u32>) {
        let middle = |one, other| middles.get(&edge(one, other)).copied();
        match [middle(a, b), middle(b, c), middle(c, a)] {
            [None, None, None] => self.corners.push([a, b, c]),
            [Some(ab), Some(bc), Some(ca)] => {
                self.corners.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
            }
            [Some(ab), Some(bc), None] => self.corners.extend([[a, ab, c], [ab, b, bc], [ab, bc, c]]),
            [Some(ab), None, None] => self.corners.extend([[a, ab, c], [ab, b, c]]),
            // Turned, so that the first edge is split, and the second one if another is.
            [None, Some(_), _] => self.push_parts([b, c, a], middles),
            [_, None, Some(_)] => self.push_parts([c, a, b], middles),
        }
    }
}
