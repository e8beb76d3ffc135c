//! Boxes around patches, and the tree that finds the near ones.

mod aabb;

pub use aabb::Aabb;
