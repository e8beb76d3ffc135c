//! A level of cells of method `certified`, for the kernels to work on.

use super::models;
use glam::DVec3;
use nurbs_hausdorff::RigidTransform;
use nurbs_hausdorff::internals::gpu::{CertifiedBench, Gpu};
use nurbs_hausdorff::shapes::operations::cut_model;
use std::sync::Arc;

/// Degrees that the kernels are measured for.
pub(crate) const DEGREES: [[usize; 2]; 3] = [[2, 2], [3, 3], [5, 5]];

/// Patches along each direction of the net.
const SPANS: usize = 12;

/// The number of cells, that of a full batch.
const CELLS: usize = 8192;

/// The copy's distance from the net and the tolerance: few cells are pruned
/// between a net and a copy nearby.
const OFFSET: f64 = 1e-3;
const TOLERANCE: f64 = 1e-5;

/// Where the copy is cut, inside spans: the bounds of equal patches would prune all.
const CUTS: [&[f64]; 2] = [&[0.03], &[0.03]];

/// The cells of a net of these degrees whose distance to its cut copy is searched.
pub(crate) fn bench(gpu: &Arc<Gpu>, degree: [usize; 2]) -> CertifiedBench {
    let net = models::rough(degree, [SPANS; 2], 1.0, 1);
    let copy = cut_model(&net, CUTS).expect("fractions inside");
    let transform = RigidTransform::translation(DVec3::new(0.0, 0.0, OFFSET)).expect("finite");
    CertifiedBench::new(gpu, [&net, &copy], transform, TOLERANCE, CELLS)
        .expect("a GPU")
        .expect("enough cells")
}
