//! A model in numbers, for people and programs that choose options.

use super::PreparedModel;
use crate::area::Area;
use crate::axis::Axis;
use crate::error::Result;
use crate::model::trim::TrimPiece;
use crate::model::{Face, Model};
use serde::Serialize;

/// The faces, patches and bounding box of a model.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct ModelInfo {
    /// The model's name.
    pub name: Option<String>,
    /// Metres per model unit; null where they are not known.
    pub unit: Option<f64>,
    /// The number of trimmed faces.
    pub trimmed: usize,
    /// The upper bound, in model units, on the distance between the model and its source.
    pub gap: f64,
    /// The upper bound, in model units, on the Hausdorff distance between the trimmed
    /// faces and the pieces that are measured.
    pub deviation: f64,
    /// The faces in order.
    pub faces: Vec<FaceInfo>,
    /// The number of Bézier patches.
    pub patches: usize,
    /// The smallest and the largest coordinates of the control points.
    pub bounding_box: [[f64; 3]; 2],
    /// The length of the box's diagonal.
    pub diagonal: f64,
    /// The area of all faces' pieces, in squares of the model unit.
    pub area: Area,
}

/// A face in numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct FaceInfo {
    /// The face's name in its source.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub face_name: Option<String>,
    /// The face's colour in its source: red, green and blue of sRGB, each from 0 to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<[f64; 3]>,
    /// The kind of surface in its source.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kind: Option<String>,
    /// The degrees in u and v.
    pub degree: [usize; 2],
    /// The numbers of control points along u and v.
    pub counts: [usize; 2],
    /// The intervals of u and v.
    pub domain: [[f64; 2]; 2],
    /// Whether the weights differ.
    pub rational: bool,
    /// Whether the end knots are repeated degree + 1 times, in u and v.
    pub clamped: [bool; 2],
    /// The numbers of curves of the trimming loops; absent for a whole surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trim: Option<Vec<usize>>,
    /// The upper bound, in model units, on the distance between the face and its source.
    pub gap: f64,
    /// The number of Bézier patches.
    pub patches: usize,
    /// The area of the face's pieces, in squares of the model unit.
    pub area: Area,
}

impl ModelInfo {
    /// Counts and measures. O(size), and the cutting of trimmed faces.
    ///
    /// # Errors
    /// Those of [`PreparedModel::new`].
    pub fn new(model: &Model) -> Result<Self> {
        Ok(Self::of_prepared(model, &PreparedModel::new(model)?))
    }

    /// As [`ModelInfo::new`] for a model that is prepared.
    #[must_use]
    pub fn of_prepared(model: &Model, prepared: &PreparedModel) -> Self {
        let bounding_box = prepared.bounding_box();
        let pieces = prepared.face_patch_counts().zip(prepared.face_areas());
        let faces = model.faces().zip(pieces);
        Self {
            name: model.name().map(str::to_owned),
            unit: model.unit(),
            trimmed: model.faces().filter(|face| face.trim().is_some()).count(),
            gap: model.gap(),
            deviation: prepared.deviation(),
            faces: faces.map(|(face, (patches, area))| FaceInfo::new(&face, patches, *area)).collect(),
            patches: prepared.face_patch_counts().sum(),
            bounding_box: [bounding_box.min.to_array(), bounding_box.max.to_array()],
            diagonal: bounding_box.diagonal(),
            area: prepared.area(),
        }
    }
}

impl FaceInfo {
    fn new(face: &Face<'_>, patches: usize, area: Area) -> Self {
        let surface = face.surface();
        let weight = surface.control_points()[0][3];
        Self {
            face_name: face.name().map(str::to_owned),
            color: face.color(),
            kind: face.kind().map(str::to_owned),
            degree: surface.degree(),
            counts: surface.counts(),
            domain: surface.domain().intervals(),
            rational: surface.control_points().iter().any(|point| point[3] != weight),
            clamped: Axis::BOTH.map(|axis| clamped(surface.knots(axis), surface.degree()[axis])),
            trim: face.trim().map(|trim| trim.loops().iter().map(|curves| curve_count(curves)).collect()),
            gap: face.gap(),
            patches,
            area,
        }
    }
}

/// Returns the number of curves of a loop; each has one piece or more.
fn curve_count(pieces: &[TrimPiece]) -> usize {
    pieces.last().map_or(0, |piece| piece.curve as usize + 1)
}

/// Whether both end knots are repeated degree + 1 times.
fn clamped(knots: &[f64], degree: usize) -> bool {
    knots[0] == knots[degree] && knots[knots.len() - 1 - degree] == knots[knots.len() - 1]
}
