//! The faces in which two models differ.

mod counterpart;
mod face;
mod face_search;
mod pair;
mod parts;
mod search;

pub use counterpart::{FaceChange, FaceCounterpart};
pub use parts::{PartDifference, PartFaces, PartMotion, PartState, PartsUnknown};

use super::query::impl_query;
use super::{PreparedModel, Seconds, Witness};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use crate::sorting::sort_by_number;
use serde::{Deserialize, Serialize};

/// The largest limit: coordinates are at most as large.
const MAX_LIMIT: f64 = 1e100;

/// The default of [`DiffOptions::max_cells`]: some seconds for one face.
const DEFAULT_MAX_CELLS: usize = 1_000_000;

/// Options of [`super::Engine::diff`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct DiffOptions {
    /// The distance, in model units, up to which a face counts as unchanged; positive.
    pub limit: f64,
    /// The cells after which a face is given up as undecided, 1 or more.
    pub max_cells: usize,
    /// Seconds after which the faces that are not decided yet are given up as undecided, positive.
    /// Each has been begun by then, and has the interval reached.
    pub max_seconds: Option<f64>,
    /// Whether B is scaled to the unit of A where both state different ones; else they are
    /// an error.
    pub scale_units: bool,
    /// Moves A before it is compared. It is not deserialized, because only
    /// [`RigidTransform::new`] makes one.
    #[serde(skip)]
    pub transform: RigidTransform,
}

impl Default for DiffOptions {
    /// The limit is a thousandth of a unit: a micrometre where the unit is a millimetre.
    fn default() -> Self {
        Self {
            limit: 1e-3,
            max_cells: DEFAULT_MAX_CELLS,
            max_seconds: None,
            scale_units: false,
            transform: RigidTransform::IDENTITY,
        }
    }
}

impl_query!(DiffOptions, diff -> DiffResult, [max_cells, scale_units, transform], max_seconds);

impl DiffOptions {
    fn require_own(&self) -> Result<()> {
        if !(self.limit > 0.0 && self.limit <= MAX_LIMIT) {
            let expected = "a positive number of at most 1e100";
            return Err(Error::out_of_range("limit", self.limit, expected));
        }
        Ok(())
    }
}

/// Whether a face, or a model, differs from the other model by more than the limit.
///
/// The order is that of a summary: a model with a changed face is changed, and without
/// one but with an undecided face it is undecided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum FaceState {
    /// Every point of the face is within the limit of the other model.
    Unchanged,
    /// The interval contains the limit: the face's distance differs from it by a
    /// hundredth or less, or the budget or float64's precision ended the search.
    Undecided,
    /// A point of the face is farther than the limit from the other model.
    Changed,
}

/// One face, and how far it is from the other model.
///
/// Guarantee: the directed distance from the face to the other model is in
/// `[lower, upper]`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct FaceDifference {
    /// The index of the face in its model.
    pub face: usize,
    /// The state, which follows from the interval and the limit.
    pub state: FaceState,
    /// A lower bound on the distance from the face to the other model.
    pub lower: f64,
    /// An upper bound on the distance from the face to the other model.
    pub upper: f64,
    /// The face's own gap and the largest of the other model: see [`super::DistanceResult::gap`].
    pub gap: f64,
    /// The state that holds for the sources of the face and of the other model, which differ
    /// from them by up to their gaps.
    pub with_gaps: FaceState,
    /// The farthest point found on the face, and its nearest point on the other model.
    pub witness: Witness,
    /// The number of cells bounded.
    pub cells: usize,
    /// The face of the other model that a changed round face became: resized, moved, or both.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub counterpart: Option<FaceCounterpart>,
}

/// The difference of two models, face by face.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct DiffResult {
    /// The state of both models together: the worst state of a face, and `Changed` if the files name different numbers of
    /// parts.
    pub state: FaceState,
    /// The limit that the states refer to, in model units.
    pub limit: f64,
    /// The larger diagonal of the two models' control-net boxes.
    pub diagonal: f64,
    /// Metres per unit of every length here, if A or B states its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<f64>,
    /// What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
    /// units have. Nothing was scaled for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
    /// The sum of both models' gaps, as in [`super::DistanceResult::gap`].
    pub gap: f64,
    /// Whether the gaps are upper bounds by what both readers have proven.
    pub gap_proven: bool,
    /// The state of both models' sources together.
    pub with_gaps: FaceState,
    /// Every face of A, in order, compared with B.
    pub faces_of_a: Vec<FaceDifference>,
    /// Every face of B, in order, compared with A.
    pub faces_of_b: Vec<FaceDifference>,
    /// The parts of both: what moved, changed, was added or removed. None of clouds, and of models of more than
    /// 2,000 bodies.
    pub parts: Vec<PartDifference>,
    /// The reason why the parts were not compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parts_unknown: Option<PartsUnknown>,
    /// Where the time went.
    pub seconds: Seconds,
}

impl DiffResult {
    /// Returns the faces of both models in this state, those of A first, the
    /// farthest first within a model.
    #[must_use]
    pub fn faces_in(&self, state: FaceState) -> [Vec<&FaceDifference>; 2] {
        [&self.faces_of_a, &self.faces_of_b].map(|faces| {
            let mut found: Vec<_> = faces.iter().filter(|face| face.state == state).collect();
            sort_by_number(&mut found, |face| -face.lower);
            found
        })
    }
}
