//! Plain JavaScript objects.

use js_sys::{Object, Reflect};
use wasm_bindgen::JsValue;

/// An object with these properties.
pub(super) fn object(properties: &[(&str, JsValue)]) -> JsValue {
    let object = Object::new();
    for (name, value) in properties {
        // Only a proxy or a frozen object refuses a property.
        let _ = Reflect::set(&object, &(*name).into(), value);
    }
    object.into()
}
