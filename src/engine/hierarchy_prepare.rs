//! One direction of method `hierarchy` on one backend.

use super::direction::{Ends, Run};
use super::hierarchy_backend::{Descending, Descent};
use super::hierarchy_cpu::boxes_of;
use super::{Options, Processor, Seconds};
use crate::bvh::Aabb;
use crate::error::Result;
use crate::gpu::Gpu;
#[cfg(not(target_arch = "wasm32"))]
use crate::gpu::{Frame, GpuDescent};
use crate::hierarchy::Traversal;
use crate::model::RigidTransform;
use crate::progress::Progress;
use crate::rounding::coordinate_rounding;
use std::rc::Rc;
use web_time::Instant;

/// Why a GPU is not used.
const ON_CPU: &str = "method hierarchy runs on the CPU in the browser";

impl Ends<'_> {
    /// Method `hierarchy`, on the GPU with boxes rounded outwards, or without
    /// one and in the browser in float64.
    pub(super) async fn hierarchy(
        &self,
        gpu: Option<&Rc<Gpu>>,
        options: &Options,
        progress: &mut Progress<'_>,
    ) -> Result<Run> {
        let started = Instant::now();
        let [a, b] = [self.from.cells(options.grid)?, self.to.cells(options.grid)?];
        let slack = coordinate_rounding(self.largest_coordinate());
        let transform = self.transform;
        let prepared = Seconds { prepare: started.elapsed().as_secs_f64(), ..Seconds::default() };
        let (stages, adapter, seconds) = match gpu {
            #[cfg(not(target_arch = "wasm32"))]
            Some(gpu) => {
                let sides = [
                    a.resident.on(gpu, |gpu| gpu.upload_cells(self.from.bezier(), &a.tree))?,
                    b.resident.on(gpu, |gpu| gpu.upload_cells(self.to.bezier(), &b.tree))?,
                ];
                let prepare = started.elapsed().as_secs_f64();
                let descent = GpuDescent::new(gpu, sides, &Frame { transform, slack }, progress).await?;
                let seconds = Seconds { prepare, compile: descent.compile_seconds(), ..prepared };
                (Descending::Gpu(Box::new(descent)), gpu.adapter(), seconds)
            }
            _ => {
                let boxes = [
                    boxes_of(self.from.bezier(), &a.tree, &transform, slack),
                    boxes_of(self.to.bezier(), &b.tree, &RigidTransform::IDENTITY, slack),
                ];
                (Descending::Cpu(Traversal::new([&a.tree, &b.tree], boxes)), None, prepared)
            }
        };
        let backend = if matches!(stages, Descending::Cpu(_)) { Processor::Cpu } else { Processor::Gpu };
        let descent = Descent {
            models: [self.from, self.to],
            trees: [&a.tree, &b.tree],
            transform,
            diagonal: self.diagonal(),
        };
        let directed = descent.run(stages, options, progress).await?;
        Ok(Run {
            directed,
            backend,
            adapter,
            // Natively there are kernels wherever there is a GPU.
            notice: (gpu.is_some() && backend == Processor::Cpu).then(|| ON_CPU.to_owned()),
            diagonal: descent.diagonal,
            sampled_patches: self.from.bezier().patches.len(),
            target_patches: self.to.bezier().patches.len(),
            seconds: Seconds {
                solve: started.elapsed().as_secs_f64() - seconds.prepare - seconds.compile,
                ..seconds
            },
        })
    }

    /// At least every coordinate of both models, before and after they are moved.
    fn largest_coordinate(&self) -> f64 {
        let of = |aabb: Aabb| aabb.min.abs().max(aabb.max.abs()).length();
        let (a, b) = (of(self.from.bounding_box()), of(self.to.bounding_box()));
        (a + self.transform.offset().length()).max(b)
    }
}
