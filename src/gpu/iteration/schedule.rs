//! The dispatches of stage `project` on one group of patches.

use super::layouts::ProjectParams;
use crate::closest::MAX_HALVINGS;
use crate::gpu::kernel::WORKGROUP_SIZE;
use crate::iteration::{Culling, Rule};
use bytemuck::Zeroable;

/// The most turns of all loops of one thread.
///
/// Mesa's llvmpipe, on which our tests run and which browsers without a
/// hardware adapter may offer, ends every loop of a thread silently once all
/// its loops together made 65,535 turns. A sum over a patch's rows that ends
/// early is a wrong point, and its distance no upper bound. Hence all kernels
/// stay below that number.
const MAX_TURNS: usize = 60_000;

/// The most turns that the tree search of one thread may count. llvmpipe runs
/// up to 16 threads as one, which together make the turns of each.
pub(crate) const MAX_TURNS_OF_TREE: u32 = 4_000;

/// The most evaluations of a step of the projection: the step and its halvings.
const EVALUATIONS_PER_STEP: usize = MAX_HALVINGS as usize + 2;

/// Columns and rows of the tile of samples that neighbouring threads project,
/// in `sample_of` of `project.wgsl`.
pub(crate) const TILE: [usize; 2] = [4, 2];

/// Cuts samples, and without a tree also patches, into chunks.
pub(crate) struct Schedule {
    samples: usize,
    columns: usize,
    /// Threads of all samples; those of incomplete tiles have no sample.
    threads: usize,
    patches: usize,
    culling: Culling,
    /// The most patches of a chunk.
    max_patches: usize,
    /// The next chunk's first thread, its number of threads and its first patch.
    thread: usize,
    thread_count: usize,
    patch: usize,
}

impl Schedule {
    /// The schedule of `samples` samples in rows of `columns`.
    pub(crate) fn new(
        samples: usize,
        columns: usize,
        patches: usize,
        degree: [usize; 2],
        rule: &Rule,
    ) -> Self {
        let evaluations = 2 + EVALUATIONS_PER_STEP * rule.iterations as usize;
        // As `offer` of `project.wgsl` counts them.
        let turns = (degree[0] + 2) * evaluations;
        let rows = samples.div_ceil(columns);
        Self {
            samples,
            columns,
            threads: columns.next_multiple_of(TILE[0]) * rows.next_multiple_of(TILE[1]),
            patches,
            culling: rule.culling,
            max_patches: (MAX_TURNS / turns).max(1),
            thread: 0,
            thread_count: 0,
            patch: 0,
        }
    }

    /// The fraction of the work in the chunks returned so far, from 0 to 1.
    pub(crate) fn fraction_done(&self) -> f64 {
        let threads_in_progress = self.patch as f64 / self.patches as f64 * self.thread_count as f64;
        (self.thread as f64 + threads_in_progress) / self.threads as f64
    }

    /// Returns the next chunk of about `units` units: its params, threads and
    /// units. A unit is a thread with the tree, a thread on one patch without.
    pub(crate) fn next(&mut self, units: usize) -> Option<(ProjectParams, [usize; 2])> {
        if self.thread >= self.threads {
            return None;
        }
        // The threads stay the same until they have projected on all patches.
        if self.patch == 0 {
            let thread_count = units.next_multiple_of(WORKGROUP_SIZE as usize);
            self.thread_count = (self.threads - self.thread).min(thread_count);
        }
        let mut params = ProjectParams {
            first_thread: self.thread as u32,
            sample_count: self.samples as u32,
            column_count: self.columns as u32,
            ..Zeroable::zeroed()
        };
        if self.culling == Culling::Tree {
            self.thread += self.thread_count;
            return Some((params, [self.thread_count; 2]));
        }
        let patch_count = (units / self.thread_count).clamp(1, self.max_patches);
        let patch_count = (self.patches - self.patch).min(patch_count);
        params.first_patch = self.patch as u32;
        params.patch_count = patch_count as u32;
        self.patch += patch_count;
        let threads = self.thread_count;
        if self.patch >= self.patches {
            self.patch = 0;
            self.thread += threads;
        }
        Some((params, [threads, threads * patch_count]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closest::Projection;

    #[test]
    fn every_sample_is_projected_on_every_patch_once_at_any_throughput() {
        let rule = Rule {
            projection: Projection::Newton,
            iterations: 5,
            step_tolerance: 0.01,
            culling: Culling::None,
        };
        // 17 rows of 18 samples take threads for 18 of 20.
        let (samples, threads, patches) = (17 * 18, 18 * 20, 1700);
        let mut projections = vec![0_u8; threads * patches];
        let mut schedule = Schedule::new(samples, 18, patches, [3, 3], &rule);
        let mut units = [1, 70, 5000, 200_000, 64].into_iter().cycle();
        while let Some((params, [count, _])) = schedule.next(units.next().unwrap_or(1)) {
            // A bicubic chunk stays below the turns that llvmpipe allows: 5 a row of evaluation and step.
            assert!(params.patch_count * 5 * 52 <= 65_535);
            assert_eq!((params.sample_count as usize, params.column_count), (samples, 18));
            let first = params.first_thread as usize;
            for thread in first..first + count {
                for patch in params.first_patch..params.first_patch + params.patch_count {
                    projections[thread * patches + patch as usize] += 1;
                }
            }
        }
        assert!(projections.iter().all(|&count| count == 1));
    }
}
