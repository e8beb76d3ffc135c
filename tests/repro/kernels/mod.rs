//! Kernels in float32.

mod gpu_deep;
#[cfg(not(target_arch = "wasm32"))]
mod gpu_deep_with_kernels;
mod hierarchy_point;

pub(crate) use gpu_deep::gpu_deep;
#[cfg(not(target_arch = "wasm32"))]
pub(crate) use gpu_deep_with_kernels::gpu_deep_with_kernels;
pub(crate) use hierarchy_point::hierarchy_point;
