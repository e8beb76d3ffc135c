//! Options from plain JavaScript objects.

use crate::distance::{Backend, Options};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use glam::{DQuat, DVec3};
use js_sys::{Array, Object};
use serde::de::value::MapDeserializer;
use serde::{Deserialize, de::DeserializeOwned};
use serde_wasm_bindgen::{Deserializer, from_value};
use wasm_bindgen::{JsCast, JsValue};

/// Keys and values of an object, in its order.
type Entries = Vec<(String, JsValue)>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Transform {
    #[serde(default)]
    rotation: Option<[f64; 4]>,
    #[serde(default)]
    translation: Option<[f64; 3]>,
}

/// The options of a distance; undefined ones keep their defaults.
///
/// # Errors
/// [`Error::OptionInvalid`] for an unknown name or a value of another type,
/// [`Error::TransformNotRigid`].
pub(super) fn distance(value: &JsValue) -> Result<Options> {
    let (transform, others) =
        entries(value)?.into_iter().partition::<Entries, _>(|(name, _)| name == "transform");
    let mut options: Options = from_entries(others)?;
    if let Some((_, value)) = transform.first() {
        let Transform { rotation, translation } = from_entries(entries(value)?)?;
        options.transform = RigidTransform::new(
            rotation.map_or(DQuat::IDENTITY, DQuat::from_array),
            translation.map_or(DVec3::ZERO, DVec3::from_array),
        )?;
    }
    Ok(options)
}

/// # Errors
/// [`Error::OptionInvalid`].
pub(super) fn backend(value: &JsValue) -> Result<Backend> {
    if value.is_undefined() { Ok(Backend::Auto) } else { from_value(value.clone()).map_err(invalid) }
}

/// The entries that are not undefined; none of undefined.
fn entries(value: &JsValue) -> Result<Entries> {
    if value.is_undefined() {
        return Ok(Vec::new());
    }
    let Some(object) = value.dyn_ref::<Object>() else {
        let found =
            format!("found {}, expected an object", value.js_typeof().as_string().unwrap_or_default());
        return Err(Error::OptionInvalid { found });
    };
    let entry = |entry: JsValue| {
        let entry: Array = entry.unchecked_into();
        let value = entry.get(1);
        (!value.is_undefined()).then(|| (entry.get(0).as_string().unwrap_or_default(), value))
    };
    Ok(Object::entries(object).iter().filter_map(entry).collect())
}

/// Unlike a struct taken from an object directly, this sees unknown names.
fn from_entries<T: DeserializeOwned>(entries: Entries) -> Result<T> {
    let entries = entries.into_iter().map(|(name, value)| (name, Deserializer::from(value)));
    T::deserialize(MapDeserializer::new(entries)).map_err(invalid)
}

fn invalid(error: serde_wasm_bindgen::Error) -> Error {
    let error: JsValue = error.into();
    let found = error.dyn_ref::<js_sys::Error>().map_or_else(String::new, |error| error.message().into());
    Error::OptionInvalid { found }
}
