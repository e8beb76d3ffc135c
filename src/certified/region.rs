//! The parts of A that are worked on.

use super::Operand;
use super::feet::Foot;
use super::profile::Profiles;

/// A rectangle of a patch of A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cell {
    /// The patch.
    pub(crate) patch: u32,
    /// Its centre (s, t).
    pub(crate) center: [f64; 2],
    /// Half its width in s and t.
    pub(crate) half: [f64; 2],
}

impl Cell {
    pub(super) fn whole(patch: u32) -> Self {
        Self { patch, center: [0.5; 2], half: [0.5; 2] }
    }

    /// Whether it is all of a patch, or of an edge.
    pub(super) fn is_whole(&self) -> bool {
        self.half.iter().all(|&half| half == 0.5 || half == 0.0)
    }

    /// The (s, t) of a place in [-1, 1]^2.
    pub(crate) fn at(&self, place: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| (self.center[axis] + place[axis] * self.half[axis]).clamp(0.0, 1.0))
    }

    /// The cell halved along the chosen axes.
    pub(super) fn split(&self, axes: [bool; 2]) -> impl Iterator<Item = Self> + use<> {
        let cell = *self;
        let half = [0, 1].map(|axis| if axes[axis] { 0.5 * cell.half[axis] } else { cell.half[axis] });
        let sides = axes.map(|split| if split { &[-1.0, 1.0][..] } else { &[0.0][..] });
        sides[0].iter().flat_map(move |&s| {
            sides[1].iter().map(move |&t| Self {
                patch: cell.patch,
                center: [cell.center[0] + s * half[0], cell.center[1] + t * half[1]],
                half,
            })
        })
    }
}

/// What is still to be bounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Domain {
    /// All patches below a node of A's tree.
    Node(u32),
    /// A rectangle of a patch.
    Cell(Cell),
}

/// A part with the bound and the foot it inherits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SearchNode {
    pub(crate) domain: Domain,
    /// At least the distance of all its points to B.
    pub(crate) upper: f64,
    /// The parent's foot, where the iteration starts.
    pub(crate) foot: Foot,
    /// Halvings above it.
    pub(crate) level: u32,
}

/// How much longer one side of a cell may be than the other before only the
/// longer is halved.
pub(crate) const MAX_ASPECT: f64 = 2.0;

impl SearchNode {
    /// Appends the parts of this region.
    pub(super) fn split_into(
        &self,
        side: &Operand<'_>,
        profiles: &Profiles,
        upper: f64,
        foot: Foot,
        parts: &mut Vec<Self>,
    ) {
        let mut push = |domain, foot| parts.push(Self { domain, upper, foot, level: self.level + 1 });
        match &self.domain {
            Domain::Node(index) => {
                let tree = &side.target.tree;
                let node = &tree.nodes()[*index as usize];
                if !node.is_leaf() {
                    // The first one's point is this one's, whose foot is known.
                    push(Domain::Node(*index + 1), foot);
                    push(Domain::Node(node.second), Foot::start(foot.patch, foot.parameters));
                } else if let Some(cell) = profiles.cell(side, tree.item(node)) {
                    push(Domain::Cell(cell), foot);
                }
            }
            Domain::Cell(cell) => {
                let [s, t] = side.whole_bounds(cell.patch).first;
                let lengths = [s * cell.half[0], t * cell.half[1]];
                let axes = [lengths[0] * MAX_ASPECT >= lengths[1], lengths[1] * MAX_ASPECT >= lengths[0]];
                for child in cell.split(axes) {
                    push(Domain::Cell(child), foot);
                }
            }
        }
    }
}
