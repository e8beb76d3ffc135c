//! The kernels' stages one at a time, for `benches`; no part of the interface.

use crate::bezier::BezierModel;
use crate::closest::Target;
use crate::error::Result;
use crate::gpu::{Gpu, GpuStages};
use crate::iteration::{Rule, Sampling};
use crate::model::RigidTransform;
use crate::progress::{NoMonitor, Progress};
use std::ops::Range;
use std::rc::Rc;

/// One direction on the GPU, stage by stage.
pub struct StageBench {
    gpu: Rc<Gpu>,
    stages: GpuStages,
    pages: Vec<Range<usize>>,
}

impl StageBench {
    /// Uploads both sides and compiles the kernels.
    ///
    /// # Errors
    /// [`crate::Error::GpuFailed`], [`crate::Error::DeviceLost`].
    pub fn new(
        gpu: &Rc<Gpu>,
        model: &BezierModel,
        sampling: &Sampling,
        target: &Target,
        transform: RigidTransform,
        rule: Rule,
    ) -> Result<Self> {
        let on_gpu = Rc::new(gpu.upload_sampling(model, sampling));
        let to = Rc::new(gpu.upload_target(target));
        let stages = pollster::block_on(GpuStages::new(gpu, on_gpu, to, transform, rule))?;
        Ok(Self { gpu: Rc::clone(gpu), stages, pages: sampling.pages() })
    }

    /// Stage `sample` on every page.
    ///
    /// # Errors
    /// As [`StageBench::new`].
    pub fn sample(&mut self) -> Result<()> {
        (0..self.pages.len()).try_for_each(|index| pollster::block_on(self.stages.sample(index)))
    }

    /// Stages `sample` and `project` on every page.
    ///
    /// # Errors
    /// As [`StageBench::new`].
    pub fn project(&mut self) -> Result<()> {
        let mut silent = NoMonitor;
        let mut progress = Progress::new(&mut silent, false);
        for (index, page) in self.pages.iter().enumerate() {
            pollster::block_on(self.stages.project(index, page, &mut progress))?;
        }
        Ok(())
    }

    /// Stage `reduce` on the page projected last; the number of blocks.
    ///
    /// # Errors
    /// As [`StageBench::new`].
    pub fn reduce(&mut self) -> Result<usize> {
        Ok(pollster::block_on(self.stages.reduce())?.len())
    }

    /// `Best.s` of the page projected last, as the kernel wrote it.
    ///
    /// # Errors
    /// As [`StageBench::new`].
    pub fn written(&mut self) -> Result<Vec<f32>> {
        pollster::block_on(self.stages.written())
    }

    /// Replaces the kernels of `project` by an edited text, on this device, until replaced again.
    pub fn edit(&self, edit: &dyn Fn(String) -> String) {
        for kernel in self.stages.project_kernels() {
            self.gpu.pipelines.replace(kernel, edit(kernel.text()));
        }
    }
}
