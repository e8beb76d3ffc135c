//! Conversion of models from float64 to the kernels' float32.

use crate::bezier::{Patch, center_grid, power_of_two_below, snapped};
use crate::bvh::Aabb;
use crate::rounding::{gamma, lower_min, upper_max};
use glam::{DVec3, DVec4, Vec4Swizzles};

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

/// The roundings of a representation error itself.
const REPRESENTATION_ROUNDINGS: f64 = 32.0;

/// The least weight of a copy whose points are bounded in float32, where the largest is 1 to 2: products of two
/// weights are far from float32's least number, and no quotient is far larger than the patch.
const LEAST_WEIGHT: f64 = 1.0 / 1024.0;

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

/// A patch in the coordinates of the GPU, before it is rounded.
pub(crate) struct ScaledPatch<'a> {
    patch: Patch<'a>,
    scale: f64,
    /// Brings the weights to about 1, which leaves the points as they are.
    weight_scale: f64,
    /// The centre relative to the model's origin.
    pub(crate) center: DVec3,
}

impl<'a> ScaledPatch<'a> {
    pub(crate) fn new(patch: &Patch<'a>, origin: DVec3, scale: f64) -> Self {
        let max_weight = patch.controls.iter().map(|control| control.w).fold(0.0, f64::max);
        let weight_scale = normalizing_power(max_weight);
        Self { patch: *patch, scale, weight_scale, center: scale * (patch.center - origin) }
    }

    /// The homogeneous controls relative to the centre.
    pub(crate) fn controls(&self) -> impl Iterator<Item = DVec4> {
        let factor = self.weight_scale * DVec3::splat(self.scale).extend(1.0);
        self.patch.controls.iter().map(move |&control| control * factor)
    }
}

/// Upper bound on the distance, in model units, between corresponding points of `patch` and of its rounded copy
/// evaluated exactly; +∞ if a weight of the copy is below [`LEAST_WEIGHT`].
///
/// With S = Σ b X / Σ b w the patch and X' and w' rounded, `S' - S = Σ b (X' - X - (w' - w) S) / Σ b w'`, which
/// is at most the largest `|X' - X| + |w' - w| ρ` over the smallest w', for ρ no less than any |S|. The
/// centre's rounding is added. All differences are those of the numbers as they are.
pub(crate) fn representation_error(patch: &Patch<'_>, frame: &ModelFrame) -> f64 {
    let scaled = ScaledPatch::new(patch, frame.origin, frame.scale);
    let rounded = |vector: DVec4| DVec4::from_array(round(vector).map(f64::from));
    let radius = patch.local_points().fold(0.0, |radius, point| upper_max(radius, point.length()));
    let (mut largest, mut lightest) = (0.0, f64::INFINITY);
    for control in scaled.controls() {
        let copy = rounded(control);
        let error = (copy - control).abs();
        largest = upper_max(largest, error.xyz().length() + error.w * frame.scale * radius);
        lightest = lower_min(lightest, copy.w);
    }
    if lightest < LEAST_WEIGHT {
        return f64::INFINITY;
    }
    let center = scaled.center.extend(0.0);
    (1.0 + gamma(REPRESENTATION_ROUNDINGS)) * (largest / lightest + (rounded(center) - center).length())
        / frame.scale
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

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    const UNIT_FRAME: ModelFrame = ModelFrame { origin: DVec3::ZERO, scale: 1.0, radius: 1.0 };

    /// The rounding of a third.
    fn of_third() -> f64 {
        (f64::from((1.0 / 3.0) as f32) - 1.0 / 3.0).abs()
    }

    fn error(controls: [DVec4; 4], center: DVec3, frame: &ModelFrame) -> f64 {
        representation_error(&Patch::whole([1, 1], center, &controls), frame)
    }

    /// A control, a centre and a weight that float32 does not hold, each alone: at a corner, everywhere, and at the corner
    /// of that weight, which is the farthest from the centre.
    #[test]
    fn representation_errors_are_attained() {
        let corners = [[0.5, 0.0], [0.0, 1.0], [-0.5, 0.0], [0.0, -0.5]].map(|[x, y]| DVec3::new(x, y, 0.0));
        let plain = corners.map(|corner| corner.extend(1.0));
        let is = |found: f64, expected: f64| {
            assert!((found / expected - 1.0).abs() <= 1e-9, "{found:e}, not {expected:e}");
        };
        assert_eq!(error(plain, DVec3::ZERO, &UNIT_FRAME), 0.0);
        let mut moved = plain;
        moved[2].x = 1.0 / 3.0;
        is(error(moved, DVec3::ZERO, &UNIT_FRAME), of_third());
        is(error(plain, DVec3::new(0.0, 1.0 / 3.0, 0.0), &UNIT_FRAME), of_third());
        // The point 3/2 = (1/2)/w has the copy (1/2)/w'.
        let mut weighed = plain;
        weighed[1] = DVec4::new(0.0, 0.5, 0.0, 1.0 / 3.0);
        is(error(weighed, DVec3::ZERO, &UNIT_FRAME), 1.5 * of_third() / f64::from((1.0 / 3.0) as f32));
    }

    /// Scale and origin come before the rounding, and the error is in model units.
    #[test]
    fn representation_errors_are_in_model_units() {
        let controls = [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X].map(|corner| corner.extend(1.0));
        let frame = ModelFrame { origin: DVec3::X, scale: 0.25, ..UNIT_FRAME };
        let found = error(controls, DVec3::new(1.0 + 4.0 / 3.0, 0.0, 0.0), &frame);
        assert!((found / (4.0 * of_third()) - 1.0).abs() <= 1e-6, "{found:e}");
    }

    /// Weights so far apart that products underflow have no bound.
    #[test]
    fn far_weights_have_no_representation() {
        let mut controls = [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X].map(|corner| corner.extend(1.0));
        controls[0] *= LEAST_WEIGHT;
        assert_eq!(error(controls, DVec3::ZERO, &UNIT_FRAME), 0.0);
        controls[0] *= 0.5;
        assert_eq!(error(controls, DVec3::ZERO, &UNIT_FRAME), f64::INFINITY);
    }
}
