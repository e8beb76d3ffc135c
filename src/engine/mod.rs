//! The distance of two prepared models: options in, interval out.

mod certified;
mod deviation;
mod direction;
mod dispatch;
mod hierarchy_backend;
mod hierarchy_cpu;
mod hierarchy_prepare;
mod iteration;
mod iteration_backend;
mod iteration_cpu;
mod options;
mod prepared;
mod result;
mod symmetric;

pub use deviation::Statistics;
pub use dispatch::Engine;
pub use options::{Backend, Method, Options};
pub use prepared::PreparedModel;
pub use result::{
    Bounds, CertifiedDetails, Details, DistanceResult, Field, HierarchyDetails, IterationDetails,
    PatchCounts, Processor, Seconds, Stop, SurfacePoint, Witness,
};

pub(crate) use prepared::{PreparedSampling, PreparedTarget};
