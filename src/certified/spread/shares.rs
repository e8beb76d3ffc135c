//! The shares of a cell within and beyond a distance: lemma S4 of `docs/meshes.md`.

use super::density::Weight;
use crate::certified::bounds::Linear;
use crate::certified::rounding::UNIT_ROUNDOFF;

/// The corners of a cell, in their order about it.
const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// The roundings of a linear bound, relative to the sum of its terms: its value is a sum of four terms, and its values at
/// corners and less a limit are sums of four more.
const LINEAR_ROUNDINGS: f64 = 64.0;

/// The rounding of a share: of at most five corners of a polygon, of its area and of its weight, each up to 1.
const SHARE_ROUNDING: f64 = 1e-12;

/// Linear functions of σ and τ between which the distances of a cell are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LinearBounds {
    low: Linear,
    high: Linear,
    weight: Weight,
}

impl LinearBounds {
    /// Bounds the distances of a cell of this weight; `None` if nothing is known of its density.
    pub(super) fn new(low: Linear, high: Linear, weight: Weight) -> Option<Self> {
        let size = |of: &Linear| of.value.abs() + of.slopes[0].abs() + of.slopes[1].abs();
        let rounding = LINEAR_ROUNDINGS * UNIT_ROUNDOFF * (size(&low) + size(&high));
        let bounds = Self { low, high, weight }.widened(rounding);
        (weight.ratio.is_finite() && bounds.thickness().is_finite()).then_some(bounds)
    }

    /// Returns bounds that hold where distances are off by this.
    pub(crate) fn widened(self, by: f64) -> Self {
        let [low, high] = [(self.low, -by), (self.high, by)]
            .map(|(linear, by)| Linear { value: linear.value + by, ..linear });
        Self { low, high, ..self }
    }

    /// Returns the largest difference of the bounds at a point of the cell.
    pub(crate) fn thickness(&self) -> f64 {
        let slopes = [0, 1].map(|axis| (self.high.slopes[axis] - self.low.slopes[axis]).abs());
        self.high.value - self.low.value + slopes[0] + slopes[1]
    }

    /// Returns the bounds at a place of the cell's square.
    pub(crate) fn at(&self, place: [f64; 2]) -> [f64; 2] {
        [self.low.at(place), self.high.at(place)]
    }

    /// Returns bounds on the share of the cell's area whose distances are above a limit.
    pub(crate) fn beyond(&self, limit: f64) -> [f64; 2] {
        let Weight { tilt, ratio } = self.weight;
        let [certain, possible] = [&self.low, &self.high].map(|linear| share_above(linear, limit, tilt));
        let less = certain / (certain + ratio * (1.0 - certain)) - SHARE_ROUNDING;
        let more = ratio * possible / (ratio * possible + (1.0 - possible)) + SHARE_ROUNDING;
        [if less > 0.0 { less } else { 0.0 }, if more < 1.0 { more } else { 1.0 }]
    }
}

/// Returns the share of the square with the density 1 + aσ + bτ on which a linear function is above a limit, up to
/// [`SHARE_ROUNDING`].
fn share_above(linear: &Linear, limit: f64, tilt: [f64; 2]) -> f64 {
    let corners = CORNERS.map(|corner| (corner, linear.at(corner) - limit));
    if corners.iter().all(|(_, height)| *height > 0.0) {
        return 1.0;
    }
    let mut polygon = [[0.0; 2]; 8];
    let mut count = 0;
    let mut push = |point: [f64; 2]| {
        polygon[count] = point;
        count += 1;
    };
    for (index, &(corner, height)) in corners.iter().enumerate() {
        let (next, next_height) = corners[(index + 1) % corners.len()];
        if height > 0.0 {
            push(corner);
        }
        if (height > 0.0) != (next_height > 0.0) {
            let part = height / (height - next_height);
            push([0, 1].map(|axis| corner[axis] + part * (next[axis] - corner[axis])));
        }
    }
    let polygon = &polygon[..count];
    let triangles = polygon.windows(2).skip(1).map(|ends| [polygon[0], ends[0], ends[1]]);
    let weight = |[a, b, c]: [[f64; 2]; 3]| {
        let middle = [0, 1].map(|axis| (a[axis] + b[axis] + c[axis]) / 3.0);
        let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        area * (1.0 + tilt[0] * middle[0] + tilt[1] * middle[1])
    };
    // The square has the area 4 and, about its middle, the weight 4.
    (triangles.map(weight).sum::<f64>() / 4.0).clamp(0.0, 1.0)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    const EVEN: [f64; 2] = [0.0; 2];

    fn linear(value: f64, slopes: [f64; 2]) -> Linear {
        Linear { value, slopes }
    }

    fn is_near(found: f64, expected: f64) {
        assert!((found - expected).abs() <= 2.0 * SHARE_ROUNDING, "{found} {expected}");
    }

    /// Halves, a corner, all but a corner, all and none of the square, by shares that are areas of triangles.
    #[test]
    fn shares_are_areas() {
        for slopes in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
            is_near(share_above(&linear(0.0, slopes), 0.5, EVEN), 0.25);
        }
        for [s, t] in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            let diagonal = linear(3.0, [s, t]);
            for (limit, share) in [(0.5, 1.0), (2.0, 0.875), (3.0, 0.5), (4.0, 0.125), (5.0, 0.0)] {
                is_near(share_above(&diagonal, limit, EVEN), share);
            }
        }
    }

    /// ∫ (1 + aσ + bτ) over a half of the square is 2 (1 ± a/2).
    #[test]
    fn shares_are_by_the_weight() {
        for (slopes, share) in [
            ([1.0, 0.0], 0.5 + 0.125),
            ([-1.0, 0.0], 0.5 - 0.125),
            ([0.0, 1.0], 0.5 - 0.0625),
            ([0.0, -1.0], 0.5 + 0.0625),
        ] {
            is_near(share_above(&linear(0.0, slopes), 0.0, [0.5, -0.25]), share);
        }
    }

    /// With a density of twice the weight on one side, a half is between a third and two thirds. Where the bounds differ
    /// what is between them counts for the upper end alone.
    #[test]
    fn the_ratio_and_the_bounds_widen_a_share() {
        let weight = |ratio: f64| Weight { tilt: EVEN, ratio };
        let tight = linear(1.0, [1.0, 0.0]);
        let beyond = |high: Linear, ratio: f64, limit: f64| {
            LinearBounds::new(tight, high, weight(ratio)).unwrap().beyond(limit)
        };
        for (high, ratio, limit, [less, more]) in [
            (tight, 2.0, 1.0, [1.0 / 3.0, 2.0 / 3.0]),
            (linear(1.5, [1.0, 0.0]), 1.0, 1.0, [0.5, 0.75]),
            (linear(1.5, [1.0, 0.0]), 1.0, 2.25, [0.0, 0.125]),
            (tight, 4.0, -0.5, [1.0, 1.0]),
            (tight, 4.0, 2.5, [0.0, 0.0]),
        ] {
            let found = beyond(high, ratio, limit);
            is_near(found[0], less);
            is_near(found[1], more);
            assert!(found[0] <= less && more <= found[1], "{found:?}");
        }
    }

    /// The thickness is at the corner where both slopes differ most; widening adds to both sides of it.
    #[test]
    fn the_thickness_is_that_at_a_corner() {
        let (low, high) = (linear(1.0, [0.5, 0.25]), linear(1.25, [0.25, 0.5]));
        let bounds = LinearBounds::new(low, high, Weight { tilt: EVEN, ratio: 1.0 }).unwrap();
        is_near(bounds.thickness(), 0.75);
        is_near(bounds.widened(0.125).thickness(), 1.0);
        let [least, most] = bounds.at([-1.0, 1.0]);
        is_near(most - least, 0.75);
        assert_eq!(LinearBounds::new(low, high, Weight { tilt: EVEN, ratio: f64::INFINITY }), None);
    }
}
