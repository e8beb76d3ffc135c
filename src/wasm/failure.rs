//! Errors as JavaScript values.

use crate::error::Error;
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::JsValue;

#[derive(Serialize)]
struct Failure {
    code: &'static str,
    message: String,
}

impl From<Error> for JsValue {
    /// `{code, message}`, of which the package makes its class of errors.
    fn from(error: Error) -> Self {
        let failure = Failure { code: error.code(), message: error.to_string() };
        // Two strings always serialise.
        failure.serialize(&Serializer::json_compatible()).unwrap_or_default()
    }
}
