//! The parts and nodes of a tree of cells on the GPU.

use super::layouts::{Children, Part, WHOLE_MODEL};
use crate::bezier::BezierModel;
use crate::gpu::Gpu;
use crate::gpu::degree_groups::{Controls, by_degree};
use crate::gpu::float32::{ModelFrame, patch_error, round_up};
use crate::hierarchy::{self, GridTree};
use glam::DVec3;

/// A tree of cells on the GPU, without boxes, which depend on the model's position.
#[derive(Debug)]
pub(crate) struct GpuGridTree {
    /// The origin of the coordinates before the model is moved.
    pub(crate) origin: DVec3,
    /// The factor of the coordinates before the model is moved.
    pub(crate) scale: f64,
    /// Upper bound on the distance of a point from the origin.
    pub(crate) radius: f64,
    pub(crate) groups: Vec<PartGroup>,
    /// A root that is its own only child, for the model with fewer levels.
    pub(crate) root: wgpu::Buffer,
    /// The nodes of every level above the parts.
    pub(crate) levels: Vec<wgpu::Buffer>,
    /// Numbers of nodes on every level, and of parts.
    pub(crate) counts: Vec<usize>,
    /// The level of the cells.
    pub(crate) finest: usize,
}

/// Parts on patches of one degree.
#[derive(Debug)]
pub(crate) struct PartGroup {
    pub(crate) degree: [usize; 2],
    pub(crate) count: usize,
    pub(crate) controls: Controls,
    pub(crate) parts: wgpu::Buffer,
}

impl Gpu {
    /// Uploads the tree and the patches of its model.
    pub(crate) fn upload_grid_tree(&self, model: &BezierModel, tree: &GridTree) -> GpuGridTree {
        let ModelFrame { origin, scale, radius } = ModelFrame::new(model.patches.bounding_box());
        let mut groups = Vec::new();
        for (degree, members) in by_degree(&model.patches) {
            let mut index_in_group = vec![None; model.patches.len()];
            for (index, &patch) in members.iter().enumerate() {
                index_in_group[patch as usize] = Some(index as u32);
            }
            let member = |(node, part): (usize, &hierarchy::CellPart)| {
                let growth = part.growth + patch_error(&model.patches.patch(part.patch));
                Some(Part {
                    s: part.s.map(|s| s as f32),
                    t: part.t.map(|t| t as f32),
                    patch_index: index_in_group[part.patch]?,
                    node: node as u32,
                    // The error is NaN or infinite where float32 does not distinguish the weights
                    // from 0; `min` then returns the other number.
                    growth: round_up((scale * growth).min(f64::from(WHOLE_MODEL))),
                    padding: 0,
                })
            };
            let parts: Vec<Part> = tree.parts.iter().enumerate().filter_map(member).collect();
            groups.push(PartGroup {
                degree,
                count: parts.len(),
                controls: self.upload_patches(&model.patches, &members, origin, scale),
                parts: self.upload("parts", &parts),
            });
        }
        let node =
            |&hierarchy::ChildRange { first, count }: &hierarchy::ChildRange| Children { first, count };
        let level = |nodes: &Vec<hierarchy::ChildRange>| {
            self.upload("nodes", &nodes.iter().map(node).collect::<Vec<_>>())
        };
        GpuGridTree {
            origin,
            scale,
            radius,
            groups,
            root: self.upload("root", &[Children { first: 0, count: 1 }]),
            levels: tree.levels.iter().map(level).collect(),
            counts: tree.levels.iter().map(Vec::len).chain([tree.parts.len()]).collect(),
            finest: tree.finest,
        }
    }
}
