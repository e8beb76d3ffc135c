//! A mesh that stands for surfaces, and how far the two are apart (lemma F10 of docs/meshes.md).

use super::super::rounding::sag_rounding;
use super::super::{FacetTarget, TriangleMesh};
use super::patch_cell::{MIN_LENGTH, PatchCell};
use crate::bezier::PatchSet;
use crate::error::Result;
use crate::model::RigidTransform;
use crate::rounding::upper_max;
use glam::DVec3;

/// The cells beyond the first of each patch at which the tolerance is given up: a million triangles,
/// about 200 MB with their tree.
const MAX_CELLS: usize = 1 << 19;

/// The factor of the tolerance then: half as many cells.
const COARSER: f64 = 2.0;

/// Two triangles for each cell of patches.
pub(crate) struct StandIn {
    pub(crate) mesh: FacetTarget,
    /// An upper bound on the Hausdorff distance of the triangles from the computed patches.
    pub(crate) error: f64,
}

impl StandIn {
    /// Halves the patches until their triangles are within the tolerance of them, or there are a
    /// million. No point of the patches is farther than `length` from the origin.
    ///
    /// # Errors
    /// Those of [`TriangleMesh::new`].
    pub(crate) fn new(patches: &PatchSet, tolerance: f64, length: f64) -> Result<Self> {
        let mut tolerance = tolerance;
        loop {
            if let Some((corners, error)) = cells(patches, tolerance) {
                let quadrangles = 0..(corners.len() / 4) as u32;
                let triangles: Vec<[u32; 3]> = quadrangles
                    .flat_map(|of| [[0, 1, 2], [0, 2, 3]].map(|triangle| triangle.map(|k| 4 * of + k)))
                    .collect();
                let mesh = FacetTarget::of_mesh(&TriangleMesh::new(&corners, &triangles)?);
                return Ok(Self { mesh, error: error + sag_rounding(length) });
            }
            tolerance *= COARSER;
        }
    }
}

/// Returns the corners of all cells, four each, and the largest distance of a cell from its
/// triangles; `None` if they are too many.
fn cells(patches: &PatchSet, tolerance: f64) -> Option<(Vec<DVec3>, f64)> {
    let (mut corners, mut error) = (Vec::new(), 0.0);
    let most = 4 * (MAX_CELLS + patches.len());
    let mut open: Vec<PatchCell> = (0..patches.len() as u32).map(PatchCell::whole).collect();
    while let Some(cell) = open.pop() {
        let net = cell.net(patches, &RigidTransform::IDENTITY);
        let apart = net.apart();
        let axis = net.halved_axis(false);
        if apart <= tolerance || cell.range.lengths()[axis as usize] < MIN_LENGTH {
            corners.extend(net.corners());
            error = upper_max(error, apart);
        } else {
            open.extend(cell.range.halves(axis).map(|range| PatchCell { range, ..cell }));
        }
        if corners.len() + 4 * open.len() > most {
            return None;
        }
    }
    Some((corners, error))
}
