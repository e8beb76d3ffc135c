//! Groups of patches of equal degree, each within one binding.

use super::Gpu;
use super::buffers::MAX_BINDING_BYTES;
use super::float32::{ScaledPatch, round};
use crate::bezier::PatchSet;
use glam::DVec3;

/// The control points of patches of one pair of degrees on the GPU.
#[derive(Debug)]
pub(crate) struct Controls {
    /// Homogeneous control points relative to the patches' centres.
    pub(crate) controls: wgpu::Buffer,
    /// The centres relative to the model's origin.
    pub(crate) centers: wgpu::Buffer,
}

/// The most patches of `degree` whose controls fit one binding.
pub(crate) fn max_patches(degree: [usize; 2]) -> usize {
    let bytes = (degree[0] + 1) * (degree[1] + 1) * size_of::<[f32; 4]>();
    MAX_BINDING_BYTES as usize / bytes
}

/// The indices of all patches in groups of equal degree, each within a
/// binding, in the order of their first members. O(patches groups).
pub(crate) fn by_degree(patches: &PatchSet) -> Vec<([usize; 2], Vec<u32>)> {
    let mut groups: Vec<([usize; 2], Vec<u32>)> = Vec::new();
    for (index, patch) in patches.iter().enumerate() {
        let is_open = |(degree, members): &&mut ([usize; 2], Vec<u32>)| {
            *degree == patch.degree && members.len() < max_patches(patch.degree)
        };
        match groups.iter_mut().find(is_open) {
            Some((_, members)) => members.push(index as u32),
            None => groups.push((patch.degree, vec![index as u32])),
        }
    }
    groups
}

impl Gpu {
    /// Uploads patches of one degree, relative to `origin` and multiplied by
    /// `scale`, rounded once to float32. Their homogeneous controls are scaled
    /// to weights about 1, which leaves the points as they are.
    pub(crate) fn upload_patches(
        &self,
        patches: &PatchSet,
        members: &[u32],
        origin: DVec3,
        scale: f64,
    ) -> Controls {
        let mut controls: Vec<[f32; 4]> = Vec::new();
        let mut centers: Vec<[f32; 4]> = Vec::with_capacity(members.len());
        for &member in members {
            let patch = patches.patch(member as usize);
            let scaled = ScaledPatch::new(&patch, origin, scale);
            controls.extend(scaled.controls().map(round));
            centers.push(round(scaled.center.extend(0.0)));
        }
        Controls { controls: self.upload("controls", &controls), centers: self.upload("centers", &centers) }
    }
}
