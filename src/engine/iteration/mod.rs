//! The driver of method `iteration`, for one direction on either backend.

mod backend;
mod cpu;

use super::direction::{DirectedRun, Direction};
use super::field::{FieldSearch, FieldTarget};
use super::options::IterationOptions;
use super::result::DirectedResult;
use super::signs::{SignRule, SignSource};
use super::{
    Bounds, Details, DistanceOptions, FaceDeviations, IterationDetails, PreparedModel, PreparedSampling,
    PreparedTarget, Processor, Seconds,
};
use crate::closest::{Closest, Projection, Status, closest, contraction, nearest_control};
use crate::error::{Error, Result};
use crate::flatness::MAX_HALVINGS;
use crate::gpu::{Gpu, GpuIteration};
use crate::iteration::{Candidate, Projected, StatusCounts, sample};
use crate::model::RigidTransform;
use crate::progress::Progress;
use crate::rounding::{VANISHING_LENGTH, gamma, upper_max};
use crate::surface_point::SurfacePoint;
use backend::IterationBackend;
use cpu::CpuIteration;
use glam::DVec3;
use std::sync::Arc;
use web_time::Instant;

/// The width of the certified interval of a sample's distance, relative to the
/// models' diagonal: a hundredth of the finest tolerance in use.
const CERTIFICATE_GAP: f64 = 1e-10;

/// The roundings of a distance of two points, relative to it: three differences, their
/// squares, two sums and a root, and the sum with the covering radius.
const DISTANCE_ROUNDINGS: f64 = 8.0;

/// After refining this many samples of a page in float64, candidates that differ
/// from the best by less than the float32 error are not refined. More candidates
/// occur only on offsets and copies, where many samples are equally far.
const MAX_REFINED_WITHIN_ERROR: usize = 64;

/// The largest number of samples of a page that are refined in float64.
const MAX_REFINED: usize = 1024;

impl Direction<'_> {
    /// Runs method `iteration` on the GPU, or without one on the CPU.
    pub(super) async fn iteration(
        &self,
        gpu: Option<&Arc<Gpu>>,
        options: &DistanceOptions,
        own: &IterationOptions,
        progress: &mut Progress<'_>,
    ) -> Result<DirectedRun> {
        let started = Instant::now();
        let sampling = self.from.sampling(options.samples, options.sampling);
        let target = self.to.target(own.flatness);
        let (prepared, mut backend) = match gpu {
            Some(gpu) => {
                let upload = |gpu: &Gpu| gpu.upload_sampling(self.from.bezier(), &sampling.sampling);
                let samples = sampling.resident.on(gpu, upload)?;
                let patches = target.resident.on(gpu, |gpu| gpu.upload_target(&target.target))?;
                let prepared = Instant::now();
                let stages = GpuIteration::new(gpu, samples, patches, self.transform, own.rule()).await?;
                (prepared, IterationBackend::Gpu(Box::new(stages)))
            }
            None => {
                let (model, patches) = (self.from.bezier(), &target.target);
                let stages =
                    CpuIteration::new(model, &sampling.sampling, patches, self.transform, own.rule());
                (Instant::now(), IterationBackend::Cpu(stages))
            }
        };
        let compile = backend.compile_seconds();
        let diagonal = self.diagonal();
        let sampled = SampledDirection {
            from: self.from,
            to: self.to,
            sampling: &sampling,
            target: &target,
            transform: self.transform,
            diagonal,
            box_bound: self.box_bound(),
            options,
            own,
        };
        let result = sampled.run(&mut backend, progress).await?.ok_or(Error::EmptyModel)?;
        Ok(DirectedRun {
            result,
            backend: if gpu.is_some() { Processor::Gpu } else { Processor::Cpu },
            adapter: gpu.and_then(|gpu| gpu.adapter()),
            notice: None,
            diagonal,
            unit: self.unit(),
            gap: self.gap(),
            is_gap_proven: self.is_gap_proven(),
            limit: options.limit,
            from_patches: self.from.bezier().patches.len(),
            to_patches: target.target.patches.len(),
            seconds: Seconds {
                prepare: (prepared - started).as_secs_f64(),
                compile,
                solve: prepared.elapsed().as_secs_f64() - compile,
            },
        })
    }
}

/// One direction with the samples of one model and the flat patches of the other.
struct SampledDirection<'a> {
    from: &'a PreparedModel,
    to: &'a PreparedModel,
    sampling: &'a PreparedSampling,
    target: &'a PreparedTarget,
    transform: RigidTransform,
    diagonal: f64,
    /// [`Direction::box_bound`].
    box_bound: f64,
    options: &'a DistanceOptions,
    own: &'a IterationOptions,
}

/// The farthest sample found, with its foot.
#[derive(Clone, Copy)]
struct FarthestSample {
    sample: usize,
    point: DVec3,
    distance: f64,
    patch: usize,
    parameters: [f64; 2],
    foot: DVec3,
    lower: f64,
    status: Status,
}

impl SampledDirection<'_> {
    /// Runs the stages page by page and returns the bounded result; `None` for a
    /// sampling without samples, which no options produce.
    ///
    /// With Newton's step, every sample that may be the farthest is refined by the
    /// certified float64 search until no other can exceed the best. A kernel's
    /// distance is that of a point of B, hence an upper bound on the sample's
    /// distance up to rounding, so the largest refined distance is the largest of
    /// all. With the tangent-plane step, the kernel's farthest sample is taken as it is.
    async fn run(
        &self,
        backend: &mut IterationBackend<'_>,
        progress: &mut Progress<'_>,
    ) -> Result<Option<DirectedResult>> {
        let pages = self.sampling.sampling.pages();
        let mut farthest: Option<FarthestSample> = None;
        let mut unrefined = 0.0_f64;
        let mut statuses = StatusCounts::default();
        let mut projected = Vec::new();
        for (index, page) in pages.iter().enumerate() {
            progress.section(index as f64 / pages.len() as f64, 1.0 / pages.len() as f64);
            backend.project(index, page, progress).await?;
            let largest = self.refine_page(backend, &mut farthest, progress).await?;
            unrefined = upper_max(unrefined, largest);
            statuses += backend.statuses();
            if self.options.deviations {
                projected.append(&mut backend.field().await?);
            }
        }
        let deviations = if self.options.deviations {
            let source = SignSource::new(self.to, 0.0);
            self.field_search(source.rule()).run(Some(&projected), progress).await?
        } else {
            Vec::new()
        };
        Ok(farthest
            .map(|farthest| self.bound(backend.distance_error(), farthest, unrefined, statuses, deviations)))
    }

    /// Updates `farthest` by the page's farthest samples; returns the largest
    /// distance from a kernel among the samples that were not refined.
    async fn refine_page(
        &self,
        backend: &mut IterationBackend<'_>,
        farthest: &mut Option<FarthestSample>,
        progress: &mut Progress<'_>,
    ) -> Result<f64> {
        let exceeds =
            |distance: f64, best: &Option<FarthestSample>| best.is_none_or(|best| distance > best.distance);
        let error = backend.distance_error() + CERTIFICATE_GAP * self.diagonal;
        let mut refined = 0;
        loop {
            let candidates = backend.reduce().await?;
            let Some(first) = candidates.first() else { return Ok(0.0) };
            let largest = first.projected.distance_squared.sqrt();
            let within_error = refined >= MAX_REFINED_WITHIN_ERROR && !exceeds(largest - error, farthest);
            if !exceeds(largest, farthest) || within_error || refined >= MAX_REFINED {
                return Ok(largest);
            }
            if self.own.projection == Projection::TangentPlane {
                *farthest = Some(self.as_published(first));
                return Ok(largest);
            }
            for candidate in &candidates {
                if !exceeds(candidate.projected.distance_squared.sqrt(), farthest) {
                    break;
                }
                progress.checkpoint(1.0).await?;
                refined += 1;
                let sample = self.refined(candidate);
                backend.set_distance_squared(candidate.sample, sample.distance * sample.distance);
                if exceeds(sample.distance, farthest) {
                    *farthest = Some(sample);
                }
            }
        }
    }

    fn field_search<'b>(&'b self, signs: SignRule<'b>) -> FieldSearch<'b> {
        FieldSearch {
            bezier: self.from.bezier(),
            pieces: self.from.pieces(),
            sampling: &self.sampling.sampling,
            target: FieldTarget::of_patches(&self.target.target, signs, self.diagonal),
            transform: self.transform,
        }
    }

    /// Returns the moved point of a sample.
    fn point(&self, index: usize) -> DVec3 {
        sample(self.from.bezier(), &self.sampling.sampling, index, &self.transform)
    }

    /// Returns the certified closest point of the target.
    fn closest(&self, point: DVec3) -> Option<Closest> {
        closest(&self.target.target, point, CERTIFICATE_GAP * self.diagonal)
    }

    /// Returns the candidate with its distance by the certified search.
    fn refined(&self, candidate: &Candidate) -> FarthestSample {
        let published = self.as_published(candidate);
        match self.closest(published.point) {
            Some(closest) => FarthestSample {
                distance: closest.upper,
                patch: closest.patch,
                parameters: closest.parameters,
                foot: closest.point,
                status: Status::Converged,
                ..published
            },
            None => published,
        }
    }

    /// Returns the candidate with its distance to the foot of its projection.
    fn as_published(&self, candidate: &Candidate) -> FarthestSample {
        let Projected { patch, parameters, status, .. } = candidate.projected;
        let point = self.point(candidate.sample);
        let foot = self.target.target.patches.patch(patch).point(parameters);
        FarthestSample {
            sample: candidate.sample,
            point,
            distance: point.distance(foot),
            patch,
            parameters,
            foot,
            lower: self.closest(point).map_or(0.0, |closest| closest.lower),
            status,
        }
    }

    /// Returns the result with the interval that the covering radius, the samples
    /// that were not refined and rounding imply.
    fn bound(
        &self,
        distance_error: f64,
        farthest: FarthestSample,
        unrefined: f64,
        statuses: StatusCounts,
        deviations: Vec<FaceDeviations>,
    ) -> DirectedResult {
        let radius = self.sampling.radius(self.from);
        let patches = &self.target.target.patches;
        let patch = patches.patch(farthest.patch);
        let start = nearest_control(&patch, farthest.point);
        let contraction = contraction(&patch, farthest.point, start, self.own.iterations);
        let k_b = (contraction < 1.0).then(|| contraction / (1.0 - contraction) * self.own.step_tolerance);
        let largest = upper_max(farthest.distance, unrefined + distance_error) + radius.rigorous;
        let rounding = self.point_errors() + gamma(DISTANCE_ROUNDINGS) * largest + VANISHING_LENGTH;
        let converged = match self.own.projection {
            Projection::Newton => {
                unrefined <= farthest.distance + distance_error + CERTIFICATE_GAP * self.diagonal
            }
            Projection::TangentPlane => farthest.status != Status::IterationLimit,
        };
        DirectedResult {
            computed: farthest.distance,
            lower: (farthest.lower.min(farthest.distance) - rounding).max(0.0),
            // `min` replaces NaN, of a float32 error without bound, by the other bound.
            upper: self.box_bound.min(largest + rounding),
            converged,
            from: self.sample_point(farthest.sample, farthest.point),
            to: self.to.pieces().surface_point(
                patch.surface,
                patch.surface_parameters(farthest.parameters),
                farthest.foot,
            ),
            details: Details::Iteration(IterationDetails {
                bounds: Bounds { k_a: radius.published, k_a_rigorous: radius.rigorous, k_b },
                samples: self.sampling.sampling.len(),
                statuses,
            }),
            deviations,
        }
    }

    /// Returns an upper bound on how far the computed points of both models, moved, are
    /// from the exact ones, added up.
    fn point_errors(&self) -> f64 {
        let moved = self.transform.rounding(self.from.control_box().farthest_from_origin());
        let of_a = self.from.bezier().point_error.after(0);
        of_a + moved + self.to.bezier().point_error.after(MAX_HALVINGS)
    }

    /// Returns a sample with its surface and parameters.
    fn sample_point(&self, index: usize, point: DVec3) -> SurfacePoint {
        let sampling = &self.sampling.sampling;
        let piece = sampling.surface(index);
        self.from.pieces().surface_point(piece, sampling.parameters(index), point)
    }
}
