//! The stages of method `hierarchy` on the GPU.

use super::Gpu;
use super::box_kernels::BoxKernel;
use super::box_layouts::{
    Bound, Box, BoxesParams, Farthest, OF_CELLS, OF_DISTANCES, OF_PARTNERS, StepParams, Totals,
};
use super::pipelines::{Kernel, WORKGROUP_SIZE};
use super::rounding::{ROUNDING, power_of_two_to_one, rounded, rounded_up};
use super::stages::ROUNDINGS;
use super::upload_cells::{GpuCells, PartGroup};
use super::work::{Dispatch, Extent, Work};
use crate::error::Result;
use crate::hierarchy::DistanceBounds;
use crate::hierarchy::LevelBounds;
use crate::model::RigidTransform;
use crate::progress::Progress;
use bytemuck::{Zeroable, bytes_of};
use glam::DVec3;
use std::rc::Rc;
use web_time::Instant;

/// Children of a node in a descent, at most.
const MAX_CHILDREN: usize = 4;

/// Bytes of a pair of indices.
const PAIR_BYTES: u64 = 8;

/// Bytes of the largest item of a storage buffer, which one must hold.
const MAX_ITEM: u64 = size_of::<Box>() as u64;

/// Squared distances from here on are beyond float32.
const FARTHEST: f32 = super::stages::FARTHEST;

/// The frame that both models are taken to.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame {
    /// Moves A.
    pub(crate) transform: RigidTransform,
    /// Room for the rounding of coordinates in float64.
    pub(crate) slack: f64,
}

/// One direction on the GPU, and the level in work.
pub(crate) struct GpuDescent {
    gpu: Rc<Gpu>,
    pub(super) sides: [Rc<GpuCells>; 2],
    pub(super) boxes: [Vec<wgpu::Buffer>; 2],
    params: wgpu::Buffer,
    readable: wgpu::Buffer,
    pairs: wgpu::Buffer,
    pair_count: usize,
    bounds: wgpu::Buffer,
    totals: wgpu::Buffer,
    level: usize,
    /// What lengths on the GPU are multiples of.
    pub(super) scale: f64,
    compile_seconds: f64,
}

/// A kernel to be run on 0 to `count` items, in chunks.
struct Step<'a> {
    kernel: Kernel,
    storage: Vec<&'a wgpu::Buffer>,
    /// Bytes of its params, which begin with a chunk's first item and end.
    params: Vec<u8>,
    count: usize,
}

impl<'a> Step<'a> {
    fn new(kernel: Kernel, storage: &[&'a wgpu::Buffer], params: &[u8], count: usize) -> Self {
        Self { kernel, storage: storage.to_vec(), params: params.to_vec(), count }
    }
}

impl GpuDescent {
    /// Makes every pipeline that the work wants, and the boxes of both models:
    /// stages `boxes` and `pyramid`.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`],
    /// [`crate::Error::Cancelled`].
    pub(crate) async fn new(
        gpu: &Rc<Gpu>,
        sides: [Rc<GpuCells>; 2],
        frame: &Frame,
        progress: &mut Progress<'_>,
    ) -> Result<Self> {
        gpu.check()?;
        let [a, b] = &sides;
        let offset = frame.transform.apply(a.origin) - b.origin;
        let moved = a.radius + offset.length() + b.radius;
        let scale = power_of_two_to_one(moved);
        let slack = rounded_up(scale * (frame.slack + ROUNDINGS * ROUNDING * moved));
        let placed = |cells: &GpuCells, transform: &RigidTransform, offset: DVec3| {
            let rescale = scale / cells.scale;
            let column = |axis: DVec3| rounded((rescale * transform.rotate(axis)).extend(0.0));
            BoxesParams {
                rotation_x: column(DVec3::X),
                rotation_y: column(DVec3::Y),
                rotation_z: column(DVec3::Z),
                translation: rounded((scale * offset).extend(0.0)),
                rescale: rounded_up(rescale),
                slack,
                ..Zeroable::zeroed()
            }
        };
        let placed = [placed(a, &frame.transform, offset), placed(b, &RigidTransform::IDENTITY, DVec3::ZERO)];
        let boxes = |cells: &GpuCells| {
            let level = |&count: &usize| gpu.storage("boxes", (count * size_of::<Box>()) as u64);
            cells.counts.iter().map(level).collect()
        };
        let mut descent = Self {
            boxes: [boxes(a), boxes(b)],
            params: gpu.params(),
            readable: gpu.readable("readable", size_of::<Totals>() as u64),
            pairs: gpu.upload("pairs", &[[0_u32; 2]]),
            pair_count: 1,
            bounds: gpu.storage("bounds", 0),
            totals: gpu.storage("totals", 0),
            level: 0,
            scale,
            compile_seconds: 0.0,
            gpu: Rc::clone(gpu),
            sides,
        };
        descent.compile().await?;
        descent.run(&descent.building(&placed), progress, [0.0, 0.0]).await?;
        Ok(descent)
    }

    /// Seconds that making new pipelines took, the driver's compilation included.
    pub(crate) fn compile_seconds(&self) -> f64 {
        self.compile_seconds
    }

    /// Makes the pipelines, and runs the new ones on nothing, which makes the
    /// driver compile them.
    async fn compile(&mut self) -> Result<()> {
        let started = Instant::now();
        let mut kernels = vec![
            Kernel::Box(BoxKernel::Pyramid),
            Kernel::Box(BoxKernel::Bound),
            Kernel::Box(BoxKernel::Extremes),
            Kernel::Box(BoxKernel::Cull),
            Kernel::Box(BoxKernel::Farthest),
        ];
        for group in self.sides.iter().flat_map(|side| &side.groups) {
            let kernel = Kernel::Box(BoxKernel::Boxes { degree: group.degree });
            if !kernels.contains(&kernel) {
                kernels.push(kernel);
            }
        }
        kernels.retain(|&kernel| self.gpu.pipelines.get(kernel).1);
        if kernels.is_empty() {
            return Ok(());
        }
        let mut work = Work::new(&self.gpu, &self.params);
        for kernel in kernels {
            let (params_bytes, storage) = kernel.bindings();
            let empty: Vec<_> = storage.iter().map(|_| self.gpu.storage("empty", MAX_ITEM)).collect();
            let empty: Vec<&wgpu::Buffer> = empty.iter().collect();
            self.record(&mut work, kernel, &empty, &vec![0; params_bytes], 0);
        }
        work.submit().await?;
        self.compile_seconds = started.elapsed().as_secs_f64();
        Ok(())
    }

    fn record(
        &self,
        work: &mut Work<'_>,
        kernel: Kernel,
        storage: &[&wgpu::Buffer],
        params: &[u8],
        units: usize,
    ) {
        let (pipeline, _) = self.gpu.pipelines.get(kernel);
        let bind_group = self.gpu.bind(&pipeline, &self.params, storage);
        let workgroups = (units as u32).div_ceil(WORKGROUP_SIZE);
        work.dispatch(&Dispatch {
            kernel,
            pipeline: &pipeline,
            bind_group: &bind_group,
            params,
            extent: Extent::Workgroups(workgroups),
            units,
        });
    }

    /// Runs the steps in turn, in submissions of bounded duration; they fill
    /// this part of the progress.
    async fn run(
        &self,
        steps: &[Step<'_>],
        progress: &mut Progress<'_>,
        [start, length]: [f64; 2],
    ) -> Result<()> {
        let mut work = Work::new(&self.gpu, &self.params);
        for (index, step) in steps.iter().enumerate() {
            let mut first = 0;
            while first < step.count {
                if work.make_room().await? {
                    let done = index as f64 + first as f64 / step.count as f64;
                    progress.checkpoint(start + length * done / steps.len() as f64).await?;
                }
                let units = self.gpu.pace.chunk(step.kernel).min(step.count - first);
                let mut params = step.params.clone();
                params[..8].copy_from_slice(bytes_of(&[first as u32, (first + units) as u32]));
                self.record(&mut work, step.kernel, &step.storage, &params, units);
                first += units;
            }
        }
        work.submit().await
    }

    /// Stages `boxes` and `pyramid` for both sides.
    fn building(&self, placed: &[BoxesParams; 2]) -> Vec<Step<'_>> {
        let mut steps = Vec::new();
        for (side, placed) in placed.iter().enumerate() {
            let (cells, boxes) = (&self.sides[side], &self.boxes[side]);
            let last = boxes.len() - 1;
            for PartGroup { degree, count, controls, parts } in &cells.groups {
                let storage = [&controls.controls, &controls.centers, parts, &boxes[last]];
                steps.push(Step::new(
                    Kernel::Box(BoxKernel::Boxes { degree: *degree }),
                    &storage,
                    bytes_of(placed),
                    *count,
                ));
            }
            for level in (0..last).rev() {
                let storage = [&cells.levels[level], &boxes[level + 1], &boxes[level]];
                let params = StepParams::zeroed();
                steps.push(Step::new(
                    Kernel::Box(BoxKernel::Pyramid),
                    &storage,
                    bytes_of(&params),
                    cells.counts[level],
                ));
            }
        }
        steps
    }

    /// The level of the side's own tree that `level` of the descent is.
    fn own(&self, side: usize, level: usize) -> usize {
        (level + self.sides[side].finest).saturating_sub(self.levels())
    }

    /// The nodes of the level that has children on the next.
    fn nodes(&self, side: usize) -> &wgpu::Buffer {
        let (this, below) = (self.own(side, self.level), self.own(side, self.level + 1));
        if this == below { &self.sides[side].root } else { &self.sides[side].levels[this] }
    }

    /// The three numbers that a buffer begins with.
    async fn read(&self, from: &wgpu::Buffer) -> Result<[u32; 3]> {
        let bytes = size_of::<[u32; 3]>() as u64;
        let work = Work::new(&self.gpu, &self.params);
        let content = work.read(from, &self.readable, bytes).await?;
        Ok(bytemuck::pod_read_unaligned(&content))
    }

    /// The levels below the roots.
    pub(crate) fn levels(&self) -> usize {
        self.sides[0].finest.max(self.sides[1].finest)
    }

    /// Stages `bound`, `extremes` and `cull` on the level below; goes there if
    /// no more than `most_pairs` are left.
    ///
    /// # Errors
    /// As [`GpuDescent::new`].
    pub(crate) async fn descend(
        &mut self,
        most_pairs: usize,
        progress: &mut Progress<'_>,
    ) -> Result<LevelBounds> {
        let [a, b] = [0, 1].map(|side| &self.boxes[side][self.own(side, self.level + 1)]);
        let [nodes_a, nodes_b] = [0, 1].map(|side| self.nodes(side));
        let nodes = self.sides[0].counts[self.own(0, self.level + 1)];
        let bounds = self.gpu.storage("bounds", (nodes * size_of::<Bound>()) as u64);
        let totals = self.gpu.storage("totals", size_of::<Totals>() as u64);
        let capacity = most_pairs.min(self.pair_count * MAX_CHILDREN * MAX_CHILDREN);
        let next = self.gpu.storage("pairs", capacity as u64 * PAIR_BYTES);
        let storage = [&self.pairs, nodes_a, nodes_b, a, b, &bounds, &totals, &next];
        let params = StepParams { capacity: capacity as u32, ..Zeroable::zeroed() };
        let params = bytes_of(&params);
        let steps = [
            Step::new(Kernel::Box(BoxKernel::Bound), &storage[..6], params, self.pair_count),
            Step::new(Kernel::Box(BoxKernel::Extremes), &storage[5..7], params, nodes),
            Step::new(Kernel::Box(BoxKernel::Cull), &storage, params, self.pair_count),
        ];
        self.run(&steps, progress, [0.0, 1.0]).await?;
        let Totals { near, far, pairs } = bytemuck::cast(self.read(&totals).await?);
        let squared = |bits: u32| f64::from(f32::from_bits(bits)) / self.scale / self.scale;
        let far = if f32::from_bits(far) < FARTHEST { squared(far) } else { f64::INFINITY };
        if pairs as usize <= most_pairs {
            (self.pairs, self.pair_count, self.bounds, self.totals) = (next, pairs as usize, bounds, totals);
            self.level += 1;
        }
        Ok(LevelBounds::new(u64::from(pairs), DistanceBounds { near: squared(near), far }))
    }

    /// Stage `farthest`: on the last level, the cell of A that is the farthest
    /// from B, and a cell of B near it.
    ///
    /// # Errors
    /// As [`GpuDescent::new`].
    pub(crate) async fn farthest(&self, progress: &mut Progress<'_>) -> Result<[usize; 2]> {
        let found = self.gpu.storage("farthest", size_of::<Farthest>() as u64);
        let [a, b] = [0, 1].map(|side| self.sides[side].finest);
        let [boxes_a, boxes_b] = [&self.boxes[0][a], &self.boxes[1][b]];
        let storage = [&self.bounds, &self.totals, &self.pairs, boxes_a, boxes_b, &found];
        let cells = self.sides[0].counts[a];
        let phases = [(OF_CELLS, cells), (OF_DISTANCES, self.pair_count), (OF_PARTNERS, self.pair_count)];
        let steps = phases.map(|(phase, count)| {
            let params = StepParams { phase, ..Zeroable::zeroed() };
            Step::new(Kernel::Box(BoxKernel::Farthest), &storage, bytes_of(&params), count)
        });
        self.run(&steps, progress, [1.0, 0.0]).await?;
        let Farthest { a: from, b: to, .. } = bytemuck::cast(self.read(&found).await?);
        let place = |complement: u32, side: usize, level: usize| {
            (!complement as usize).min(self.sides[side].counts[level] - 1)
        };
        Ok([place(from, 0, a), place(to, 1, b)])
    }
}
