//! A model in numbers, for people and programs that choose options.

mod counts;

use super::{Body, PreparedModel};
use crate::area::Area;
use crate::axis::Axis;
use crate::carrier::FaceForm;
use crate::error::Result;
use crate::facts::Facts;
use crate::model::trim::TrimPiece;
use crate::model::{Face, Model};
pub use counts::Counts;
pub(in crate::engine) use counts::first_alike;
use glam::DVec3;
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
    /// The faces in order; none of a mesh or a cloud of points.
    pub faces: Vec<FaceInfo>,
    /// The number of Bézier patches.
    pub patches: usize,
    /// A box around the model: its least and its largest coordinates, rounded out by at most about 1e-9 of the
    /// diagonal.
    pub bounding_box: [[f64; 3]; 2],
    /// The length of the box's diagonal.
    pub diagonal: f64,
    /// The area of all faces' pieces, in squares of the model unit.
    pub area: Area,
    /// The facts of all bodies together.
    pub facts: Facts,
    /// The bodies.
    pub bodies: Vec<BodyInfo>,
    /// What the model consists of.
    pub counts: Counts,
}

/// A body with its facts.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct BodyInfo {
    /// The body.
    #[serde(flatten)]
    pub body: Body,
    /// Its facts.
    pub facts: Facts,
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
    /// The elementary surface that the face lies on, with bounds on how far it leaves it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub form: Option<FaceForm>,
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
        let pieces = prepared.face_patch_counts().zip(prepared.face_areas());
        let faces = model.faces().zip(pieces).zip(prepared.face_forms());
        let faces = faces.map(|((face, (patches, area)), form)| FaceInfo::new(&face, form, patches, *area));
        let faces = faces.collect();
        let trimmed = model.faces().filter(|face| face.trim().is_some()).count();
        let counts = Counts::new(Some(model), prepared);
        Self { faces, trimmed, patches: prepared.face_patch_counts().sum(), ..Self::whole(prepared, counts) }
    }

    /// Counts and measures a mesh or a cloud of points, of which `faces` are none.
    #[must_use]
    pub fn of_facets(prepared: &PreparedModel) -> Self {
        Self::whole(prepared, Counts::new(None, prepared))
    }

    /// Returns what is known of the model without its faces.
    fn whole(prepared: &PreparedModel, counts: Counts) -> Self {
        let facts = prepared.facts().clone();
        let bounding_box = [facts.min.map(|low| low.lower), facts.max.map(|high| high.upper)];
        let [min, max] = bounding_box.map(DVec3::from_array);
        Self {
            name: prepared.name().map(str::to_owned),
            unit: prepared.unit(),
            trimmed: 0,
            gap: prepared.gap(),
            deviation: prepared.deviation(),
            faces: Vec::new(),
            patches: 0,
            bounding_box,
            diagonal: min.distance(max),
            area: prepared.area(),
            facts,
            bodies: BodyInfo::of(prepared),
            counts,
        }
    }
}

impl BodyInfo {
    /// Returns the bodies of a model with their facts.
    #[must_use]
    pub fn of(prepared: &PreparedModel) -> Vec<Self> {
        let bodies = prepared.bodies().into_iter().zip(prepared.body_facts().cloned());
        bodies.map(|(body, facts)| Self { body, facts }).collect()
    }
}

impl FaceInfo {
    fn new(face: &Face<'_>, form: Option<FaceForm>, patches: usize, area: Area) -> Self {
        let surface = face.surface();
        let weight = surface.control_points()[0][3];
        Self {
            face_name: face.name().map(str::to_owned),
            color: face.color(),
            kind: face.kind().map(str::to_owned),
            form,
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
