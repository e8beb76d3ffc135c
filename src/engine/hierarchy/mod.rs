//! The driver of method `hierarchy`, for one direction on either backend.

mod backend;
mod cpu;

use super::direction::{DirectedRun, Direction};
use super::options::HierarchyOptions;
use super::result::DirectedResult;
use super::{Details, DistanceOptions, HierarchyDetails, PreparedModel, Processor, Seconds};
use crate::error::{Error, Result};
use crate::gpu::{Gpu, GpuHierarchy, Placement};
use crate::hierarchy::{GridTree, Traversal};
use crate::model::RigidTransform;
use crate::progress::Progress;
use crate::rounding::{VANISHING_LENGTH, gamma};
use backend::HierarchyBackend;
use cpu::level_boxes;
use std::sync::Arc;
use web_time::Instant;

/// The number of bytes of a pair: two indices.
const PAIR_BYTES: usize = 2 * size_of::<u32>();

/// The number of lists of pairs in memory: that of the current level and the next.
const PAIR_LISTS: usize = 2;

/// The roundings of a box and of a distance of boxes, relative to the largest length
/// of a point. A patch's box has sides off by 3 roundings each of at most three such
/// lengths, so its diagonal, which may replace the growth, by less than 32. The
/// distance of two boxes is at most 4√3 lengths and passes through 4 roundings, half
/// of which each side covers: 14.
const BOX_ROUNDINGS: f64 = 46.0;

impl Direction<'_> {
    /// Runs method `hierarchy` on the GPU, with boxes rounded outwards, or
    /// without one on the CPU in float64.
    pub(super) async fn hierarchy(
        &self,
        gpu: Option<&Arc<Gpu>>,
        options: &DistanceOptions,
        own: &HierarchyOptions,
        progress: &mut Progress<'_>,
    ) -> Result<DirectedRun> {
        let started = Instant::now();
        let a = self.from.cells(own.grid, progress).await?;
        let b = self.to.cells(own.grid, progress).await?;
        let coordinate_error = self.box_error();
        let transform = self.transform;
        let prepared = Seconds { prepare: started.elapsed().as_secs_f64(), ..Seconds::default() };
        let (stages, processor, adapter, seconds) = match gpu {
            Some(gpu) => {
                let trees = [
                    a.resident.on(gpu, |gpu| gpu.upload_grid_tree(self.from.bezier(), &a.tree))?,
                    b.resident.on(gpu, |gpu| gpu.upload_grid_tree(self.to.bezier(), &b.tree))?,
                ];
                let prepare = started.elapsed().as_secs_f64();
                let placement = Placement { transform, coordinate_error };
                let hierarchy = GpuHierarchy::new(gpu, trees, &placement, progress).await?;
                let seconds = Seconds { prepare, compile: hierarchy.compile_seconds(), ..prepared };
                (HierarchyBackend::Gpu(Box::new(hierarchy)), Processor::Gpu, gpu.adapter(), seconds)
            }
            None => {
                let (from, to, fixed) = (self.from.bezier(), self.to.bezier(), RigidTransform::IDENTITY);
                let boxes = [
                    level_boxes(from, &a.tree, &transform, coordinate_error, progress).await?,
                    level_boxes(to, &b.tree, &fixed, coordinate_error, progress).await?,
                ];
                let traversal = Traversal::new([&a.tree, &b.tree], boxes);
                (HierarchyBackend::Cpu(traversal), Processor::Cpu, None, prepared)
            }
        };
        let pair = TreePair {
            models: [self.from, self.to],
            trees: [&a.tree, &b.tree],
            transform,
            diagonal: self.diagonal(),
            box_bound: self.box_bound(),
        };
        let result = pair.run(stages, options, own, progress).await?;
        Ok(DirectedRun {
            result,
            backend: processor,
            adapter,
            notice: None,
            diagonal: pair.diagonal,
            unit: self.unit(),
            gap: self.gap(),
            is_gap_proven: self.is_gap_proven(),
            limit: options.limit,
            from_patches: self.from.bezier().patches.len(),
            to_patches: self.to.bezier().patches.len(),
            seconds: Seconds {
                solve: started.elapsed().as_secs_f64() - seconds.prepare - seconds.compile,
                ..seconds
            },
        })
    }

    /// Returns an upper bound on the distance between any points of the two models, and so
    /// on the directed distance (lemma of docs/published.md, section 9): that of their boxes.
    /// It is finite for every pair, as float32 bounds are not.
    pub(super) fn box_bound(&self) -> f64 {
        let [a, b] = [self.from, self.to].map(PreparedModel::control_box);
        a.max_distance(|point| self.transform.apply(point), &b) + 2.0 * self.box_error()
    }

    /// Returns an upper bound on the error of every side of a box of either model, and
    /// half of that of a distance of two boxes: the points of a model, A's motion, and
    /// [`BOX_ROUNDINGS`].
    fn box_error(&self) -> f64 {
        let models = [self.from, self.to];
        let [a, b] = models.map(|model| model.control_box().farthest_from_origin());
        let [of_a, of_b] = models.map(|model| model.bezier().point_error.after(0));
        let length = (a + self.transform.offset().length()).max(b);
        (of_a + self.transform.rounding(a)).max(of_b) + gamma(BOX_ROUNDINGS) * length + VANISHING_LENGTH
    }
}

/// The two models of one direction with their trees.
struct TreePair<'a> {
    models: [&'a PreparedModel; 2],
    trees: [&'a GridTree; 2],
    transform: RigidTransform,
    diagonal: f64,
    /// [`Direction::box_bound`].
    box_bound: f64,
}

impl TreePair<'_> {
    /// Traverses the trees level by level. The witness is the pair of middles of
    /// the last cells, whose distance lies within the bounds of their boxes, and so
    /// in the interval.
    ///
    /// # Errors
    /// [`Error::PairBudgetExceeded`], [`Error::Cancelled`], those of the backend.
    async fn run(
        &self,
        mut backend: HierarchyBackend<'_>,
        options: &DistanceOptions,
        own: &HierarchyOptions,
        progress: &mut Progress<'_>,
    ) -> Result<DirectedResult> {
        let max_pairs = (own.memory_budget << 20) / PAIR_BYTES / PAIR_LISTS;
        let levels = backend.levels();
        let mut pairs = vec![1];
        let (mut lower, mut upper) = (0.0_f64, self.box_bound);
        for level in 1..=levels {
            progress.section((level - 1) as f64 / levels as f64, 1.0 / levels as f64);
            progress.checkpoint(0.0).await?;
            let bounds = backend.descend(max_pairs, progress).await?;
            if bounds.pairs > max_pairs as u64 {
                let (found, expected) = (bounds.pairs, max_pairs as u64);
                return Err(Error::PairBudgetExceeded {
                    level,
                    found,
                    expected,
                    mebibytes: own.memory_budget,
                });
            }
            pairs.push(bounds.pairs);
            lower = lower.max(bounds.lower);
            upper = upper.min(bounds.upper);
            progress.interval(lower, upper, false);
        }
        let farthest = backend.farthest(progress).await?;
        let [(a_parameters, a), (b_parameters, b)] =
            [0, 1].map(|side| self.trees[side].middle(self.models[side].bezier(), farthest[side]));
        let a = self.transform.apply(a);
        let surface_point = |side: usize, parameters, point| {
            let piece = self.trees[side].cells[farthest[side]].surface as usize;
            self.models[side].pieces().surface_point(piece, parameters, point)
        };
        let tolerance = options.width(self.diagonal);
        Ok(DirectedResult {
            computed: a.distance(b),
            lower,
            upper,
            converged: upper - lower <= tolerance,
            from: surface_point(0, a_parameters, a),
            to: surface_point(1, b_parameters, b),
            details: Details::Hierarchy(HierarchyDetails { grid: own.grid, levels: pairs.len(), pairs }),
            deviations: Vec::new(),
        })
    }
}
