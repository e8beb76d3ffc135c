//! One direction of method `hierarchy`, on any backend.

use super::hierarchy_cpu::descend;
use super::iteration::{Directed, surface_point};
use super::{Details, HierarchyDetails, Options, PreparedModel};
use crate::error::{Error, Result};
use crate::gpu::GpuHierarchy;
use crate::hierarchy::{GridTree, LevelBounds, Traversal};
use crate::model::RigidTransform;
use crate::progress::Progress;

/// Bytes of a pair: two indices.
const PAIR_BYTES: usize = 2 * size_of::<u32>();

/// Lists of pairs held at a time: of the level in work and of the next.
const LISTS: usize = 2;

/// The backend's stages, at the pair of roots first.
pub(super) enum Descending<'a> {
    /// In float64.
    Cpu(Traversal<'a>),
    /// In float32.
    Gpu(Box<GpuHierarchy>),
}

impl Descending<'_> {
    fn below_roots(&self) -> usize {
        match self {
            Self::Cpu(traversal) => traversal.finest(),
            Self::Gpu(hierarchy) => hierarchy.levels(),
        }
    }

    async fn descend(&mut self, most_pairs: usize, progress: &mut Progress<'_>) -> Result<LevelBounds> {
        match self {
            Self::Cpu(traversal) => descend(traversal, most_pairs, progress).await,
            Self::Gpu(hierarchy) => hierarchy.descend(most_pairs, progress).await,
        }
    }

    async fn farthest(&self, progress: &mut Progress<'_>) -> Result<[usize; 2]> {
        match self {
            Self::Cpu(traversal) => {
                progress.checkpoint(1.0).await?;
                Ok(traversal.farthest())
            }
            Self::Gpu(hierarchy) => hierarchy.farthest(progress).await,
        }
    }
}

/// The two models of one direction with their trees.
pub(super) struct Descent<'a> {
    pub(super) models: [&'a PreparedModel; 2],
    pub(super) trees: [&'a GridTree; 2],
    pub(super) transform: RigidTransform,
    pub(super) diagonal: f64,
}

impl Descent<'_> {
    /// Descends level by level and takes the middles of the last cells for
    /// the witness: their distance is within the boxes', so in the interval.
    ///
    /// # Errors
    /// [`Error::PairBudgetExceeded`], [`Error::Cancelled`], the backend's.
    pub(super) async fn run(
        &self,
        mut stages: Descending<'_>,
        options: &Options,
        progress: &mut Progress<'_>,
    ) -> Result<Directed> {
        let most_pairs = (options.memory_budget << 20) / PAIR_BYTES / LISTS;
        let levels = stages.below_roots();
        let mut pairs = vec![1];
        let (mut lower, mut upper) = (0.0_f64, f64::INFINITY);
        for level in 1..=levels {
            progress.section((level - 1) as f64 / levels as f64, 1.0 / levels as f64);
            progress.checkpoint(0.0).await?;
            let found = stages.descend(most_pairs, progress).await?;
            if found.pairs > most_pairs as u64 {
                let (found, expected) = (found.pairs, most_pairs as u64);
                return Err(Error::PairBudgetExceeded {
                    level,
                    found,
                    expected,
                    mebibytes: options.memory_budget,
                });
            }
            pairs.push(found.pairs);
            lower = lower.max(found.lower);
            upper = upper.min(found.upper);
            progress.interval(lower, upper);
        }
        let farthest = stages.farthest(progress).await?;
        let [(a_parameters, a), (b_parameters, b)] =
            [0, 1].map(|side| self.trees[side].middle(self.models[side].bezier(), farthest[side]));
        let a = self.transform.apply(a);
        let surface = |side: usize| self.trees[side].cells[farthest[side]].surface as usize;
        let tolerance = if options.absolute { options.tolerance } else { options.tolerance * self.diagonal };
        Ok(Directed {
            computed: a.distance(b),
            lower,
            upper,
            converged: upper - lower <= tolerance,
            from: surface_point(surface(0), a_parameters, a),
            to: surface_point(surface(1), b_parameters, b),
            details: Details::Hierarchy(HierarchyDetails { grid: options.grid, levels: pairs.len(), pairs }),
            field: Vec::new(),
        })
    }
}
