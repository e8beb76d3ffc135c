//! Numbers in messages.

use std::fmt::{Display, Formatter, Result};

/// A number written in the fewest digits that tell it from others. In
/// JavaScript by its engine, as the wasm module would carry tables for it.
pub(crate) struct Shown(pub(crate) f64);

#[cfg(not(target_arch = "wasm32"))]
impl Display for Shown {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        self.0.fmt(formatter)
    }
}

#[cfg(target_arch = "wasm32")]
impl Display for Shown {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        use wasm_bindgen::prelude::wasm_bindgen;
        #[wasm_bindgen]
        extern "C" {
            #[wasm_bindgen(js_name = String)]
            fn string(number: f64) -> String;
        }
        formatter.write_str(&string(self.0))
    }
}
