//! The class that measures.

use super::model::PreparedModel;
use super::monitor::Watch;
use super::{options, result};
use crate::distance::{self, Backend, Monitor};
use crate::error::Error;
use js_sys::{Function, Promise};
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
    pub async fn create(backend: JsValue) -> Result<Engine, JsValue> {
        let backend: Backend = options::backend(&backend)?;
        Ok(Self(Rc::new(distance::Engine::new(backend).await?)))
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
        future_to_promise(async move {
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
        })
    }
}
