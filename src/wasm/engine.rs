//! The class that measures.

use super::model::PreparedModel;
use super::monitor::Watch;
use super::{options, result};
use crate::engine;
use crate::error::Error;
use crate::progress::Monitor;
use js_sys::{Function, Promise};
use std::pin::Pin;
use std::rc::Rc;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, future_to_promise};
use web_sys::AbortSignal;

/// One device. The promises it gives own what they need, so that disposing of
/// engine or models while they run is safe.
#[wasm_bindgen]
pub struct Engine(Rc<distance::Engine>);

#[wasm_bindgen]
impl Engine {
    /// `backend`: `"auto"`, `"gpu"` or `"cpu"`; undefined is `"auto"`.
    #[wasm_bindgen(unchecked_return_type = "Promise<Engine>")]
    pub fn create(backend: &JsValue) -> Promise {
        let backend = options::backend(backend);
        promise(Box::pin(async move { Ok(Self(Rc::new(distance::Engine::new(backend?).await?)).into()) }))
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
        signal: Option<AbortSignal>,
        on_progress: Option<Function>,
        turn: Promise,
    ) -> Promise {
        let engine = Rc::clone(&self.0);
        let (a, b) = (a.inner(), b.inner());
        let options = options::distance(options);
        promise(Box::pin(async move {
            let options = options?;
            // However the distance before ended, it is this one's turn.
            let _ = JsFuture::from(turn).await;
            let mut watch = Watch::new(signal, on_progress);
            if watch.cancelled() {
                return Err(Error::Cancelled.into());
            }
            let measured = engine.distance(&a, &b, &options, &mut watch).await;
            match (watch.into_thrown(), measured) {
                (Some(thrown), _) => Err(thrown),
                (None, measured) => result::of(&measured?),
            }
        }))
    }
}

/// Of work of any kind, so that what drives it is compiled once.
fn promise(work: Pin<Box<dyn Future<Output = Result<JsValue, JsValue>>>>) -> Promise {
    future_to_promise(work)
}
