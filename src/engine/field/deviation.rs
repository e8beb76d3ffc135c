//! Signed deviations, and their statistics over an area.

use crate::engine::Signs;
use crate::sorting::sort_by_number;
use serde::Serialize;

/// The samples of one face, or of a piece of a trimmed one, v fastest.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct FaceDeviations {
    /// Index of the face in the sampled model.
    pub face: usize,
    /// Numbers of samples along u and v; of a mesh or a cloud, all of them and 1.
    pub counts: [usize; 2],
    /// The points, x y z each.
    pub points: Vec<f64>,
    /// Their feet on the other model, x y z each.
    pub feet: Vec<f64>,
    /// Their distances.
    pub distances: Vec<f64>,
    /// The distances with signs.
    pub signed: Vec<f64>,
    /// What the signs stand for: the other model where it is a solid.
    pub signs: Signs,
    /// The area of the surface that each sample stands for; 1 for a point of a cloud.
    pub areas: Vec<f64>,
    /// The corners of triangles between the samples of a mesh, three indices each; else none.
    pub triangles: Vec<u32>,
    /// The ends of the projections: [`crate::result::Status`] as a number.
    pub statuses: Vec<u8>,
}

/// Statistics of the deviation over the area of the sampled model. They are
/// estimates: sums over samples without error bounds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Statistics {
    /// Always true: a reminder in the data that these are not certified.
    pub estimate: bool,
    /// The area that the samples stand for.
    pub area: f64,
    /// Mean distance.
    pub mean: f64,
    /// Root of the mean squared distance.
    pub rms: f64,
    /// Mean of the signed distance, where there is a sign; 0 if nowhere.
    pub signed_mean: f64,
    /// The distance that half the area does not exceed.
    pub median: f64,
    /// The distance that 95 % of the area does not exceed.
    pub percentile_95: f64,
    /// The distance that 99 % of the area does not exceed.
    pub percentile_99: f64,
}

impl Statistics {
    /// Weighted by the samples' areas; `None` where there is no area. O(n log n).
    pub(in crate::engine) fn of(field: &[FaceDeviations]) -> Option<Self> {
        let mut samples: Vec<(f64, f64)> = Vec::new();
        let (mut area, mut sum, mut squares) = (0.0, 0.0, 0.0);
        let (mut signed_area, mut signed_sum) = (0.0, 0.0);
        for part in field {
            for ((&distance, &signed), &weight) in part.distances.iter().zip(&part.signed).zip(&part.areas) {
                samples.push((distance, weight));
                area += weight;
                sum += weight * distance;
                squares += weight * distance * distance;
                if signed.is_finite() {
                    signed_area += weight;
                    signed_sum += weight * signed;
                }
            }
        }
        if area <= 0.0 || !area.is_finite() {
            return None;
        }
        sort_by_number(&mut samples, |sample| sample.0);
        let quantile = |part: f64| {
            let mut below = 0.0;
            let reached = samples.iter().find(|(_, weight)| {
                below += weight;
                below >= part * area
            });
            reached.or(samples.last()).map_or(0.0, |(distance, _)| *distance)
        };
        Some(Self {
            estimate: true,
            area,
            mean: sum / area,
            rms: (squares / area).sqrt(),
            signed_mean: if signed_area > 0.0 { signed_sum / signed_area } else { 0.0 },
            median: quantile(0.5),
            percentile_95: quantile(0.95),
            percentile_99: quantile(0.99),
        })
    }
}

impl FaceDeviations {
    /// Limits the distances to an upper bound on the distance of the whole model, which
    /// they may exceed by the gap of their search.
    pub(in crate::engine) fn limit(&mut self, upper: f64) {
        for distance in &mut self.distances {
            *distance = distance.min(upper);
        }
        // NaN, which stands for no sign, stays NaN.
        for signed in &mut self.signed {
            if signed.abs() > upper {
                *signed = upper.copysign(*signed);
            }
        }
    }
}
