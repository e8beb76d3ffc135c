//! Options from plain JavaScript objects.

use super::value::{Mismatch, Properties, Value, described};
use crate::distance::{Backend, Options};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use glam::{DQuat, DVec3};
use serde::Deserialize;
use wasm_bindgen::JsValue;

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
    let (others, transform) = Properties::of(value).map_err(invalid)?.without("transform");
    let mut options = Options::deserialize(others).map_err(invalid)?;
    if let Some(value) = transform {
        let properties = Properties::of(&value).map_err(of_transform)?;
        let Transform { rotation, translation } = Transform::deserialize(properties).map_err(of_transform)?;
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
    if value.is_undefined() {
        return Ok(Backend::Auto);
    }
    let found = described(value);
    Backend::deserialize(Value(value.clone()))
        .map_err(|error| Error::OptionInvalid { found: format!("backend is {found}, {error}") })
}

fn invalid(Mismatch(found): Mismatch) -> Error {
    Error::OptionInvalid { found }
}

fn of_transform(Mismatch(found): Mismatch) -> Error {
    Error::OptionInvalid { found: format!("transform: {found}") }
}
