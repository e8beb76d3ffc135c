//! The stages of method `hierarchy` on either backend.

use super::cpu::{descend, farthest};
use crate::error::Result;
use crate::gpu::GpuHierarchy;
use crate::hierarchy::{LevelBounds, Traversal};
use crate::progress::Progress;

/// A traversal of two trees, which starts at the pair of roots.
pub(super) enum HierarchyBackend<'a> {
    /// In float64.
    Cpu(Traversal<'a>),
    /// In float32.
    Gpu(Box<GpuHierarchy>),
}

impl HierarchyBackend<'_> {
    /// Returns the number of levels below the roots.
    pub(super) fn levels(&self) -> usize {
        match self {
            Self::Cpu(traversal) => traversal.finest(),
            Self::Gpu(hierarchy) => hierarchy.levels(),
        }
    }

    /// Runs the stages on the level below, and moves there unless it has more than
    /// `max_pairs` pairs.
    pub(super) async fn descend(
        &mut self,
        max_pairs: usize,
        progress: &mut Progress<'_>,
    ) -> Result<LevelBounds> {
        match self {
            Self::Cpu(traversal) => descend(traversal, max_pairs, progress).await,
            Self::Gpu(hierarchy) => hierarchy.descend(max_pairs, progress).await,
        }
    }

    /// Returns, on the last level, the cell of A with the largest lower bound and its
    /// nearest cell of B.
    pub(super) async fn farthest(&self, progress: &mut Progress<'_>) -> Result<[usize; 2]> {
        match self {
            Self::Cpu(traversal) => farthest(traversal, progress).await,
            Self::Gpu(hierarchy) => hierarchy.farthest(progress).await,
        }
    }
}
