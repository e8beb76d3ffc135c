//! The dispatches of stage `project` on one group of patches.

use super::layouts::ProjectParams;
use crate::gpu::kernel::WORKGROUP_SIZE;
use crate::iteration::Culling;
use bytemuck::Zeroable;

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
    /// The next chunk's first thread, its number of threads and its first patch.
    thread: usize,
    thread_count: usize,
    patch: usize,
}

impl Schedule {
    /// The schedule of `samples` samples in rows of `columns`.
    pub(crate) fn new(samples: usize, columns: usize, patches: usize, culling: Culling) -> Self {
        let rows = samples.div_ceil(columns);
        Self {
            samples,
            columns,
            threads: columns.next_multiple_of(TILE[0]) * rows.next_multiple_of(TILE[1]),
            patches,
            culling,
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
        let patch_count = (units / self.thread_count).clamp(1, self.patches - self.patch);
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

    #[test]
    fn every_sample_is_projected_on_every_patch_once_at_any_throughput() {
        // 17 rows of 18 samples take threads for 18 of 20.
        let (samples, threads, patches) = (17 * 18, 18 * 20, 1700);
        let mut projections = vec![0_u8; threads * patches];
        let mut schedule = Schedule::new(samples, 18, patches, Culling::None);
        let mut units = [1, 70, 5000, 200_000, 64].into_iter().cycle();
        while let Some((params, [count, _])) = schedule.next(units.next().unwrap_or(1)) {
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
