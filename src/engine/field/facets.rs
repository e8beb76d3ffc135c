//! Fields of meshes and clouds: at their vertices, within large triangles, and at their points.

use super::SAMPLES_AT_ONCE;
use super::target::{FieldTarget, Known};
use crate::closest::Status;
use crate::engine::FaceDeviations;
use crate::engine::direction::Direction;
use crate::error::{Error, Result};
use crate::facets::{FacetSamples, PreparedFacets};
use crate::progress::Progress;
use crate::threads::parallel::map_ranges;
use std::ops::Range;

impl Direction<'_> {
    /// Returns one field a group of `facets`, which are those of `from`.
    ///
    /// # Errors
    /// [`Error::Cancelled`]; [`Error::EmptyModel`].
    pub(super) async fn facet_deviations(
        &self,
        facets: &PreparedFacets,
        target: FieldTarget<'_>,
        samples: usize,
        progress: &mut Progress<'_>,
    ) -> Result<Vec<FaceDeviations>> {
        let groups = facets.targets();
        let transform = self.transform;
        let mut fields = Vec::with_capacity(groups.len());
        for (face, group) in groups.iter().enumerate() {
            let FacetSamples { points, areas, triangles } = FacetSamples::of(group, samples);
            let mut field = FaceDeviations {
                face,
                counts: [points.len(), 1],
                statuses: vec![Status::Converged as u8; points.len()],
                areas,
                triangles,
                signs: target.signs(),
                ..FaceDeviations::default()
            };
            for (page, points) in points.chunks(SAMPLES_AT_ONCE).enumerate() {
                let parts = map_ranges(points.len(), |range: Range<usize>| {
                    let mut known = Known::default();
                    let mut part = FaceDeviations::default();
                    for &point in &points[range] {
                        part.push(transform.apply(point), target, &mut known)?;
                    }
                    Some(part)
                });
                for part in parts {
                    field.append(part.ok_or(Error::EmptyModel)?);
                }
                let done = ((page + 1) * SAMPLES_AT_ONCE).min(field.counts[0]) as f64;
                let of_group = done / field.counts[0] as f64;
                progress.checkpoint((face as f64 + of_group) / groups.len() as f64).await?;
            }
            fields.push(field);
        }
        Ok(fields)
    }
}

impl FaceDeviations {
    /// Appends a point with its foot; `None` for a target without patches.
    fn push(&mut self, point: glam::DVec3, target: FieldTarget<'_>, known: &mut Known) -> Option<()> {
        let foot = target.closest(point, known)?;
        self.points.extend(point.to_array());
        self.feet.extend(foot.point.to_array());
        self.distances.push(foot.distance);
        self.signed.push(foot.signed);
        Some(())
    }

    fn append(&mut self, mut other: Self) {
        self.points.append(&mut other.points);
        self.feet.append(&mut other.feet);
        self.distances.append(&mut other.distances);
        self.signed.append(&mut other.signed);
    }
}
