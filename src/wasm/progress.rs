//! Progress to a JavaScript function, cancelling by an `AbortSignal`.

use crate::progress::Monitor;
use js_sys::{Array, Function};
use wasm_bindgen::JsValue;
use web_sys::AbortSignal;

/// The caller's signal and function, both optional.
pub(super) struct JsMonitor {
    signal: Option<AbortSignal>,
    on_progress: Option<Function>,
    interval: Option<[f64; 2]>,
    stalled: bool,
    thrown: Option<JsValue>,
}

impl JsMonitor {
    pub(super) fn new(signal: Option<AbortSignal>, on_progress: Option<Function>) -> Self {
        Self { signal, on_progress, interval: None, stalled: false, thrown: None }
    }

    /// The value that the function threw, which also cancelled the work.
    pub(super) fn into_thrown(self) -> Option<JsValue> {
        self.thrown
    }
}

impl Monitor for JsMonitor {
    fn progress(&mut self, fraction: f64) {
        let interval = self
            .interval
            .map_or(JsValue::UNDEFINED, |[lower, upper]| Array::of2(&lower.into(), &upper.into()).into());
        if let Some(on_progress) = &self.on_progress
            && let Err(thrown) =
                on_progress.call3(&JsValue::UNDEFINED, &fraction.into(), &interval, &self.stalled.into())
        {
            self.thrown.get_or_insert(thrown);
        }
    }

    fn interval(&mut self, lower: f64, upper: f64) {
        self.interval = Some([lower, upper]);
    }

    fn stalled(&mut self, stalled: bool) {
        self.stalled = stalled;
    }

    fn cancelled(&self) -> bool {
        self.thrown.is_some() || self.signal.as_ref().is_some_and(AbortSignal::aborted)
    }
}
