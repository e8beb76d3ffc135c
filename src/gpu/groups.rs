//! Patches of equal degree that fit a binding together.

use super::Gpu;
use super::buffers::MOST_BINDING_BYTES;
use crate::bezier::{Patch, PatchSet};
use crate::error::Result;
use glam::{DVec3, DVec4};

/// Patches of one pair of degrees on the GPU.
#[derive(Debug)]
pub(super) struct Controls {
    /// Homogeneous controls relative to the centres.
    pub(super) controls: wgpu::Buffer,
    /// The centres relative to the model's origin.
    pub(super) centers: wgpu::Buffer,
}

/// Patches of `degree` that a binding holds.
pub(super) fn most_patches(degree: [usize; 2]) -> usize {
    let bytes = (degree[0] + 1) * (degree[1] + 1) * size_of::<[f32; 4]>();
    MOST_BINDING_BYTES as usize / bytes
}

/// Lists of patches of equal degree, each within a binding, in order of degree.
pub(super) fn by_degree(patches: &PatchSet) -> Vec<([usize; 2], Vec<usize>)> {
    let mut groups: Vec<([usize; 2], Vec<usize>)> = Vec::new();
    for (index, patch) in patches.iter().enumerate() {
        let open = |(degree, members): &&mut ([usize; 2], Vec<usize>)| {
            *degree == patch.degree && members.len() < most_patches(patch.degree)
        };
        match groups.iter_mut().find(open) {
            Some((_, members)) => members.push(index),
            None => groups.push((patch.degree, vec![index])),
        }
    }
    groups
}

impl Gpu {
    /// Uploads patches of one degree, rounded once to float32.
    pub(super) fn upload_patches<'a>(
        &self,
        patches: impl Iterator<Item = Patch<'a>>,
        origin: DVec3,
    ) -> Result<Controls> {
        let mut controls: Vec<[f32; 4]> = Vec::new();
        let mut centers: Vec<[f32; 4]> = Vec::new();
        for patch in patches {
            controls.extend(patch.controls.iter().map(|&control| rounded(control)));
            centers.push(rounded((patch.center - origin).extend(0.0)));
        }
        Ok(Controls {
            controls: self.upload("controls", &controls)?,
            centers: self.upload("centers", &centers)?,
        })
    }
}

/// To the nearest float32.
pub(super) fn rounded(vector: DVec4) -> [f32; 4] {
    vector.to_array().map(|value| value as f32)
}
