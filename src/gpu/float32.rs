//! Conversion of models from float64 to the kernels' float32.

use crate::bezier::{Patch, center_grid, power_of_two_below, snapped};
use crate::bvh::Aabb;
use glam::{DVec3, DVec4};

/// Upper bound on the relative error of a WGSL operation that the standard
/// requires to be correctly rounded: one unit in the last place, since WGSL
/// specifies no rounding mode.
pub(crate) const UNIT_ROUNDOFF: f64 = f32::EPSILON as f64;

/// Stands for a squared distance that is unknown or beyond float32: nearly the
/// largest float32.
pub(crate) const UNKNOWN_DISTANCE: f32 = 3e38;

/// Roundings of a rigid motion followed by a distance, in units of the largest
/// coordinate: products, sums, centre, difference, squares and root.
const MOTION_ROUNDINGS: f64 = 16.0;

/// Roundings in evaluating a point, per degree and besides, in units of the
/// patch's largest homogeneous coordinate: a basis function takes two a degree
/// and direction, the sums two more a term, the rounded parameter half a one a
/// degree, and centre and difference a few.
const POINT_ROUNDINGS_PER_DEGREE: f64 = 4.0;
const POINT_ROUNDINGS_BESIDES: f64 = 16.0;

/// The origin and scale of a model's coordinates on the GPU.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ModelFrame {
    /// A point of the grid of patch centres, so that differences are exact.
    pub(crate) origin: DVec3,
    /// A power of two that makes the model's size about 1.
    pub(crate) scale: f64,
    /// Upper bound on the distance of a point of the model from the origin.
    pub(crate) radius: f64,
}

impl ModelFrame {
    /// The frame of a model with this bounding box.
    pub(crate) fn new(bounding_box: Aabb) -> Self {
        let origin = snapped(bounding_box.center(), center_grid(bounding_box.diagonal()));
        let radius = bounding_box.max_distance_squared(origin).sqrt();
        Self { origin, scale: normalizing_power(radius), radius }
    }
}

/// Upper bound on the error of a distance between moved points in float32,
/// if no coordinate, before or after any step, exceeds `largest` in size.
pub(crate) fn motion_error(largest: f64) -> f64 {
    MOTION_ROUNDINGS * UNIT_ROUNDOFF * largest
}

/// Upper bound on the error of a point of `patch` computed in float32 from
/// rounded controls, relative to the patch's centre.
///
/// Numerator and weight each pass through the roundings above, relative to the
/// largest weight. Divided by a weight no smaller than the smallest, each
/// error is at most roundings times largest over smallest weight times the
/// radius, an upper bound on the size of any point of the patch.
pub(crate) fn patch_error(patch: &Patch<'_>) -> f64 {
    let radius = patch.local_points().fold(0.0_f64, |radius, point| radius.max(point.length()));
    let weights = patch.controls.iter().map(|control| control.w);
    let ratio = weights.clone().fold(0.0, f64::max) / weights.fold(f64::INFINITY, f64::min);
    let degrees = (patch.degree[0] + patch.degree[1]) as f64;
    let roundings = POINT_ROUNDINGS_PER_DEGREE * degrees + POINT_ROUNDINGS_BESIDES;
    2.0 * roundings * UNIT_ROUNDOFF * ratio * radius
}

/// The power of two that scales a positive number into [1, 2), and 1 for 0.
/// Scaling by it is exact and brings numbers into float32's range.
pub(crate) fn normalizing_power(number: f64) -> f64 {
    if number > 0.0 { power_of_two_below(number.max(f64::MIN_POSITIVE)).recip() } else { 1.0 }
}

/// The least float32 that is `value` or more.
pub(crate) fn round_up(value: f64) -> f32 {
    let nearest = value as f32;
    if f64::from(nearest) < value { nearest.next_up() } else { nearest }
}

/// The largest float32 that is `value` or less.
pub(crate) fn round_down(value: f64) -> f32 {
    -round_up(-value)
}

/// The nearest float32 of every component.
pub(crate) fn round(vector: DVec4) -> [f32; 4] {
    vector.to_array().map(|value| value as f32)
}
