//! Options from plain JavaScript objects.

use super::value::{BACKENDS, Place, mismatch, named, take};
use crate::engine::{Backend, Options};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use glam::{DQuat, DVec3};
use wasm_bindgen::JsValue;

/// The options of a distance; undefined ones keep their defaults.
///
/// # Errors
/// [`Error::OptionInvalid`] for an unknown name or a value of another type,
/// [`Error::TransformNotRigid`].
pub(super) fn distance(value: &JsValue) -> Result<Options> {
    let (mut options, mut transform) = (Options::default(), JsValue::UNDEFINED);
    let mut places = [
        ("method", Place::Method(&mut options.method)),
        ("tolerance", Place::Number(&mut options.tolerance)),
        ("absolute", Place::Flag(&mut options.absolute)),
        ("limit", Place::OptionalNumber(&mut options.limit)),
        ("maxSeconds", Place::OptionalNumber(&mut options.max_seconds)),
        ("maxCells", Place::OptionalCount(&mut options.max_cells)),
        ("samples", Place::Count(&mut options.samples)),
        ("sampling", Place::Sampling(&mut options.sampling)),
        ("flatness", Place::Flatness(&mut options.flatness)),
        ("projection", Place::Projection(&mut options.projection)),
        ("culling", Place::Culling(&mut options.culling)),
        ("iterations", Place::Steps(&mut options.iterations)),
        ("stepTolerance", Place::Number(&mut options.step_tolerance)),
        ("grid", Place::Count(&mut options.grid)),
        ("memoryBudget", Place::Count(&mut options.memory_budget)),
        ("symmetric", Place::Flag(&mut options.symmetric)),
        ("transform", Place::Object(&mut transform)),
        ("backend", Place::Backend(&mut options.backend)),
        ("field", Place::Flag(&mut options.field)),
    ];
    take(value, &mut places).map_err(|found| Error::OptionInvalid { found })?;
    if !transform.is_undefined() {
        options.transform = rigid(&transform)?;
    }
    Ok(options)
}

fn rigid(value: &JsValue) -> Result<RigidTransform> {
    let mut rotation = DQuat::IDENTITY.to_array();
    let mut translation = [0.0; 3];
    let mut places =
        [("rotation", Place::Numbers(&mut rotation)), ("translation", Place::Numbers(&mut translation))];
    take(value, &mut places)
        .map_err(|found| Error::OptionInvalid { found: format!("transform: {found}") })?;
    RigidTransform::new(DQuat::from_array(rotation), DVec3::from_array(translation))
}

/// # Errors
/// [`Error::OptionInvalid`].
pub(super) fn backend(value: &JsValue) -> Result<Backend> {
    if value.is_undefined() {
        return Ok(Backend::Auto);
    }
    named(value, BACKENDS)
        .map_err(|expected| Error::OptionInvalid { found: mismatch("backend", value, &expected) })
}
