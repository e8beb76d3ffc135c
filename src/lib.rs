//! How far apart are two NURBS models?

pub mod bezier;
pub mod certified;
pub mod distance;
pub mod error;
pub mod flatness;
pub mod gpu;
pub mod hierarchy;
pub mod iteration;
pub mod model;
mod parallel;
pub mod project;
mod rounding;
pub mod shapes;
mod symmetry;
pub mod tessellate;
pub mod tree;
#[cfg(target_arch = "wasm32")]
mod wasm;

pub use error::{Error, Result};
pub use model::{Model, NurbsSurface, RigidTransform, SurfaceArrays};
