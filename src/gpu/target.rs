//! The flat patches that points are projected on, with their BVHs.

use super::Gpu;
use super::degree_groups::{Controls, by_degree};
use super::float32::{ModelFrame, patch_error, representation_error, round_down, round_up};
use crate::bvh::{self, Bvh};
use crate::closest::Target;
use crate::rounding::upper_max;
use bytemuck::{Pod, Zeroable};
use glam::DVec3;

/// `Node` of `tree.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Node {
    pub(crate) box_min: [f32; 3],
    pub(crate) code: u32,
    pub(crate) box_max: [f32; 3],
    pub(crate) right_child: u32,
}

/// A target on the GPU.
#[derive(Debug)]
pub(crate) struct GpuTarget {
    /// The origin of all coordinates on the GPU.
    pub(crate) origin: DVec3,
    /// The factor of all coordinates on the GPU.
    pub(crate) scale: f64,
    pub(crate) groups: Vec<TargetGroup>,
    /// The target's patch of every patch on the GPU, group by group.
    pub(crate) patches: Vec<u32>,
    /// Upper bound on the error of a point in float32, in model units.
    pub(crate) coordinate_error: f64,
    /// Upper bound on the distance between a patch and its copy, evaluated exactly, in model units; +∞ if a patch is
    /// beyond float32.
    pub(crate) representation_error: f64,
    /// Upper bound on the distance of a point from the origin.
    pub(crate) radius: f64,
}

/// Patches of one degree with a BVH of their own, in the order of its leaves.
#[derive(Debug)]
pub(crate) struct TargetGroup {
    pub(crate) degree: [usize; 2],
    pub(crate) count: usize,
    /// Number of patches in the groups before this one.
    pub(crate) patches_before: usize,
    pub(crate) controls: Controls,
    pub(crate) nodes: wgpu::Buffer,
}

impl Gpu {
    /// Uploads the target's patches group by group. O(n log n) for n patches.
    pub(crate) fn upload_target(&self, target: &Target) -> GpuTarget {
        let aabb = target.tree.bounding_box();
        let frame = ModelFrame::new(aabb);
        let mut groups = Vec::new();
        let mut patches: Vec<u32> = Vec::with_capacity(target.patches.len());
        for (degree, members) in by_degree(&target.patches) {
            let aabb = |&member: &u32| target.patches.patch(member as usize).bounding_box();
            let tree = Bvh::new(&members.iter().map(aabb).collect::<Vec<_>>());
            let nodes = tree.nodes().iter().enumerate().map(|(index, node)| packed(node, index, &frame));
            let nodes: Vec<Node> = nodes.collect();
            let patches_before = patches.len();
            patches.extend(tree.order().iter().map(|&place| members[place as usize]));
            let members = &patches[patches_before..];
            groups.push(TargetGroup {
                degree,
                count: members.len(),
                patches_before,
                controls: self.upload_patches(&target.patches, members, frame.origin, frame.scale),
                nodes: self.upload("nodes", &nodes),
            });
        }
        let coordinate_error = target.patches.iter().map(|patch| patch_error(&patch)).fold(0.0, f64::max);
        let representation_error =
            target.patches.iter().map(|patch| representation_error(&patch, &frame)).fold(0.0, upper_max);
        let ModelFrame { origin, scale, radius } = frame;
        GpuTarget { origin, scale, groups, patches, coordinate_error, representation_error, radius }
    }
}

/// The node of this index with its box rounded outwards. A leaf has an odd
/// code, twice its patch plus one; an inner node has twice its own index.
fn packed(node: &bvh::Node, index: usize, frame: &ModelFrame) -> Node {
    Node {
        box_min: (frame.scale * (node.aabb.min - frame.origin)).to_array().map(round_down),
        code: if node.is_leaf() { 2 * node.first_leaf + 1 } else { 2 * index as u32 },
        box_max: (frame.scale * (node.aabb.max - frame.origin)).to_array().map(round_up),
        right_child: node.right_child,
    }
}
