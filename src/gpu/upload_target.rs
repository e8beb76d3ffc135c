//! The flat patches that samples are projected on, with their trees.

use super::Gpu;
use super::groups::{Controls, by_degree};
use super::layouts::Node;
#[cfg(not(target_arch = "wasm32"))]
use super::packet_tree::packet_nodes;
use super::rounding::{OwnFrame, ROUNDING, rounded_down, rounded_up};
use crate::bvh::{Aabb, Bvh};
use crate::closest::Target;
use glam::DVec3;

/// A target on the GPU.
#[derive(Debug)]
pub(crate) struct GpuTarget {
    /// What everything on the GPU is relative to.
    pub(super) origin: DVec3,
    /// What everything on the GPU is multiplied by.
    pub(super) scale: f64,
    pub(super) groups: Vec<TargetGroup>,
    /// The target's patch of every patch on the GPU, group by group.
    pub(super) patches: Vec<u32>,
    /// Bound of the error of a foot's coordinates in float32.
    pub(super) coordinate_error: f64,
    /// Largest distance of a point from the origin.
    pub(super) radius: f64,
}

/// Patches of one degree with a tree of their own, in the order of its leaves.
#[derive(Debug)]
pub(super) struct TargetGroup {
    pub(super) degree: [usize; 2],
    pub(super) count: usize,
    pub(super) patches_before: usize,
    pub(super) controls: Controls,
    pub(super) nodes: wgpu::Buffer,
}

/// Roundings on the way to a point, per degree and besides, in units of the
/// patch's largest homogeneous coordinate: a basis function takes two a degree
/// and direction, the sums two more a term, the rounded parameter half a one a
/// degree, and centre and difference a few.
const ROUNDINGS_PER_DEGREE: f64 = 4.0;
const ROUNDINGS_BESIDES: f64 = 16.0;

impl Gpu {
    /// Uploads the target's patches group by group.
    pub(crate) fn upload_target(&self, target: &Target) -> GpuTarget {
        let aabb = target.tree.nodes().first().map_or(Aabb::EMPTY, |root| root.aabb);
        let OwnFrame { origin, scale, radius } = OwnFrame::of(aabb);
        let mut groups = Vec::new();
        let mut patches: Vec<u32> = Vec::with_capacity(target.patches.len());
        let mut coordinate_error = 0.0_f64;
        for (degree, members) in by_degree(&target.patches) {
            let mut boxes: Vec<Aabb> = Vec::with_capacity(members.len());
            for &member in &members {
                let patch = target.patches.patch(member as usize);
                boxes.push(patch.bounding_box());
                coordinate_error = coordinate_error.max(patch_error(&patch));
            }
            let tree = Bvh::new(&boxes);
            let nodes = self.nodes(&tree, &|of, place| node(of, place, origin, scale));
            let patches_before = patches.len();
            patches.extend(tree.order().iter().map(|&place| members[place as usize]));
            groups.push(TargetGroup {
                degree,
                count: members.len(),
                patches_before,
                controls: self.upload_patches(&target.patches, &patches[patches_before..], origin, scale),
                nodes: self.upload("nodes", &nodes),
            });
        }
        GpuTarget { origin, scale, groups, patches, coordinate_error, radius }
    }

    /// The tree as stage `project` goes through it.
    fn nodes(&self, tree: &Bvh, pack: &dyn Fn(&crate::bvh::Node, u32) -> Node) -> Vec<Node> {
        #[cfg(not(target_arch = "wasm32"))]
        if self.pipelines.lanes > 0 {
            return packet_nodes(tree, self.pipelines.lanes as usize, pack);
        }
        let place = |index: usize, of: &crate::bvh::Node| {
            if of.is_leaf() { leaf_place(of) } else { 2 * index as u32 }
        };
        tree.nodes().iter().enumerate().map(|(index, of)| pack(of, place(index, of))).collect()
    }
}

/// What tells the kernels a leaf's patch: odd, where an inner node's place is even.
pub(super) fn leaf_place(leaf: &crate::bvh::Node) -> u32 {
    2 * leaf.first_leaf + 1
}

/// Bound of the error of a point of `patch` computed in float32 from rounded
/// controls, relative to the patch's centre: the roundings of the numerator
/// and of the weight, each at most the roundings above times the largest
/// weight, over the smallest, times the radius, which is at least any point's.
pub(super) fn patch_error(patch: &crate::bezier::Patch<'_>) -> f64 {
    let radius = patch.local_points().fold(0.0_f64, |radius, point| radius.max(point.length()));
    let weights = patch.controls.iter().map(|control| control.w);
    let ratio = weights.clone().fold(0.0, f64::max) / weights.fold(f64::INFINITY, f64::min);
    let degrees = (patch.degree[0] + patch.degree[1]) as f64;
    2.0 * (ROUNDINGS_PER_DEGREE * degrees + ROUNDINGS_BESIDES) * ROUNDING * ratio * radius
}

/// A node with its box rounded outwards.
fn node(node: &crate::bvh::Node, place: u32, origin: DVec3, scale: f64) -> Node {
    Node {
        box_min: (scale * (node.aabb.min - origin)).to_array().map(rounded_down),
        place,
        box_max: (scale * (node.aabb.max - origin)).to_array().map(rounded_up),
        second: node.right_child,
    }
}
