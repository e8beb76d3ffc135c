//! Boxes around patches, and the tree that finds the near ones.

mod aabb;
mod tree;

pub use aabb::Aabb;
pub use tree::{Bvh, Node};
