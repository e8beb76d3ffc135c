//! The GPU implementation of the three methods, on WebGPU through `wgpu`.
//!
//! | module | holds |
//! |---|---|
//! | `device`, `buffers` | the device, its errors and its buffers |
//! | `submission` | submissions of bounded duration, by the throughput of kernels |
//! | `kernel` | WGSL text, specialised by degree, and the pipelines made of it |
//! | `float32`, `degree_groups`, `target`, `subpatch_domain`, `residency` | models in float32: rounding, patches by degree with their trees, parts of patches, copies kept on a device |
//! | `iteration`, `hierarchy`, `certified` | one driver per method, each with the kernels in the folder of `shaders` of the same name |
//! | `points` | the same for closest points of many points |
//! | `testing` | benchmarks of single stages, and tests of the float32 error bounds |
//!
//! Every bound that a kernel computes accounts for float32's rounding, so the
//! interval of a distance is as certain as on the CPU, only wider. The stages
//! have the names of their counterparts on the CPU, in [`crate::iteration`],
//! [`crate::hierarchy`] and [`crate::certified`].

mod buffers;
mod certified;
mod degree_groups;
mod device;
mod float32;
mod hierarchy;
mod iteration;
mod kernel;
mod points;
mod residency;
mod submission;
mod subpatch_domain;
mod target;
#[cfg(all(feature = "internals", not(target_arch = "wasm32")))]
mod testing;

pub(crate) use certified::GpuCertified;
pub use device::Gpu;
pub(crate) use device::Turn;
pub(crate) use hierarchy::{GpuGridTree, GpuHierarchy, Placement};
pub(crate) use iteration::{GpuIteration, GpuSampling};
pub(crate) use points::{GpuPointTarget, GpuPoints};
pub(crate) use residency::Resident;
pub(crate) use target::GpuTarget;
#[cfg(not(target_arch = "wasm32"))]
#[doc(hidden)]
#[cfg(all(feature = "internals", not(target_arch = "wasm32")))]
#[doc(hidden)]
pub use testing::{CertifiedBench, CertifiedStage, IterationBench};
