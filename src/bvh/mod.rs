//! Axis-aligned boxes, and the bounding volume hierarchy (BVH) over them.

mod aabb;
mod range_tree;
mod tree;

pub use aabb::Aabb;
pub(crate) use range_tree::RangeTree;
pub use tree::{Bvh, Node};
