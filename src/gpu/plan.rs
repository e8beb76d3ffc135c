//! The projection on one group of patches, chunk by chunk.

use super::layouts::ProjectParams;
use super::pipelines::WORKGROUP_SIZE;
use crate::iteration::{Culling, Rule};
use bytemuck::Zeroable;

/// Turns of all loops of one invocation, at most: llvmpipe ends every loop
/// after 65,535, in the middle of whatever it sums.
const MOST_TURNS: usize = 60_000;

/// Evaluations a step of the projection takes, at most: the step and its halvings.
const EVALUATIONS_PER_STEP: usize = 10;

/// Cuts samples, and without a tree also patches, into chunks.
pub(super) struct Plan {
    samples: usize,
    patches: usize,
    culling: Culling,
    /// Patches of a chunk, at most.
    most_patches: usize,
    sample: usize,
    sample_count: usize,
    patch: usize,
}

impl Plan {
    pub(super) fn new(samples: usize, patches: usize, degree: [usize; 2], rule: &Rule) -> Self {
        let evaluations = 2 + EVALUATIONS_PER_STEP * rule.iterations as usize;
        // As `offer` of `project.wgsl` counts them.
        let turns = (degree[0] + 2) * evaluations;
        Self {
            samples,
            patches,
            culling: rule.culling,
            most_patches: (MOST_TURNS / turns).max(1),
            sample: 0,
            sample_count: 0,
            patch: 0,
        }
    }

    /// The part done by the chunks handed out.
    pub(super) fn fraction_before(&self) -> f64 {
        let of_samples = self.patch as f64 / self.patches as f64 * self.sample_count as f64;
        (self.sample as f64 + of_samples) / self.samples as f64
    }

    /// The next chunk of about `units` units, a sample each with the tree, a
    /// sample on a patch each without.
    pub(super) fn next(&mut self, units: usize) -> Option<(ProjectParams, usize)> {
        if self.sample >= self.samples {
            return None;
        }
        // The samples stay the same until they have met all patches.
        if self.patch == 0 {
            self.sample_count = (self.samples - self.sample).min(units.max(WORKGROUP_SIZE as usize));
        }
        let mut params = ProjectParams {
            first_sample: self.sample as u32,
            sample_count: self.sample_count as u32,
            ..Zeroable::zeroed()
        };
        if self.culling == Culling::Tree {
            self.sample += self.sample_count;
            return Some((params, self.sample_count));
        }
        let wanted = (units / self.sample_count).clamp(1, self.most_patches);
        let patch_count = (self.patches - self.patch).min(wanted);
        params.first_patch = self.patch as u32;
        params.patch_count = patch_count as u32;
        self.patch += patch_count;
        if self.patch >= self.patches {
            self.patch = 0;
            self.sample += self.sample_count;
        }
        Some((params, self.sample_count * patch_count))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::Projection;

    #[test]
    fn every_sample_meets_every_patch_once_whatever_the_pace() {
        let rule = Rule {
            projection: Projection::Newton,
            iterations: 5,
            step_tolerance: 0.01,
            culling: Culling::None,
        };
        let (samples, patches) = (300, 1700);
        let mut met = vec![0_u8; samples * patches];
        let mut plan = Plan::new(samples, patches, [3, 3], &rule);
        let mut paces = [1, 70, 5000, 200_000, 64].into_iter().cycle();
        while let Some((params, _)) = plan.next(paces.next().unwrap_or(1)) {
            // A bicubic chunk stays below the turns that llvmpipe allows: 5 a row of evaluation and step.
            assert!(params.patch_count * 5 * 52 <= 65_535);
            for sample in params.first_sample..params.first_sample + params.sample_count {
                for patch in params.first_patch..params.first_patch + params.patch_count {
                    met[sample as usize * patches + patch as usize] += 1;
                }
            }
        }
        assert!(met.iter().all(|&times| times == 1));
    }
}
