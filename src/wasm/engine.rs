//! The class that computes distances.

use super::convert;
use super::model::PreparedModel;
use super::progress::JsMonitor;
use crate::engine;
use crate::error::Error;
use crate::progress::Monitor;
use js_sys::{Function, Promise};
use std::rc::Rc;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, future_to_promise};
use web_sys::AbortSignal;

/// One device. The promises that it returns own what they need, so that
/// engine and models may be disposed of while they run.
#[wasm_bindgen]
pub struct Engine(Rc<engine::Engine>);

#[wasm_bindgen]
impl Engine {
    /// `backend`: `"auto"`, `"gpu"` or `"cpu"`; undefined is `"auto"`.
    #[wasm_bindgen(unchecked_return_type = "Promise<Engine>")]
    pub fn create(backend: &JsValue) -> Promise {
        let backend = convert::option("backend", backend);
        future_to_promise(async move { Ok(Self(Rc::new(engine::Engine::new(backend?).await?)).into()) })
    }

    #[wasm_bindgen(getter, js_name = hasGpu)]
    pub fn has_gpu(&self) -> bool {
        self.0.has_gpu()
    }

    #[wasm_bindgen(getter)]
    pub fn adapter(&self) -> Option<String> {
        self.0.adapter()
    }

    #[wasm_bindgen(getter)]
    pub fn notice(&self) -> Option<String> {
        self.0.notice()
    }

    /// Begins when `turn` is settled. Resolves to the result as a plain object;
    /// rejects with `{code, message}`, or with what `on_progress` threw.
    pub fn distance(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        options: &JsValue,
        transform: &JsValue,
        signal: Option<AbortSignal>,
        on_progress: Option<Function>,
        turn: Promise,
    ) -> Promise {
        let engine = Rc::clone(&self.0);
        let (a, b) = (a.inner(), b.inner());
        let options = convert::options(options, transform);
        in_turn(turn, JsMonitor::new(signal, on_progress), async move |monitor| {
            convert::result(&engine.distance(&a, &b, &options?, monitor).await?)
        })
    }

    /// As `distance`, for the comparison of all faces.
    pub fn diff(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        options: &JsValue,
        transform: &JsValue,
        signal: Option<AbortSignal>,
        on_progress: Option<Function>,
        turn: Promise,
    ) -> Promise {
        let engine = Rc::clone(&self.0);
        let (a, b) = (a.inner(), b.inner());
        let options = convert::diff_options(options, transform);
        in_turn(turn, JsMonitor::new(signal, on_progress), async move |monitor| {
            convert::to_object(&engine.diff(&a, &b, &options?, monitor).await?)
        })
    }

    /// As `distance`, for the closest points of a model to `points`, x, y, z each.
    #[wasm_bindgen(js_name = closestPoints)]
    pub fn closest_points(
        &self,
        model: &PreparedModel,
        points: Vec<f64>,
        options: &JsValue,
        transform: &JsValue,
        signal: Option<AbortSignal>,
        on_progress: Option<Function>,
        turn: Promise,
    ) -> Promise {
        let engine = Rc::clone(&self.0);
        let model = model.inner();
        let options = convert::closest_point_options(options, transform);
        in_turn(turn, JsMonitor::new(signal, on_progress), async move |monitor| {
            convert::closest_points(&engine.closest_points(&model, &points, &options?, monitor).await?)
        })
    }
}

/// Does `work` when `turn` is settled, unless the monitor cancels it before.
fn in_turn(
    turn: Promise,
    mut monitor: JsMonitor,
    work: impl AsyncFnOnce(&mut JsMonitor) -> Result<JsValue, JsValue> + 'static,
) -> Promise {
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
