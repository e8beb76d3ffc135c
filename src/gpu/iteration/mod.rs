//! Method `iteration` on the GPU: stages `sample`, `project` and `reduce`, page by page.

pub(crate) mod kernels;
pub(crate) mod layouts;
mod sampling;
mod schedule;

pub(crate) use sampling::GpuSampling;

use super::Gpu;
use super::float32::{UNKNOWN_DISTANCE, motion_error, round, round_down};
use super::kernel::{Kernel, Pipeline, WORKGROUP_SIZE};
use super::submission::{Dispatch, Extent, Submission};
use super::target::{GpuTarget, TargetGroup};
use crate::error::Result;
use crate::iteration::{BLOCK_SIZE, Candidate, Culling, Projected, Rule, StatusCounts};
use crate::model::RigidTransform;
use crate::progress::Progress;
use crate::sorting::sort_by_number;
use bytemuck::{Zeroable, bytes_of};
use glam::DVec3;
use layouts::{Block, ProjectParams, ReduceParams, SampleParams};
use sampling::SampleGroup;
use schedule::Schedule;
use std::ops::Range;
use std::sync::Arc;
use web_time::Instant;

/// One direction of method `iteration` on the GPU, with the results of one page.
pub(crate) struct GpuIteration {
    gpu: Arc<Gpu>,
    sampling: Arc<GpuSampling>,
    target: Arc<GpuTarget>,
    transform: RigidTransform,
    rule: Rule,
    buffers: Buffers,
    reduce: BoundKernel,
    /// The samples of the page projected last.
    page: Range<usize>,
    statuses: StatusCounts,
    compile_seconds: f64,
}

/// Buffers for the largest page.
struct Buffers {
    params: wgpu::Buffer,
    samples: wgpu::Buffer,
    projected: wgpu::Buffer,
    blocks: wgpu::Buffer,
    readable: wgpu::Buffer,
}

/// A kernel with its buffers.
struct BoundKernel {
    kernel: Kernel,
    pipeline: Arc<Pipeline>,
    bind_group: Arc<wgpu::BindGroup>,
}

impl GpuIteration {
    /// Makes the buffers of a page and all pipelines.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`].
    pub(crate) async fn new(
        gpu: &Arc<Gpu>,
        sampling: Arc<GpuSampling>,
        target: Arc<GpuTarget>,
        transform: RigidTransform,
        rule: Rule,
    ) -> Result<Self> {
        gpu.check()?;
        let capacity = sampling.page_samples;
        let projected_bytes = capacity * size_of::<layouts::Projected>() as u64;
        let block_bytes = block_count(capacity) * size_of::<Block>() as u64;
        let buffers = Buffers {
            params: gpu.params_buffer(),
            samples: gpu.storage("samples", capacity * size_of::<[f32; 4]>() as u64),
            projected: gpu.storage("projected", projected_bytes),
            blocks: gpu.storage("blocks", block_bytes),
            readable: gpu.readable("readable", projected_bytes.max(block_bytes)),
        };
        let started = Instant::now();
        let kernel = kernels::reduce();
        let (pipeline, is_new) = gpu.pipelines.get(kernel);
        let bind_group = gpu.bind(&pipeline, &buffers.params, &[&buffers.projected, &buffers.blocks]);
        let mut stages = Self {
            gpu: Arc::clone(gpu),
            sampling,
            target,
            transform,
            rule,
            buffers,
            reduce: BoundKernel { kernel, pipeline, bind_group },
            page: 0..0,
            statuses: StatusCounts::default(),
            compile_seconds: 0.0,
        };
        if stages.compile(is_new).await? {
            stages.compile_seconds = started.elapsed().as_secs_f64();
        }
        Ok(stages)
    }

    /// Makes the pipelines and runs every new one without samples, since
    /// drivers compile at first use. Returns whether there was a new one.
    async fn compile(&self, mut is_new: bool) -> Result<bool> {
        let mut submission = Submission::new(&self.gpu, &self.buffers.params);
        for group in self.sampling.pages.iter().flatten() {
            if self.gpu.pipelines.get(kernels::sample(group.degree)).1 {
                is_new = true;
                let params = SampleParams { column_count: 1, ..Zeroable::zeroed() };
                self.record_sample(&mut submission, group, &params);
            }
        }
        for group in &self.target.groups {
            if self.gpu.pipelines.get(self.project_kernel(group)).1 {
                is_new = true;
                let bound = self.bind_project(group);
                self.record_project(&mut submission, &bound, &Zeroable::zeroed(), [0; 2]);
            }
        }
        if is_new {
            self.record_reduce(&mut submission, 0);
            submission.submit().await?;
        }
        Ok(is_new)
    }

    /// Seconds spent on making new pipelines, the driver's compilation included.
    pub(crate) fn compile_seconds(&self) -> f64 {
        self.compile_seconds
    }

    /// The culling of one group: a single patch needs no tree.
    fn culling(&self, group: &TargetGroup) -> Culling {
        if group.count == 1 { Culling::None } else { self.rule.culling }
    }

    fn project_kernel(&self, group: &TargetGroup) -> Kernel {
        kernels::project(group.degree, self.rule.projection, self.culling(group))
    }

    fn record_sample(&self, submission: &mut Submission<'_>, group: &SampleGroup, params: &SampleParams) {
        let kernel = kernels::sample(group.degree);
        let (pipeline, _) = self.gpu.pipelines.get(kernel);
        let Buffers { params: uniform, samples, projected, .. } = &self.buffers;
        let controls = &group.controls;
        let storage =
            [&controls.controls, &controls.centers, &group.rows, &group.columns, samples, projected];
        let bind_group = self.gpu.bind(&pipeline, uniform, &storage);
        let count = params.row_count * params.column_count;
        submission.dispatch(&Dispatch {
            kernel,
            pipeline: &pipeline,
            bind_group: &bind_group,
            params: bytes_of(params),
            extent: Extent::Workgroups(count.div_ceil(WORKGROUP_SIZE)),
            units: count as usize,
        });
    }

    fn bind_project(&self, group: &TargetGroup) -> BoundKernel {
        let kernel = self.project_kernel(group);
        let (pipeline, _) = self.gpu.pipelines.get(kernel);
        let Buffers { params, samples, projected, .. } = &self.buffers;
        let controls = &group.controls;
        let storage = [samples, projected, &controls.controls, &controls.centers, &group.nodes];
        let bind_group = self.gpu.bind(&pipeline, params, &storage);
        BoundKernel { kernel, pipeline, bind_group }
    }

    fn record_project(
        &self,
        submission: &mut Submission<'_>,
        BoundKernel { kernel, pipeline, bind_group }: &BoundKernel,
        params: &ProjectParams,
        [threads, units]: [usize; 2],
    ) {
        let extent = Extent::Workgroups((threads as u32).div_ceil(WORKGROUP_SIZE));
        let params = bytes_of(params);
        submission.dispatch(&Dispatch { kernel: *kernel, pipeline, bind_group, params, extent, units });
    }

    fn record_reduce(&self, submission: &mut Submission<'_>, count: u32) {
        let BoundKernel { kernel, pipeline, bind_group } = &self.reduce;
        submission.dispatch(&Dispatch {
            kernel: *kernel,
            pipeline,
            bind_group,
            params: bytes_of(&ReduceParams { sample_count: count }),
            extent: Extent::Workgroups(count.div_ceil(BLOCK_SIZE as u32)),
            units: count as usize,
        });
    }

    /// The motion from A's frame and scale on the GPU into B's.
    fn sample_params(&self, group: &SampleGroup) -> SampleParams {
        let rescale = self.target.scale / self.sampling.scale;
        let column = |axis: DVec3| round((rescale * self.transform.rotate(axis)).extend(0.0));
        SampleParams {
            rotation_x: column(DVec3::X),
            rotation_y: column(DVec3::Y),
            rotation_z: column(DVec3::Z),
            translation: round((self.target.scale * self.offset()).extend(0.0)),
            row_count: group.row_count,
            column_count: group.column_count,
            padding: [0; 2],
        }
    }

    /// A's moved origin relative to B's.
    fn offset(&self) -> DVec3 {
        self.transform.apply(self.sampling.origin) - self.target.origin
    }

    /// Records stage `sample` of a page in a submission that is left open.
    async fn sampled(&self, page: usize) -> Result<Submission<'_>> {
        let mut submission = Submission::new(&self.gpu, &self.buffers.params);
        for group in &self.sampling.pages[page] {
            submission.submit_if_full().await?;
            self.record_sample(&mut submission, group, &self.sample_params(group));
        }
        Ok(submission)
    }

    /// Samples and projects page `index`, which holds the samples `page`.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`],
    /// [`crate::Error::Cancelled`].
    pub(crate) async fn project(
        &mut self,
        index: usize,
        page: &Range<usize>,
        progress: &mut Progress<'_>,
    ) -> Result<()> {
        progress.checkpoint(0.0).await?;
        self.page = page.clone();
        let mut submission = self.sampled(index).await?;
        let group_count = self.target.groups.len() as f64;
        for (index, group) in self.target.groups.iter().enumerate() {
            let bound = self.bind_project(group);
            let columns = self.sampling.columns;
            let mut schedule = Schedule::new(page.len(), columns, group.count, self.culling(group));
            while let Some((params, size)) = schedule.next(self.gpu.throughput.chunk(bound.kernel)) {
                if submission.submit_if_full().await? {
                    progress.checkpoint((index as f64 + schedule.fraction_done()) / group_count).await?;
                }
                let params = ProjectParams {
                    patches_before: group.patches_before as u32,
                    iterations: self.rule.iterations,
                    step_tolerance: (self.rule.step_tolerance * self.target.scale) as f32,
                    ..params
                };
                self.record_project(&mut submission, &bound, &params, size);
            }
        }
        submission.submit().await
    }

    /// Returns the farthest sample of every block of the page, farthest first.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`].
    pub(crate) async fn reduce(&mut self) -> Result<Vec<Candidate>> {
        let count = self.page.len() as u32;
        let mut submission = Submission::new(&self.gpu, &self.buffers.params);
        self.record_reduce(&mut submission, count);
        let bytes = block_count(u64::from(count)) * size_of::<Block>() as u64;
        let blocks = submission.read(&self.buffers.blocks, &self.buffers.readable, bytes).await?;
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
            candidates.push(Candidate { sample, projected: self.unpacked(&block.farthest) });
        }
        sort_by_number(&mut candidates, |candidate| -candidate.projected.distance_squared);
        Ok(candidates)
    }

    /// Replaces a sample's squared distance by one computed in float64.
    pub(crate) fn set_distance_squared(&mut self, sample: usize, distance_squared: f64) {
        // Rounded down, so that `reduce` does not rank the sample above its true distance.
        let scaled = round_down(distance_squared * self.target.scale * self.target.scale);
        let offset = ((sample - self.page.start) * size_of::<layouts::Projected>()) as u64;
        self.gpu.queue.write_buffer(&self.buffers.projected, offset, bytes_of(&scaled));
    }

    /// The numbers of the page's samples by the status of their projection.
    pub(crate) fn statuses(&self) -> StatusCounts {
        self.statuses
    }

    /// Returns all projections of the page.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`].
    pub(crate) async fn field(&self) -> Result<Vec<Projected>> {
        Ok(self.read_projected().await?.iter().map(|projected| self.unpacked(projected)).collect())
    }

    /// Upper bound on the error of a distance, in model units. The distance is
    /// that of the sample to a point of the target, so it may exceed the
    /// sample's distance to the target by more.
    pub(crate) fn distance_error(&self) -> f64 {
        let largest = self.sampling.radius + self.offset().length() + self.target.radius;
        self.sampling.coordinate_error + self.target.coordinate_error + motion_error(largest)
    }

    async fn read_projected(&self) -> Result<Vec<layouts::Projected>> {
        let submission = Submission::new(&self.gpu, &self.buffers.params);
        let bytes = (self.page.len() * size_of::<layouts::Projected>()) as u64;
        let projected = submission.read(&self.buffers.projected, &self.buffers.readable, bytes).await?;
        Ok(bytemuck::pod_collect_to_vec(&projected))
    }

    fn unpacked(&self, projected: &layouts::Projected) -> Projected {
        let scaled = f64::from(projected.distance_squared);
        // A NaN or a distance beyond float32 counts as +∞, which float64 then decides.
        let is_known = projected.distance_squared < UNKNOWN_DISTANCE;
        Projected {
            distance_squared: if is_known {
                scaled / self.target.scale / self.target.scale
            } else {
                f64::INFINITY
            },
            patch: self.target.patches.get(projected.patch()).map_or(0, |&patch| patch as usize),
            parameters: [projected.s, projected.t].map(|parameter| f64::from(parameter).clamp(0.0, 1.0)),
            status: projected.status(),
        }
    }
}

/// Access to single stages, for benchmarks.
#[cfg(all(feature = "internals", not(target_arch = "wasm32")))]
impl GpuIteration {
    /// Runs stage `sample` alone.
    pub(crate) async fn sample(&self, page: usize) -> Result<()> {
        self.sampled(page).await?.submit().await
    }

    /// The kernels of stage `project`.
    pub(crate) fn project_kernels(&self) -> Vec<Kernel> {
        let mut kernels: Vec<Kernel> = Vec::new();
        for group in &self.target.groups {
            let kernel = self.project_kernel(group);
            if !kernels.contains(&kernel) {
                kernels.push(kernel);
            }
        }
        kernels
    }

    /// Returns `Projected.s` of the page as the kernel wrote it.
    pub(crate) async fn written(&self) -> Result<Vec<f32>> {
        Ok(self.read_projected().await?.iter().map(|projected| projected.s).collect())
    }
}

/// The number of blocks of [`BLOCK_SIZE`] samples.
fn block_count(samples: u64) -> u64 {
    samples.div_ceil(BLOCK_SIZE as u64)
}
