//! One direction of method `hierarchy` on one backend.

use super::direction::{Ends, Run};
use super::hierarchy_backend::{Descending, Descent};
use super::hierarchy_cpu::boxes_of;
use super::{Options, Processor, Seconds};
use crate::error::Result;
use crate::gpu::{Gpu, GpuHierarchy, Placement};
use crate::hierarchy::Traversal;
use crate::model::RigidTransform;
use crate::progress::Progress;
use crate::rounding::{accumulated, vanishing};
use std::rc::Rc;
use web_time::Instant;

/// Roundings of a box and of a distance of boxes, relative to the largest length of
/// a point. A patch's box has sides off by 3 roundings each of at most three such
/// lengths, so its diagonal, which may replace the growth, by less than 32. The
/// distance of two boxes is at most 4√3 lengths and passes through 4 roundings, half
/// of which each side covers: 14.
const BOX_ROUNDINGS: f64 = 46.0;

impl Ends<'_> {
    /// Runs method `hierarchy` on the GPU, with boxes rounded outwards, or
    /// without one on the CPU in float64.
    pub(super) async fn hierarchy(
        &self,
        gpu: Option<&Rc<Gpu>>,
        options: &Options,
        progress: &mut Progress<'_>,
    ) -> Result<Run> {
        let started = Instant::now();
        let [a, b] = [self.from.cells(options.grid)?, self.to.cells(options.grid)?];
        let coordinate_error = self.box_error();
        let transform = self.transform;
        let prepared = Seconds { prepare: started.elapsed().as_secs_f64(), ..Seconds::default() };
        let (stages, backend, adapter, seconds) = match gpu {
            Some(gpu) => {
                let trees = [
                    a.resident.on(gpu, |gpu| gpu.upload_grid_tree(self.from.bezier(), &a.tree))?,
                    b.resident.on(gpu, |gpu| gpu.upload_grid_tree(self.to.bezier(), &b.tree))?,
                ];
                let prepare = started.elapsed().as_secs_f64();
                let placement = Placement { transform, coordinate_error };
                let hierarchy = GpuHierarchy::new(gpu, trees, &placement, progress).await?;
                let seconds = Seconds { prepare, compile: hierarchy.compile_seconds(), ..prepared };
                (Descending::Gpu(Box::new(hierarchy)), Processor::Gpu, gpu.adapter(), seconds)
            }
            None => {
                let boxes = [
                    boxes_of(self.from.bezier(), &a.tree, &transform, coordinate_error),
                    boxes_of(self.to.bezier(), &b.tree, &RigidTransform::IDENTITY, coordinate_error),
                ];
                (Descending::Cpu(Traversal::new([&a.tree, &b.tree], boxes)), Processor::Cpu, None, prepared)
            }
        };
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
            notice: None,
            diagonal: descent.diagonal,
            sampled_patches: self.from.bezier().patches.len(),
            target_patches: self.to.bezier().patches.len(),
            seconds: Seconds {
                solve: started.elapsed().as_secs_f64() - seconds.prepare - seconds.compile,
                ..seconds
            },
        })
    }

    /// An upper bound on the error of every side of a box of either model, and half
    /// of that of a distance of two boxes: the points of a model, A's motion, and
    /// [`BOX_ROUNDINGS`].
    fn box_error(&self) -> f64 {
        let [a, b] = [self.from, self.to].map(|model| model.bounding_box().farthest_from_origin());
        let [of_a, of_b] = [self.from, self.to].map(|model| model.bezier().point_error.after(0));
        let length = (a + self.transform.offset().length()).max(b);
        (of_a + self.transform.rounding(a)).max(of_b) + accumulated(BOX_ROUNDINGS) * length + vanishing()
    }
}
