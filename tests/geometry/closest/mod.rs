//! Closest points, and the tree of boxes that finds them.

mod bvh;
mod closest_point;
mod newton_and_tangent_plane;
