//! Elementary functions: the platform's own, natively and in JavaScript, whose
//! engine has them while the wasm module would carry them.

#[cfg(target_arch = "wasm32")]
pub(crate) use js_sys::Math::{acos, cos, log as ln, sin, tan};

#[cfg(not(target_arch = "wasm32"))]
pub(crate) use native::{acos, cos, ln, sin, tan};

#[cfg(not(target_arch = "wasm32"))]
mod native {
    pub(crate) fn acos(x: f64) -> f64 {
        x.acos()
    }

    pub(crate) fn cos(x: f64) -> f64 {
        x.cos()
    }

    pub(crate) fn ln(x: f64) -> f64 {
        x.ln()
    }

    pub(crate) fn sin(x: f64) -> f64 {
        x.sin()
    }

    pub(crate) fn tan(x: f64) -> f64 {
        x.tan()
    }
}
