//! The deviation field: the foot and the distance of every sample, and their statistics.

use super::Field;
use super::iteration::SampledDirection;
use crate::bezier::Jet;
use crate::iteration::{Projected, SampleGrid};
use glam::DVec3;
use serde::Serialize;

/// Statistics of the deviation over the area of the sampled model. They are
/// estimates: sums over samples without error bounds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
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
    pub(super) fn of(field: &[Field]) -> Option<Self> {
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
        samples.sort_by(|a, b| a.0.total_cmp(&b.0));
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

impl SampledDirection<'_> {
    /// One field a surface, distances recomputed in float64 from the feet.
    pub(super) fn field(&self, projected: &[Projected]) -> Vec<Field> {
        let grids = self.sampling.sampling.grids.iter().enumerate();
        grids.map(|(surface, grid)| self.field_of_surface(surface, grid, projected)).collect()
    }

    fn field_of_surface(&self, surface: usize, grid: &SampleGrid, projected: &[Projected]) -> Field {
        let mut field = Field { surface, counts: grid.counts(), ..Field::default() };
        let bezier = self.from.bezier();
        let patches = &bezier.grids[surface];
        for (index, projected) in projected.iter().enumerate().skip(grid.first).take(grid.len()) {
            let (i, j) = grid.row_and_column(index);
            let ((row, s), (column, t)) = (grid.locations[0][i], grid.locations[1][j]);
            let patch = bezier.patches.patch(patches.first + row * patches.counts()[1] + column);
            let jet = patch.jet([s, t]);
            let point = self.transform.apply(jet.point);
            let foot = self.target.target.patches.patch(projected.patch).jet(projected.parameters);
            let [u, v] = patch.domain.lengths();
            let weight = weight(&grid.parameters[0], i) * weight(&grid.parameters[1], j) / (u * v);
            field.points.extend_from_slice(&point.to_array());
            field.feet.extend_from_slice(&foot.point.to_array());
            field.distances.push(point.distance(foot.point));
            field.signed.push(signed(point, &foot));
            field.areas.push(jet.s.cross(jet.t).length() * weight);
            field.statuses.push(projected.status as u8);
        }
        field
    }
}

/// The parameter range that a sample stands for: half of both its neighbours'.
fn weight(parameters: &[f64], index: usize) -> f64 {
    let before = parameters[index.saturating_sub(1)];
    let after = parameters[(index + 1).min(parameters.len() - 1)];
    0.5 * (after - before)
}

/// The distance, negative behind the foot's normal; NaN where there is no normal.
fn signed(point: DVec3, foot: &Jet) -> f64 {
    let offset = point - foot.point;
    foot.normal().map_or(f64::NAN, |normal| offset.length().copysign(offset.dot(normal)))
}
