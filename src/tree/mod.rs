//! Boxes around patches, and the tree that finds the near ones.

mod aabb;
mod box_tree;

pub use aabb::Aabb;
pub use box_tree::{BoxTree, Node};
