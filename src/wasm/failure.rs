//! Plain objects and errors for JavaScript.

use crate::error::Error;
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::JsValue;

/// A plain object as the command line's JSON, with `null` for absent values.
///
/// # Errors
/// The serializer's, which the crate's own types do not cause.
pub fn to_object(value: &impl Serialize) -> Result<JsValue, JsValue> {
    Ok(value.serialize(&Serializer::json_compatible())?)
}

impl From<Error> for JsValue {
    /// `{code, message}`, from which the package makes its class of errors.
    fn from(error: Error) -> Self {
        #[derive(Serialize)]
        struct Failure {
            code: &'static str,
            message: String,
        }
        let failure = Failure { code: error.code(), message: error.to_string() };
        to_object(&failure).unwrap_or_else(|thrown| thrown)
    }
}
