//! Questions besides the distance of two models.

mod clearance;
mod closest_points;
mod diff;
mod exact_clearances;
mod field;
mod overlaps;
mod sheets;
mod signed_distances;
mod solids;
mod update;
