//! The subpatches that points are measured to.

use super::subpatches::Subpatches;
use crate::closest::Target;
use crate::gpu::Gpu;
use crate::gpu::subpatch_domain::SubpatchDomain;
use crate::gpu::target::GpuTarget;

/// A target on the GPU, cut finely.
#[derive(Debug)]
pub(crate) struct GpuPointTarget {
    pub(crate) subpatches: GpuTarget,
    /// Where each subpatch is, in the order of the GPU, group by group.
    pub(crate) domains: Vec<SubpatchDomain>,
    /// The patch of each subpatch, for each group.
    pub(crate) owners: Vec<wgpu::Buffer>,
    /// Upper bound on the distance between a point of the target and that of the copy, in model units; +∞ if a patch is
    /// beyond float32.
    pub(crate) error: f64,
}

impl Gpu {
    /// Cuts and uploads a target. O(n log n) for n subpatches.
    pub(crate) fn upload_point_target(&self, target: &Target) -> GpuPointTarget {
        let cut = Subpatches::new(target);
        let subpatches = self.upload_target(&cut.target);
        let domain = |&index: &u32| cut.domains[index as usize];
        let domains: Vec<SubpatchDomain> = subpatches.patches.iter().map(domain).collect();
        let owners = subpatches.groups.iter().map(|group| {
            let members = &domains[group.patches_before..][..group.count];
            self.upload("owners", &members.iter().map(|domain| domain.patch).collect::<Vec<u32>>())
        });
        let owners = owners.collect();
        let error = subpatches.representation_error + cut.error;
        GpuPointTarget { subpatches, domains, owners, error }
    }
}
