//! Edges between neighbouring faces.

use super::placed::{Placed, matrix};
use super::topology::{Orientation, ShapeKind, Topology, Use};
use std::collections::HashMap;

/// An edge where it is placed.
type PlacedEdge = (usize, [u64; 12]);

/// The uses of the edges of placed faces, along and against each.
pub(super) struct EdgeUses(HashMap<PlacedEdge, [usize; 2]>);

impl EdgeUses {
    /// Counts the uses, with the directions of the faces' normals. O(edges).
    pub(super) fn of(file: &Topology, faces: &[Placed]) -> Self {
        let mut counts: HashMap<PlacedEdge, [usize; 2]> = HashMap::new();
        for face in faces {
            for (edge, reversed) in edges(file, face) {
                counts.entry(edge).or_default()[usize::from(reversed)] += 1;
            }
        }
        Self(counts)
    }

    /// Returns whether every edge of a face is used once each way, as on a closed shell whose faces
    /// agree on the sides of their edges.
    pub(super) fn confirm(&self, file: &Topology, face: &Placed) -> bool {
        edges(file, face).all(|(edge, _)| self.0.get(&edge) == Some(&[1, 1]))
    }
}

/// Returns the edges that bound a face, but those that are points, with whether the face lies on
/// the left of each against its direction, seen from outside.
fn edges<'a>(file: &'a Topology, face: &'a Placed) -> impl Iterator<Item = (PlacedEdge, bool)> + 'a {
    let wires = file.shapes[face.shape].children.iter();
    let wires = wires.filter(|wire| bounds(wire) && matches!(file.shapes[wire.shape].kind, ShapeKind::Wire));
    wires.flat_map(move |wire| {
        let uses = file.shapes[wire.shape].children.iter().filter(|child| bounds(child));
        uses.filter_map(move |child| {
            let ShapeKind::Edge(edge) = &file.shapes[child.shape].kind else { return None };
            let location = matrix(&(face.location * wire.location * child.location)).map(f64::to_bits);
            let reversed = [wire, child].map(|one| one.orientation == Orientation::Reversed);
            let reversed = reversed[0] ^ reversed[1] ^ face.reversed;
            (!edge.degenerate).then_some(((child.shape, location), reversed))
        })
    })
}

fn bounds(shape: &Use) -> bool {
    matches!(shape.orientation, Orientation::Forward | Orientation::Reversed)
}
