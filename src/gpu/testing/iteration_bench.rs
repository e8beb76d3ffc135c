//! Method `iteration` stage by stage, for `benches`.

use crate::bezier::BezierModel;
use crate::closest::Target;
use crate::error::Result;
use crate::gpu::{Gpu, GpuIteration};
use crate::iteration::{Rule, Sampling};
use crate::model::RigidTransform;
use crate::progress::{NoMonitor, Progress};
use std::ops::Range;
use std::sync::Arc;

/// One direction of method `iteration` on the GPU.
pub struct IterationBench {
    gpu: Arc<Gpu>,
    stages: GpuIteration,
    pages: Vec<Range<usize>>,
}

impl IterationBench {
    /// Uploads both models and compiles the kernels.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`].
    pub fn new(
        gpu: &Arc<Gpu>,
        model: &BezierModel,
        sampling: &Sampling,
        target: &Target,
        transform: RigidTransform,
        rule: Rule,
    ) -> Result<Self> {
        let from = Arc::new(gpu.upload_sampling(model, sampling));
        let to = Arc::new(gpu.upload_target(target));
        let stages = pollster::block_on(GpuIteration::new(gpu, from, to, transform, rule))?;
        Ok(Self { gpu: Arc::clone(gpu), stages, pages: sampling.pages() })
    }

    /// Runs stage `sample` on every page.
    ///
    /// # Errors
    /// As [`IterationBench::new`].
    pub fn sample(&mut self) -> Result<()> {
        (0..self.pages.len()).try_for_each(|index| pollster::block_on(self.stages.sample(index)))
    }

    /// Runs stages `sample` and `project` on every page.
    ///
    /// # Errors
    /// As [`IterationBench::new`].
    pub fn project(&mut self) -> Result<()> {
        let mut silent = NoMonitor;
        let mut progress = Progress::new(&mut silent, false);
        for (index, page) in self.pages.iter().enumerate() {
            pollster::block_on(self.stages.project(index, page, &mut progress))?;
        }
        Ok(())
    }

    /// Runs stage `reduce` on the page projected last. Returns the number of blocks.
    ///
    /// # Errors
    /// As [`IterationBench::new`].
    pub fn reduce(&mut self) -> Result<usize> {
        Ok(pollster::block_on(self.stages.reduce())?.len())
    }

    /// Returns `Projected.s` of the page projected last, as the kernel wrote it.
    ///
    /// # Errors
    /// As [`IterationBench::new`].
    pub fn written(&mut self) -> Result<Vec<f32>> {
        pollster::block_on(self.stages.written())
    }

    /// Replaces the text of the kernels of `project` on this device, until they are replaced again.
    pub fn edit(&self, edit: &dyn Fn(String) -> String) {
        for kernel in self.stages.project_kernels() {
            self.gpu.pipelines.replace(kernel, edit(kernel.text()));
        }
    }
}
