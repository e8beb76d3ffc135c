//! The projection on one group of patches, chunk by chunk.

use crate::gpu::iteration::layouts::ProjectParams;
use crate::gpu::kernel::WORKGROUP_SIZE;
use crate::iteration::{Culling, Rule};
use bytemuck::Zeroable;

/// Turns of all loops of one invocation, at most: llvmpipe ends every loop
/// after 65,535, in the middle of whatever it sums.
const MAX_TURNS: usize = 60_000;

/// Evaluations a step of the projection takes, at most: the step and its halvings.
const EVALUATIONS_PER_STEP: usize = 10;

/// Columns and rows of samples that neighbouring threads have, as `sample_of` of `project.wgsl`.
const TILE: [usize; 2] = [4, 2];

/// Cuts samples, and without a tree also patches, into chunks.
pub(crate) struct Plan {
    samples: usize,
    columns: usize,
    /// Threads for the samples: some at the ends of rows have none.
    threads: usize,
    patches: usize,
    culling: Culling,
    /// Patches of a chunk, at most.
    most_patches: usize,
    thread: usize,
    thread_count: usize,
    patch: usize,
}

impl Plan {
    /// Of so many samples, in rows of `columns`.
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
            most_patches: (MAX_TURNS / turns).max(1),
            thread: 0,
            thread_count: 0,
            patch: 0,
        }
    }

    /// The part done by the chunks handed out.
    pub(crate) fn fraction_before(&self) -> f64 {
        let of_threads = self.patch as f64 / self.patches as f64 * self.thread_count as f64;
        (self.thread as f64 + of_threads) / self.threads as f64
    }

    /// The next chunk of about `units` units, a thread each with the tree, a
    /// thread on a patch each without: its params, threads and units.
    pub(crate) fn next(&mut self, units: usize) -> Option<(ProjectParams, [usize; 2])> {
        if self.thread >= self.threads {
            return None;
        }
        // The samples stay the same until they have met all patches.
        if self.patch == 0 {
            let wanted = units.next_multiple_of(WORKGROUP_SIZE as usize);
            self.thread_count = (self.threads - self.thread).min(wanted);
        }
        let mut params = ProjectParams {
            first_thread: self.thread as u32,
            sample_count: self.samples as u32,
            columns: self.columns as u32,
            ..Zeroable::zeroed()
        };
        if self.culling == Culling::Tree {
            self.thread += self.thread_count;
            return Some((params, [self.thread_count; 2]));
        }
        let wanted = (units / self.thread_count).clamp(1, self.most_patches);
        let patch_count = (self.patches - self.patch).min(wanted);
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
    fn every_sample_meets_every_patch_once_whatever_the_pace() {
        let rule = Rule {
            projection: Projection::Newton,
            iterations: 5,
            step_tolerance: 0.01,
            culling: Culling::None,
        };
        // 17 rows of 18 samples want threads for 18 of 20.
        let (samples, threads, patches) = (17 * 18, 18 * 20, 1700);
        let mut met = vec![0_u8; threads * patches];
        let mut plan = Plan::new(samples, 18, patches, [3, 3], &rule);
        let mut paces = [1, 70, 5000, 200_000, 64].into_iter().cycle();
        while let Some((params, [count, _])) = plan.next(paces.next().unwrap_or(1)) {
            // A bicubic chunk stays below the turns that llvmpipe allows: 5 a row of evaluation and step.
            assert!(params.patch_count * 5 * 52 <= 65_535);
            assert_eq!((params.sample_count as usize, params.columns), (samples, 18));
            let first = params.first_thread as usize;
            for thread in first..first + count {
                for patch in params.first_patch..params.first_patch + params.patch_count {
                    met[thread * patches + patch as usize] += 1;
                }
            }
        }
        assert!(met.iter().all(|&times| times == 1));
    }
}
