//! The deviation field: the samples of one model with their closest points on the other.

mod deviation;
mod facets;
mod target;

use super::direction::Direction;
use super::options::{DEFAULT_SAMPLES, at_least_zero, require_samples};
use super::query::{Opened, impl_query};
use super::{Computation, Engine, PreparedModel};
use crate::bezier::BezierModel;
use crate::closest::Status;
use crate::error::{Error, Result};
use crate::iteration::{Projected, SampleGrid, Sampling, SamplingRule};
use crate::model::RigidTransform;
use crate::pieces::FacePieces;
use crate::progress::{Monitor, Progress};
use crate::threads::parallel::map_ranges;
pub use deviation::{FaceDeviations, Statistics};
use glam::DVec3;
use serde::Deserialize;
use std::ops::Range;
pub(super) use target::FieldTarget;
use target::{Foot, Held, Known};

/// The number of samples between two checkpoints: some milliseconds of work.
const SAMPLES_AT_ONCE: usize = 2048;

/// Options of [`Engine::field`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct FieldOptions {
    /// Samples along each direction of every surface of A, 2 to 1024. A mesh is sampled at its
    /// vertices, and each group in at least their square of triangles; a cloud at its points.
    pub samples: usize,
    /// The rule by which they are spread.
    pub sampling: SamplingRule,
    /// A known upper bound on the distance from A to B, such as that of a
    /// [`super::DistanceResult`], 0 or more: no distance of the field exceeds it.
    pub upper: Option<f64>,
    /// Whether B is scaled to the unit of A where both state different ones; else they are
    /// an error.
    pub scale_units: bool,
    /// Moves A before it is measured. It is not deserialized, because only
    /// [`RigidTransform::new`] makes one.
    #[serde(skip)]
    pub transform: RigidTransform,
}

impl Default for FieldOptions {
    fn default() -> Self {
        Self {
            samples: DEFAULT_SAMPLES,
            sampling: SamplingRule::default(),
            upper: None,
            scale_units: false,
            transform: RigidTransform::IDENTITY,
        }
    }
}

impl_query!(FieldOptions, field -> DeviationField, [scale_units, transform]);

impl FieldOptions {
    fn require_own(&self) -> Result<()> {
        require_samples(self.samples)?;
        self.upper.map_or(Ok(()), |upper| at_least_zero("upper", upper))
    }
}

/// The deviation of A from B at samples of A.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DeviationField {
    /// The larger diagonal of the two models' control-net boxes.
    pub diagonal: f64,
    /// Statistics over A's area, where it has one. Estimates.
    pub statistics: Option<Statistics>,
    /// One entry a surface of A, a piece of a trimmed face, a group of a mesh, or a cloud.
    pub deviations: Vec<FaceDeviations>,
}

impl Engine {
    /// Returns the deviation of A, moved by the options' transform, from B at the samples of
    /// a grid, without a search for the largest one.
    ///
    /// Guarantee: every distance is not below the sample's distance to B up to rounding, and
    /// exceeds it by at most 1e-9 of the larger diagonal. All in float64 on the CPU.
    /// O(samples log patches) in general position.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`]; [`Error::UnitsDiffer`]; [`Error::Cancelled`].
    pub fn field<'a>(
        &'a self,
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        options: &'a FieldOptions,
    ) -> Computation<'a, DeviationField> {
        Computation::new(move |mut watched| {
            Box::pin(async move { self.field_of(a, b, options, watched.monitor()).await })
        })
    }

    async fn field_of(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        options: &FieldOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<DeviationField> {
        let opened = Opened::new([a, b], options)?;
        let mut progress = Progress::new(monitor, false);
        let direction = opened.forward();
        let mut deviations = direction.deviations(options.samples, options.sampling, &mut progress).await?;
        if let Some(upper) = options.upper {
            deviations.iter_mut().for_each(|face| face.limit(upper));
        }
        progress.finish();
        Ok(DeviationField {
            diagonal: direction.diagonal(),
            statistics: Statistics::of(&deviations),
            deviations,
        })
    }
}

impl Direction<'_> {
    /// Returns one field a surface or a group of `from`, as [`FieldSearch::run`] does.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) async fn deviations(
        &self,
        samples: usize,
        rule: SamplingRule,
        progress: &mut Progress<'_>,
    ) -> Result<Vec<FaceDeviations>> {
        let held = Held::new(self.to);
        let target = self.field_target(&held)?;
        if let Some(facets) = self.from.facets() {
            return self.facet_deviations(facets, target, samples, progress).await;
        }
        let sampling = self.from.sampling(samples, rule);
        let search = FieldSearch {
            bezier: self.from.bezier(),
            pieces: self.from.pieces(),
            sampling: &sampling.sampling,
            target,
            transform: self.transform,
        };
        search.run(None, progress).await
    }
}

/// The samples of surfaces, and the model on which their closest points lie.
pub(super) struct FieldSearch<'a> {
    pub(super) bezier: &'a BezierModel,
    pub(super) pieces: &'a FacePieces,
    pub(super) sampling: &'a Sampling,
    pub(super) target: FieldTarget<'a>,
    pub(super) transform: RigidTransform,
}

/// One sample with its foot.
struct FieldSample {
    point: DVec3,
    foot: Foot,
    area: f64,
    status: Status,
}

impl FieldSearch<'_> {
    /// Returns one field a surface.
    ///
    /// Guarantee: every distance exceeds the sample's distance to the other model by at
    /// most 1e-9 of the diagonal and is not below it, up to rounding. Each sample's
    /// closest point is searched on the whole of the other model in float64, from the foot
    /// that `projected` names, or else from that of the sample before it.
    /// O(samples log patches) in general position.
    ///
    /// # Errors
    /// [`Error::Cancelled`]; [`Error::EmptyModel`].
    pub(super) async fn run(
        &self,
        projected: Option<&[Projected]>,
        progress: &mut Progress<'_>,
    ) -> Result<Vec<FaceDeviations>> {
        let count = self.sampling.len();
        let mut samples: Vec<FieldSample> = Vec::with_capacity(count);
        while samples.len() < count {
            let first = samples.len();
            let work = |range: Range<usize>| self.samples(first + range.start..first + range.end, projected);
            for part in map_ranges(SAMPLES_AT_ONCE.min(count - first), work) {
                samples.append(&mut part.ok_or(Error::EmptyModel)?);
            }
            progress.checkpoint(samples.len() as f64 / count as f64).await?;
        }
        let grids = self.sampling.grids.iter().enumerate();
        Ok(grids.map(|(surface, grid)| self.of_surface(surface, grid, &samples)).collect())
    }

    /// Returns the samples of a range with their closest points; `None` for a target
    /// without patches.
    fn samples(&self, range: Range<usize>, projected: Option<&[Projected]>) -> Option<Vec<FieldSample>> {
        let bezier = self.bezier;
        let mut known = Known::default();
        let find = |index: usize| {
            let surface = self.sampling.surface(index);
            let (grid, patches) = (&self.sampling.grids[surface], &bezier.grids[surface]);
            let (i, j) = grid.row_and_column(index);
            let ((row, s), (column, t)) = (grid.locations[0][i], grid.locations[1][j]);
            let patch = bezier.patches.patch(patches.first + row * patches.counts()[1] + column);
            let jet = patch.jet([s, t]);
            let point = self.transform.apply(jet.point);
            if let Some(projected) = projected {
                known.place = Some((projected[index].patch as u32, projected[index].parameters));
            }
            let foot = self.target.closest(point, &mut known)?;
            let [u, v] = patch.domain.lengths();
            let weight = weight(&grid.parameters[0], i) * weight(&grid.parameters[1], j) / (u * v);
            Some(FieldSample {
                point,
                foot,
                area: jet.s.cross(jet.t).length() * weight,
                status: projected.map_or(Status::Converged, |projected| projected[index].status),
            })
        };
        range.map(find).collect()
    }

    fn of_surface(&self, surface: usize, grid: &SampleGrid, samples: &[FieldSample]) -> FaceDeviations {
        let face = self.pieces.face(surface);
        let mut field = FaceDeviations {
            face,
            counts: grid.counts(),
            signs: self.target.signs(),
            ..FaceDeviations::default()
        };
        for sample in &samples[grid.first..grid.first + grid.len()] {
            field.points.extend_from_slice(&sample.point.to_array());
            field.feet.extend_from_slice(&sample.foot.point.to_array());
            field.distances.push(sample.foot.distance);
            field.signed.push(sample.foot.signed);
            field.areas.push(sample.area);
            field.statuses.push(sample.status as u8);
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
