//! Values on their way between Rust and JavaScript: options, results and tessellations.

use super::failure::to_object;
use crate::engine::{
    CheckOptions, ClosestPointOptions, ClosestPoints, DeviationField, DistanceOptions, DistanceResult,
    FaceDeviations, Grid, Layers, NamedOptions, Precision, Query, SignedDistanceOptions, SignedDistances,
    Signs, Statistics,
};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use crate::tessellate::{Tessellation, TessellationOptions};
use glam::{DQuat, DVec3};
use js_sys::{Array, Float32Array, Float64Array, Object, Reflect, Uint8Array, Uint32Array};
use serde::de::DeserializeOwned;
use serde::de::value::MapDeserializer;
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::Deserializer;
use wasm_bindgen::{JsCast, JsValue};

/// The options of a distance; undefined ones have their defaults. The
/// transform is a value of its own, whose numbers have conditions.
///
/// # Errors
/// [`Error::OptionInvalid`] for an unknown name, a value of another type or an option of another method,
/// [`Error::TransformNotRigid`].
pub(super) fn options(options: &JsValue, transform: &JsValue) -> Result<DistanceOptions> {
    let transform = rigid_transform(transform)?;
    let named: NamedOptions = properties(options).map_err(invalid)?;
    NamedOptions { transform, ..named }.try_into()
}

/// The options of a question about two models, as [`options`].
///
/// # Errors
/// As [`options`].
pub(super) fn query<Q: Query + DeserializeOwned>(options: &JsValue, transform: &JsValue) -> Result<Q> {
    let transform = rigid_transform(transform)?;
    Ok(properties::<Q>(options).map_err(invalid)?.moved(transform))
}

/// The options of signed distances, as [`options`]; they have no transform.
///
/// # Errors
/// As [`options`].
pub(super) fn signed_distance_options(
    options: &JsValue,
    transform: &JsValue,
) -> Result<SignedDistanceOptions> {
    without_transform(options, transform, "grids")
}

/// The options of a check, as [`options`]; they have no transform.
///
/// # Errors
/// As [`options`].
pub(super) fn check_options(options: &JsValue, transform: &JsValue) -> Result<CheckOptions> {
    without_transform(options, transform, "checks")
}

fn without_transform<T: DeserializeOwned>(options: &JsValue, transform: &JsValue, what: &str) -> Result<T> {
    if !transform.is_undefined() {
        return Err(invalid(format!("a transform, which {what} do not have")));
    }
    properties(options).map_err(invalid)
}

/// The options of closest points, as [`options`].
///
/// # Errors
/// As [`options`].
pub(super) fn closest_point_options(options: &JsValue, transform: &JsValue) -> Result<ClosestPointOptions> {
    let transform = rigid_transform(transform)?;
    let options: ClosestPointOptions = properties(options).map_err(invalid)?;
    Ok(ClosestPointOptions { transform, ..options })
}

/// The options of a tessellation, as [`options`].
///
/// # Errors
/// [`Error::OptionInvalid`].
pub(super) fn tessellation_options(options: &JsValue) -> Result<TessellationOptions> {
    properties(options).map_err(invalid)
}

/// The transform of an object; undefined is the identity.
fn rigid_transform(transform: &JsValue) -> Result<RigidTransform> {
    if transform.is_undefined() {
        return Ok(RigidTransform::IDENTITY);
    }
    let TransformParts { rotation, translation } =
        properties(transform).map_err(|found| invalid(format!("transform: {found}")))?;
    RigidTransform::new(DQuat::from_array(rotation), DVec3::from_array(translation))
}

/// One option given apart from the others; undefined is its default.
///
/// # Errors
/// [`Error::OptionInvalid`] that names it.
pub(super) fn option<T: DeserializeOwned + Default>(name: &str, value: &JsValue) -> Result<T> {
    if value.is_undefined() {
        return Ok(T::default());
    }
    serde_wasm_bindgen::from_value(value.clone())
        .map_err(|error| invalid(format!("{name}: {}", message(error))))
}

#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct TransformParts {
    #[serde(deserialize_with = "numbers")]
    rotation: [f64; 4],
    #[serde(deserialize_with = "numbers")]
    translation: [f64; 3],
}

/// Exactly N numbers, where serde's arrays ignore the rest of a longer one.
fn numbers<'de, D: serde::Deserializer<'de>, const N: usize>(
    deserializer: D,
) -> std::result::Result<[f64; N], D::Error> {
    let numbers = Vec::<f64>::deserialize(deserializer)?;
    numbers.try_into().map_err(|numbers: Vec<f64>| {
        serde::de::Error::invalid_length(numbers.len(), &format!("{N} numbers").as_str())
    })
}

impl Default for TransformParts {
    fn default() -> Self {
        Self { rotation: DQuat::IDENTITY.to_array(), translation: [0.0; 3] }
    }
}

/// A struct from the properties of an object that are not undefined.
/// `serde_wasm_bindgen::from_value` would look for the struct's fields only,
/// and so not see unknown names.
///
/// # Errors
/// The name of the property, what was found and what was expected.
fn properties<T: DeserializeOwned>(value: &JsValue) -> std::result::Result<T, String> {
    let Some(object) = value.dyn_ref::<Object>() else {
        let found = if value.is_null() { Some("null".to_owned()) } else { value.js_typeof().as_string() };
        return Err(format!("found {}, expected an object", found.unwrap_or_default()));
    };
    let defined = Object::entries(object).into_iter().filter_map(|entry| {
        let entry: Array = entry.unchecked_into();
        let value = entry.get(1);
        (!value.is_undefined())
            .then(|| (entry.get(0).as_string().unwrap_or_default(), Deserializer::from(value)))
    });
    // To serde null is an option that is not given.
    let mut entries = Object::entries(object).into_iter().map(JsCast::unchecked_into::<Array>);
    if let Some(null) = entries.find(|entry: &Array| entry.get(1).is_null()) {
        return Err(format!("{}: found null", null.get(0).as_string().unwrap_or_default()));
    }
    serde_path_to_error::deserialize(MapDeserializer::new(defined)).map_err(|error| {
        let path = error.path().to_string();
        format!("{path}: {}", message(error.into_inner()))
    })
}

/// The message of a deserializer's error, which is a JavaScript `Error`.
fn message(error: serde_wasm_bindgen::Error) -> String {
    JsValue::from(error).unchecked_into::<js_sys::Error>().message().into()
}

fn invalid(found: String) -> Error {
    Error::OptionInvalid { found }
}

/// A result as the command line's JSON, with the fields as typed arrays.
///
/// # Errors
/// As [`to_object`].
pub(super) fn result(result: &DistanceResult) -> std::result::Result<JsValue, JsValue> {
    let object = to_object(result)?;
    set_deviations(&object, result)?;
    for (name, directed) in [("forward", &result.forward), ("reverse", &result.reverse)] {
        if let Some(directed) = directed {
            set_deviations(&Reflect::get(&object, &name.into())?, directed)?;
        }
    }
    Ok(object)
}

fn set_deviations(object: &JsValue, result: &DistanceResult) -> std::result::Result<(), JsValue> {
    if !result.deviations.is_empty() {
        Reflect::set(object, &"deviations".into(), &to_object(&arrays(&result.deviations))?)?;
    }
    Ok(())
}

fn arrays(deviations: &[FaceDeviations]) -> Vec<FaceArrays> {
    deviations.iter().map(FaceArrays::from).collect()
}

/// A field with its statistics.
///
/// # Errors
/// As [`to_object`].
pub(super) fn deviation_field(found: &DeviationField) -> std::result::Result<JsValue, JsValue> {
    to_object(&DeviationArrays {
        diagonal: found.diagonal,
        statistics: found.statistics,
        deviations: arrays(&found.deviations),
    })
}

#[derive(Serialize)]
struct DeviationArrays {
    diagonal: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    statistics: Option<Statistics>,
    deviations: Vec<FaceArrays>,
}

#[derive(Serialize)]
struct FaceArrays {
    face: usize,
    counts: [usize; 2],
    #[serde(with = "serde_wasm_bindgen::preserve")]
    points: Float64Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    feet: Float64Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    distances: Float64Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    signed: Float64Array,
    signs: Signs,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    areas: Float64Array,
    /// Undefined but for a mesh.
    #[serde(with = "serde_wasm_bindgen::preserve", skip_serializing_if = "JsValue::is_undefined")]
    triangles: JsValue,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    statuses: Uint8Array,
}

impl From<&FaceDeviations> for FaceArrays {
    fn from(field: &FaceDeviations) -> Self {
        Self {
            face: field.face,
            counts: field.counts,
            points: field.points.as_slice().into(),
            feet: field.feet.as_slice().into(),
            distances: field.distances.as_slice().into(),
            signed: field.signed.as_slice().into(),
            signs: field.signs,
            areas: field.areas.as_slice().into(),
            triangles: if field.triangles.is_empty() {
                JsValue::UNDEFINED
            } else {
                Uint32Array::from(field.triangles.as_slice()).into()
            },
            statuses: field.statuses.as_slice().into(),
        }
    }
}

#[derive(Serialize)]
struct ClosestPointArrays {
    #[serde(with = "serde_wasm_bindgen::preserve")]
    distances: Float64Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    bounds: Float64Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    signed: Float64Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    feet: Float64Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    faces: Uint32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    parameters: Float64Array,
    signs: Signs,
    #[serde(rename = "decidedOnGpu")]
    decided_on_gpu: usize,
}

/// Closest points as typed arrays.
///
/// # Errors
/// As [`to_object`].
pub(super) fn closest_points(found: &ClosestPoints) -> std::result::Result<JsValue, JsValue> {
    to_object(&ClosestPointArrays {
        distances: found.distances.as_slice().into(),
        bounds: found.bounds.as_slice().into(),
        signed: found.signed.as_slice().into(),
        feet: found.feet.as_slice().into(),
        faces: found.faces.as_slice().into(),
        parameters: found.parameters.as_slice().into(),
        signs: found.signs,
        decided_on_gpu: found.decided_on_gpu,
    })
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct GridArrays {
    #[serde(flatten)]
    grid: Grid,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    values: JsValue,
    precision: Precision,
    bound: f64,
    band: f64,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    undecided: Uint32Array,
    measured: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    rounding: Option<f64>,
}

/// Signed distances as typed arrays.
///
/// # Errors
/// As [`to_object`].
pub(super) fn signed_distances(found: &SignedDistances) -> std::result::Result<JsValue, JsValue> {
    grid_arrays(found, None)
}

/// Signed distances of layers of a grid, with their rounding.
///
/// # Errors
/// As [`to_object`].
pub(super) fn layers(layers: &Layers) -> std::result::Result<JsValue, JsValue> {
    grid_arrays(&layers.found, Some(layers.rounding))
}

fn grid_arrays(found: &SignedDistances, rounding: Option<f64>) -> std::result::Result<JsValue, JsValue> {
    let values = match found.precision {
        // Values of that precision are numbers of float32.
        Precision::Float32 => {
            let values: Vec<f32> = found.values.iter().map(|&value| value as f32).collect();
            Float32Array::from(values.as_slice()).into()
        }
        Precision::Float64 => Float64Array::from(found.values.as_slice()).into(),
    };
    // Indices of at most 2^29 points.
    let undecided: Vec<u32> = found.undecided.iter().map(|&index| index as u32).collect();
    let SignedDistances { grid, precision, bound, band, measured, .. } = *found;
    let undecided = Uint32Array::from(undecided.as_slice());
    to_object(&GridArrays { grid, values, precision, bound, band, undecided, measured, rounding })
}

/// Triangles as typed arrays.
///
/// # Errors
/// As [`to_object`].
pub(super) fn tessellation(tessellation: &Tessellation) -> std::result::Result<JsValue, JsValue> {
    to_object(&TessellationArrays {
        positions: tessellation.positions.as_slice().into(),
        normals: tessellation.normals.as_slice().into(),
        indices: tessellation.indices.as_slice().into(),
        origin: tessellation.origin.to_array(),
        faces: tessellation
            .faces
            .iter()
            .map(|range| IndexRange { first_index: range.start, index_count: range.len() })
            .collect(),
    })
}

#[derive(Serialize)]
struct TessellationArrays {
    #[serde(with = "serde_wasm_bindgen::preserve")]
    positions: Float32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    normals: Float32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    indices: Uint32Array,
    origin: [f64; 3],
    faces: Vec<IndexRange>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct IndexRange {
    first_index: usize,
    index_count: usize,
}
