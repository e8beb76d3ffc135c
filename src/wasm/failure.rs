//! Errors as JavaScript values.

use super::object::object;
use crate::error::Error;
use wasm_bindgen::JsValue;

impl From<Error> for JsValue {
    /// `{code, message}`, of which the package makes its class of errors.
    fn from(error: Error) -> Self {
        object(&[("code", error.code().into()), ("message", error.to_string().into())])
    }
}
