//! The kernels of `shaders` and what feeds them.
//!
//! Those of method `hierarchy` are natively only: they would take 12 KiB of the
//! gzipped wasm module's 150, which every page pays that only wants a distance.

#[cfg(all(feature = "internals", not(target_arch = "wasm32")))]
mod bench;
#[cfg(not(target_arch = "wasm32"))]
mod box_kernels;
#[cfg(not(target_arch = "wasm32"))]
mod box_layouts;
mod buffers;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod cell_boxes;
#[cfg(not(target_arch = "wasm32"))]
mod descent;
mod device;
mod groups;
#[cfg(not(target_arch = "wasm32"))]
mod kept_text;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod kernel_error;
mod layouts;
#[cfg(all(feature = "internals", not(target_arch = "wasm32")))]
mod level_bench;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod level_error;
mod levels;
#[cfg(not(target_arch = "wasm32"))]
mod packet_tree;
mod patch_text;
mod piece_error;
mod pipelines;
mod plan;
mod resident;
mod rounding;
mod slot;
mod stages;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod test_gpu;
#[cfg(not(target_arch = "wasm32"))]
mod upload_cells;
mod upload_pieces;
mod upload_sampling;
mod upload_target;
mod work;

#[cfg(all(feature = "internals", not(target_arch = "wasm32")))]
pub use bench::StageBench;
#[cfg(not(target_arch = "wasm32"))]
pub(crate) use descent::{Frame, GpuDescent};
pub use device::Gpu;
#[cfg(all(feature = "internals", not(target_arch = "wasm32")))]
pub use level_bench::{LevelBench, LevelStage};
pub(crate) use levels::Levels;
pub(crate) use resident::Resident;
pub(crate) use stages::GpuStages;
#[cfg(not(target_arch = "wasm32"))]
pub(crate) use upload_cells::GpuCells;
pub(crate) use upload_sampling::GpuSampling;
pub(crate) use upload_target::GpuTarget;
