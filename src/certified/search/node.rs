//! The nodes of the search tree.

use super::super::nearest::Foot;
use super::super::{Block, Cell, Operand};

/// The part of A that a node covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Domain {
    /// All patches below a node of A's tree.
    BvhNode(u32),
    /// A rectangle of the patches of a surface.
    Block(Block),
    /// A rectangle of a patch.
    Cell(Cell),
}

/// A part of A with the bound and the foot that it inherits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SearchNode {
    pub(crate) domain: Domain,
    /// An upper bound on the distance to B of all its points.
    pub(crate) upper: f64,
    /// The parent's foot, where the iteration starts.
    pub(crate) foot: Foot,
    /// Its depth: the number of subdivisions above it.
    pub(crate) level: u32,
}

impl SearchNode {
    /// All of A.
    pub(super) fn root(upper: f64) -> Self {
        Self { domain: Domain::BvhNode(0), upper, foot: Foot::start(0, [0.5; 2]), level: 0 }
    }

    /// Appends nodes for these parts of this one, given its own foot.
    pub(super) fn push_children(
        &self,
        domains: impl Iterator<Item = Domain>,
        foot: Foot,
        children: &mut Vec<Self>,
    ) {
        let foot = Foot::start(foot.patch, foot.parameters);
        children.extend(domains.map(|domain| Self {
            domain,
            foot,
            upper: self.upper,
            level: self.level + 1,
        }));
    }

    /// Appends the children of this node, given its own foot; a cell is halved along the sides given,
    /// or else along the longer one.
    pub(crate) fn branch(
        &self,
        a: &Operand<'_>,
        foot: Foot,
        halved: Option<[bool; 2]>,
        children: &mut Vec<Self>,
    ) {
        let mut push = |domain, foot| {
            children.push(Self { domain, foot, upper: self.upper, level: self.level + 1 });
        };
        match &self.domain {
            Domain::BvhNode(index) => {
                let tree = &a.target.tree;
                let node = &tree.nodes()[*index as usize];
                if node.is_leaf() {
                    push(Domain::Cell(Cell::whole(tree.primitive(node))), foot);
                } else {
                    // The left child's first patch is this node's, whose foot is known.
                    push(Domain::BvhNode(*index + 1), foot);
                    push(Domain::BvhNode(node.right_child), Foot::start(foot.patch, foot.parameters));
                }
            }
            // Blocks are branched where they are bounded.
            Domain::Block(_) => {}
            Domain::Cell(cell) => {
                let longer = || cell.longer_sides(a.patch_bounds(cell.patch).first);
                for child in cell.halves(halved.unwrap_or_else(longer)) {
                    push(Domain::Cell(child), foot);
                }
            }
        }
    }
}
