//! The distance of two prepared models: options in, interval out.

mod certified;
mod clock;
mod cpu;
mod cpu_descent;
mod descent;
mod deviation;
mod directed;
mod engine;
mod hierarchy;
mod monitor;
mod options;
mod prepared;
mod result;
mod run;
mod stages;
mod symmetric;

pub use deviation::Statistics;
pub use engine::Engine;
pub use monitor::{Monitor, Silent};
pub use options::{Backend, Method, Options};
pub use prepared::PreparedModel;
pub use result::{
    Bounds, CertifiedDetails, DistanceResult, Field, HierarchyDetails, IterationDetails, PatchCounts,
    Seconds, StatusCounts, Stop, SurfacePoint, Witness,
};

pub(crate) use clock::now;
pub(crate) use descent::Descended;
pub(crate) use monitor::Progress;
pub(crate) use prepared::{PreparedSampling, PreparedTarget};
pub(crate) use stages::Candidate;
