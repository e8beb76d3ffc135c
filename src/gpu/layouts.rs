//! The structs shared with the kernels, field by field as in `shaders`.

use bytemuck::{Pod, Zeroable};

/// `SampleParams` of `sample.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct SampleParams {
    pub(super) rotation_x: [f32; 4],
    pub(super) rotation_y: [f32; 4],
    pub(super) rotation_z: [f32; 4],
    pub(super) translation: [f32; 4],
    pub(super) first_row: u32,
    pub(super) row_count: u32,
    pub(super) columns: u32,
    pub(super) padding: u32,
}

/// `Row` of `sample.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Row {
    pub(super) first_patch: u32,
    pub(super) first_place: u32,
    pub(super) s: f32,
    pub(super) first_sample: u32,
}

/// `Place` of `sample.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Place {
    pub(super) patch_column: u32,
    pub(super) t: f32,
}

/// `ProjectParams` of `project.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct ProjectParams {
    pub(super) first_sample: u32,
    pub(super) sample_count: u32,
    pub(super) first_patch: u32,
    pub(super) patch_count: u32,
    pub(super) patches_before: u32,
    pub(super) iterations: u32,
    pub(super) step_tolerance: f32,
    pub(super) padding: u32,
}

/// `Node` of `project.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Node {
    pub(super) box_min: [f32; 3],
    pub(super) second: u32,
    pub(super) box_max: [f32; 3],
    pub(super) patches: u32,
}

/// Bits of `Node::patches` for the number of a leaf's patches.
pub(super) const LEAF_COUNT_BITS: u32 = 2;

/// `Best` of `best.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Best {
    pub(super) distance_squared: f32,
    pub(super) patch_and_status: u32,
    pub(super) s: f32,
    pub(super) t: f32,
}

/// Bits of `Best::patch_and_status` for the patch.
pub(super) const STATUS_SHIFT: u32 = 30;

/// `ReduceParams` of `reduce.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct ReduceParams {
    pub(super) sample_count: u32,
    pub(super) block_size: u32,
}

/// `Block` of `reduce.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Block {
    pub(super) best: Best,
    pub(super) sample: u32,
    pub(super) converged: u32,
    pub(super) iteration_limit: u32,
    pub(super) on_edge: u32,
}
