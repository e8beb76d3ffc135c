//! Closest points of many points on the GPU: stages `locate` and `bound_others`.

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

pub(crate) mod kernels;
pub(crate) mod layouts;
mod subpatches;
mod target;

pub(crate) use target::GpuPointTarget;

use super::Gpu;
use super::float32::{UNIT_ROUNDOFF, UNKNOWN_DISTANCE, round};
use super::kernel::{Kernel, Pipeline, WORKGROUP_SIZE};
use super::submission::{Dispatch, Extent, Submission};
use super::target::GpuTarget;
use crate::closest::Located;
use crate::error::Result;
use crate::rounding::gamma;
use bytemuck::{Zeroable, bytes_of};
use glam::DVec3;
use layouts::LocateParams;
use std::sync::Arc;

/// The largest number of Newton steps on a patch; on a flat one about five suffice.
const MAX_ITERATIONS: u32 = 16;

/// Coordinates of a point beyond this, in units of the model's size, are not measured in float32, where their squares
/// might overflow.
const MAX_COORDINATE: f64 = (1_u64 << 40) as f64;

/// The roundings in float64 of a point relative to the origin, and of its difference from its copy.
const COPY_ROUNDINGS: f64 = 8.0;

/// The roundings in float32 of a copy's difference from a centre: one, and the snapping of centres to their grid.
const LOCAL_ROUNDINGS: f64 = 1.01;

/// The roundings of boxes and squared distances in the kernel, relative to a distance. The kernel bounds each subpatch that
/// is not farther than the foot by these. They are part of no bound.
const EXPECTED_ROUNDINGS: f64 = 8.0;

/// Both kernels on one target, with the buffers of a page.
pub(crate) struct GpuPoints {
    gpu: Arc<Gpu>,
    target: Arc<GpuPointTarget>,
    /// The excess of a distance that is permitted.
    gap: f64,
    /// The largest number of Newton steps on a subpatch.
    iterations: u32,
    params: wgpu::Buffer,
    points: wgpu::Buffer,
    located: wgpu::Buffer,
    readable: wgpu::Buffer,
}

/// The kernel of a stage on one group, with its buffers.
struct BoundKernel {
    kernel: Kernel,
    pipeline: Arc<Pipeline>,
    bind_group: Arc<wgpu::BindGroup>,
}

impl GpuPoints {
    /// Makes the buffers for this many points, and all pipelines. `None` of a target that float32 cannot bound.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`].
    pub(crate) async fn new(
        gpu: &Arc<Gpu>,
        target: Arc<GpuPointTarget>,
        gap: f64,
        capacity: usize,
    ) -> Result<Option<Self>> {
        if !target.error.is_finite() {
            return Ok(None);
        }
        gpu.check()?;
        let located_bytes = (capacity * size_of::<layouts::Located>()) as u64;
        let stage = Self {
            gpu: Arc::clone(gpu),
            target,
            gap,
            iterations: MAX_ITERATIONS,
            params: gpu.params_buffer(),
            points: gpu.storage("points", (capacity * size_of::<[f32; 4]>()) as u64),
            located: gpu.storage("located", located_bytes),
            readable: gpu.readable("readable", located_bytes),
        };
        stage.compile().await?;
        Ok(Some(stage))
    }

    /// Makes the pipelines and runs every new one without points, since drivers compile at first use.
    async fn compile(&self) -> Result<()> {
        let mut submission = Submission::new(&self.gpu, &self.params);
        let mut is_new = false;
        for (index, group) in self.target.subpatches.groups.iter().enumerate() {
            for kernel in [kernels::locate(group.degree), kernels::bound_others(group.degree)] {
                if self.gpu.pipelines.get(kernel).1 {
                    is_new = true;
                    record(&mut submission, &self.bind(kernel, index), &Zeroable::zeroed());
                }
            }
        }
        if is_new { submission.submit().await } else { Ok(()) }
    }

    fn bind(&self, kernel: Kernel, index: usize) -> BoundKernel {
        let (group, owners) = (&self.target.subpatches.groups[index], &self.target.owners[index]);
        let (pipeline, _) = self.gpu.pipelines.get(kernel);
        let controls = &group.controls;
        let storage =
            [&self.points, &self.located, &controls.controls, &controls.centers, &group.nodes, owners];
        let bind_group = self.gpu.bind(&pipeline, &self.params, &storage);
        BoundKernel { kernel, pipeline, bind_group }
    }

    /// Returns a foot of each point, and lower bounds on the distances to its patch and to all others (lemma P4 of
    /// docs/points.md); at most as many points as the capacity.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`].
    pub(crate) async fn locate(&self, points: &[DVec3]) -> Result<Vec<Located>> {
        let copies: Vec<Copy> = points.iter().map(|&point| Copy::new(point, &self.target)).collect();
        let found = self.run(&copies).await?;
        Ok(found.iter().zip(&copies).map(|(found, copy)| self.unpacked(found, copy)).collect())
    }

    /// Runs the kernel, and returns what it wrote.
    async fn run(&self, points: &[Copy]) -> Result<Vec<layouts::Located>> {
        let coordinates: Vec<[f32; 4]> = points.iter().map(|copy| copy.coordinates).collect();
        self.gpu.queue.write_buffer(&self.points, 0, bytemuck::cast_slice(&coordinates));
        let mut submission = Submission::new(&self.gpu, &self.params);
        for stage in [kernels::locate, kernels::bound_others] {
            for (index, group) in self.target.subpatches.groups.iter().enumerate() {
                let bound = self.bind(stage(group.degree), index);
                let mut first = 0;
                while first < points.len() {
                    submission.submit_if_full().await?;
                    let chunk =
                        self.gpu.throughput.chunk(bound.kernel).next_multiple_of(WORKGROUP_SIZE as usize);
                    let end = (first + chunk).min(points.len());
                    let params = LocateParams {
                        first_point: first as u32,
                        end_point: end as u32,
                        patches_before: group.patches_before as u32,
                        iterations: self.iterations,
                        permitted: self.permitted(),
                    };
                    record(&mut submission, &bound, &params);
                    first = end;
                }
            }
        }
        let bytes = (points.len() * size_of::<layouts::Located>()) as u64;
        let found = submission.read(&self.located, &self.readable, bytes).await?;
        Ok(bytemuck::pod_collect_to_vec(&found))
    }

    /// What the distance to a patch may lack of that to the foot and still be enough, scaled: the gap less what a bound
    /// loses afterwards.
    fn permitted(&self) -> f32 {
        let GpuTarget { scale, radius, .. } = self.target.subpatches;
        (scale * (self.gap - self.target.error) - EXPECTED_ROUNDINGS * UNIT_ROUNDOFF * scale * radius) as f32
    }

    fn unpacked(&self, found: &layouts::Located, copy: &Copy) -> Located {
        let lower = |squared: f32| f64::from(squared).sqrt() / self.target.subpatches.scale - copy.error;
        let domain = self.target.domains.get(found.foot.patch());
        // Neither a NaN, nor an index out of range, nor bounds beside another patch are trusted.
        let is_of_owner = domain.is_some_and(|domain| domain.patch == found.owner);
        let is_known = found.foot.distance_squared < UNKNOWN_DISTANCE && is_of_owner;
        let bound =
            |squared: f32| if is_known && squared >= 0.0 { lower(squared) } else { f64::NEG_INFINITY };
        let parameter = |found: f32| if (0.0..=1.0).contains(&found) { f64::from(found) } else { 0.5 };
        let parameters = [found.foot.s, found.foot.t].map(parameter);
        Located {
            patch: domain.map_or(0, |domain| domain.patch),
            parameters: domain.map_or(parameters, |domain| domain.patch_parameters(parameters)),
            own: bound(found.own),
            others: bound(found.others),
        }
    }
}

/// Records one dispatch.
fn record(
    submission: &mut Submission<'_>,
    BoundKernel { kernel, pipeline, bind_group }: &BoundKernel,
    params: &LocateParams,
) {
    let count = params.end_point - params.first_point;
    submission.dispatch(&Dispatch {
        kernel: *kernel,
        pipeline,
        bind_group,
        params: bytes_of(params),
        extent: Extent::Workgroups(count.div_ceil(WORKGROUP_SIZE)),
        units: count as usize,
    });
}

/// A point as the kernels measure it.
struct Copy {
    coordinates: [f32; 4],
    /// Upper bound on the difference between the distances of the point and of its copy to a patch, as the kernel has
    /// them relative to the patch's centre, in model units.
    error: f64,
}

impl Copy {
    /// The copy relative to the target's origin. Its rounding is known; that of its difference from a centre is u of the
    /// difference, whose length is at most that of the copy and the radius.
    fn new(point: DVec3, target: &GpuPointTarget) -> Self {
        let (error, target) = (target.error, &target.subpatches);
        let scaled = target.scale * (point - target.origin);
        if !(scaled.abs().max_element() <= MAX_COORDINATE) {
            return Self { coordinates: [0.0; 4], error: f64::INFINITY };
        }
        let coordinates = round(scaled.extend(0.0));
        let distance = scaled.length() / target.scale;
        let rounded = DVec3::from_slice(&coordinates.map(f64::from)).distance(scaled) / target.scale;
        let error = error + rounded + gamma(COPY_ROUNDINGS) * distance;
        Self { coordinates, error: error + LOCAL_ROUNDINGS * UNIT_ROUNDOFF * (distance + target.radius) }
    }
}
