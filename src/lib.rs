//! How far apart are two NURBS models?

pub mod bezier;
mod both;
pub mod certified;
pub mod distance;
mod elementary;
pub mod error;
pub mod flatness;
mod gather;
pub mod gpu;
pub mod hierarchy;
pub mod iteration;
pub mod model;
mod order;
mod parallel;
pub mod project;
mod rounding;
pub mod shapes;
mod shown;
mod symmetry;
pub mod tessellate;
pub mod tree;
#[cfg(target_arch = "wasm32")]
mod wasm;

pub use error::{Error, Result};
pub use model::{Model, NurbsSurface, RigidTransform, SurfaceArrays};
