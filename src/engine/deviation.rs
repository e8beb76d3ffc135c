//! The deviation field: the foot and the distance of every sample, and their statistics.

use super::Field;
use super::iteration::SampledDirection;
use crate::bezier::Jet;
use crate::closest::closest_above;
use crate::error::Result;
use crate::iteration::{Projected, SampleGrid, sample};
use crate::parallel::map;
use crate::progress::Progress;
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

/// The width of the certified interval of a sample's distance, relative to the models'
/// diagonal: below what any colour or statistic shows.
const FIELD_GAP: f64 = 1e-9;

/// The number of samples between two checkpoints: some milliseconds of work.
const SAMPLES_AT_ONCE: usize = 2048;

impl SampledDirection<'_> {
    /// Returns one field a surface.
    ///
    /// Guarantee: every distance exceeds the sample's distance to the other model by at
    /// most [`FIELD_GAP`] of the diagonal and is not below it, up to rounding. The
    /// projections are only starting points: each sample's closest point is searched
    /// on the whole of the other model in float64. O(samples log patches) in general
    /// position.
    ///
    /// # Errors
    /// [`crate::Error::Cancelled`].
    pub(super) async fn field(
        &self,
        projected: &[Projected],
        progress: &mut Progress<'_>,
    ) -> Result<Vec<Field>> {
        // What the threads share; the models around it are not made for that.
        let (model, sampling, target) = (self.from.bezier(), &self.sampling.sampling, &self.target.target);
        let gap = FIELD_GAP * self.diagonal;
        let transform = self.transform;
        let nearest_foot = |index: usize| {
            let projected = projected[index];
            let point = sample(model, sampling, index, &transform);
            let known = Some((projected.patch as u32, projected.parameters));
            closest_above(target, point, gap, known, 0.0, None).map_or(projected, |closest| Projected {
                patch: closest.patch,
                parameters: closest.parameters,
                distance_squared: closest.upper * closest.upper,
                ..projected
            })
        };
        let mut feet = Vec::with_capacity(projected.len());
        while feet.len() < projected.len() {
            let first = feet.len();
            let count = SAMPLES_AT_ONCE.min(projected.len() - first);
            feet.extend(map(count, |index| nearest_foot(first + index)));
            progress.checkpoint(1.0).await?;
        }
        let grids = self.sampling.sampling.grids.iter().enumerate();
        Ok(grids.map(|(surface, grid)| self.field_of_surface(surface, grid, &feet)).collect())
    }

    fn field_of_surface(&self, surface: usize, grid: &SampleGrid, feet: &[Projected]) -> Field {
        let face = self.from.pieces().face(surface);
        let mut field = Field { surface: face, counts: grid.counts(), ..Field::default() };
        let bezier = self.from.bezier();
        let patches = &bezier.grids[surface];
        for (index, projected) in feet.iter().enumerate().skip(grid.first).take(grid.len()) {
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

impl Field {
    /// Limits the distances to an upper bound on the distance of the whole model, which
    /// they may exceed by the gap of their search.
    pub(super) fn limit(&mut self, upper: f64) {
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

/// The parameter range that a sample stands for: half of both its neighbours'.
fn weight(parameters: &[f64], index: usize) -> f64 {
    let before = parameters[index.saturating_sub(1)];
    let after = parameters[(index + 1).min(parameters.len() - 1)];
    0.5 * (after - before)
}

/// The distance, negative behind the foot's normal; NaN where there is no normal.
pub(super) fn signed(point: DVec3, foot: &Jet) -> f64 {
    let offset = point - foot.point;
    foot.normal().map_or(f64::NAN, |normal| offset.length().copysign(offset.dot(normal)))
}
