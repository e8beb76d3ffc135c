//! The kernels of `shaders` and what feeds them.
//!
//! Those of method `hierarchy` are natively only: they would take 12 KiB of the
//! gzipped wasm module's 150, which every page pays that only wants a distance.

mod buffers;
mod certified;
mod degree_groups;
mod device;
mod float32;
#[cfg(not(target_arch = "wasm32"))]
mod hierarchy;
mod iteration;
mod kernel;
mod patch_wgsl;
mod residency;
mod slot;
mod submission;
#[cfg(not(target_arch = "wasm32"))]
mod testing;

pub(crate) use certified::Levels;
pub(crate) use certified::subpatches::{Pieces, Place};
pub use device::Gpu;
#[cfg(not(target_arch = "wasm32"))]
pub(crate) use hierarchy::grid_tree::GpuCells;
#[cfg(not(target_arch = "wasm32"))]
pub(crate) use hierarchy::{Frame, GpuDescent};
pub(crate) use iteration::GpuStages;
pub(crate) use iteration::sampling::GpuSampling;
pub(crate) use iteration::target::GpuTarget;
pub(crate) use residency::Resident;
#[cfg(not(target_arch = "wasm32"))]
#[doc(hidden)]
pub use testing::{LevelBench, LevelStage, StageBench};
