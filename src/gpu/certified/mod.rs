//! Method `certified` on the GPU: stages `cell_jet`, `project`, `taylor_bound`,
//! `split` and `next_level`, on several levels of cells in one submission.
//!
//! The branch and bound of [`crate::certified`] hands over batches of cells
//! and takes back those that are still to be split or to be bounded in
//! float64. Both models are cut into subpatches on which float32 loses only a
//! part of the tolerance; the kernels add that error to every bound.

mod float32_error;
pub(crate) mod kernels;
pub(crate) mod layouts;
mod level;
mod subpatches;
mod upload;

pub(crate) use float32_error::Float32Error;
pub(crate) use subpatches::{SubpatchCell, Subpatches};
pub(crate) use upload::{BoundsDomain, GpuSubpatches, SubpatchFrame};

use super::Gpu;
use super::degree_groups::by_degree;
use super::float32::{UNIT_ROUNDOFF, UNKNOWN_DISTANCE, round_down, round_up};
use super::kernel::WORKGROUP_SIZE;
use super::submission::MAX_SECONDS;
use super::submission::Submission;
use super::target::GpuTarget;
use crate::bezier::{Patch, power_of_two_below};
use crate::certified::{BatchResult, BranchAndBound, Cell, Domain, Foot, Pair, SearchNode};
use crate::closest::Target;
use crate::error::Result;
use crate::model::RigidTransform;
use bytemuck::{Zeroable, bytes_of, pod_read_unaligned};
use layouts::{
    Batch, CellState, DIFFERENCE_ROUNDINGS, FLOAT64_ONLY, LENGTH_ROUNDINGS, LEVELS, LevelParams, Tally,
};
use level::{Buffers, CAPACITY, LevelDispatch, dispatches};
use std::sync::Arc;
use web_time::Instant;

/// Cells of the first batch. Batches double while a submission takes less than
/// half of [`MAX_SECONDS`], and halve when it takes more.
const FIRST_BATCH: usize = 2048;

/// The fewest cells of a batch: fewer do not occupy a GPU.
const MIN_BATCH: usize = 256;

/// The most cells of a batch, so that its children fit the next level.
const MAX_BATCH: usize = CAPACITY / 4;

/// The most subpatches of a model.
const MAX_SUBPATCHES: usize = 1 << 15;

/// The fractions of the tolerance that float32 may lose in the subpatches of
/// either model, and in the length of a distance.
const MAX_SUBPATCH_ERROR: f64 = 0.12;
const MAX_LENGTH_ERROR: f64 = 0.4;

/// Upper bound on the relative error of a distance: of the difference, of its
/// length, and two roundings of the bound that is compared.
const DISTANCE_ROUNDINGS: f64 = DIFFERENCE_ROUNDINGS as f64 + LENGTH_ROUNDINGS as f64 + 2.0 * UNIT_ROUNDOFF;

/// Units of the centres' grid from the frame's origin to its farthest point:
/// the difference of two centres is within 32 bits.
const CENTER_UNITS: f64 = (1_u32 << 28) as f64;

/// The subpatches of both models of a search on the GPU, with the buffers of its levels.
pub(crate) struct GpuCertified {
    gpu: Arc<Gpu>,
    /// The subpatches of A and B.
    subpatches: [Subpatches; 2],
    uploaded: [GpuSubpatches; 2],
    frame: SubpatchFrame,
    pub(crate) buffers: Buffers,
    /// The dispatches of even and of odd levels, which read the cells from
    /// either buffer and write them to the other.
    pub(crate) dispatches: [Vec<LevelDispatch>; 2],
    batch_size: usize,
}

impl GpuCertified {
    /// Cuts both models of a search into subpatches and uploads them. Returns
    /// `None` where float32 is too coarse for the search's tolerance.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`].
    pub(crate) fn new(gpu: &Arc<Gpu>, search: &BranchAndBound<'_>) -> Result<Option<Self>> {
        gpu.check()?;
        let tolerance = search.tolerance();
        if DISTANCE_ROUNDINGS * search.interval().upper > MAX_LENGTH_ERROR * tolerance {
            return Ok(None);
        }
        let Pair { a, b, transform } = search.pair();
        let fits =
            |patch: &Patch<'_>| Float32Error::new(patch, 1.0).total() <= MAX_SUBPATCH_ERROR * tolerance;
        let Some(from) = Subpatches::new(a.patches(), transform, &fits, MAX_SUBPATCHES) else {
            return Ok(None);
        };
        let Some(to) = Subpatches::new(b.patches(), &RigidTransform::IDENTITY, &fits, MAX_SUBPATCHES) else {
            return Ok(None);
        };
        let target = gpu.upload_target(&Target::new(to.patches.clone()));
        let frame = frame(&target, [&from, &to]);
        let from_groups = by_degree(&from.patches);
        let to_groups: Vec<([usize; 2], Vec<u32>)> = target
            .groups
            .iter()
            .map(|group| {
                let members = group.patches_before..group.patches_before + group.count;
                (group.degree, target.patches[members].to_vec())
            })
            .collect();
        let uploaded = [
            gpu.upload_subpatches(&from, &from_groups, BoundsDomain::Subpatch, &frame),
            gpu.upload_subpatches(&to, &to_groups, BoundsDomain::Extended(b), &frame),
        ];
        let buffers = Buffers::new(gpu);
        let dispatches = dispatches(gpu, &buffers, &uploaded, &target);
        gpu.check()?;
        Ok(Some(Self {
            gpu: Arc::clone(gpu),
            subpatches: [from, to],
            uploaded,
            frame,
            buffers,
            dispatches,
            batch_size: FIRST_BATCH,
        }))
    }

    /// Takes the next batch of cells from the search, bounds them and their
    /// descendants of some levels, and returns the result to the search.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`]; the search has
    /// its cells back.
    pub(crate) async fn advance(&mut self, search: &mut BranchAndBound<'_>) -> Result<()> {
        let started = Instant::now();
        let batch = search.take_batch(self.batch_size);
        match self.bound(&batch, search.prune_threshold()).await {
            Ok(result) => search.return_batch(result),
            Err(error) => {
                search.return_batch(BatchResult { waiting: batch, ..BatchResult::default() });
                return Err(error);
            }
        }
        let seconds = started.elapsed().as_secs_f64();
        if seconds > MAX_SECONDS {
            self.batch_size = (self.batch_size / 2).max(MIN_BATCH);
        } else if 2.0 * seconds < MAX_SECONDS {
            self.batch_size = (2 * self.batch_size).min(MAX_BATCH);
        }
        Ok(())
    }

    /// Bounds the cells of the nodes and their descendants of some levels.
    pub(crate) async fn bound(&self, nodes: &[SearchNode], prune_threshold: f64) -> Result<BatchResult> {
        let mut result = BatchResult::default();
        let cells = self.cells(nodes, &mut result);
        let Buffers { params, cells: buffers, leftover_cells, tally, .. } = &self.buffers;
        self.upload_level(&cells);
        let mut submission = Submission::new(&self.gpu, params);
        let level_params = self.params(prune_threshold);
        for level in 0..LEVELS {
            for dispatch in &self.dispatches[level % 2] {
                dispatch.record(&mut submission, &self.buffers, &level_params);
            }
        }
        let tally: Tally = pod_read_unaligned(&self.read(submission, tally, size_of::<Tally>()).await?);
        for (from, count) in
            [(&buffers[LEVELS % 2], tally.waiting_cells), (leftover_cells, tally.leftover_cells)]
        {
            let submission = Submission::new(&self.gpu, params);
            let content = self.read(submission, from, count as usize * size_of::<CellState>()).await?;
            for cell in content.chunks_exact(size_of::<CellState>()) {
                let cell: CellState = pod_read_unaligned(cell);
                let node = self.node(&cell)?;
                if cell.verdict == FLOAT64_ONLY {
                    result.undecided.push(node);
                } else {
                    result.waiting.push(node);
                }
            }
        }
        result.dropped = f64::from(f32::from_bits(tally.pruned_upper)) / self.frame.scale;
        result.cells = tally.cells as usize;
        result.levels = nodes.iter().map(|node| node.level).max().unwrap_or(0) + tally.levels;
        if tally.farthest > 0 {
            let center = [tally.farthest_s, tally.farthest_t].map(f32::from_bits);
            let cell = self.cell(tally.farthest_subpatch, center, [0.0; 2])?;
            result.farthest = Some((cell.patch, cell.center));
        }
        Ok(result)
    }

    /// The cells of the nodes, on one subpatch each. Nodes whose cells exceed the
    /// capacity are left waiting in the result, and nodes that float32 does not
    /// represent exactly are left to float64.
    pub(crate) fn cells(&self, nodes: &[SearchNode], result: &mut BatchResult) -> Vec<CellState> {
        let mut cells = Vec::new();
        for node in nodes {
            let Domain::Cell(cell) = &node.domain else { continue };
            let intersections: Vec<SubpatchCell> = self.subpatches[0].intersections(cell).collect();
            if !intersections.iter().all(SubpatchCell::is_exact_in_float32) {
                result.undecided.push(*node);
            } else if cells.len() + intersections.len() > CAPACITY {
                result.waiting.push(*node);
            } else {
                cells.extend(intersections.iter().map(|cell| self.cell_state(cell, node)));
            }
        }
        cells
    }

    /// Uploads the cells of the first level and resets the tally.
    pub(crate) fn upload_level(&self, cells: &[CellState]) {
        let Buffers { batch, cells: buffers, tally, .. } = &self.buffers;
        let count = cells.len() as u32;
        let first = Batch { workgroups: [count.div_ceil(WORKGROUP_SIZE), 1, 1], count };
        let queue = &self.gpu.queue;
        queue.write_buffer(&buffers[0], 0, bytemuck::cast_slice(cells));
        queue.write_buffer(batch, 0, bytes_of(&first));
        queue.write_buffer(tally, 0, bytes_of(&Tally::zeroed()));
    }

    /// The params common to all stages.
    pub(crate) fn params(&self, prune_threshold: f64) -> LevelParams {
        LevelParams {
            prune_threshold: round_down(self.frame.scale * prune_threshold),
            center_unit: self.frame.center_unit as f32,
            // Half a unit in each coordinate of either centre, √3 in length, with a
            // margin for float64.
            center_error: 2.0 * self.frame.center_unit as f32,
            capacity: CAPACITY as u32,
            first_subpatch: 0,
            subpatch_count: 0,
        }
    }

    pub(crate) async fn read(
        &self,
        submission: Submission<'_>,
        from: &wgpu::Buffer,
        bytes: usize,
    ) -> Result<Vec<u8>> {
        let readable = self.gpu.readable("readable", bytes as u64);
        submission.read(from, &readable, bytes as u64).await
    }

    fn cell_state(&self, cell: &SubpatchCell, node: &SearchNode) -> CellState {
        CellState {
            // Exact, see `SubpatchCell::is_exact_in_float32`.
            center: cell.center.map(|x| x as f32),
            half: cell.half.map(|x| x as f32),
            subpatch: self.uploaded[0].index_of(cell.subpatch),
            foot_subpatch: 0,
            foot_parameters: [0.5; 2],
            upper: round_up(self.frame.scale * node.upper),
            foot_distance: UNKNOWN_DISTANCE,
            level: node.level,
            verdict: 0,
        }
    }

    /// The cell of A of a rectangle on the subpatch of this index on the GPU.
    fn cell(&self, index: u32, center: [f32; 2], half: [f32; 2]) -> Result<Cell> {
        let subpatch = self.uploaded[0].subpatch(index)?;
        let center = center.map(|x| f64::from(x).clamp(-1.0, 1.0));
        Ok(self.subpatches[0].cell(&SubpatchCell { subpatch, center, half: half.map(f64::from) }))
    }

    fn node(&self, cell: &CellState) -> Result<SearchNode> {
        let foot = self.uploaded[1].subpatch(cell.foot_subpatch)?;
        let domain = self.subpatches[1].domains[foot];
        let foot_parameters = domain.patch_parameters(cell.foot_parameters.map(f64::from));
        Ok(SearchNode {
            domain: Domain::Cell(self.cell(cell.subpatch, cell.center, cell.half)?),
            upper: f64::from(cell.upper) / self.frame.scale,
            foot: Foot::start(domain.patch, foot_parameters),
            level: cell.level,
        })
    }
}

/// B's frame, with a grid of centres that reaches all subpatches.
fn frame(target: &GpuTarget, models: [&Subpatches; 2]) -> SubpatchFrame {
    let mut largest = 0.0_f64;
    for subpatches in models {
        for patch in subpatches.patches.iter() {
            largest = largest.max((target.scale * (patch.center - target.origin)).abs().max_element());
        }
    }
    let unit = 2.0 * power_of_two_below(largest.max(f64::MIN_POSITIVE)) / CENTER_UNITS;
    let center_unit = unit.max(f64::from(f32::MIN_POSITIVE));
    SubpatchFrame { origin: target.origin, scale: target.scale, center_unit }
}
