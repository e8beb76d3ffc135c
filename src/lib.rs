//! How far apart are two NURBS models?

mod axis;
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
mod param_box;
pub mod progress;
mod rounding;
pub mod shapes;
mod symmetry;
pub mod tessellate;
#[cfg(target_arch = "wasm32")]
mod wasm;

pub use axis::Axis;
pub use error::{Error, Result};
pub use model::{Model, NurbsSurface, RigidTransform, SurfaceArrays};
pub use param_box::ParamBox;
