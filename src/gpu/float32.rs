//! From float64 into the kernels' float32.

use crate::bezier::{center_grid, power_of_two_below};
use crate::bvh::Aabb;
use glam::{DVec3, DVec4};

/// A rounding of WGSL, which promises no mode: a whole unit in the last place.
pub(crate) const ROUNDING: f64 = f32::EPSILON as f64;

/// What a model on the GPU is relative to and multiplied by.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OwnFrame {
    /// A point of the grid of patch centres, so that differences are exact.
    pub(crate) origin: DVec3,
    /// A power of two that makes the model's size about 1.
    pub(crate) scale: f64,
    /// Largest distance of a point from the origin.
    pub(crate) radius: f64,
}

impl OwnFrame {
    /// Of the model in this box.
    pub(crate) fn of(aabb: Aabb) -> Self {
        let grid = center_grid(aabb.diagonal());
        let origin = (aabb.center() / grid).round() * grid;
        let radius = aabb.max_distance_squared(origin).sqrt();
        Self { origin, scale: power_of_two_to_one(radius), radius }
    }
}

/// The power of two that takes a positive number into [1, 2): what is
/// multiplied by it keeps its digits and comes within float32's exponents.
pub(crate) fn power_of_two_to_one(number: f64) -> f64 {
    if number > 0.0 { power_of_two_below(number.max(f64::MIN_POSITIVE)).recip() } else { 1.0 }
}

/// The least float32 that is not below the value.
pub(crate) fn rounded_up(value: f64) -> f32 {
    let nearest = value as f32;
    if f64::from(nearest) < value { nearest.next_up() } else { nearest }
}

/// The largest float32 that is not above the value.
pub(crate) fn rounded_down(value: f64) -> f32 {
    -rounded_up(-value)
}

/// To the nearest float32.
pub(crate) fn rounded(vector: DVec4) -> [f32; 4] {
    vector.to_array().map(|value| value as f32)
}
