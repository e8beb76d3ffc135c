//! The structs shared with the kernels of method `hierarchy`, field by field as in `shaders`.

use bytemuck::{Pod, Zeroable};

/// `BoxesParams` of `boxes.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct BoxesParams {
    pub(super) first: u32,
    pub(super) end: u32,
    pub(super) rescale: f32,
    pub(super) slack: f32,
    pub(super) rotation_x: [f32; 4],
    pub(super) rotation_y: [f32; 4],
    pub(super) rotation_z: [f32; 4],
    pub(super) translation: [f32; 4],
}

/// `Part` of `boxes.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Part {
    pub(super) s: [f32; 2],
    pub(super) t: [f32; 2],
    pub(super) patch_index: u32,
    pub(super) node: u32,
    pub(super) growth: f32,
    pub(super) padding: u32,
}

/// `Box` of `box.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Box {
    pub(super) low: [f32; 4],
    pub(super) high: [f32; 4],
}

/// `Children` of `box.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Children {
    pub(super) first: u32,
    pub(super) count: u32,
}

/// `StepParams` of `box.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct StepParams {
    pub(super) first: u32,
    pub(super) end: u32,
    pub(super) capacity: u32,
    pub(super) phase: u32,
}

/// `Totals` of `box.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Totals {
    pub(super) near: u32,
    pub(super) far: u32,
    pub(super) pairs: u32,
}

/// `Bound` of `bound.wgsl`, `extremes.wgsl`, `cull.wgsl` and `farthest.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Bound {
    pub(super) near: u32,
    pub(super) far: u32,
}

/// `Farthest` of `farthest.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Farthest {
    pub(super) a: u32,
    pub(super) far: u32,
    pub(super) b: u32,
}

/// `StepParams::phase` of stage `farthest`, in the order they are run.
pub(super) const OF_CELLS: u32 = 0;
pub(super) const OF_DISTANCES: u32 = 1;
pub(super) const OF_PARTNERS: u32 = 2;

/// `WHOLE_MODEL` of `boxes.wgsl`: more than twice the largest radius, which is below 2.
pub(super) const WHOLE_MODEL: f32 = 4.0;
