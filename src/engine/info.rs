//! A model in numbers, for people and programs that choose options.

use super::PreparedModel;
use crate::axis::Axis;
use crate::model::{Face, Model};
use serde::Serialize;

/// The surfaces, patches and bounding box of a model.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ModelInfo {
    /// The model's name.
    pub name: Option<String>,
    /// Metres per model unit, if they are known.
    pub unit: Option<f64>,
    /// The upper bound, in model units, on the distance between the model and its source.
    pub gap: f64,
    /// The faces in order.
    pub surfaces: Vec<SurfaceInfo>,
    /// The number of Bézier patches.
    pub patches: usize,
    /// The smallest and the largest coordinates of the control points.
    pub bounding_box: [[f64; 3]; 2],
    /// The length of the box's diagonal.
    pub diagonal: f64,
}

/// A face in numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SurfaceInfo {
    /// The face's name in its source.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<String>,
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
    /// The number of loops that trim the face; 0 for a whole surface.
    pub loops: usize,
    /// The number of Bézier patches.
    pub patches: usize,
}

impl ModelInfo {
    /// Counts and measures. O(size).
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let prepared = PreparedModel::new(model);
        let bounding_box = model.bounding_box();
        let surfaces = model.faces().zip(prepared.patch_counts());
        Self {
            name: model.name().map(str::to_owned),
            unit: model.unit(),
            gap: model.gap(),
            surfaces: surfaces.map(|(face, counts)| SurfaceInfo::new(&face, counts)).collect(),
            patches: prepared.patch_counts().map(|[rows, columns]| rows * columns).sum(),
            bounding_box: [bounding_box.min.to_array(), bounding_box.max.to_array()],
            diagonal: bounding_box.diagonal(),
        }
    }
}

impl SurfaceInfo {
    fn new(face: &Face<'_>, [rows, columns]: [usize; 2]) -> Self {
        let surface = face.surface();
        let weight = surface.control_points()[0][3];
        Self {
            part: face.part().map(str::to_owned),
            degree: surface.degree(),
            counts: surface.counts(),
            domain: surface.domain().intervals(),
            rational: surface.control_points().iter().any(|point| point[3] != weight),
            clamped: Axis::BOTH.map(|axis| clamped(surface.knots(axis), surface.degree()[axis])),
            loops: face.trim().map_or(0, |trim| trim.loops().len()),
            patches: rows * columns,
        }
    }
}

/// Whether both end knots are repeated degree + 1 times.
fn clamped(knots: &[f64], degree: usize) -> bool {
    knots[0] == knots[degree] && knots[knots.len() - 1 - degree] == knots[knots.len() - 1]
}
