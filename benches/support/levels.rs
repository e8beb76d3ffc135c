//! A level of cells of method `certified`, for the kernels to work on.

use super::models;
use glam::DVec3;
use nurbs_hausdorff::RigidTransform;
use nurbs_hausdorff::engine::PreparedModel;
use nurbs_hausdorff::gpu::{Gpu, LevelBench};
use nurbs_hausdorff::shapes::operations::cut_model;
use std::rc::Rc;

/// Degrees that the kernels are measured for.
pub(crate) const DEGREES: [[usize; 2]; 3] = [[2, 2], [3, 3], [5, 5]];

/// Patches along each direction of the net.
const SPANS: usize = 12;

/// Cells, at least: those of a submission that has found its pace.
const CELLS: usize = 8192;

/// How far the net is moved, and the tolerance: cells die out slowly between a
/// net and its copy close by.
const MOVED: f64 = 1e-3;
const TOLERANCE: f64 = 1e-5;

/// Where the copy is cut, inside spans: patches alike would bound each other.
const CUTS: [&[f64]; 2] = [&[0.03], &[0.03]];

/// A net of these degrees and its pieces moved, cut into cells.
pub(crate) fn bench(gpu: &Rc<Gpu>, degree: [usize; 2]) -> LevelBench {
    let net = models::rough(degree, [SPANS; 2], 1.0, 1);
    let pieces = PreparedModel::new(&cut_model(&net, CUTS).expect("fractions inside"));
    let model = PreparedModel::new(&net);
    let transform = RigidTransform::translation(DVec3::new(0.0, 0.0, MOVED)).expect("finite");
    LevelBench::new(gpu, [&model, &pieces], transform, TOLERANCE, CELLS)
        .expect("a GPU")
        .expect("enough cells")
}
