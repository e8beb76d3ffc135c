//! A result as a plain JavaScript object.

use super::object::object;
use super::plain::Plain;
use crate::engine::{DistanceResult, Field};
use js_sys::{Array, Float64Array, Reflect, Uint8Array};
use serde::Serialize;
use wasm_bindgen::{JsError, JsValue};

/// The result as the command line prints it, with the fields as typed arrays.
pub(super) fn of(result: &DistanceResult) -> Result<JsValue, JsValue> {
    let object = result.serialize(Plain).map_err(JsError::from)?;
    add_field(&object, result)?;
    for (name, directed) in [("forward", &result.forward), ("reverse", &result.reverse)] {
        if let Some(directed) = directed {
            add_field(&Reflect::get(&object, &name.into())?, directed)?;
        }
    }
    Ok(object)
}

fn add_field(object: &JsValue, result: &DistanceResult) -> Result<(), JsValue> {
    if !result.field.is_empty() {
        let fields = Array::new();
        for part in &result.field {
            fields.push(&field(part));
        }
        Reflect::set(object, &"field".into(), &fields)?;
    }
    Ok(())
}

fn field(field: &Field) -> JsValue {
    let [rows, columns] = field.counts.map(|count| JsValue::from(count as u32));
    object(&[
        ("surface", JsValue::from(field.surface as u32)),
        ("counts", Array::of2(&rows, &columns).into()),
        ("points", Float64Array::from(field.points.as_slice()).into()),
        ("feet", Float64Array::from(field.feet.as_slice()).into()),
        ("distances", Float64Array::from(field.distances.as_slice()).into()),
        ("signed", Float64Array::from(field.signed.as_slice()).into()),
        ("areas", Float64Array::from(field.areas.as_slice()).into()),
        ("statuses", Uint8Array::from(field.statuses.as_slice()).into()),
    ])
}
