//! The parts and nodes of a tree of cells.

use super::Gpu;
use super::box_layouts::{Children, Part, WHOLE_MODEL};
use super::groups::{Controls, by_degree};
use super::rounding::{OwnFrame, rounded_up};
use super::upload_target::patch_error;
use crate::bezier::BezierModel;
use crate::hierarchy::{self, GridTree};
use glam::DVec3;

/// A tree of cells on the GPU, without boxes, which depend on where the model is.
#[derive(Debug)]
pub(crate) struct GpuCells {
    /// What the patches are relative to before they are moved.
    pub(super) origin: DVec3,
    /// What they are multiplied by.
    pub(super) scale: f64,
    /// Largest distance of a point from the origin.
    pub(super) radius: f64,
    pub(super) groups: Vec<PartGroup>,
    /// A node that is its own only child, then the nodes of every level above the parts.
    pub(super) root: wgpu::Buffer,
    pub(super) levels: Vec<wgpu::Buffer>,
    /// Numbers of nodes on every level, and of parts.
    pub(super) counts: Vec<usize>,
    /// The level of the cells.
    pub(super) finest: usize,
}

/// Parts on patches of one degree.
#[derive(Debug)]
pub(super) struct PartGroup {
    pub(super) degree: [usize; 2],
    pub(super) count: usize,
    pub(super) controls: Controls,
    pub(super) parts: wgpu::Buffer,
}

impl Gpu {
    /// Uploads the tree and the patches of its model.
    pub(crate) fn upload_cells(&self, model: &BezierModel, tree: &GridTree) -> GpuCells {
        let OwnFrame { origin, scale, radius } = OwnFrame::of(model.patches.bounding_box());
        let mut groups = Vec::new();
        for (degree, members) in by_degree(&model.patches) {
            let mut places = vec![None; model.patches.len()];
            for (place, &patch) in members.iter().enumerate() {
                places[patch as usize] = Some(place as u32);
            }
            let in_group = |(node, part): (usize, &hierarchy::CellPart)| {
                let growth = part.growth + patch_error(&model.patches.patch(part.patch));
                Some(Part {
                    s: part.s.map(|s| s as f32),
                    t: part.t.map(|t| t as f32),
                    patch_index: places[part.patch]?,
                    node: node as u32,
                    // No number where float32 cannot tell the weights from 0.
                    growth: rounded_up((scale * growth).min(f64::from(WHOLE_MODEL))),
                    padding: 0,
                })
            };
            let parts: Vec<Part> = tree.parts.iter().enumerate().filter_map(in_group).collect();
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
        GpuCells {
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
