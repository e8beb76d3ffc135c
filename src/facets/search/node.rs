//! The nodes of the search, and the order in which they are bounded.

use super::part::TrianglePart;
use super::patch_cell::PatchCell;
use super::source::Start;
use crate::sorting::ordered_by;
use glam::DVec3;

/// A part of A.
#[derive(Debug, Clone, Copy)]
pub(super) enum Region {
    /// All facets below a node of A's tree.
    Node(u32),
    /// A part of a triangle, by its place in the order of the leaves.
    Part(u32, TrianglePart),
    /// A cell of a patch.
    Cell(PatchCell),
}

/// A part of A with an upper bound on the distance of its points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub(super) upper: f64,
    pub(super) region: Region,
    /// A place on B that may be near.
    pub(super) start: Start,
    /// The number of subdivisions above it.
    pub(super) level: u32,
}

impl Node {
    /// Returns a part of this node, bounded by `upper` and by the bound of this node.
    pub(super) fn child(&self, region: Region, start: Start, upper: f64) -> Self {
        let upper = if upper < self.upper { upper } else { self.upper };
        Self { upper, region, start, level: self.level + 1 }
    }
}

// The largest upper bound comes first.
ordered_by!(Node, |node| node.upper);

/// The place of a point on A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Domain {
    /// On a facet, by its place in the order of the leaves.
    Facet(u32),
    /// On a patch, at these parameters.
    Patch(u32, [f64; 2]),
}

/// A point of A, moved, with the distance of a point of B.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sample {
    pub(super) point: DVec3,
    pub(super) domain: Domain,
    pub(super) start: Start,
    pub(super) distance: f64,
    /// How far rounding may have moved the point from A.
    pub(super) moved: f64,
}
