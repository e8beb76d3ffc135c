//! One direction run on one backend, and its result.

use super::certified::certified;
use super::iteration::{Directed, Direction};
use super::iteration_backend::Stages;
use super::iteration_cpu::CpuStages;
use super::{
    DistanceResult, Method, Options, PatchCounts, PreparedModel, Processor, Seconds, Statistics, Stop,
    SurfacePoint, Witness,
};
use crate::certified::Pair;
use crate::error::{Error, Result};
use crate::flatness::Flatness;
use crate::gpu::{Gpu, GpuIteration};
use crate::model::RigidTransform;
use crate::progress::Progress;
use glam::DVec3;
use std::rc::Rc;
use web_time::Instant;

/// Bézier patches of A from which on they are not cut flat for its cells: the
/// cutting then takes longer than the search, which needs flat patches of B
/// only. Few patches are, for closer bounds of their derivatives.
const FINE: usize = 1000;

/// The two models of one direction; the transform takes `from` into the frame of `to`.
pub(super) struct Ends<'a> {
    pub(super) from: &'a PreparedModel,
    pub(super) to: &'a PreparedModel,
    pub(super) transform: RigidTransform,
}

/// What one direction found, on which backend, how fast.
pub(super) struct Run {
    pub(super) directed: Directed,
    pub(super) backend: Processor,
    pub(super) adapter: Option<String>,
    pub(super) notice: Option<String>,
    pub(super) diagonal: f64,
    pub(super) sampled_patches: usize,
    pub(super) target_patches: usize,
    pub(super) seconds: Seconds,
}

impl Ends<'_> {
    /// A method that is made of stages, on the CPU without a GPU.
    pub(super) async fn staged(
        &self,
        gpu: Option<&Rc<Gpu>>,
        method: Method,
        options: &Options,
        notice: Option<String>,
        progress: &mut Progress<'_>,
    ) -> Result<Run> {
        if method == Method::Hierarchy {
            let run = self.hierarchy(gpu, options, progress).await?;
            return Ok(Run { notice: notice.or(run.notice), ..run });
        }
        let started = Instant::now();
        let sampling = self.from.sampling(options.samples, options.sampling);
        let target = self.to.target(options.flatness);
        let (prepared, mut stages) = match gpu {
            Some(gpu) => {
                let upload = |gpu: &Gpu| gpu.upload_sampling(self.from.bezier(), &sampling.sampling);
                let uploaded = sampling.resident.on(gpu, upload)?;
                let to = target.resident.on(gpu, |gpu| gpu.upload_target(&target.target))?;
                let prepared = Instant::now();
                let stages = GpuIteration::new(gpu, uploaded, to, self.transform, options.rule()).await?;
                (prepared, Stages::Gpu(Box::new(stages)))
            }
            None => {
                let (model, to) = (self.from.bezier(), &target.target);
                let stages = CpuStages::new(model, &sampling.sampling, to, self.transform, options.rule());
                (Instant::now(), Stages::Cpu(stages))
            }
        };
        let compile = stages.compile_seconds();
        let diagonal = self.diagonal();
        let direction = Direction {
            a: self.from,
            b: self.to,
            sampling: &sampling,
            target: &target,
            transform: self.transform,
            diagonal,
            options,
        };
        let directed = direction.run(&mut stages, progress).await?.ok_or(Error::EmptyModel)?;
        Ok(Run {
            directed,
            backend: if gpu.is_some() { Processor::Gpu } else { Processor::Cpu },
            adapter: gpu.and_then(|gpu| gpu.adapter()),
            notice,
            diagonal,
            sampled_patches: self.from.bezier().patches.len(),
            target_patches: target.target.patches.len(),
            seconds: Seconds {
                prepare: (prepared - started).as_secs_f64(),
                compile,
                solve: prepared.elapsed().as_secs_f64() - compile,
            },
        })
    }

    /// Method `certified`: in float64, many cells on the GPU if there is one.
    pub(super) async fn certified(
        &self,
        gpu: Option<&Rc<Gpu>>,
        options: &Options,
        progress: &mut Progress<'_>,
    ) -> Result<Run> {
        let started = Instant::now();
        let fine = self.from.bezier().patches.len() >= FINE;
        let of_cells = if fine { Flatness::None } else { Flatness::Loose };
        let (from, to) = (self.from.target(of_cells), self.to.target(Flatness::Loose));
        let (a, mut b) = (from.operand(self.from), to.operand(self.to));
        if fine {
            b = b.with_uncut(&self.to.bezier().patches);
        }
        let prepare = started.elapsed().as_secs_f64();
        let diagonal = self.diagonal();
        let directed =
            certified(Pair { a, b, transform: self.transform }, diagonal, options, gpu, progress).await?;
        let (directed, notice) = directed.ok_or(Error::EmptyModel)?;
        let helped = directed.details.certified().is_some_and(|details| details.cpu_cells < details.cells);
        Ok(Run {
            directed,
            backend: if helped { Processor::Gpu } else { Processor::Cpu },
            adapter: gpu.filter(|_| helped).and_then(|gpu| gpu.adapter()),
            notice,
            diagonal,
            sampled_patches: from.target.patches.len(),
            target_patches: to.target.patches.len(),
            seconds: Seconds { prepare, compile: 0.0, solve: started.elapsed().as_secs_f64() - prepare },
        })
    }

    pub(super) fn diagonal(&self) -> f64 {
        self.from.bounding_box().diagonal().max(self.to.bounding_box().diagonal())
    }
}

impl Run {
    /// Whether the caller ended it early.
    pub(super) fn is_cancelled(&self) -> bool {
        self.directed.details.certified().is_some_and(|certified| certified.stop == Stop::Cancelled)
    }

    /// This run with another's samples.
    pub(super) fn with_field_of(mut self, sampled: Self) -> Self {
        self.directed.field = sampled.directed.field;
        self.seconds += sampled.seconds;
        self
    }

    /// From A to B.
    pub(super) fn into_forward(self) -> DistanceResult {
        let witness = Witness { a: self.directed.from, b: self.directed.to };
        let patches = PatchCounts { a: self.sampled_patches, b: self.target_patches };
        self.into_result(witness, patches)
    }

    /// From B to A: found in A's own frame, told in B's.
    pub(super) fn into_reverse(mut self, options: &Options) -> DistanceResult {
        let transform = &options.transform;
        let witness =
            Witness { a: moved(self.directed.to, transform), b: moved(self.directed.from, transform) };
        for field in &mut self.directed.field {
            for points in [&mut field.points, &mut field.feet] {
                for point in points.chunks_exact_mut(3) {
                    let [x, y, z] = [point[0], point[1], point[2]];
                    point.copy_from_slice(&transform.apply(DVec3::new(x, y, z)).to_array());
                }
            }
        }
        let patches = PatchCounts { a: self.target_patches, b: self.sampled_patches };
        self.into_result(witness, patches)
    }

    fn into_result(self, witness: Witness, patches: PatchCounts) -> DistanceResult {
        let Directed { computed, lower, upper, converged, details, field, .. } = self.directed;
        DistanceResult {
            details,
            backend: self.backend,
            adapter: self.adapter,
            diagonal: self.diagonal,
            computed,
            lower,
            upper,
            converged,
            witness,
            patches,
            seconds: self.seconds,
            notice: self.notice,
            statistics: Statistics::of(&field),
            forward: None,
            reverse: None,
            field,
        }
    }
}

fn moved(point: SurfacePoint, transform: &RigidTransform) -> SurfacePoint {
    SurfacePoint { point: transform.apply(DVec3::from_array(point.point)).to_array(), ..point }
}
