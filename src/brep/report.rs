//! The account of what was read, which accompanies the model.

use super::nurbs::Unconvertible;
use crate::model::Model;
use serde::Serialize;

/// The result of reading a CAD file, face by face.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ReadReport {
    /// The number of faces read.
    pub surfaces: usize,
    /// The number of trimming curves of those faces.
    pub trims: usize,
    /// The number of trimming curves that are exact images of the file's.
    pub exact: usize,
    /// The number of trimming curves fitted to the file's, with a proven bound in their gaps.
    pub fitted: usize,
    /// The largest gap of a trimming curve, in model units: the distance between the curve
    /// on its surface and the edge of the file, of which the part that the file itself
    /// causes is measured at [`ReadReport::GAP_SAMPLES`] points of an edge, unless the
    /// curve was made from the edge.
    pub gap: f64,
    /// Metres per model unit; `None` where the file does not state it, as in BREP.
    pub unit: Option<f64>,
    /// The faces that could not be read.
    pub skipped: Vec<Skipped>,
}

impl ReadReport {
    /// The number of points of an edge at which its distance to the curve in the file is measured.
    pub const GAP_SAMPLES: usize = 17;

    /// Returns the report on a model that was read without a change, as interchange JSON is.
    #[must_use]
    pub fn of_exact(model: &Model) -> Self {
        let loops = model.faces().filter_map(|face| face.to_arrays().trim).flatten();
        let trims = loops.map(|curves| curves.len()).sum();
        Self {
            surfaces: model.surfaces().len(),
            trims,
            exact: trims,
            fitted: 0,
            gap: model.gap(),
            unit: model.unit(),
            skipped: Vec::new(),
        }
    }
}

/// A face that could not be read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Skipped {
    /// The number of the face among those of the file, from 0.
    pub face: usize,
    /// The stable code of the reason.
    pub code: &'static str,
    /// The reason.
    pub why: String,
}

/// The reason for which a face cannot be read.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FaceFault {
    pub(super) code: &'static str,
    pub(super) why: String,
}

impl FaceFault {
    pub(super) fn new(code: &'static str, why: impl Into<String>) -> Self {
        Self { code, why: why.into() }
    }
}

impl From<Unconvertible> for FaceFault {
    fn from(reason: Unconvertible) -> Self {
        Self::new(reason.code(), reason.why())
    }
}
