//! The edges of a model that may be features, in pieces that are halved when they are first needed.

use super::turn::{ArcPart, sharpness};
use super::{Faces, Piece, Sharpness};
use crate::bvh::{Aabb, Bvh};
use crate::model::RigidTransform;
use crate::solid::{Curve, JoinedArc};
use crate::threads::parallel::map;

/// The number of times that an edge is halved at most.
const MAX_DEPTH: u32 = 40;

/// The edges of a model, moved, without those that are certainly smooth.
pub(crate) struct FeatureEdges<'a> {
    faces: Faces<'a>,
    edges: Vec<JoinedArc>,
    pieces: Vec<Piece>,
    tree: Bvh,
    transform: RigidTransform,
    /// The angle by which a surface turns at a feature edge at least, in radians.
    angle: f64,
    /// The error of control points.
    error: f64,
    /// The largest length of a part of an edge that is left out because a face may have no normal there.
    least: f64,
}

impl<'a> FeatureEdges<'a> {
    /// Finds the edges that may be features, at which the faces turn by more than `angle` radians. `error` bounds the
    /// errors of their control points; a part of an edge next to a point without a normal is none if it is at most `least`
    /// long. O(n log n).
    pub(crate) fn new(
        faces: Faces<'a>,
        edges: Vec<JoinedArc>,
        transform: RigidTransform,
        [angle, error, least]: [f64; 3],
    ) -> Self {
        let (pieces, tree) = (Vec::new(), Bvh::new(&[]));
        let mut found = Self { faces, edges, pieces, tree, transform, angle, error, least };
        let whole = |index: usize| {
            let curve = found.edges[index].one.curve.clone();
            found.piece((index as u32, curve, [0.0, 1.0], 0))
        };
        let pieces = map(found.edges.len(), whole);
        found.pieces = pieces.into_iter().filter(|piece| piece.sharpness != Sharpness::Smooth).collect();
        let boxes: Vec<Aabb> = found.pieces.iter().map(|piece| piece.hull.aabb).collect();
        found.tree = Bvh::new(&boxes);
        found
    }

    fn piece(&self, of: (u32, Curve, [f64; 2], u32)) -> Piece {
        let edge = &self.edges[of.0 as usize];
        let part = ArcPart { curve: &of.1, range: of.2 };
        let sharpness = sharpness(&self.faces, edge, &part, self.angle);
        let piece = Piece::new(of, sharpness, &self.transform, self.error);
        match sharpness {
            Sharpness::NoNormal if piece.length.upper <= self.least => {
                Piece { sharpness: Sharpness::Smooth, ..piece }
            }
            _ => piece,
        }
    }

    /// Returns the whole edges.
    pub(crate) fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// Returns the error of control points.
    pub(crate) fn error(&self) -> f64 {
        self.error
    }

    /// Returns the box of all edges.
    pub(crate) fn bounding_box(&self) -> Option<Aabb> {
        Some(self.tree.nodes().first()?.aabb)
    }

    /// Returns the halves of a piece; `None` of one that is halved no further.
    pub(crate) fn halves<'p>(&self, piece: &'p Piece) -> Option<&'p [Piece; 2]> {
        let halves = || {
            if piece.depth >= MAX_DEPTH {
                return None;
            }
            let [start, end] = piece.range;
            let middle = 0.5 * (start + end);
            let [low, high] = piece.curve.split(0.5);
            let half = |curve, range| self.piece((piece.edge, curve, range, piece.depth + 1));
            Some(Box::new([half(low, [start, middle]), half(high, [middle, end])]))
        };
        piece.halves.get_or_init(halves).as_deref()
    }

    /// Calls `visit` with the edges whose boxes are within `reach` of a box, until it returns false.
    pub(super) fn near(&self, aabb: &Aabb, reach: f64, visit: &mut dyn FnMut(&Piece) -> bool) {
        let grown = aabb.grown(reach);
        let nodes = self.tree.nodes();
        let mut stack = vec![0_usize];
        while let Some(index) = stack.pop() {
            let Some(node) = nodes.get(index).filter(|node| node.aabb.meets(&grown)) else { continue };
            if !node.is_leaf() {
                stack.extend([node.right_child as usize, index + 1]);
            } else if !visit(&self.pieces[self.tree.primitive(node) as usize]) {
                return;
            }
        }
    }
}
