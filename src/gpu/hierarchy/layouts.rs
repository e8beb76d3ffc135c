//! The structs and constants shared with `shaders/hierarchy`, field by field.

use crate::gpu::float32::UNKNOWN_DISTANCE;
use crate::gpu::kernel::Constant;
use bytemuck::{Pod, Zeroable};

/// `BoxesParams` of `boxes.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct BoxesParams {
    pub(crate) first: u32,
    pub(crate) end: u32,
    pub(crate) rescale: f32,
    pub(crate) margin: f32,
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

/// `Box` of `box_distance.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Box {
    pub(crate) low: [f32; 4],
    pub(crate) high: [f32; 4],
}

/// `Children` of `box_distance.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Children {
    pub(crate) first: u32,
    pub(crate) count: u32,
}

/// `StageParams` of `box_distance.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct StageParams {
    pub(crate) first: u32,
    pub(crate) end: u32,
    pub(crate) capacity: u32,
    pub(crate) phase: u32,
}

/// `Totals` of `box_distance.wgsl`.
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

/// The constants of `box_distance.wgsl`.
pub(crate) const BOX_DISTANCE_CONSTANTS: &[Constant] = &[Constant::f32("UNKNOWN_DISTANCE", UNKNOWN_DISTANCE)];

/// The values of `StageParams::phase` of stage `farthest`, in the order they are run.
pub(crate) const PHASE_CELL: u32 = 0;
pub(crate) const PHASE_DISTANCE: u32 = 1;
pub(crate) const PHASE_PARTNER: u32 = 2;

/// The constants of `farthest.wgsl`.
pub(crate) const FARTHEST_CONSTANTS: &[Constant] =
    &[Constant::u32("PHASE_CELL", PHASE_CELL), Constant::u32("PHASE_DISTANCE", PHASE_DISTANCE)];

/// A growth that makes a part's box contain the whole model: more than twice
/// the largest radius, which is below 2.
pub(crate) const WHOLE_MODEL: f32 = 4.0;

/// The constants of `boxes.wgsl`.
pub(crate) const BOXES_CONSTANTS: &[Constant] = &[Constant::f32("WHOLE_MODEL", WHOLE_MODEL)];
