//! Models, the shapes that make them, and their display triangles.

mod areas;
mod properties;
mod shape_operations;
mod shapes;
mod tessellation;
mod validation;
