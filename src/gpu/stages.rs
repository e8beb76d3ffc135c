//! The stages `sample`, `project` and `reduce` on the GPU.

use super::Gpu;
use super::layouts::{Best, Block, ProjectParams, ReduceParams, STATUS_SHIFT, SampleParams};
use super::pipelines::{Kernel, Pipeline, WORKGROUP_SIZE};
use super::plan::Plan;
use super::rounding::{ROUNDING, rounded, rounded_down};
use super::upload_sampling::{GpuSampling, SampleGroup};
use super::upload_target::{GpuTarget, TargetGroup};
use super::work::{Dispatch, Extent, Work};
use crate::closest::Status;
use crate::error::Result;
use crate::iteration::{Candidate, StatusCounts};
use crate::iteration::{Culling, Projected, Rule};
use crate::model::RigidTransform;
use crate::progress::Progress;
use bytemuck::{Zeroable, bytes_of};
use glam::DVec3;
use std::ops::Range;
use std::rc::Rc;
use web_time::Instant;

/// Samples of which `reduce` finds the farthest: some sixteen a thread.
const BLOCK_SIZE: u32 = 1024;

/// Squared distances from here on are those of samples not projected, `FARTHEST`
/// of `best.wgsl`, or beyond float32.
pub(super) const FARTHEST: f32 = 3e38;

/// Roundings in moving a sample and in a distance, in units of the largest
/// coordinate: products, sums, centre, difference, squares and root.
pub(super) const ROUNDINGS: f64 = 16.0;

/// One direction on the GPU, and the page in work.
pub(crate) struct GpuStages {
    gpu: Rc<Gpu>,
    sampling: Rc<GpuSampling>,
    target: Rc<GpuTarget>,
    transform: RigidTransform,
    rule: Rule,
    buffers: Buffers,
    reduce: (Rc<Pipeline>, Rc<wgpu::BindGroup>),
    page: Range<usize>,
    statuses: StatusCounts,
    compile_seconds: f64,
}

struct Buffers {
    params: wgpu::Buffer,
    samples: wgpu::Buffer,
    best: wgpu::Buffer,
    blocks: wgpu::Buffer,
    readable: wgpu::Buffer,
}

impl GpuStages {
    /// Makes the buffers of a page and every pipeline that the work wants.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`].
    pub(crate) async fn new(
        gpu: &Rc<Gpu>,
        sampling: Rc<GpuSampling>,
        target: Rc<GpuTarget>,
        transform: RigidTransform,
        rule: Rule,
    ) -> Result<Self> {
        gpu.check()?;
        let rows = |page: &Vec<SampleGroup>| page.iter().map(|group| u64::from(group.row_count)).sum::<u64>();
        let most = sampling.pages.iter().map(rows).max().unwrap_or(0) * sampling.samples as u64;
        let best_bytes = most * size_of::<Best>() as u64;
        let block_bytes = blocks_of(most) * size_of::<Block>() as u64;
        let buffers = Buffers {
            params: gpu.params(),
            samples: gpu.storage("samples", most * size_of::<[f32; 4]>() as u64),
            best: gpu.storage("best", best_bytes),
            blocks: gpu.storage("blocks", block_bytes),
            readable: gpu.readable("readable", best_bytes.max(block_bytes)),
        };
        let started = Instant::now();
        let (pipeline, mut new) = gpu.pipelines.get(Kernel::Reduce);
        let bind_group = gpu.bind(&pipeline, &buffers.params, &[&buffers.best, &buffers.blocks]);
        let mut stages = Self {
            gpu: Rc::clone(gpu),
            sampling,
            target,
            transform,
            rule,
            buffers,
            reduce: (pipeline, bind_group),
            page: 0..0,
            statuses: StatusCounts::default(),
            compile_seconds: 0.0,
        };
        // Run on nothing, which makes the driver compile it, is every kernel that is new.
        let mut work = Work::new(gpu, &stages.buffers.params);
        for group in stages.sampling.pages.iter().flatten() {
            if gpu.pipelines.get(Kernel::Sample { degree: group.degree }).1 {
                new = true;
                stages.record_sample(&mut work, group, &SampleParams { columns: 1, ..Zeroable::zeroed() });
            }
        }
        for group in &stages.target.groups {
            let kernel = stages.project_kernel(group);
            if gpu.pipelines.get(kernel).1 {
                new = true;
                let (pipeline, bind_group) = stages.bind_project(group);
                let params = Zeroable::zeroed();
                stages.record_project(&mut work, kernel, &pipeline, &bind_group, &params, [0; 2]);
            }
        }
        if new {
            stages.record_reduce(&mut work, 0);
            work.submit().await?;
            stages.compile_seconds = started.elapsed().as_secs_f64();
        }
        Ok(stages)
    }

    /// Seconds that making new pipelines took, the driver's compilation included.
    pub(crate) fn compile_seconds(&self) -> f64 {
        self.compile_seconds
    }

    /// The rule on one group: a single patch needs no tree.
    fn rule_on(&self, group: &TargetGroup) -> Rule {
        let culling = if group.count == 1 { Culling::None } else { self.rule.culling };
        Rule { culling, ..self.rule }
    }

    fn project_kernel(&self, group: &TargetGroup) -> Kernel {
        let Rule { projection, culling, .. } = self.rule_on(group);
        Kernel::Project { degree: group.degree, projection, culling }
    }

    fn record_sample(&self, work: &mut Work<'_>, group: &SampleGroup, params: &SampleParams) {
        let kernel = Kernel::Sample { degree: group.degree };
        let (pipeline, _) = self.gpu.pipelines.get(kernel);
        let Buffers { params: uniform, samples, best, .. } = &self.buffers;
        let controls = &group.controls;
        let storage = [&controls.controls, &controls.centers, &group.rows, &group.places, samples, best];
        let bind_group = self.gpu.bind(&pipeline, uniform, &storage);
        let count = params.row_count * params.columns;
        work.dispatch(&Dispatch {
            kernel,
            pipeline: &pipeline,
            bind_group: &bind_group,
            params: bytes_of(params),
            extent: Extent::Workgroups(count.div_ceil(WORKGROUP_SIZE)),
            units: count as usize,
        });
    }

    fn bind_project(&self, group: &TargetGroup) -> (Rc<Pipeline>, Rc<wgpu::BindGroup>) {
        let (pipeline, _) = self.gpu.pipelines.get(self.project_kernel(group));
        let Buffers { params, samples, best, .. } = &self.buffers;
        let controls = &group.controls;
        let storage = [samples, best, &controls.controls, &controls.centers, &group.nodes];
        let bind_group = self.gpu.bind(&pipeline, params, &storage);
        (pipeline, bind_group)
    }

    fn record_project(
        &self,
        work: &mut Work<'_>,
        kernel: Kernel,
        pipeline: &Pipeline,
        bind_group: &wgpu::BindGroup,
        params: &ProjectParams,
        [threads, units]: [usize; 2],
    ) {
        let extent = Extent::Workgroups((threads as u32).div_ceil(WORKGROUP_SIZE));
        let params = bytes_of(params);
        work.dispatch(&Dispatch { kernel, pipeline, bind_group, params, extent, units });
    }

    fn record_reduce(&self, work: &mut Work<'_>, count: u32) {
        let (pipeline, bind_group) = &self.reduce;
        work.dispatch(&Dispatch {
            kernel: Kernel::Reduce,
            pipeline,
            bind_group,
            params: bytes_of(&ReduceParams { sample_count: count, block_size: BLOCK_SIZE }),
            extent: Extent::Workgroups(count.div_ceil(BLOCK_SIZE)),
            units: count as usize,
        });
    }

    /// The frame and scale of A's samples in those of B's patches, as the kernel wants them.
    fn sample_params(&self, group: &SampleGroup) -> SampleParams {
        let rescale = self.target.scale / self.sampling.scale;
        let column = |axis: DVec3| rounded((rescale * self.transform.rotate(axis)).extend(0.0));
        SampleParams {
            rotation_x: column(DVec3::X),
            rotation_y: column(DVec3::Y),
            rotation_z: column(DVec3::Z),
            translation: rounded((self.target.scale * self.offset()).extend(0.0)),
            first_row: 0,
            row_count: group.row_count,
            columns: group.columns,
            padding: 0,
        }
    }

    fn offset(&self) -> DVec3 {
        self.transform.apply(self.sampling.origin) - self.target.origin
    }

    /// Stage `sample` on page `index` up to a submission that is left open.
    async fn sampled(&self, index: usize) -> Result<Work<'_>> {
        let mut work = Work::new(&self.gpu, &self.buffers.params);
        for group in &self.sampling.pages[index] {
            work.make_room().await?;
            self.record_sample(&mut work, group, &self.sample_params(group));
        }
        Ok(work)
    }

    /// Stage `sample` alone, for `benches`.
    #[cfg(all(feature = "internals", not(target_arch = "wasm32")))]
    pub(super) async fn sample(&self, index: usize) -> Result<()> {
        self.sampled(index).await?.submit().await
    }

    /// The kernels of stage `project`, for `benches`.
    #[cfg(all(feature = "internals", not(target_arch = "wasm32")))]
    pub(super) fn project_kernels(&self) -> Vec<Kernel> {
        let mut kernels: Vec<Kernel> = Vec::new();
        for group in &self.target.groups {
            let kernel = self.project_kernel(group);
            if !kernels.contains(&kernel) {
                kernels.push(kernel);
            }
        }
        kernels
    }

    /// `Best.s` of the page as the kernel wrote it, for `benches`.
    #[cfg(all(feature = "internals", not(target_arch = "wasm32")))]
    pub(super) async fn written(&self) -> Result<Vec<f32>> {
        let work = Work::new(&self.gpu, &self.buffers.params);
        let bytes = (self.page.len() * size_of::<Best>()) as u64;
        let best = work.read(&self.buffers.best, &self.buffers.readable, bytes).await?;
        let best: Vec<Best> = bytemuck::pod_collect_to_vec(&best);
        Ok(best.iter().map(|best| best.s).collect())
    }

    fn projected(&self, best: &Best) -> Projected {
        let place = best.patch_and_status & ((1 << STATUS_SHIFT) - 1);
        let scaled = f64::from(best.distance_squared);
        // What is no number or beyond float32 is for float64 to decide.
        let known = best.distance_squared < FARTHEST;
        Projected {
            distance_squared: if known {
                scaled / self.target.scale / self.target.scale
            } else {
                f64::INFINITY
            },
            patch: self.target.patches.get(place as usize).map_or(0, |&patch| patch as usize),
            parameters: [best.s, best.t].map(|parameter| f64::from(parameter).clamp(0.0, 1.0)),
            status: Status::from_code(best.patch_and_status >> STATUS_SHIFT),
        }
    }

    pub(crate) fn distance_error(&self) -> f64 {
        let moved = self.sampling.radius + self.offset().length() + self.target.radius;
        self.sampling.coordinate_error + self.target.coordinate_error + ROUNDINGS * ROUNDING * moved
    }

    pub(crate) async fn project(
        &mut self,
        index: usize,
        page: &Range<usize>,
        progress: &mut Progress<'_>,
    ) -> Result<()> {
        progress.checkpoint(0.0).await?;
        self.page = page.clone();
        let mut work = self.sampled(index).await?;
        for (index, group) in self.target.groups.iter().enumerate() {
            let kernel = self.project_kernel(group);
            let (pipeline, bind_group) = self.bind_project(group);
            let columns = self.sampling.samples;
            let mut plan = Plan::new(page.len(), columns, group.count, group.degree, &self.rule_on(group));
            while let Some((params, size)) = plan.next(self.gpu.pace.chunk(kernel)) {
                if work.make_room().await? {
                    let of_group = plan.fraction_before();
                    let groups = self.target.groups.len() as f64;
                    progress.checkpoint((index as f64 + of_group) / groups).await?;
                }
                let params = ProjectParams {
                    patches_before: group.patches_before as u32,
                    iterations: self.rule.iterations,
                    step_tolerance: (self.rule.step_tolerance * self.target.scale) as f32,
                    ..params
                };
                self.record_project(&mut work, kernel, &pipeline, &bind_group, &params, size);
            }
        }
        work.submit().await
    }

    pub(crate) async fn reduce(&mut self) -> Result<Vec<Candidate>> {
        let count = self.page.len() as u32;
        let mut work = Work::new(&self.gpu, &self.buffers.params);
        self.record_reduce(&mut work, count);
        let bytes = blocks_of(u64::from(count)) * size_of::<Block>() as u64;
        let blocks = work.read(&self.buffers.blocks, &self.buffers.readable, bytes).await?;
        let blocks: Vec<Block> = bytemuck::pod_collect_to_vec(&blocks);
        self.statuses = StatusCounts::default();
        let mut candidates = Vec::with_capacity(blocks.len());
        for block in &blocks {
            self.statuses += StatusCounts {
                converged: block.converged as usize,
                iteration_limit: block.iteration_limit as usize,
                on_edge: block.on_edge as usize,
            };
            let sample = self.page.start + (block.sample as usize).min(self.page.len() - 1);
            candidates.push(Candidate { sample, projected: self.projected(&block.best) });
        }
        candidates.sort_by(|a, b| b.projected.distance_squared.total_cmp(&a.projected.distance_squared));
        Ok(candidates)
    }

    pub(crate) fn settle(&mut self, sample: usize, distance_squared: f64) {
        let scaled = distance_squared * self.target.scale * self.target.scale;
        // Never above the exact value, so that the sample is not taken for farther than it is.
        let below = rounded_down(scaled);
        let offset = ((sample - self.page.start) * size_of::<Best>()) as u64;
        self.gpu.queue.write_buffer(&self.buffers.best, offset, bytes_of(&below));
    }

    pub(crate) fn statuses(&self) -> StatusCounts {
        self.statuses
    }

    pub(crate) async fn field(&self) -> Result<Vec<Projected>> {
        let work = Work::new(&self.gpu, &self.buffers.params);
        let bytes = (self.page.len() * size_of::<Best>()) as u64;
        let best = work.read(&self.buffers.best, &self.buffers.readable, bytes).await?;
        let best: Vec<Best> = bytemuck::pod_collect_to_vec(&best);
        Ok(best.iter().map(|best| self.projected(best)).collect())
    }
}

fn blocks_of(samples: u64) -> u64 {
    samples.div_ceil(u64::from(BLOCK_SIZE))
}
