//! The distance in one direction, and its result.

use super::certified::certified;
use super::options::CertifiedOptions;
use super::result::DirectedResult;
use super::{
    DistanceOptions, DistanceResult, PatchCounts, PreparedModel, Processor, Seconds, Statistics, Stop,
    WithGaps, Witness,
};
use crate::certified::Pair;
use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::progress::Progress;
use glam::DVec3;
use std::sync::Arc;
use web_time::Instant;

/// The largest ratio of the reach of a pair, from the farther end of one model to that of the
/// other, to the smaller model's radius up to which kernels measure it. Their coordinates are in
/// units of a model's radius: squares of more than 2^64 overflow float32, of less than 2^-63 lose
/// digits, and a single point has no radius.
const MAX_FLOAT32_REACH: f64 = (1_u64 << 30) as f64;

/// The two models of one direction; the transform maps `from` into the frame of `to`.
pub(super) struct Direction<'a> {
    pub(super) from: &'a PreparedModel,
    pub(super) to: &'a PreparedModel,
    pub(super) transform: RigidTransform,
}

/// A result with the processor that computed it, and the time taken.
pub(super) struct DirectedRun {
    pub(super) result: DirectedResult,
    pub(super) backend: Processor,
    pub(super) adapter: Option<String>,
    pub(super) notice: Option<String>,
    pub(super) diagonal: f64,
    /// Metres per unit, if a model states it.
    pub(super) unit: Option<f64>,
    /// The sum of the models' gaps.
    pub(super) gap: f64,
    pub(super) is_gap_proven: bool,
    pub(super) limit: Option<f64>,
    /// The number of patches of `from`.
    pub(super) from_patches: usize,
    /// The number of patches of `to`.
    pub(super) to_patches: usize,
    pub(super) seconds: Seconds,
}

impl Direction<'_> {
    /// Runs method `certified` in float64, with large numbers of cells on the GPU
    /// if there is one.
    pub(super) async fn certified(
        &self,
        gpu: Option<&Arc<Gpu>>,
        options: &DistanceOptions,
        budgets: &CertifiedOptions,
        progress: &mut Progress<'_>,
    ) -> Result<DirectedRun> {
        let started = Instant::now();
        let (from, to) = (self.from.certified_target(), self.to.certified_target());
        let (a, mut b) = (from.operand(self.from), to.operand(self.to));
        if self.from.is_left_uncut() {
            b = b.with_uncut(&self.to.bezier().patches);
        }
        let prepare = started.elapsed().as_secs_f64();
        let diagonal = self.diagonal();
        let pair = Pair { a, b, transform: self.transform };
        let models = [self.from, self.to];
        let result = certified(pair, models, [diagonal, self.gap()], options, budgets, gpu, progress).await?;
        let (result, notice) = result.ok_or(Error::EmptyModel)?;
        let on_gpu = result.details.certified().is_some_and(|details| details.cpu_cells < details.cells);
        Ok(DirectedRun {
            result,
            backend: if on_gpu { Processor::Gpu } else { Processor::Cpu },
            adapter: gpu.filter(|_| on_gpu).and_then(|gpu| gpu.adapter()),
            notice,
            diagonal,
            unit: self.unit(),
            gap: self.gap(),
            is_gap_proven: self.is_gap_proven(),
            limit: options.limit,
            from_patches: from.target.patches.len(),
            to_patches: to.target.patches.len(),
            seconds: Seconds { prepare, compile: 0.0, solve: started.elapsed().as_secs_f64() - prepare },
        })
    }

    /// Returns the metres per unit, if a model states it; both state the same if both do.
    pub(super) fn unit(&self) -> Option<f64> {
        self.from.unit().or(self.to.unit())
    }

    /// Refuses meshes and clouds for a computation that has none.
    ///
    /// # Errors
    /// [`Error::FacetsUnsupported`].
    pub(super) fn require_surfaces(&self, found: &'static str) -> Result<()> {
        self.from.require_surfaces(found)?;
        self.to.require_surfaces(found)
    }

    /// Returns the sum of both models' gaps.
    pub(super) fn gap(&self) -> f64 {
        self.from.gap() + self.to.gap()
    }

    /// Returns whether the gaps of both are upper bounds.
    pub(super) fn is_gap_proven(&self) -> bool {
        self.from.is_gap_proven() && self.to.is_gap_proven()
    }

    /// Returns whether float32 holds the lengths of both models in units of either one's size.
    pub(super) fn is_in_float32_range(&self) -> bool {
        let [from, to] = [self.from, self.to].map(PreparedModel::bounding_box);
        let [a, b] = [from, to].map(|aabb| 0.5 * aabb.diagonal());
        let reach = self.transform.apply(from.center()).distance(to.center()) + a + b;
        [a, b].into_iter().all(|radius| reach <= MAX_FLOAT32_REACH * radius)
    }

    /// Returns the larger diagonal of the two models' boxes.
    pub(super) fn diagonal(&self) -> f64 {
        self.from.bounding_box().diagonal().max(self.to.bounding_box().diagonal())
    }
}

impl DirectedRun {
    /// Returns whether the caller cancelled the run.
    pub(super) fn is_cancelled(&self) -> bool {
        self.result.details.certified().is_some_and(|certified| certified.stop == Stop::Cancelled)
    }

    /// Adds a notice to the one there is.
    pub(super) fn add_notice(&mut self, notice: &str) {
        self.notice = Some(match self.notice.take() {
            Some(other) => format!("{other}; {notice}"),
            None => notice.to_owned(),
        });
    }

    /// Returns the result of the direction from A to B.
    pub(super) fn into_forward(self) -> DistanceResult {
        let witness = Witness { a: self.result.from.clone(), b: self.result.to.clone() };
        let patches = PatchCounts { a: self.from_patches, b: self.to_patches };
        self.into_result(witness, patches)
    }

    /// Returns the result of the direction from B to A, which was computed in A's
    /// own frame, in the frame of B.
    pub(super) fn into_reverse(mut self, options: &DistanceOptions) -> DistanceResult {
        let transform = &options.transform;
        let [from, to] = [&self.result.from, &self.result.to].map(|point| point.moved(transform));
        let witness = Witness { a: to, b: from };
        for face in &mut self.result.deviations {
            for points in [&mut face.points, &mut face.feet] {
                for point in points.chunks_exact_mut(3) {
                    let [x, y, z] = [point[0], point[1], point[2]];
                    point.copy_from_slice(&transform.apply(DVec3::new(x, y, z)).to_array());
                }
            }
        }
        let patches = PatchCounts { a: self.to_patches, b: self.from_patches };
        self.into_result(witness, patches)
    }

    fn into_result(self, witness: Witness, patches: PatchCounts) -> DistanceResult {
        let DirectedResult { computed, lower, upper, converged, details, mut deviations, .. } = self.result;
        deviations.iter_mut().for_each(|face| face.limit(upper));
        DistanceResult {
            details,
            backend: self.backend,
            adapter: self.adapter,
            diagonal: self.diagonal,
            unit: self.unit,
            hint: None,
            gap: self.gap,
            gap_proven: self.is_gap_proven,
            with_gaps: WithGaps::new(Interval { lower, upper }, self.gap, self.limit),
            computed,
            lower,
            upper,
            converged,
            witness,
            patches,
            seconds: self.seconds,
            notice: self.notice,
            statistics: Statistics::of(&deviations),
            forward: None,
            reverse: None,
            deviations,
        }
    }
}
