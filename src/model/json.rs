//! Reading and writing of the interchange JSON.

use super::trim::{FaceArrays, TrimCurveArrays};
use super::{Face, InstanceArrays, Model, ModelArrays, SurfaceArrays};
use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
struct InterchangeModel {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unit: Option<f64>,
    surfaces: Vec<InterchangeSurface>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    instances: Vec<InterchangeInstance>,
}

#[derive(Serialize, Deserialize)]
struct InterchangeSurface {
    degree: [usize; 2],
    knots_u: Vec<f64>,
    knots_v: Vec<f64>,
    ctrl: Vec<Vec<[f64; 4]>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    trim: Option<Vec<Vec<InterchangeCurve>>>,
    #[serde(default, skip_serializing_if = "is_false")]
    reversed: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    part: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    kind: Option<String>,
    #[serde(default, skip_serializing_if = "is_zero")]
    gap: f64,
    #[serde(default, skip_serializing_if = "is_false")]
    gap_measured: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    color: Option<[f64; 3]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    shell: Option<u32>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    solid: Option<u32>,
}

#[derive(Serialize, Deserialize)]
struct InterchangeCurve {
    degree: usize,
    knots: Vec<f64>,
    ctrl: Vec<[f64; 3]>,
    #[serde(default, skip_serializing_if = "is_zero")]
    gap: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    edge: Option<u32>,
}

#[derive(Serialize, Deserialize)]
struct InterchangeInstance {
    surfaces: Vec<usize>,
    transform: [f64; 12],
    #[serde(default)]
    name: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    solid: Option<u32>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes references")]
fn is_false(value: &bool) -> bool {
    !value
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes references")]
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

impl InterchangeSurface {
    fn into_arrays(self, surface: usize) -> Result<FaceArrays> {
        let columns = self.ctrl.first().map_or(0, Vec::len);
        if let Some((index, row)) = self.ctrl.iter().enumerate().find(|(_, row)| row.len() != columns) {
            return Err(Error::RaggedNet { surface, index, found: row.len(), expected: columns });
        }
        let curves = |curves: Vec<InterchangeCurve>| curves.into_iter().map(InterchangeCurve::into_arrays);
        Ok(FaceArrays {
            surface: SurfaceArrays {
                degree: self.degree,
                knots: [self.knots_u, self.knots_v],
                counts: [self.ctrl.len(), columns],
                control_points: self.ctrl.into_iter().flatten().collect(),
            },
            trim: self.trim.map(|loops| loops.into_iter().map(|list| curves(list).collect()).collect()),
            reversed: self.reversed,
            face_name: self.part,
            kind: self.kind,
            gap: self.gap,
            gap_measured: self.gap_measured,
            color: self.color,
            shell: self.shell,
            solid: self.solid,
        })
    }

    fn from_face(face: &Face<'_>) -> Self {
        let FaceArrays { surface, trim, reversed, face_name, kind, gap, gap_measured, color, shell, solid } =
            face.to_arrays();
        let [knots_u, knots_v] = surface.knots;
        let curves =
            |curves: Vec<TrimCurveArrays>| curves.into_iter().map(InterchangeCurve::from_arrays).collect();
        Self {
            degree: surface.degree,
            knots_u,
            knots_v,
            ctrl: surface.control_points.chunks(surface.counts[1]).map(<[_]>::to_vec).collect(),
            trim: trim.map(|loops| loops.into_iter().map(curves).collect()),
            reversed,
            part: face_name,
            kind,
            gap,
            gap_measured,
            color,
            shell,
            solid,
        }
    }
}

impl InterchangeCurve {
    fn into_arrays(self) -> TrimCurveArrays {
        let Self { degree, knots, ctrl, gap, edge } = self;
        TrimCurveArrays { degree, knots, control_points: ctrl, gap, edge }
    }

    fn from_arrays(arrays: TrimCurveArrays) -> Self {
        let TrimCurveArrays { degree, knots, control_points, gap, edge } = arrays;
        Self { degree, knots, ctrl: control_points, gap, edge }
    }
}

/// Returns the error for a text that `serde_json` rejected, with the path to the
/// error, such as `surfaces[0].degree`. Tracking the path makes parsing slower by a
/// third, so only texts with an error are parsed with it.
fn shape_error(text: &str, error: &serde_json::Error) -> Error {
    let mut reader = serde_json::Deserializer::from_str(text);
    let located = serde_path_to_error::deserialize::<_, InterchangeModel>(&mut reader);
    // Text after the model has no path.
    Error::JsonShape { found: located.map_or_else(|located| located.to_string(), |_| error.to_string()) }
}

impl Model {
    /// The largest JSON text accepted, in bytes: 256 MiB, about 2.5 million control
    /// points. A 32-bit wasm memory could not hold a longer text and its model
    /// together.
    pub const MAX_JSON_BYTES: u64 = 256 << 20;

    /// Parses interchange JSON, version 1 or 2: `{"name"?, "unit"?, "surfaces": [{"degree":
    /// [pu, pv], "knots_u", "knots_v", "ctrl": [[[x, y, z, w], …], …], "trim"?, "reversed"?,
    /// "part"?, "kind"?, "gap"?, "gap_measured"?, "color"?, "shell"?, "solid"?}], "instances"?}` with `ctrl[i][j]`, i along u, points
    /// not multiplied by w; docs/interchange.md describes every key. Other keys, among
    /// them `source`, are ignored. O(size), and the validation of trims.
    ///
    /// # Errors
    /// [`Error::FileTooLarge`] over [`Model::MAX_JSON_BYTES`], [`Error::JsonShape`]
    /// for text that is not of this shape, else the errors of [`Model::from_faces`].
    pub fn from_json(text: &str) -> Result<Self> {
        Self::from_faces(Self::arrays_of_json(text)?)
    }

    /// Parses interchange JSON as [`Model::from_json`] does, without validating the faces.
    ///
    /// # Errors
    /// [`Error::FileTooLarge`], [`Error::JsonShape`], [`Error::RaggedNet`].
    pub(crate) fn arrays_of_json(text: &str) -> Result<ModelArrays> {
        let found = text.len() as u64;
        if found > Self::MAX_JSON_BYTES {
            return Err(Error::FileTooLarge { found, expected: Self::MAX_JSON_BYTES });
        }
        let parsed: InterchangeModel =
            serde_json::from_str(text).map_err(|error| shape_error(text, &error))?;
        let faces = parsed.surfaces.into_iter().enumerate();
        let instances = parsed.instances.into_iter().map(|instance| {
            let InterchangeInstance { surfaces, transform, name, solid } = instance;
            InstanceArrays { surfaces, transform, name, solid }
        });
        Ok(ModelArrays {
            name: parsed.name,
            unit: parsed.unit,
            faces: faces.map(|(index, surface)| surface.into_arrays(index)).collect::<Result<_>>()?,
            instances: instances.collect(),
        })
    }

    /// Returns the model as interchange JSON, with every number in full precision.
    /// Instances are written as the faces that they place.
    ///
    /// # Errors
    /// [`Error::JsonShape`] if the writer fails, which it does not for valid models.
    pub fn to_json(&self) -> Result<String> {
        let model = InterchangeModel {
            name: self.name().map(str::to_owned),
            unit: self.unit(),
            surfaces: self.faces().map(|face| InterchangeSurface::from_face(&face)).collect(),
            instances: Vec::new(),
        };
        serde_json::to_string(&model).map_err(|error| Error::JsonShape { found: error.to_string() })
    }
}
