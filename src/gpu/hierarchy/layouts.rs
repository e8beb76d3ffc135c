//! The structs shared with the kernels of method `hierarchy`, field by field as in `shaders`.

use bytemuck::{Pod, Zeroable};

/// `BoxesParams` of `boxes.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct BoxesParams {
    pub(crate) first: u32,
    pub(crate) end: u32,
    pub(crate) rescale: f32,
    pub(crate) slack: f32,
    pub(crate) rotation_x: [f32; 4],
    pub(crate) rotation_y: [f32; 4],
    pub(crate) rotation_z: [f32; 4],
    pub(crate) translation: [f32; 4],
}

/// `Part` of `boxes.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Part {
    pub(crate) s: [f32; 2],
    pub(crate) t: [f32; 2],
    pub(crate) patch_index: u32,
    pub(crate) node: u32,
    pub(crate) growth: f32,
    pub(crate) padding: u32,
}

/// `Box` of `box.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Box {
    pub(crate) low: [f32; 4],
    pub(crate) high: [f32; 4],
}

/// `Children` of `box.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Children {
    pub(crate) first: u32,
    pub(crate) count: u32,
}

/// `StepParams` of `box.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct StepParams {
    pub(crate) first: u32,
    pub(crate) end: u32,
    pub(crate) capacity: u32,
    pub(crate) phase: u32,
}

/// `Totals` of `box.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Totals {
    pub(crate) near: u32,
    pub(crate) far: u32,
    pub(crate) pairs: u32,
}

/// `Bound` of `bound.wgsl`, `extremes.wgsl`, `cull.wgsl` and `farthest.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Bound {
    pub(crate) near: u32,
    pub(crate) far: u32,
}

/// `Farthest` of `farthest.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Farthest {
    pub(crate) a: u32,
    pub(crate) far: u32,
    pub(crate) b: u32,
}

/// `StepParams::phase` of stage `farthest`, in the order they are run.
pub(crate) const OF_CELLS: u32 = 0;
pub(crate) const OF_DISTANCES: u32 = 1;
pub(crate) const OF_PARTNERS: u32 = 2;

/// `WHOLE_MODEL` of `boxes.wgsl`: more than twice the largest radius, which is below 2.
pub(crate) const WHOLE_MODEL: f32 = 4.0;
