//! Questions besides the distance of two models.

mod closest_points;
mod diff;
mod field;
mod update;
