//! One direction of method `hierarchy` on one backend.

use super::cpu_descent::boxes_of;
use super::descent::Descent;
use super::directed::COORDINATE_ROUNDING;
use super::run::{Ends, Run};
use super::{Descend, Options, PreparedCells, Progress, Seconds, now};
use crate::error::Result;
use crate::hierarchy::Traversal;
use crate::model::RigidTransform;
use std::rc::Rc;

/// What is prepared for one direction.
struct Prepared {
    cells: [Rc<PreparedCells>; 2],
    started: f64,
    seconds: Seconds,
}

impl Ends<'_> {
    /// Method `hierarchy` in float64.
    pub(super) async fn hierarchy_on_cpu(
        &self,
        options: &Options,
        progress: &mut Progress<'_>,
    ) -> Result<Run> {
        let prepared = self.prepare_cells(options)?;
        let [a, b] = &prepared.cells;
        let slack = COORDINATE_ROUNDING * self.largest_coordinate();
        let boxes = [
            boxes_of(self.from.bezier(), &a.tree, &self.transform, slack),
            boxes_of(self.to.bezier(), &b.tree, &RigidTransform::IDENTITY, slack),
        ];
        let mut stages = Traversal::new([&a.tree, &b.tree], [&boxes[0], &boxes[1]]);
        self.descend(&prepared, &mut stages, options, progress).await
    }

    fn prepare_cells(&self, options: &Options) -> Result<Prepared> {
        let started = now();
        let cells = [self.from.cells(options.grid)?, self.to.cells(options.grid)?];
        let seconds = Seconds { prepare: now() - started, ..Seconds::default() };
        Ok(Prepared { cells, started, seconds })
    }

    /// At least every coordinate of both models, before and after they are moved.
    fn largest_coordinate(&self) -> f64 {
        let of = |aabb: crate::tree::Aabb| aabb.min.abs().max(aabb.max.abs()).length();
        let (a, b) = (of(self.from.bounding_box()), of(self.to.bounding_box()));
        (a + self.transform.offset().length()).max(b)
    }

    async fn descend(
        &self,
        prepared: &Prepared,
        stages: &mut impl Descend,
        options: &Options,
        progress: &mut Progress<'_>,
    ) -> Result<Run> {
        let Prepared { cells: [a, b], started, seconds } = prepared;
        let descent = Descent {
            models: [self.from, self.to],
            trees: [&a.tree, &b.tree],
            transform: self.transform,
            diagonal: self.diagonal(),
        };
        let directed = descent.run(stages, options, progress).await?;
        Ok(Run {
            directed,
            backend: "cpu",
            adapter: None,
            notice: None,
            diagonal: descent.diagonal,
            sampled_patches: self.from.bezier().patches.len(),
            target_patches: self.to.bezier().patches.len(),
            seconds: Seconds { solve: now() - started - seconds.prepare - seconds.compile, ..*seconds },
        })
    }
}
