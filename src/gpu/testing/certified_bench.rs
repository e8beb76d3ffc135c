//! Method `certified` stage by stage on one level of cells, for `benches`.

use crate::bezier::extract;
use crate::certified::{BatchResult, BranchAndBound, Operand, Pair};
use crate::closest::Target;
use crate::error::Result;
use crate::flatness::{Flatness, flatten};
use crate::gpu::Gpu;
use crate::gpu::certified::GpuCertified;
use crate::gpu::certified::layouts::{CellState, LevelParams};
use crate::gpu::iteration::layouts::Projected;
use crate::gpu::kernel::Kernel;
use crate::gpu::submission::Submission;
use crate::model::{Model, RigidTransform};
use std::sync::Arc;

/// A stage of a level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names of the stages")]
pub enum CertifiedStage {
    CellJet,
    Project,
    TaylorBound,
    Split,
    NextLevel,
}

impl CertifiedStage {
    /// All stages in the order of a level.
    pub const ALL: [Self; 5] =
        [Self::CellJet, Self::Project, Self::TaylorBound, Self::Split, Self::NextLevel];

    fn of(kernel: Kernel) -> Option<Self> {
        match kernel.entry_point {
            "cell_jet" => Some(Self::CellJet),
            "project_tree" => Some(Self::Project),
            "taylor_bound" => Some(Self::TaylorBound),
            "split" => Some(Self::Split),
            "next_level" => Some(Self::NextLevel),
            _ => None,
        }
    }
}

/// One level of cells on the GPU.
pub struct CertifiedBench {
    gpu: Arc<Gpu>,
    driver: GpuCertified,
    cells: Vec<CellState>,
    params: LevelParams,
}

impl CertifiedBench {
    /// Searches in float64 until about `cells` cells of A wait, and uploads
    /// them and both models. Returns `None` where float32 is too coarse for
    /// the tolerance or the search ends before.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`].
    pub fn new(
        gpu: &Arc<Gpu>,
        models: [&Model; 2],
        transform: RigidTransform,
        tolerance: f64,
        cells: usize,
    ) -> Result<Option<Self>> {
        let operands = models.map(|model| {
            let patches = extract(model).patches;
            let flat = flatten(&patches, Flatness::Loose);
            let bounds = flat.places.derivative_bounds();
            (Target::new(flat.patches), bounds)
        });
        let [a, b] = [0, 1].map(|index| Operand::new(&operands[index].0, &operands[index].1));
        let mut search = BranchAndBound::new(Pair { a, b, transform }, tolerance, None, 0.0);
        while search.waiting() < cells {
            if search.advance(usize::MAX).is_some() {
                return Ok(None);
            }
        }
        let Some(driver) = GpuCertified::new(gpu, &search)? else { return Ok(None) };
        let cells = driver.cells(&search.take_batch(cells), &mut BatchResult::default());
        let params = driver.params(search.prune_threshold());
        Ok(Some(Self { gpu: Arc::clone(gpu), driver, cells, params }))
    }

    /// The number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.cells.len()
    }

    /// Uploads the cells and runs some stages of the level on them, in order.
    /// `Project` requires `CellJet` before it, and `TaylorBound` that both ran once.
    ///
    /// # Errors
    /// As [`CertifiedBench::new`].
    pub fn run(&self, stages: &[CertifiedStage]) -> Result<()> {
        self.driver.upload_level(&self.cells);
        let mut submission = Submission::new(&self.gpu, &self.driver.buffers.params);
        for dispatch in &self.driver.dispatches[0] {
            if CertifiedStage::of(dispatch.kernel).is_some_and(|stage| stages.contains(&stage)) {
                dispatch.record(&mut submission, &self.driver.buffers, &self.params);
            }
        }
        pollster::block_on(submission.submit())
    }

    /// Replaces the text of the kernels of a stage, in this benchmark only,
    /// until they are replaced again.
    pub fn edit(&mut self, stage: CertifiedStage, edit: &dyn Fn(String) -> String) {
        for dispatch in self.driver.dispatches.iter_mut().flatten() {
            if CertifiedStage::of(dispatch.kernel) == Some(stage) {
                let text = edit(dispatch.kernel.text());
                dispatch.pipeline = Arc::new(self.gpu.pipelines.make(dispatch.kernel, text));
            }
        }
    }

    /// Returns `Projected.s` and `CellState.foot_distance` of every cell, as
    /// the kernels wrote them.
    ///
    /// # Errors
    /// As [`CertifiedBench::new`].
    pub fn written(&self) -> Result<Vec<[f32; 2]>> {
        let Self { gpu, driver, cells, .. } = self;
        let read = |from: &wgpu::Buffer, bytes: usize| {
            pollster::block_on(driver.read(Submission::new(gpu, &driver.buffers.params), from, bytes))
        };
        let projected = read(&driver.buffers.projected, cells.len() * size_of::<Projected>())?;
        let cells = read(&driver.buffers.cells[0], cells.len() * size_of::<CellState>())?;
        let projected: Vec<Projected> = bytemuck::pod_collect_to_vec(&projected);
        let cells: Vec<CellState> = bytemuck::pod_collect_to_vec(&cells);
        Ok(projected.iter().zip(&cells).map(|(foot, cell)| [foot.s, cell.foot_distance]).collect())
    }
}
