//! Bézier patches in intervals: their extraction, evaluation, subdivision and bounds.

mod curvature;
mod extract;
mod net;

pub(super) use curvature::SecondDerivatives;
pub(super) use extract::{Patch, patches, patches_of};
pub(super) use net::{Homogeneous, Net, project};
