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
    /// The last step of a fit and its residual; `None` of what has no steps.
    fit: Option<(usize, f64)>,
    fraction: f64,
    thrown: Option<JsValue>,
}

impl JsMonitor {
    pub(super) fn new(signal: Option<AbortSignal>, on_progress: Option<Function>) -> Self {
        let (interval, fit) = (None, None);
        Self { signal, on_progress, interval, stalled: false, fit, fraction: 0.0, thrown: None }
    }

    /// Reports steps of a fit, in place of fractions and intervals.
    pub(super) fn by_steps(self) -> Self {
        Self { fit: Some((0, f64::INFINITY)), ..self }
    }

    fn call(&mut self, [first, second, third]: [JsValue; 3]) {
        if let Some(on_progress) = &self.on_progress
            && let Err(thrown) = on_progress.call3(&JsValue::UNDEFINED, &first, &second, &third)
        {
            self.thrown.get_or_insert(thrown);
        }
    }

    /// The value that the function threw, which also cancelled the work.
    pub(super) fn into_thrown(self) -> Option<JsValue> {
        self.thrown
    }
}

impl Monitor for JsMonitor {
    fn progress(&mut self, fraction: f64) {
        self.fraction = fraction;
        match self.fit {
            // Steps report themselves.
            Some((step, _)) if step > 0 => return,
            Some((step, rms)) => return self.call([(step as f64).into(), rms.into(), fraction.into()]),
            None => {}
        }
        let interval = self
            .interval
            .map_or(JsValue::UNDEFINED, |[lower, upper]| Array::of2(&lower.into(), &upper.into()).into());
        self.call([fraction.into(), interval, self.stalled.into()]);
    }

    fn step(&mut self, step: usize, rms: f64) {
        if self.fit.is_some() {
            self.fit = Some((step, rms));
            self.call([(step as f64).into(), rms.into(), self.fraction.into()]);
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
