//! The stages `cell`, `project`, `certify`, `split` and `level` on the GPU:
//! several levels of cells in one submission.

pub(crate) mod float32_error;
pub(crate) mod subpatches;
pub(crate) mod upload;

use crate::bezier::{Patch, power_of_two_below};
use crate::certified::{BatchResult, BranchAndBound, Domain, Foot, SearchNode};
use crate::closest::{Projection, Target};
use crate::error::Result;
use crate::gpu::Gpu;
use crate::gpu::Pieces;
use crate::gpu::certified::float32_error::PieceError;
use crate::gpu::certified::upload::{GpuPieces, PieceFrame, Reach};
use crate::gpu::degree_groups::by_degree;
use crate::gpu::float32::{ROUNDING, rounded_down, rounded_up};
use crate::gpu::iteration::FARTHEST;
use crate::gpu::iteration::layouts::{
    Batch, Best, Cell, JET_BYTES, LevelParams, ProjectParams, Tally, UNDECIDED,
};
use crate::gpu::iteration::target::GpuTarget;
use crate::gpu::kernel::{Kernel, Pipeline, WORKGROUP_SIZE};
use crate::gpu::submission::{Dispatch, Extent, Work};
use crate::iteration::Culling;
use crate::model::RigidTransform;
use bytemuck::{Zeroable, bytes_of, pod_read_unaligned};
use std::rc::Rc;
use web_time::Instant;

/// Cells that a level has room for.
const CAPACITY: usize = 1 << 15;

/// Levels of one submission.
const LEVELS: usize = 4;

/// Cells that a submission may leave over: those of every level, and parts
/// that found no room in the next.
const MAX_LEFT: usize = 4 * LEVELS * CAPACITY;

/// Cells that a submission begins with: first, and at least.
const FIRST_CHUNK: usize = 2048;
const MIN_CHUNK: usize = 256;

/// Seconds that a submission should take: browsers kill work of seconds, and
/// this is also the grain of progress and cancelling.
const SECONDS: f64 = 0.2;

/// Pieces of a model, at most.
const MAX_PIECES: usize = 1 << 15;

/// Part of the tolerance that float32 may lose in the pieces of either model,
/// and in the length of a distance.
const PIECE_PART: f64 = 0.12;
const LENGTH_PART: f64 = 0.4;

/// Roundings of a distance relative to itself, `LENGTH_ROUNDINGS` and those of
/// `DIFFERENCE_ROUNDINGS` in `certify.wgsl`, and of the bound compared.
const DISTANCE_ROUNDINGS: f64 = 22.0 * ROUNDING;

/// Units of the centres' grid from the frame's origin to its farthest point:
/// a difference of two is within 32 bits.
const GRID_UNITS: f64 = (1_u32 << 28) as f64;

/// Newton steps on one piece, at most: pieces are small, and a foot that was
/// not reached only loosens.
const ITERATIONS: u32 = 8;

/// Both models' pieces on the GPU and the buffers of the levels.
pub(crate) struct Levels {
    gpu: Rc<Gpu>,
    pieces: [Pieces; 2],
    uploaded: [GpuPieces; 2],
    frame: PieceFrame,
    pub(crate) buffers: Buffers,
    /// The dispatches of a level, cells from one buffer or the other.
    pub(crate) steps: [Vec<Step>; 2],
    chunk: usize,
}

pub(crate) struct Buffers {
    pub(crate) params: wgpu::Buffer,
    batch: wgpu::Buffer,
    pub(crate) cells: [wgpu::Buffer; 2],
    pub(crate) best: wgpu::Buffer,
    left: wgpu::Buffer,
    tally: wgpu::Buffer,
}

/// One dispatch of a level.
pub(crate) struct Step {
    pub(crate) kernel: Kernel,
    pub(crate) pipeline: Rc<Pipeline>,
    bind_group: Rc<wgpu::BindGroup>,
    about: About,
}

/// The pieces that a dispatch is about.
#[derive(Clone, Copy)]
enum About {
    Pieces { first: usize, count: usize },
    Project { patches_before: usize },
    Level,
}

impl Levels {
    /// Cuts and uploads both models of a search; `None` where float32 is not
    /// exact enough for its tolerance.
    ///
    /// # Errors
    /// [`Error::GpuFailed`], [`Error::DeviceLost`].
    pub(crate) fn new(gpu: &Rc<Gpu>, search: &BranchAndBound<'_>) -> Result<Option<Self>> {
        gpu.check()?;
        let tolerance = search.tolerance();
        if DISTANCE_ROUNDINGS * search.interval().upper > LENGTH_PART * tolerance {
            return Ok(None);
        }
        let (a, b, transform) = search.sides();
        let fits = |patch: &Patch<'_>| PieceError::of(patch, 1.0).total() <= PIECE_PART * tolerance;
        let Some(from) = Pieces::new(a, transform, &fits, MAX_PIECES) else { return Ok(None) };
        let Some(to) = Pieces::new(b, &RigidTransform::IDENTITY, &fits, MAX_PIECES) else { return Ok(None) };
        let target = gpu.upload_target(&Target::new(to.patches.clone()));
        let frame = frame(&target, [&from, &to]);
        let from_groups = by_degree(&from.patches);
        let of_group = |before: usize, count: usize| target.patches[before..before + count].to_vec();
        let to_groups: Vec<([usize; 2], Vec<u32>)> = target
            .groups
            .iter()
            .map(|group| (group.degree, of_group(group.patches_before, group.count)))
            .collect();
        let uploaded = [
            gpu.upload_pieces(&from, &from_groups, Reach::Piece, &frame),
            gpu.upload_pieces(&to, &to_groups, Reach::Beyond(b), &frame),
        ];
        let cells = |label| gpu.storage(label, (CAPACITY * size_of::<Cell>()) as u64);
        let usages =
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDIRECT | wgpu::BufferUsages::COPY_DST;
        let buffers = Buffers {
            params: gpu.params(),
            batch: gpu.buffer("batch", size_of::<Batch>() as u64, usages),
            cells: [cells("cells"), cells("next cells")],
            best: gpu.storage("best", (CAPACITY * size_of::<Best>()) as u64),
            left: gpu.storage("left cells", (MAX_LEFT * size_of::<Cell>()) as u64),
            tally: gpu.storage("tally", size_of::<Tally>() as u64),
        };
        let steps = steps(gpu, &buffers, &uploaded, &target);
        gpu.check()?;
        Ok(Some(Self {
            gpu: Rc::clone(gpu),
            pieces: [from, to],
            uploaded,
            frame,
            buffers,
            steps,
            chunk: FIRST_CHUNK,
        }))
    }

    /// Bounds the next waiting cells and their parts, some levels down.
    ///
    /// # Errors
    /// [`Error::GpuFailed`], [`Error::DeviceLost`]; the search has its cells back.
    pub(crate) async fn advance(&mut self, search: &mut BranchAndBound<'_>) -> Result<()> {
        let started = Instant::now();
        let lent = search.take_batch(self.chunk);
        match self.bound(&lent, search.prune_threshold()).await {
            Ok(returned) => search.return_batch(returned),
            Err(error) => {
                search.return_batch(BatchResult { waiting: lent, ..BatchResult::default() });
                return Err(error);
            }
        }
        let seconds = started.elapsed().as_secs_f64();
        if seconds > SECONDS {
            self.chunk = (self.chunk / 2).max(MIN_CHUNK);
        } else if 2.0 * seconds < SECONDS {
            self.chunk = (2 * self.chunk).min(CAPACITY / 4);
        }
        Ok(())
    }

    pub(crate) async fn bound(&self, lent: &[SearchNode], prune_threshold: f64) -> Result<BatchResult> {
        let mut returned = BatchResult::default();
        let cells = self.cells(lent, &mut returned.waiting);
        let Buffers { params, cells: buffers, left, tally, .. } = &self.buffers;
        self.begin(&cells);
        let mut work = Work::new(&self.gpu, params);
        let level = self.params(prune_threshold);
        for index in 0..LEVELS {
            for step in &self.steps[index % 2] {
                self.record(&mut work, step, &level);
            }
        }
        let tally: Tally = pod_read_unaligned(&self.read(work, tally, size_of::<Tally>()).await?);
        for (from, count) in [(&buffers[LEVELS % 2], tally.waiting), (left, tally.left)] {
            let work = Work::new(&self.gpu, params);
            for cell in self
                .read(work, from, count as usize * size_of::<Cell>())
                .await?
                .chunks_exact(size_of::<Cell>())
            {
                let cell: Cell = pod_read_unaligned(cell);
                let region = self.region(&cell)?;
                if cell.verdict == UNDECIDED {
                    returned.undecided.push(region);
                } else {
                    returned.waiting.push(region);
                }
            }
        }
        returned.dropped = f64::from(f32::from_bits(tally.dropped)) / self.frame.scale;
        returned.cells = tally.cells as usize;
        returned.levels = lent.iter().map(|region| region.level).max().unwrap_or(0) + tally.levels;
        if tally.farthest > 0 {
            let center = [tally.farthest_s, tally.farthest_t].map(f32::from_bits);
            let cell = self.place(tally.farthest_piece, center, [0.0; 2])?;
            returned.farthest = Some((cell.patch, cell.center));
        }
        Ok(returned)
    }

    /// The cells of the regions; those that found no room are left waiting.
    pub(crate) fn cells(&self, lent: &[SearchNode], waiting: &mut Vec<SearchNode>) -> Vec<Cell> {
        let mut cells = Vec::new();
        for region in lent {
            let before = cells.len();
            if let Domain::Cell(cell) = &region.domain {
                for part in self.pieces[0].parts(cell) {
                    cells.push(self.cell(part, region));
                }
            }
            if cells.len() > CAPACITY {
                cells.truncate(before);
                waiting.push(*region);
            }
        }
        cells
    }

    /// Makes these the cells of the first level, which has told nothing yet.
    pub(crate) fn begin(&self, cells: &[Cell]) {
        let Buffers { batch, cells: buffers, tally, .. } = &self.buffers;
        let count = cells.len() as u32;
        let first = Batch { workgroups: [count.div_ceil(WORKGROUP_SIZE), 1, 1], count };
        let queue = &self.gpu.queue;
        queue.write_buffer(&buffers[0], 0, bytemuck::cast_slice(cells));
        queue.write_buffer(batch, 0, bytes_of(&first));
        queue.write_buffer(tally, 0, bytes_of(&Tally::zeroed()));
    }

    /// What all stages are told where a bound of `prune_threshold` ends a cell.
    pub(crate) fn params(&self, prune_threshold: f64) -> LevelParams {
        LevelParams {
            prune_threshold: rounded_down(self.frame.scale * prune_threshold),
            grid: self.frame.grid as f32,
            // Half a unit in each coordinate of either centre, and a little for float64.
            slack: 2.0 * self.frame.grid as f32,
            capacity: CAPACITY as u32,
            first_piece: 0,
            piece_count: 0,
        }
    }

    pub(crate) fn record(&self, work: &mut Work<'_>, step: &Step, level: &LevelParams) {
        let params;
        let project;
        let (bytes, extent) = match step.about {
            About::Pieces { first, count } => {
                params = LevelParams { first_piece: first as u32, piece_count: count as u32, ..*level };
                (bytes_of(&params), Extent::Indirect(&self.buffers.batch))
            }
            About::Project { patches_before } => {
                project = ProjectParams {
                    sample_count: CAPACITY as u32,
                    patches_before: patches_before as u32,
                    iterations: ITERATIONS,
                    ..ProjectParams::zeroed()
                };
                (bytes_of(&project), Extent::Indirect(&self.buffers.batch))
            }
            About::Level => (bytes_of(level), Extent::Workgroups(1)),
        };
        let Step { kernel, pipeline, bind_group, .. } = step;
        // A level has no pace of its own: it is as long as its cells are many.
        work.dispatch(&Dispatch { kernel: *kernel, pipeline, bind_group, params: bytes, extent, units: 0 });
    }

    pub(crate) async fn read(&self, work: Work<'_>, from: &wgpu::Buffer, bytes: usize) -> Result<Vec<u8>> {
        let readable = self.gpu.readable("readable", bytes as u64);
        work.read(from, &readable, bytes as u64).await
    }

    fn cell(&self, (piece, center, half): (usize, [f64; 2], [f64; 2]), region: &SearchNode) -> Cell {
        Cell {
            // Dyadic numbers of few digits, so exact.
            center: center.map(|x| x as f32),
            half: half.map(|x| x as f32),
            piece: self.uploaded[0].index_of(piece),
            foot: 0,
            foot_at: [0.5; 2],
            upper: rounded_up(self.frame.scale * region.upper),
            reach: FARTHEST,
            level: region.level,
            verdict: 0,
        }
    }

    fn place(&self, piece: u32, center: [f32; 2], half: [f32; 2]) -> Result<crate::certified::Cell> {
        let piece = self.uploaded[0].piece(piece)?;
        let center = center.map(|x| f64::from(x).clamp(-1.0, 1.0));
        Ok(self.pieces[0].cell(piece, center, half.map(f64::from)))
    }

    fn region(&self, cell: &Cell) -> Result<SearchNode> {
        let foot = self.uploaded[1].piece(cell.foot)?;
        let place = &self.pieces[1].places[foot];
        let at = place.at(cell.foot_at.map(|x| 2.0 * f64::from(x) - 1.0));
        Ok(SearchNode {
            domain: Domain::Cell(self.place(cell.piece, cell.center, cell.half)?),
            upper: f64::from(cell.upper) / self.frame.scale,
            foot: Foot::start(place.patch, at),
            level: cell.level,
        })
    }
}

/// B's frame with a grid that reaches all centres.
fn frame(target: &GpuTarget, sides: [&Pieces; 2]) -> PieceFrame {
    let mut largest = 0.0_f64;
    for pieces in sides {
        for patch in pieces.patches.iter() {
            largest = largest.max((target.scale * (patch.center - target.origin)).abs().max_element());
        }
    }
    let grid = 2.0 * power_of_two_below(largest.max(f64::MIN_POSITIVE)) / GRID_UNITS;
    PieceFrame { origin: target.origin, scale: target.scale, grid: grid.max(f64::from(f32::MIN_POSITIVE)) }
}

/// What a level does, with its cells in either buffer.
fn steps(
    gpu: &Rc<Gpu>,
    buffers: &Buffers,
    [from, to]: &[GpuPieces; 2],
    target: &GpuTarget,
) -> [Vec<Step>; 2] {
    let room = CAPACITY as u64;
    let jets = gpu.storage("jets", room * JET_BYTES);
    let samples = gpu.storage("samples", room * size_of::<[f32; 4]>() as u64);
    let Buffers { params, batch, best, left, tally, .. } = buffers;
    [0, 1].map(|parity| {
        let (cells, next) = (&buffers.cells[parity], &buffers.cells[1 - parity]);
        let mut steps = Vec::new();
        let mut push = |kernel, storage: &[&wgpu::Buffer], about| {
            let (pipeline, _) = gpu.pipelines.get(kernel);
            let bind_group = gpu.bind(&pipeline, params, storage);
            steps.push(Step { kernel, pipeline, bind_group, about });
        };
        for group in &from.groups {
            let storage = [batch, cells, &group.coefficients, &from.pieces, &jets, &samples, best];
            let about = About::Pieces { first: group.first, count: group.count };
            push(Kernel::Cell { degree: group.degree }, &storage, about);
        }
        for group in &target.groups {
            let kernel = Kernel::Project {
                degree: group.degree,
                projection: Projection::Newton,
                culling: Culling::Tree,
            };
            let storage = [&samples, best, &group.controls.controls, &group.controls.centers, &group.nodes];
            push(kernel, &storage, About::Project { patches_before: group.patches_before });
        }
        for group in &to.groups {
            let storage = [batch, cells, &jets, best, &from.pieces, &to.pieces, &group.coefficients];
            let about = About::Pieces { first: group.first, count: group.count };
            push(Kernel::Certify { degree: group.degree }, &storage, about);
        }
        let about = About::Pieces { first: 0, count: 0 };
        push(Kernel::Split, &[batch, cells, next, left, tally, &from.pieces], about);
        push(Kernel::Level, &[batch, tally], About::Level);
        steps
    })
}
