//! Method `hierarchy`: the 2011 paper's boxes and pairs.
//!
//! A. Krishnamurthy, S. McMains, I. Hanniel, *GPU-accelerated Hausdorff
//! distance computation between dynamic deformable NURBS surfaces*,
//! Computer-Aided Design 43 (2011). Stages, each with the same name in the
//! kernels: `boxes` around the parts of a regular grid's cells, the `pyramid`
//! of boxes of four boxes each, and down its levels `bound` (each box of A
//! from its pairs), `extremes` (the bounds of the distance) and `cull` (the
//! pairs of the next level).
//!
//! Every bound holds for what is inside the boxes, so the interval is certain
//! wherever the descent ends.

mod box_distance;
mod boxes;
mod grid_tree;
mod level_bounds;
mod pyramid;
mod traversal;

pub use box_distance::Distances;
pub use boxes::{Part, boxes};
pub(crate) use grid_tree::BRANCHING;
pub use grid_tree::{Cell, Children, GridTree, MAX_CELLS, MAX_CHILDREN};
pub(crate) use level_bounds::LevelBounds;
pub use pyramid::pyramid;
pub use traversal::{Bound, Pairs, Traversal, extremes};
