//! The kernels of method `certified` one stage at a time, for `benches`; no
//! part of the interface.

use crate::certified::BranchAndBound;
use crate::engine::PreparedModel;
use crate::error::Result;
use crate::flatness::Flatness;
use crate::gpu::iteration::layouts::{Best, Cell, LevelParams};
use crate::gpu::kernel::Kernel;
use crate::gpu::submission::Work;
use crate::gpu::{Gpu, Levels};
use crate::model::RigidTransform;
use std::rc::Rc;

/// A stage of a level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the stages' names")]
pub enum LevelStage {
    Cell,
    Project,
    Certify,
    Split,
    Level,
}

impl LevelStage {
    /// In the order of a level.
    pub const ALL: [Self; 5] = [Self::Cell, Self::Project, Self::Certify, Self::Split, Self::Level];

    fn of(kernel: Kernel) -> Option<Self> {
        match kernel {
            Kernel::Cell { .. } => Some(Self::Cell),
            Kernel::Project { .. } => Some(Self::Project),
            Kernel::Certify { .. } => Some(Self::Certify),
            Kernel::Split => Some(Self::Split),
            Kernel::Level => Some(Self::Level),
            _ => None,
        }
    }
}

/// One level of cells on the GPU.
pub struct LevelBench {
    gpu: Rc<Gpu>,
    levels: Levels,
    cells: Vec<Cell>,
    params: LevelParams,
}

impl LevelBench {
    /// Cuts A in float64 until about `cells` cells wait, whose bounds are not
    /// yet within `tolerance`, and uploads them and both models. `None` where
    /// float32 is too coarse for it, or so many cells never wait.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`].
    pub fn new(
        gpu: &Rc<Gpu>,
        [a, b]: [&PreparedModel; 2],
        transform: RigidTransform,
        tolerance: f64,
        cells: usize,
    ) -> Result<Option<Self>> {
        let (from, to) = (a.target(Flatness::Loose), b.target(Flatness::Loose));
        let (a, b) = (from.side(a), to.side(b));
        let mut search = BranchAndBound::new(a, b, transform, tolerance, None);
        while search.waiting() < cells {
            if search.advance().is_some() {
                return Ok(None);
            }
        }
        let Some(levels) = Levels::new(gpu, &search)? else { return Ok(None) };
        let cells = levels.cells(&search.take_batch(cells), &mut Vec::new());
        let params = levels.params(search.prune_threshold());
        Ok(Some(Self { gpu: Rc::clone(gpu), levels, cells, params }))
    }

    /// Number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.cells.len()
    }

    /// Uploads the cells and runs some stages of the level on them, in order.
    /// `Project` wants `Cell` before it, and `Certify` what these two once wrote.
    ///
    /// # Errors
    /// As [`LevelBench::new`].
    pub fn run(&self, stages: &[LevelStage]) -> Result<()> {
        self.levels.begin(&self.cells);
        let mut work = Work::new(&self.gpu, &self.levels.buffers.params);
        for step in &self.levels.steps[0] {
            if LevelStage::of(step.kernel).is_some_and(|stage| stages.contains(&stage)) {
                self.levels.record(&mut work, step, &self.params);
            }
        }
        pollster::block_on(work.submit())
    }

    /// Replaces the kernels of a stage by an edited text, here only, until replaced again.
    pub fn edit(&mut self, stage: LevelStage, edit: &dyn Fn(String) -> String) {
        for step in self.levels.steps.iter_mut().flatten() {
            if LevelStage::of(step.kernel) == Some(stage) {
                let pipelines = &self.gpu.pipelines;
                step.pipeline = Rc::new(pipelines.make(step.kernel, edit(step.kernel.text())));
            }
        }
    }

    /// What the kernels wrote: `Best.s` of every cell, and `Cell.reach`.
    ///
    /// # Errors
    /// As [`LevelBench::new`].
    pub fn written(&self) -> Result<Vec<[f32; 2]>> {
        let Self { gpu, levels, cells, .. } = self;
        let read = |from: &wgpu::Buffer, bytes: usize| {
            pollster::block_on(levels.read(Work::new(gpu, &levels.buffers.params), from, bytes))
        };
        let best = read(&levels.buffers.best, cells.len() * size_of::<Best>())?;
        let after = read(&levels.buffers.cells[0], cells.len() * size_of::<Cell>())?;
        let best: Vec<Best> = bytemuck::pod_collect_to_vec(&best);
        let after: Vec<Cell> = bytemuck::pod_collect_to_vec(&after);
        Ok(best.iter().zip(&after).map(|(best, cell)| [best.s, cell.reach]).collect())
    }
}
