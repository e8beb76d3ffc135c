//! Many points measured to one model: closest points, and signed distances on grids.

mod bricks;
mod closest_points;
mod grid;
mod order;
mod query;
mod signed_distances;

pub(super) use closest_points::require_in_range;
pub use closest_points::{ClosestPointOptions, ClosestPoints};
pub use grid::{Grid, GridOptions};
pub use signed_distances::{Precision, SignedDistanceOptions, SignedDistances};
