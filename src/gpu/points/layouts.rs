//! The structs and constants shared with `shaders/points`, field by field.

use crate::gpu::iteration::layouts::Projected;
use bytemuck::{Pod, Zeroable};

/// `LocateParams` of `locate.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct LocateParams {
    pub(crate) first_point: u32,
    pub(crate) end_point: u32,
    pub(crate) patches_before: u32,
    pub(crate) iterations: u32,
    pub(crate) permitted: f32,
}

/// `Located` of `locate.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Located {
    pub(crate) foot: Projected,
    pub(crate) owner: u32,
    pub(crate) point: [f32; 3],
    pub(crate) own: f32,
    pub(crate) others: f32,
}
