//! Numbers in messages.

use std::fmt::{Display, Formatter, Result};

/// A number written in the fewest digits that tell it from others. In
/// JavaScript by its engine, as the wasm module would carry tables for it.
pub(crate) struct Shown(pub(crate) f64);

/// Sizes written without an exponent: those that JavaScript does, for a number
/// looks the same everywhere.
#[cfg(not(target_arch = "wasm32"))]
const PLAIN: std::ops::Range<f64> = 1e-6..1e21;

#[cfg(not(target_arch = "wasm32"))]
impl Display for Shown {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        let is_plain = PLAIN.contains(&self.0.abs()) || self.0 == 0.0 || !self.0.is_finite();
        if is_plain { self.0.fmt(formatter) } else { std::fmt::LowerExp::fmt(&self.0, formatter) }
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
