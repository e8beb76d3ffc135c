//! Method `hierarchy` on the GPU: stages `boxes` and `pyramid` once, then
//! `bound`, `extremes` and `cull` on every level, then `farthest`.

mod grid_tree;
pub(crate) mod kernels;
pub(crate) mod layouts;

pub(crate) use grid_tree::GpuGridTree;

use super::Gpu;
use super::float32::{UNKNOWN_DISTANCE, motion_error, normalizing_power, round, round_up};
use super::kernel::{Kernel, WORKGROUP_SIZE};
use super::submission::{Dispatch, Extent, Submission};
use crate::error::Result;
use crate::hierarchy::{BRANCHING, DistanceBounds, LevelBounds};
use crate::model::RigidTransform;
use crate::progress::Progress;
use bytemuck::{Zeroable, bytes_of};
use glam::DVec3;
use grid_tree::PartGroup;
use layouts::{
    Bound, Box, BoxesParams, Farthest, PHASE_CELL, PHASE_DISTANCE, PHASE_PARTNER, StageParams, Totals,
};
use std::sync::Arc;
use web_time::Instant;

/// Bytes of a pair of node indices.
const PAIR_BYTES: u64 = 2 * size_of::<u32>() as u64;

/// Bytes of the largest element of a storage buffer, the least size that every binding accepts.
const MAX_ELEMENT_BYTES: u64 = size_of::<Box>() as u64;

/// The position of A in the frame of B, to which both models are moved.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placement {
    /// Moves A.
    pub(crate) transform: RigidTransform,
    /// Upper bound on the rounding error of coordinates in float64.
    pub(crate) coordinate_error: f64,
}

/// One direction of method `hierarchy` on the GPU, at one level of the descent.
pub(crate) struct GpuHierarchy {
    gpu: Arc<Gpu>,
    /// The trees of A and B, and the boxes of every level.
    pub(crate) trees: [Arc<GpuGridTree>; 2],
    pub(crate) boxes: [Vec<wgpu::Buffer>; 2],
    params: wgpu::Buffer,
    readable: wgpu::Buffer,
    /// The pairs of the level that may contain the distance.
    pairs: wgpu::Buffer,
    pair_count: usize,
    bounds: wgpu::Buffer,
    totals: wgpu::Buffer,
    level: usize,
    /// The factor of lengths on the GPU.
    pub(crate) scale: f64,
    compile_seconds: f64,
}

/// A kernel on items 0 to `count`, dispatched in chunks.
struct ChunkedDispatch<'a> {
    kernel: Kernel,
    storage: Vec<&'a wgpu::Buffer>,
    /// The params, whose first two numbers are a chunk's first item and end.
    params: Vec<u8>,
    count: usize,
}

impl<'a> ChunkedDispatch<'a> {
    fn new(kernel: Kernel, storage: &[&'a wgpu::Buffer], params: &[u8], count: usize) -> Self {
        Self { kernel, storage: storage.to_vec(), params: params.to_vec(), count }
    }
}

impl GpuHierarchy {
    /// Makes all pipelines and the boxes of both models, stages `boxes` and
    /// `pyramid`, and starts at the pair of roots.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`],
    /// [`crate::Error::Cancelled`].
    pub(crate) async fn new(
        gpu: &Arc<Gpu>,
        trees: [Arc<GpuGridTree>; 2],
        placement: &Placement,
        progress: &mut Progress<'_>,
    ) -> Result<Self> {
        gpu.check()?;
        let [a, b] = &trees;
        let offset = placement.transform.apply(a.origin) - b.origin;
        let largest = a.radius + offset.length() + b.radius;
        let scale = normalizing_power(largest);
        let margin = round_up(scale * (placement.coordinate_error + motion_error(largest)));
        let boxes_params = |tree: &GpuGridTree, transform: &RigidTransform, offset: DVec3| {
            let rescale = scale / tree.scale;
            let column = |axis: DVec3| round((rescale * transform.rotate(axis)).extend(0.0));
            BoxesParams {
                rotation_x: column(DVec3::X),
                rotation_y: column(DVec3::Y),
                rotation_z: column(DVec3::Z),
                translation: round((scale * offset).extend(0.0)),
                rescale: round_up(rescale),
                margin,
                ..Zeroable::zeroed()
            }
        };
        let boxes_params = [
            boxes_params(a, &placement.transform, offset),
            boxes_params(b, &RigidTransform::IDENTITY, DVec3::ZERO),
        ];
        let boxes = |tree: &GpuGridTree| {
            let level = |&count: &usize| gpu.storage("boxes", (count * size_of::<Box>()) as u64);
            tree.counts.iter().map(level).collect()
        };
        let mut hierarchy = Self {
            boxes: [boxes(a), boxes(b)],
            params: gpu.params_buffer(),
            readable: gpu.readable("readable", size_of::<Totals>() as u64),
            pairs: gpu.upload("pairs", &[[0_u32; 2]]),
            pair_count: 1,
            bounds: gpu.storage("bounds", 0),
            totals: gpu.storage("totals", 0),
            level: 0,
            scale,
            compile_seconds: 0.0,
            gpu: Arc::clone(gpu),
            trees,
        };
        hierarchy.compile().await?;
        hierarchy.run(&hierarchy.box_dispatches(&boxes_params), progress, [0.0, 0.0]).await?;
        Ok(hierarchy)
    }

    /// Seconds spent on making new pipelines, the driver's compilation included.
    pub(crate) fn compile_seconds(&self) -> f64 {
        self.compile_seconds
    }

    /// Makes the pipelines and runs every new one without items, since drivers
    /// compile at first use.
    async fn compile(&mut self) -> Result<()> {
        let started = Instant::now();
        let mut kernels = vec![
            kernels::pyramid(),
            kernels::bound(),
            kernels::extremes(),
            kernels::cull(),
            kernels::farthest(),
        ];
        for group in self.trees.iter().flat_map(|tree| &tree.groups) {
            let kernel = kernels::boxes(group.degree);
            if !kernels.contains(&kernel) {
                kernels.push(kernel);
            }
        }
        kernels.retain(|&kernel| self.gpu.pipelines.get(kernel).1);
        if kernels.is_empty() {
            return Ok(());
        }
        let mut submission = Submission::new(&self.gpu, &self.params);
        for kernel in kernels {
            let buffers: Vec<_> =
                kernel.storage.iter().map(|_| self.gpu.storage("empty", MAX_ELEMENT_BYTES)).collect();
            let buffers: Vec<&wgpu::Buffer> = buffers.iter().collect();
            self.record(&mut submission, kernel, &buffers, &vec![0; kernel.params_bytes], 0);
        }
        submission.submit().await?;
        self.compile_seconds = started.elapsed().as_secs_f64();
        Ok(())
    }

    fn record(
        &self,
        submission: &mut Submission<'_>,
        kernel: Kernel,
        storage: &[&wgpu::Buffer],
        params: &[u8],
        units: usize,
    ) {
        let (pipeline, _) = self.gpu.pipelines.get(kernel);
        let bind_group = self.gpu.bind(&pipeline, &self.params, storage);
        let workgroups = (units as u32).div_ceil(WORKGROUP_SIZE);
        submission.dispatch(&Dispatch {
            kernel,
            pipeline: &pipeline,
            bind_group: &bind_group,
            params,
            extent: Extent::Workgroups(workgroups),
            units,
        });
    }

    /// Runs the dispatches in order, in submissions of bounded duration. They
    /// fill `[start, start + length]` of the progress.
    async fn run(
        &self,
        dispatches: &[ChunkedDispatch<'_>],
        progress: &mut Progress<'_>,
        [start, length]: [f64; 2],
    ) -> Result<()> {
        let mut submission = Submission::new(&self.gpu, &self.params);
        for (index, dispatch) in dispatches.iter().enumerate() {
            let mut first = 0;
            while first < dispatch.count {
                if submission.submit_if_full().await? {
                    let done = index as f64 + first as f64 / dispatch.count as f64;
                    progress.checkpoint(start + length * done / dispatches.len() as f64).await?;
                }
                let units = self.gpu.throughput.chunk(dispatch.kernel).min(dispatch.count - first);
                let mut params = dispatch.params.clone();
                params[..8].copy_from_slice(bytes_of(&[first as u32, (first + units) as u32]));
                self.record(&mut submission, dispatch.kernel, &dispatch.storage, &params, units);
                first += units;
            }
        }
        submission.submit().await
    }

    /// The dispatches of stages `boxes` and `pyramid` for both models.
    fn box_dispatches(&self, boxes_params: &[BoxesParams; 2]) -> Vec<ChunkedDispatch<'_>> {
        let mut dispatches = Vec::new();
        for ((tree, boxes), params) in self.trees.iter().zip(&self.boxes).zip(boxes_params) {
            let parts_level = boxes.len() - 1;
            for PartGroup { degree, count, controls, parts } in &tree.groups {
                let storage = [&controls.controls, &controls.centers, parts, &boxes[parts_level]];
                let kernel = kernels::boxes(*degree);
                dispatches.push(ChunkedDispatch::new(kernel, &storage, bytes_of(params), *count));
            }
            for level in (0..parts_level).rev() {
                let storage = [&tree.levels[level], &boxes[level + 1], &boxes[level]];
                let (params, count) = (StageParams::zeroed(), tree.counts[level]);
                let kernel = kernels::pyramid();
                dispatches.push(ChunkedDispatch::new(kernel, &storage, bytes_of(&params), count));
            }
        }
        dispatches
    }

    /// The level of the tree of model `index` that is used on `level` of the
    /// descent. The model with fewer levels stays at its root at first.
    fn tree_level(&self, index: usize, level: usize) -> usize {
        (level + self.trees[index].finest).saturating_sub(self.levels())
    }

    /// The nodes of the current level, with their children on the next.
    fn nodes(&self, index: usize) -> &wgpu::Buffer {
        let level = self.tree_level(index, self.level);
        let tree = &self.trees[index];
        if level == self.tree_level(index, self.level + 1) { &tree.root } else { &tree.levels[level] }
    }

    /// Reads the first three numbers of a buffer.
    async fn read(&self, from: &wgpu::Buffer) -> Result<[u32; 3]> {
        let bytes = size_of::<[u32; 3]>() as u64;
        let submission = Submission::new(&self.gpu, &self.params);
        let content = submission.read(from, &self.readable, bytes).await?;
        Ok(bytemuck::pod_read_unaligned(&content))
    }

    /// The number of levels below the roots.
    pub(crate) fn levels(&self) -> usize {
        self.trees[0].finest.max(self.trees[1].finest)
    }

    /// Stages `bound`, `extremes` and `cull` on the next level. The descent
    /// advances to that level if no more than `max_pairs` pairs are left.
    ///
    /// # Errors
    /// As [`GpuHierarchy::new`].
    pub(crate) async fn descend(
        &mut self,
        max_pairs: usize,
        progress: &mut Progress<'_>,
    ) -> Result<LevelBounds> {
        let [a, b] = [0, 1].map(|index| &self.boxes[index][self.tree_level(index, self.level + 1)]);
        let [nodes_a, nodes_b] = [0, 1].map(|index| self.nodes(index));
        let nodes = self.trees[0].counts[self.tree_level(0, self.level + 1)];
        let bounds = self.gpu.storage("bounds", (nodes * size_of::<Bound>()) as u64);
        let totals = self.gpu.storage("totals", size_of::<Totals>() as u64);
        let capacity = max_pairs.min(self.pair_count * BRANCHING * BRANCHING);
        let next_pairs = self.gpu.storage("pairs", capacity as u64 * PAIR_BYTES);
        let storage = [&self.pairs, nodes_a, nodes_b, a, b, &bounds, &totals, &next_pairs];
        let params = StageParams { capacity: capacity as u32, ..Zeroable::zeroed() };
        let params = bytes_of(&params);
        let dispatches = [
            ChunkedDispatch::new(kernels::bound(), &storage[..6], params, self.pair_count),
            ChunkedDispatch::new(kernels::extremes(), &storage[5..7], params, nodes),
            ChunkedDispatch::new(kernels::cull(), &storage, params, self.pair_count),
        ];
        self.run(&dispatches, progress, [0.0, 1.0]).await?;
        let Totals { near, far, pairs } = bytemuck::cast(self.read(&totals).await?);
        let squared = |bits: u32| f64::from(f32::from_bits(bits)) / self.scale / self.scale;
        let far = if f32::from_bits(far) < UNKNOWN_DISTANCE { squared(far) } else { f64::INFINITY };
        if pairs as usize <= max_pairs {
            self.pairs = next_pairs;
            self.pair_count = pairs as usize;
            self.bounds = bounds;
            self.totals = totals;
            self.level += 1;
        }
        Ok(LevelBounds::new(u64::from(pairs), DistanceBounds { near: squared(near), far }))
    }

    /// Stage `farthest` on the last level: returns the cell of A that is
    /// farthest from B by its lower bound, and a cell of B near it.
    ///
    /// # Errors
    /// As [`GpuHierarchy::new`].
    pub(crate) async fn farthest(&self, progress: &mut Progress<'_>) -> Result<[usize; 2]> {
        let found = self.gpu.storage("farthest", size_of::<Farthest>() as u64);
        let levels = [0, 1].map(|index| self.trees[index].finest);
        let [boxes_a, boxes_b] = [0, 1].map(|index| &self.boxes[index][levels[index]]);
        let storage = [&self.bounds, &self.totals, &self.pairs, boxes_a, boxes_b, &found];
        let counts = [0, 1].map(|index| self.trees[index].counts[levels[index]]);
        let phases =
            [(PHASE_CELL, counts[0]), (PHASE_DISTANCE, self.pair_count), (PHASE_PARTNER, self.pair_count)];
        let dispatches = phases.map(|(phase, count)| {
            let params = StageParams { phase, ..Zeroable::zeroed() };
            ChunkedDispatch::new(kernels::farthest(), &storage, bytes_of(&params), count)
        });
        self.run(&dispatches, progress, [1.0, 0.0]).await?;
        let Farthest { a, b, .. } = bytemuck::cast(self.read(&found).await?);
        let cell = |complement: u32, index: usize| (!complement as usize).min(counts[index] - 1);
        Ok([cell(a, 0), cell(b, 1)])
    }
}
