//! The account of what was read, which accompanies the model.

use crate::error::Error;
use crate::model::Model;
use serde::{Deserialize, Deserializer, Serialize};
use std::cell::RefCell;
use std::collections::HashSet;
use std::fmt::{Display, Formatter};

/// The result of reading a CAD file, face by face.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct ReadReport {
    /// The number of faces read.
    pub faces: usize,
    /// The number of trimming curves of those faces.
    pub trims: usize,
    /// The number of trimming curves that are exact images of the file's.
    pub exact: usize,
    /// The number of trimming curves fitted to the file's, with the deviation in their gaps,
    /// and of those on surfaces that are approximated.
    pub fitted: usize,
    /// The largest gap of a face, in model units: the distance between a trimming curve on its
    /// surface and the edge of the file, plus the deviation of an approximated surface.
    pub gap: f64,
    /// Whether the gap is an upper bound. Curves and surfaces that are offsets but not
    /// rational, curves that were moved far at a pole, and segments that close a loop where no
    /// edge of the file does are measured at points instead.
    pub gap_proven: bool,
    /// Metres per model unit; `None` where the file does not state it, as in BREP.
    pub unit: Option<f64>,
    /// The faces that could not be read, or not be cut into patches.
    pub skipped: Vec<Skipped>,
    /// The faces that the file leaves ambiguous, with what was decided.
    pub notes: Vec<Note>,
    /// The file's faces of the model's, one entry a face of the model: with instances a face
    /// of the file has several.
    #[serde(skip)]
    pub(super) sources: Vec<FaceCounts>,
    /// The shapes of a document, as of [`super::Assembled`].
    #[serde(skip)]
    pub(super) shapes: Vec<(usize, String)>,
}

/// The number of a face among those of the file, and those of its curves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FaceCounts {
    /// The number in the file, from 0.
    pub number: usize,
    /// The number by which the file calls the face.
    pub entity: Option<u64>,
    /// The number of its curves that are exact.
    pub exact: usize,
    /// The number of its curves that are fitted.
    pub fitted: usize,
}

impl ReadReport {
    /// Returns the report on a model that was read without a change, as interchange JSON is.
    #[must_use]
    pub fn of_exact(model: &Model) -> Self {
        let loops = model.faces().filter_map(|face| face.to_arrays().trim).flatten();
        let trims = loops.map(|curves| curves.len()).sum();
        Self {
            faces: model.surfaces().len(),
            trims,
            exact: trims,
            fitted: 0,
            gap: model.gap(),
            gap_proven: model.is_gap_proven(),
            unit: model.unit(),
            skipped: Vec::new(),
            notes: Vec::new(),
            sources: Vec::new(),
            shapes: Vec::new(),
        }
    }

    /// Returns the report on a mesh or a cloud of points in this unit, which is one face.
    #[must_use]
    pub fn of_facets(unit: Option<f64>) -> Self {
        Self { faces: 1, gap_proven: true, unit, ..Self::default() }
    }

    /// Moves faces of the model, by their indices, from those that were read to those skipped.
    pub(crate) fn leave_out(&mut self, refused: &[(usize, Error)]) {
        for (face, error) in refused {
            let unknown = FaceCounts { number: *face, entity: None, exact: 0, fitted: 0 };
            let FaceCounts { number, entity, exact, fitted } =
                self.sources.get(*face).copied().unwrap_or(unknown);
            let face = face_id(&self.shapes, number);
            // Other instances of the face are refused with it.
            if self.skipped.iter().any(|skipped| skipped.face == face) {
                continue;
            }
            self.faces -= 1;
            self.trims -= exact + fitted;
            self.exact -= exact;
            self.fitted -= fitted;
            self.skipped.push(Skipped { face, entity, code: error.code(), why: error.to_string() });
        }
        order_skipped(&mut self.skipped, &mut self.notes);
    }
}

/// The place of a face in its file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(untagged)]
#[non_exhaustive]
pub enum FaceId {
    /// The number in the file, from 0, in the order of OpenCASCADE's `TopExp_Explorer`, each face once
    /// at its place.
    Number(usize),
    /// The name of an object of a document that is not read, or that of its shape with the number of
    /// the face in it.
    Name(String),
}

impl From<usize> for FaceId {
    fn from(number: usize) -> Self {
        Self::Number(number)
    }
}

impl Display for FaceId {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) => write!(formatter, "{number}"),
            Self::Name(name) => write!(formatter, "{name}"),
        }
    }
}

/// Returns how a file with these shapes, by the numbers of their first faces, calls a face.
pub(super) fn face_id(shapes: &[(usize, String)], number: usize) -> FaceId {
    let index = shapes.partition_point(|(first, _)| *first <= number);
    match index.checked_sub(1).map(|index| &shapes[index]) {
        Some((first, name)) => FaceId::Name(format!("{name} {}", number - first)),
        None => FaceId::Number(number),
    }
}

/// A face that could not be read.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Skipped {
    /// The place of the face in the file.
    pub face: FaceId,
    /// The number by which the file calls the face, if it has one, as `#` in STEP.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub entity: Option<u64>,
    /// The stable code of the reason.
    pub code: &'static str,
    /// The reason.
    pub why: String,
}

impl Skipped {
    /// Returns the account of a face that could not be read.
    #[must_use]
    pub fn new(face: FaceId, entity: Option<u64>, code: &'static str, why: String) -> Self {
        Self { face, entity, code, why }
    }
}

/// What the file leaves open of a face that was read.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Note {
    /// The place of the face in the file.
    pub face: FaceId,
    /// The stable code of the remark.
    pub code: &'static str,
    /// The decision, and the reason for it.
    pub why: String,
}

impl Note {
    /// Returns a remark on a face that was read.
    #[must_use]
    pub fn new(face: FaceId, code: &'static str, why: String) -> Self {
        Self { face, code, why }
    }
}

/// The account of a face as JSON has it.
#[derive(Deserialize)]
struct Account {
    face: FaceId,
    entity: Option<u64>,
    code: String,
    why: String,
}

impl<'de> Deserialize<'de> for Skipped {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let Account { face, entity, code, why } = Account::deserialize(from)?;
        Ok(Self { face, entity, code: interned(code), why })
    }
}

impl<'de> Deserialize<'de> for Note {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let Account { face, code, why, .. } = Account::deserialize(from)?;
        Ok(Self { face, code: interned(code), why })
    }
}

/// Returns a code for as long as the program runs. Each distinct one is kept once, and the
/// readers have some dozens.
pub(super) fn interned(code: String) -> &'static str {
    thread_local! {
        static CODES: RefCell<HashSet<&'static str>> = RefCell::default();
    }
    CODES.with_borrow_mut(|codes| match codes.get(code.as_str()) {
        Some(known) => known,
        None => {
            let kept: &'static str = code.leak();
            codes.insert(kept);
            kept
        }
    })
}

/// Sorts what was skipped by its faces, about which there are no notes besides.
pub(super) fn order_skipped(skipped: &mut [Skipped], notes: &mut Vec<Note>) {
    skipped.sort_by(|one, other| one.face.cmp(&other.face));
    notes.retain(|note| skipped.iter().all(|skipped| skipped.face != note.face));
}
