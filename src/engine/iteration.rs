//! One direction of method `iteration`, on any backend.

use super::iteration_backend::Stages;
use super::{
    Bounds, Details, Field, IterationDetails, Options, PreparedModel, PreparedSampling, PreparedTarget,
    SurfacePoint,
};
use crate::closest::{Closest, Projection, Status, closest, contraction, nearest_control};
use crate::error::Result;
use crate::flatness::MAX_HALVINGS;
use crate::iteration::Candidate;
use crate::iteration::StatusCounts;
use crate::iteration::{Projected, sample};
use crate::model::RigidTransform;
use crate::progress::Progress;
use crate::rounding::{accumulated, vanishing};
use glam::DVec3;

/// Width asked of a sample's float64 certificate, relative to the models'
/// diagonal: a hundredth of the finest tolerance that anyone asks.
const CERTIFICATE_GAP: f64 = 1e-10;

/// Roundings of a distance of two points, relative to it: three differences, their
/// squares, two sums and a root, and the sum with the covering radius.
const DISTANCE_ROUNDINGS: f64 = 8.0;

/// Samples of a page finished in float64 before a distance within the
/// kernel's error of the best is left as it is. Only where many samples are
/// equally far, as on offsets and copies, are there more.
const FINISHED_TO_THE_END: usize = 64;

/// Samples of a page finished in float64, at most.
const MAX_FINISHED: usize = 1024;

/// One direction: A's samples against B's patches.
pub(super) struct Direction<'a> {
    pub(super) a: &'a PreparedModel,
    pub(super) b: &'a PreparedModel,
    pub(super) sampling: &'a PreparedSampling,
    pub(super) target: &'a PreparedTarget,
    pub(super) transform: RigidTransform,
    pub(super) diagonal: f64,
    pub(super) options: &'a Options,
}

/// What one direction found; `b` in the frame of the target.
pub(super) struct Directed {
    pub(super) computed: f64,
    pub(super) lower: f64,
    pub(super) upper: f64,
    pub(super) converged: bool,
    pub(super) from: SurfacePoint,
    pub(super) to: SurfacePoint,
    pub(super) details: Details,
    pub(super) field: Vec<Field>,
}

/// The farthest sample so far, as the method counts it.
#[derive(Clone, Copy)]
struct Farthest {
    sample: usize,
    point: DVec3,
    distance: f64,
    patch: usize,
    parameters: [f64; 2],
    foot: DVec3,
    lower: f64,
    status: Status,
}

impl Direction<'_> {
    /// Runs the stages page by page and bounds the result; `None` for a
    /// sampling without samples, which no options make.
    ///
    /// With Newton's step every sample that may be the farthest is finished by
    /// the certified float64 search, until none left can exceed the best:
    /// kernels find distances of points of B, so never too small ones beyond
    /// their rounding, and the largest finished one is the largest of all.
    /// With the tangent-plane step the farthest is taken as the kernel found it.
    pub(super) async fn run(
        &self,
        stages: &mut Stages<'_>,
        progress: &mut Progress<'_>,
    ) -> Result<Option<Directed>> {
        let pages = self.sampling.sampling.pages();
        let mut farthest: Option<Farthest> = None;
        let mut unfinished = 0.0_f64;
        let mut statuses = StatusCounts::default();
        let mut projected = Vec::new();
        for (index, page) in pages.iter().enumerate() {
            progress.section(index as f64 / pages.len() as f64, 1.0 / pages.len() as f64);
            stages.project(index, page, progress).await?;
            let left = self.finish_page(stages, &mut farthest, progress).await?;
            unfinished = unfinished.max(left);
            statuses += stages.statuses();
            if self.options.field {
                projected.append(&mut stages.field().await?);
            }
        }
        let field = if self.options.field { self.field(&projected) } else { Vec::new() };
        Ok(farthest
            .map(|farthest| self.bound(stages.distance_error(), farthest, unfinished, statuses, field)))
    }

    /// Takes the page's farthest samples into `farthest`; returns the largest
    /// distance that the kernel gave a sample left unfinished.
    async fn finish_page(
        &self,
        stages: &mut Stages<'_>,
        farthest: &mut Option<Farthest>,
        progress: &mut Progress<'_>,
    ) -> Result<f64> {
        let exceeds =
            |distance: f64, best: &Option<Farthest>| best.is_none_or(|best| distance > best.distance);
        let error = stages.distance_error() + CERTIFICATE_GAP * self.diagonal;
        let mut finished = 0;
        loop {
            let candidates = stages.reduce().await?;
            let Some(first) = candidates.first() else { return Ok(0.0) };
            let largest = first.projected.distance_squared.sqrt();
            let within_error = finished >= FINISHED_TO_THE_END && !exceeds(largest - error, farthest);
            if !exceeds(largest, farthest) || within_error || finished >= MAX_FINISHED {
                return Ok(largest);
            }
            if self.options.projection == Projection::TangentPlane {
                *farthest = Some(self.as_published(first));
                return Ok(largest);
            }
            for candidate in &candidates {
                if !exceeds(candidate.projected.distance_squared.sqrt(), farthest) {
                    break;
                }
                progress.checkpoint(1.0).await?;
                finished += 1;
                let this = self.finish(candidate);
                stages.settle(candidate.sample, this.distance * this.distance);
                if exceeds(this.distance, farthest) {
                    *farthest = Some(this);
                }
            }
        }
    }

    fn point(&self, index: usize) -> DVec3 {
        sample(self.a.bezier(), &self.sampling.sampling, index, &self.transform)
    }

    fn closest(&self, point: DVec3) -> Option<Closest> {
        closest(&self.target.target, point, CERTIFICATE_GAP * self.diagonal)
    }

    /// The candidate's distance by the certified search.
    fn finish(&self, candidate: &Candidate) -> Farthest {
        let published = self.as_published(candidate);
        match self.closest(published.point) {
            Some(closest) => Farthest {
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

    /// The candidate's distance to the foot that its projection found.
    fn as_published(&self, candidate: &Candidate) -> Farthest {
        let Projected { patch, parameters, status, .. } = candidate.projected;
        let point = self.point(candidate.sample);
        let foot = self.target.target.patches.patch(patch).point(parameters);
        Farthest {
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

    fn bound(
        &self,
        distance_error: f64,
        farthest: Farthest,
        unfinished: f64,
        statuses: StatusCounts,
        field: Vec<Field>,
    ) -> Directed {
        let radius = self.sampling.sampling.radius;
        let patches = &self.target.target.patches;
        let patch = patches.patch(farthest.patch);
        let start = nearest_control(&patch, farthest.point);
        let contraction = contraction(&patch, farthest.point, start, self.options.iterations);
        let k_b =
            (contraction < 1.0).then(|| contraction / (1.0 - contraction) * self.options.step_tolerance);
        let largest = farthest.distance.max(unfinished + distance_error) + radius.rigorous;
        let rounding = self.point_errors() + accumulated(DISTANCE_ROUNDINGS) * largest + vanishing();
        let converged = match self.options.projection {
            Projection::Newton => {
                unfinished <= farthest.distance + distance_error + CERTIFICATE_GAP * self.diagonal
            }
            Projection::TangentPlane => farthest.status != Status::IterationLimit,
        };
        Directed {
            computed: farthest.distance,
            lower: (farthest.lower.min(farthest.distance) - rounding).max(0.0),
            upper: largest + rounding,
            converged,
            from: self.sample_point(farthest.sample, farthest.point),
            to: surface_point(patch.surface, patch.surface_parameters(farthest.parameters), farthest.foot),
            details: Details::Iteration(IterationDetails {
                bounds: Bounds { k_a: radius.published, k_a_rigorous: radius.rigorous, k_b },
                samples: self.sampling.sampling.len(),
                statuses,
            }),
            field,
        }
    }

    /// An upper bound on how far the computed points of both models, moved, are from
    /// the exact ones, added up.
    fn point_errors(&self) -> f64 {
        let moved = self.transform.rounding(self.a.bounding_box().farthest_from_origin());
        let of_a = self.a.bezier().point_error.after(0);
        of_a + moved + self.b.bezier().point_error.after(MAX_HALVINGS)
    }

    fn sample_point(&self, index: usize, point: DVec3) -> SurfacePoint {
        let sampling = &self.sampling.sampling;
        surface_point(sampling.surface(index), sampling.parameters(index), point)
    }
}

pub(super) fn surface_point(surface: usize, [u, v]: [f64; 2], point: DVec3) -> SurfacePoint {
    SurfacePoint { surface, u, v, point: point.to_array() }
}
