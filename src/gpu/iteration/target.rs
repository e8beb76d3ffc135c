//! The flat patches that samples are projected on, with their trees.

use crate::bvh::{Aabb, Bvh};
use crate::closest::Target;
use crate::gpu::Gpu;
use crate::gpu::degree_groups::{Controls, by_degree};
use crate::gpu::float32::{OwnFrame, ROUNDING, rounded_down, rounded_up};
use crate::gpu::iteration::layouts::Node;
use glam::DVec3;

/// A target on the GPU.
#[derive(Debug)]
pub(crate) struct GpuTarget {
    /// What everything on the GPU is relative to.
    pub(crate) origin: DVec3,
    /// What everything on the GPU is multiplied by.
    pub(crate) scale: f64,
    pub(crate) groups: Vec<TargetGroup>,
    /// The target's patch of every patch on the GPU, group by group.
    pub(crate) patches: Vec<u32>,
    /// Bound of the error of a foot's coordinates in float32.
    pub(crate) coordinate_error: f64,
    /// Largest distance of a point from the origin.
    pub(crate) radius: f64,
}

/// Patches of one degree with a tree of their own, in the order of its leaves.
#[derive(Debug)]
pub(crate) struct TargetGroup {
    pub(crate) degree: [usize; 2],
    pub(crate) count: usize,
    pub(crate) patches_before: usize,
    pub(crate) controls: Controls,
    pub(crate) nodes: wgpu::Buffer,
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
            let nodes = nodes(&tree, origin, scale);
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
}

/// The tree's nodes as stage `project` traverses them.
fn nodes(tree: &Bvh, origin: DVec3, scale: f64) -> Vec<Node> {
    tree.nodes().iter().enumerate().map(|(index, of)| node(of, index, origin, scale)).collect()
}

/// Bound of the error of a point of `patch` computed in float32 from rounded
/// controls, relative to the patch's centre: the roundings of the numerator
/// and of the weight, each at most the roundings above times the largest
/// weight, over the smallest, times the radius, which is at least any point's.
pub(crate) fn patch_error(patch: &crate::bezier::Patch<'_>) -> f64 {
    let radius = patch.local_points().fold(0.0_f64, |radius, point| radius.max(point.length()));
    let weights = patch.controls.iter().map(|control| control.w);
    let ratio = weights.clone().fold(0.0, f64::max) / weights.fold(f64::INFINITY, f64::min);
    let degrees = (patch.degree[0] + patch.degree[1]) as f64;
    2.0 * (ROUNDINGS_PER_DEGREE * degrees + ROUNDINGS_BESIDES) * ROUNDING * ratio * radius
}

/// A node with its box rounded outwards. Leaves have odd codes, inner nodes even ones.
fn node(node: &crate::bvh::Node, index: usize, origin: DVec3, scale: f64) -> Node {
    let place = if node.is_leaf() { 2 * node.first + 1 } else { 2 * index as u32 };
    Node {
        box_min: (scale * (node.aabb.min - origin)).to_array().map(rounded_down),
        place,
        box_max: (scale * (node.aabb.max - origin)).to_array().map(rounded_up),
        second: node.second,
    }
}
