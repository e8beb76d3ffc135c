//! Many points measured to one model: closest points, and signed distances on grids.

#[cfg(any(all(test, feature = "shapes"), all(feature = "wasm", target_arch = "wasm32")))]
mod blocks;
mod bricks;
mod closest_points;
mod grid;
mod order;
mod query;
mod signed_distances;

#[cfg(all(feature = "wasm", target_arch = "wasm32"))]
pub(crate) use blocks::{BLOCK, layers_of_grid, measuring_order};
pub use closest_points::{ClosestPointOptions, ClosestPoints};
pub(super) use closest_points::{closest_points_of, require_in_range};
pub use grid::{Grid, GridOptions};
#[cfg(all(feature = "wasm", target_arch = "wasm32"))]
pub(crate) use signed_distances::Layers;
pub use signed_distances::{Precision, SignedDistanceOptions, SignedDistances};
