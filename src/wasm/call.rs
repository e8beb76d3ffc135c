//! Calls of the engine that take their turn.

use super::convert;
use super::engine::Engine;
use super::model::PreparedModel;
use super::progress::JsMonitor;
use crate::engine::Query;
use crate::error::{self, Error};
use crate::progress::Monitor;
use js_sys::{Function, Promise};
use serde::de::DeserializeOwned;
use std::rc::Rc;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, future_to_promise};
use web_sys::AbortSignal;

/// The arguments of a computation besides its models and points. The method
/// that receives a call takes it over.
#[wasm_bindgen]
pub struct Call {
    options: JsValue,
    transform: JsValue,
    monitor: JsMonitor,
    turn: Promise,
}

#[wasm_bindgen]
impl Call {
    /// The computation begins when `turn` is settled.
    #[wasm_bindgen(constructor)]
    pub fn new(
        options: JsValue,
        transform: JsValue,
        signal: Option<AbortSignal>,
        on_progress: Option<Function>,
        turn: Promise,
    ) -> Self {
        Self { options, transform, monitor: JsMonitor::new(signal, on_progress), turn }
    }
}

impl Call {
    /// The same call with progress by the steps of a fit.
    pub(super) fn by_steps(self) -> Self {
        Self { monitor: self.monitor.by_steps(), ..self }
    }

    /// The options, by the function that reads them from the plain object and the transform.
    pub(super) fn options<T>(
        &self,
        read: impl FnOnce(&JsValue, &JsValue) -> error::Result<T>,
    ) -> error::Result<T> {
        read(&self.options, &self.transform)
    }

    /// Asks a question about `a` and `b` when the turn comes, and resolves to its answer as `object` makes it.
    pub(super) fn ask<Q: Query + DeserializeOwned + 'static>(
        self,
        engine: &Engine,
        [a, b]: [&PreparedModel; 2],
        object: impl FnOnce(&Q::Answer) -> Result<JsValue, JsValue> + 'static,
    ) -> Promise {
        let (engine, a, b) = (Rc::clone(&engine.0), a.inner(), b.inner());
        let question = self.options(convert::query::<Q>);
        self.run(async move |monitor| object(&question?.ask(&engine, [&a, &b]).monitored(monitor).await?))
    }

    /// Does `work` when the turn comes, unless the monitor cancels it before.
    /// The promise resolves to the result as a plain object, and rejects with
    /// `{code, message}` or with the value that `on_progress` threw.
    pub(super) fn run(
        self,
        work: impl AsyncFnOnce(&mut JsMonitor) -> Result<JsValue, JsValue> + 'static,
    ) -> Promise {
        let Self { mut monitor, turn, .. } = self;
        future_to_promise(async move {
            // The turn comes however the previous work ended.
            let _ = JsFuture::from(turn).await;
            if monitor.cancelled() {
                return Err(Error::Cancelled.into());
            }
            let result = work(&mut monitor).await;
            match monitor.into_thrown() {
                Some(thrown) => Err(thrown),
                None => result,
            }
        })
    }
}
