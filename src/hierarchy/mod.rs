//! Method `hierarchy`: a traversal of pairs of boxes of two models.
//!
//! The method is that of A. Krishnamurthy, S. McMains and I. Hanniel,
//! *GPU-accelerated Hausdorff distance computation between dynamic deformable
//! NURBS surfaces*, Computer-Aided Design 43 (2011), 1370–1379, "the 2011 paper"
//! below. Its stages have the same names in the kernels: `boxes` encloses the
//! parts of the cells of a regular grid, `pyramid` builds boxes of four boxes
//! each, and on every level `bound` bounds the distance of each box of A by its
//! pairs, `extremes` bounds the directed distance, and `cull` selects the pairs of
//! the next level.
//!
//! Every bound holds for the contents of the boxes, so the interval is valid on
//! whichever level the traversal ends.

mod box_distance;
mod boxes;
mod grid_tree;
mod level_bounds;
mod pyramid;
mod traversal;

pub use box_distance::DistanceBounds;
pub use boxes::{CellPart, boxes};
pub(crate) use grid_tree::{BRANCHING, GridTreeBuilder};
pub use grid_tree::{ChildRange, GridTree};
#[cfg(feature = "internals")]
pub use grid_tree::{GridCell, MAX_CELLS, MAX_CHILDREN};
pub(crate) use level_bounds::LevelBounds;
pub use pyramid::pyramid;
#[cfg(feature = "internals")]
pub use traversal::NodeBounds;
pub use traversal::{Pairs, Traversal, extremes};
