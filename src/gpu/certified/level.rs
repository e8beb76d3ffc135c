//! One level of cells: its buffers and its dispatches.

use super::kernels;
use super::layouts::{Batch, CellState, JET_BYTES, LEVELS, LevelParams, Tally};
use super::upload::GpuSubpatches;
use crate::closest::Projection;
use crate::gpu::Gpu;
use crate::gpu::GpuTarget;
use crate::gpu::iteration::kernels as iteration_kernels;
use crate::gpu::iteration::layouts::{ProjectParams, Projected};
use crate::gpu::kernel::{Kernel, Pipeline};
use crate::gpu::submission::{Dispatch, Extent, Submission};
use crate::iteration::Culling;
use bytemuck::{Zeroable, bytes_of};
use std::sync::Arc;

/// The most cells of a level.
pub(crate) const CAPACITY: usize = 1 << 15;

/// The most leftover cells of a submission: every cell of every level may be
/// for float64 or have up to four children without space in the next level.
const MAX_LEFTOVER: usize = 4 * LEVELS * CAPACITY;

/// The most Newton steps on one subpatch: it is small, and a foot that is not
/// reached only loosens the bound.
const ITERATIONS: u32 = 8;

/// The buffers of a search, for two consecutive levels.
pub(crate) struct Buffers {
    pub(crate) params: wgpu::Buffer,
    pub(crate) batch: wgpu::Buffer,
    pub(crate) cells: [wgpu::Buffer; 2],
    pub(crate) projected: wgpu::Buffer,
    pub(crate) leftover_cells: wgpu::Buffer,
    pub(crate) tally: wgpu::Buffer,
}

impl Buffers {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let cells = |label| gpu.storage(label, (CAPACITY * size_of::<CellState>()) as u64);
        let indirect =
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDIRECT | wgpu::BufferUsages::COPY_DST;
        Self {
            params: gpu.params_buffer(),
            batch: gpu.buffer("batch", size_of::<Batch>() as u64, indirect),
            cells: [cells("cells"), cells("next cells")],
            projected: gpu.storage("projected", (CAPACITY * size_of::<Projected>()) as u64),
            leftover_cells: gpu.storage("leftover cells", (MAX_LEFTOVER * size_of::<CellState>()) as u64),
            tally: gpu.storage("tally", size_of::<Tally>() as u64),
        }
    }
}

/// One dispatch of a level.
pub(crate) struct LevelDispatch {
    pub(crate) kernel: Kernel,
    pub(crate) pipeline: Arc<Pipeline>,
    bind_group: Arc<wgpu::BindGroup>,
    scope: Scope,
}

/// The subpatches that a dispatch uses.
#[derive(Clone, Copy)]
enum Scope {
    /// A group of subpatches, for all cells.
    Subpatches { first: usize, count: usize },
    /// A group of B's subpatches, for stage `project`.
    Project { patches_before: usize },
    /// None: the dispatch has one thread.
    Level,
}

impl LevelDispatch {
    /// Records the dispatch on the cells of the current level.
    pub(crate) fn record(
        &self,
        submission: &mut Submission<'_>,
        buffers: &Buffers,
        level_params: &LevelParams,
    ) {
        let (subpatch_params, project_params);
        let (params, extent) = match self.scope {
            Scope::Subpatches { first, count } => {
                subpatch_params = LevelParams {
                    first_subpatch: first as u32,
                    subpatch_count: count as u32,
                    ..*level_params
                };
                (bytes_of(&subpatch_params), Extent::Indirect(&buffers.batch))
            }
            Scope::Project { patches_before } => {
                project_params = ProjectParams {
                    sample_count: CAPACITY as u32,
                    patches_before: patches_before as u32,
                    iterations: ITERATIONS,
                    ..ProjectParams::zeroed()
                };
                (bytes_of(&project_params), Extent::Indirect(&buffers.batch))
            }
            Scope::Level => (bytes_of(level_params), Extent::Workgroups(1)),
        };
        let LevelDispatch { kernel, pipeline, bind_group, .. } = self;
        // The number of cells is not known here, so no throughput can be measured.
        submission.dispatch(&Dispatch { kernel: *kernel, pipeline, bind_group, params, extent, units: 0 });
    }
}

/// The dispatches of a level with its cells in the first and in the second buffer.
pub(crate) fn dispatches(
    gpu: &Gpu,
    buffers: &Buffers,
    [from, to]: &[GpuSubpatches; 2],
    target: &GpuTarget,
) -> [Vec<LevelDispatch>; 2] {
    let capacity = CAPACITY as u64;
    let jets = gpu.storage("jets", capacity * JET_BYTES);
    let samples = gpu.storage("samples", capacity * size_of::<[f32; 4]>() as u64);
    let Buffers { params, batch, projected, leftover_cells, tally, .. } = buffers;
    [0, 1].map(|parity| {
        let (cells, next_cells) = (&buffers.cells[parity], &buffers.cells[1 - parity]);
        let mut dispatches = Vec::new();
        let mut push = |kernel, storage: &[&wgpu::Buffer], scope| {
            let (pipeline, _) = gpu.pipelines.get(kernel);
            let bind_group = gpu.bind(&pipeline, params, storage);
            dispatches.push(LevelDispatch { kernel, pipeline, bind_group, scope });
        };
        for group in &from.groups {
            let storage = [batch, cells, &group.coefficients, &from.subpatches, &jets, &samples, projected];
            let scope = Scope::Subpatches { first: group.first, count: group.count };
            push(kernels::cell_jet(group.degree), &storage, scope);
        }
        for group in &target.groups {
            let kernel = iteration_kernels::project(group.degree, Projection::Newton, Culling::Tree);
            let controls = &group.controls;
            let storage = [&samples, projected, &controls.controls, &controls.centers, &group.nodes];
            push(kernel, &storage, Scope::Project { patches_before: group.patches_before });
        }
        for group in &to.groups {
            let storage =
                [batch, cells, &jets, projected, &from.subpatches, &to.subpatches, &group.coefficients];
            let scope = Scope::Subpatches { first: group.first, count: group.count };
            push(kernels::taylor_bound(group.degree), &storage, scope);
        }
        let all = Scope::Subpatches { first: 0, count: 0 };
        push(kernels::split(), &[batch, cells, next_cells, leftover_cells, tally, &from.subpatches], all);
        push(kernels::next_level(), &[batch, tally], Scope::Level);
        dispatches
    })
}
