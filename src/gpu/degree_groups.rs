//! Patches of equal degree that fit a binding together.

use crate::bezier::PatchSet;
use crate::gpu::Gpu;
use crate::gpu::buffers::MAX_BINDING_BYTES;
use crate::gpu::float32::{power_of_two_to_one, rounded};
use glam::{DVec3, DVec4};

/// Patches of one pair of degrees on the GPU.
#[derive(Debug)]
pub(crate) struct Controls {
    /// Homogeneous controls relative to the centres.
    pub(crate) controls: wgpu::Buffer,
    /// The centres relative to the model's origin.
    pub(crate) centers: wgpu::Buffer,
}

/// Patches of `degree` that a binding holds.
pub(crate) fn most_patches(degree: [usize; 2]) -> usize {
    let bytes = (degree[0] + 1) * (degree[1] + 1) * size_of::<[f32; 4]>();
    MAX_BINDING_BYTES as usize / bytes
}

/// Lists of patches of equal degree, each within a binding, in order of degree.
pub(crate) fn by_degree(patches: &PatchSet) -> Vec<([usize; 2], Vec<u32>)> {
    let mut groups: Vec<([usize; 2], Vec<u32>)> = Vec::new();
    for (index, patch) in patches.iter().enumerate() {
        let open = |(degree, members): &&mut ([usize; 2], Vec<u32>)| {
            *degree == patch.degree && members.len() < most_patches(patch.degree)
        };
        match groups.iter_mut().find(open) {
            Some((_, members)) => members.push(index as u32),
            None => groups.push((patch.degree, vec![index as u32])),
        }
    }
    groups
}

impl Gpu {
    /// Uploads members of a set, of one degree, relative to `origin` and multiplied by
    /// `scale`, rounded once to float32. Their weights are made about 1, which
    /// leaves the points as they are.
    pub(crate) fn upload_patches(
        &self,
        patches: &PatchSet,
        members: &[u32],
        origin: DVec3,
        scale: f64,
    ) -> Controls {
        let mut controls: Vec<[f32; 4]> = Vec::new();
        let mut centers: Vec<[f32; 4]> = Vec::new();
        for &member in members {
            let patch = patches.patch(member as usize);
            let heaviest = patch.controls.iter().map(|control| control.w).fold(0.0, f64::max);
            let lighter = power_of_two_to_one(heaviest);
            let scaled = |&control: &DVec4| rounded(lighter * control * DVec3::splat(scale).extend(1.0));
            controls.extend(patch.controls.iter().map(scaled));
            centers.push(rounded((scale * (patch.center - origin)).extend(0.0)));
        }
        Controls { controls: self.upload("controls", &controls), centers: self.upload("centers", &centers) }
    }
}
