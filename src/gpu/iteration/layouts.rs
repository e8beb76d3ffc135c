//! The structs and constants shared with `shaders/iteration`, field by field.

use crate::closest::Status;
use crate::gpu::float32::UNKNOWN_DISTANCE;
use crate::gpu::kernel::Constant;
use bytemuck::{Pod, Zeroable};

/// `SampleParams` of `sample.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct SampleParams {
    pub(crate) rotation_x: [f32; 4],
    pub(crate) rotation_y: [f32; 4],
    pub(crate) rotation_z: [f32; 4],
    pub(crate) translation: [f32; 4],
    pub(crate) row_count: u32,
    pub(crate) column_count: u32,
    pub(crate) padding: [u32; 2],
}

/// `SampleRow` of `sample.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct SampleRow {
    pub(crate) first_patch: u32,
    pub(crate) first_column: u32,
    pub(crate) s: f32,
    pub(crate) first_sample: u32,
}

/// `SampleColumn` of `sample.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct SampleColumn {
    pub(crate) patch_column: u32,
    pub(crate) t: f32,
}

/// `ProjectParams` of `project.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct ProjectParams {
    pub(crate) first_thread: u32,
    pub(crate) sample_count: u32,
    pub(crate) first_patch: u32,
    pub(crate) patch_count: u32,
    pub(crate) patches_before: u32,
    pub(crate) iterations: u32,
    pub(crate) step_tolerance: f32,
    pub(crate) column_count: u32,
}

/// `Projected` of `projected.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Projected {
    pub(crate) distance_squared: f32,
    pub(crate) patch_and_status: u32,
    pub(crate) s: f32,
    pub(crate) t: f32,
}

/// The bit of [`Projected::patch_and_status`] at which the status starts,
/// above the bits of the patch.
const STATUS_SHIFT: u32 = 30;

/// The bits of [`Projected::patch_and_status`] that are the patch.
const PATCH_MASK: u32 = (1 << STATUS_SHIFT) - 1;

impl Projected {
    /// Index of the patch on the GPU.
    pub(crate) fn patch(&self) -> usize {
        (self.patch_and_status & PATCH_MASK) as usize
    }

    /// The status with which the iteration on that patch ended.
    pub(crate) fn status(&self) -> Status {
        Status::from_code(self.patch_and_status >> STATUS_SHIFT)
    }
}

/// The constants of `projected.wgsl`.
pub(crate) const PROJECTED_CONSTANTS: &[Constant] = &[
    Constant::u32("STATUS_SHIFT", STATUS_SHIFT),
    Constant::u32("PATCH_MASK", PATCH_MASK),
    Constant::u32("CONVERGED", Status::Converged as u32),
    Constant::u32("ITERATION_LIMIT", Status::IterationLimit as u32),
    Constant::u32("ON_EDGE", Status::OnEdge as u32),
    Constant::f32("UNKNOWN_DISTANCE", UNKNOWN_DISTANCE),
];

/// `ReduceParams` of `reduce.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct ReduceParams {
    pub(crate) sample_count: u32,
}

/// `Block` of `reduce.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Block {
    pub(crate) farthest: Projected,
    pub(crate) sample: u32,
    pub(crate) converged: u32,
    pub(crate) iteration_limit: u32,
    pub(crate) on_edge: u32,
}
