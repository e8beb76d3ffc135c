//! The kernels of `shaders` and what feeds them.

#[cfg(not(target_arch = "wasm32"))]
mod bench;
mod box_layouts;
mod buffers;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod cell_boxes;
mod descent;
mod device;
mod groups;
#[cfg(not(target_arch = "wasm32"))]
mod kept_text;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod kernel_error;
mod layouts;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod level_error;
mod levels;
mod patch_text;
mod piece_error;
mod pipelines;
mod plan;
mod resident;
mod slot;
mod stages;
mod upload_cells;
mod upload_pieces;
mod upload_sampling;
mod upload_target;
mod work;

#[cfg(not(target_arch = "wasm32"))]
#[doc(hidden)]
pub use bench::StageBench;
pub(crate) use descent::{Frame, GpuDescent};
pub use device::Gpu;
pub(crate) use levels::Levels;
pub(crate) use resident::Resident;
pub(crate) use stages::GpuStages;
pub(crate) use upload_cells::GpuCells;
pub(crate) use upload_sampling::GpuSampling;
pub(crate) use upload_target::GpuTarget;
