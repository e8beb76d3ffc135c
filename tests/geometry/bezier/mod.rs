//! Bézier patches and the bounds of them.

mod attained_bounds;
mod local_derivative_bounds;
mod patches;
