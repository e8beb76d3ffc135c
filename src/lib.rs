//! How far apart are two NURBS models?

pub mod bezier;
pub mod bvh;
pub mod certified;
pub mod closest;
pub mod engine;
pub mod error;
pub mod flatness;
pub mod gpu;
pub mod hierarchy;
pub mod iteration;
mod limits;
pub mod model;
mod parallel;
pub mod progress;
mod rounding;
pub mod shapes;
mod symmetry;
pub mod tessellate;
#[cfg(target_arch = "wasm32")]
mod wasm;

pub use error::{Error, Result};
pub use model::{Model, NurbsSurface, RigidTransform, SurfaceArrays};
