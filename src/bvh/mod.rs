//! Axis-aligned boxes, and the bounding volume hierarchy (BVH) over them.

mod aabb;
mod tree;

pub use aabb::Aabb;
pub use tree::{Bvh, Node};
