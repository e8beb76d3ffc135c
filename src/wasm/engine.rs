//! The class that computes distances.

use super::call::Call;
use super::convert;
use super::failure::to_object;
use super::model::{NamedModels, PreparedModel};
use crate::engine::{
    self, BestFitOptions, ClearanceOptions, DiffOptions, FieldOptions, GapOptions, OverlapOptions,
    ScoreOptions, StatisticsOptions,
};
use js_sys::Promise;
use std::rc::Rc;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::future_to_promise;

/// One device. The promises that it returns own what they need, so that
/// engine and models may be disposed of while they run.
#[wasm_bindgen]
pub struct Engine(pub(super) Rc<engine::Engine>);

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

    /// The distance from `a` to `b`.
    pub fn distance(&self, a: &PreparedModel, b: &PreparedModel, call: Call) -> Promise {
        let (engine, a, b) = (Rc::clone(&self.0), a.inner(), b.inner());
        let options = call.options(convert::options);
        call.run(async move |monitor| {
            convert::result(&engine.distance(&a, &b, &options?).monitored(monitor).await?)
        })
    }

    /// The deviation of `a` from `b` at samples of `a`.
    pub fn field(&self, a: &PreparedModel, b: &PreparedModel, call: Call) -> Promise {
        call.ask::<FieldOptions>(self, [a, b], convert::deviation_field)
    }

    /// The pose of `a` that fits `b` best; progress is reported by steps.
    #[wasm_bindgen(js_name = bestFit)]
    pub fn best_fit(&self, a: &PreparedModel, b: &PreparedModel, call: Call) -> Promise {
        call.by_steps().ask::<BestFitOptions>(self, [a, b], to_object)
    }

    /// The comparison of all faces of two models.
    pub fn diff(&self, a: &PreparedModel, b: &PreparedModel, call: Call) -> Promise {
        call.ask::<DiffOptions>(self, [a, b], to_object)
    }

    /// Statistics of the distances from `a` to `b`, as intervals.
    pub fn statistics(&self, a: &PreparedModel, b: &PreparedModel, call: Call) -> Promise {
        call.ask::<StatisticsOptions>(self, [a, b], to_object)
    }

    /// The score of `a` against the truth `b`.
    pub fn score(&self, a: &PreparedModel, b: &PreparedModel, call: Call) -> Promise {
        call.ask::<ScoreOptions>(self, [a, b], to_object)
    }

    /// The least distance of two models, and whether solids overlap.
    pub fn clearance(&self, a: &PreparedModel, b: &PreparedModel, call: Call) -> Promise {
        call.ask::<ClearanceOptions>(self, [a, b], to_object)
    }

    /// The volumes that two solids have in common and apart.
    pub fn overlap(&self, a: &PreparedModel, b: &PreparedModel, call: Call) -> Promise {
        call.ask::<OverlapOptions>(self, [a, b], to_object)
    }

    /// The pairs of faces of two models that come near each other.
    pub fn gaps(&self, a: &PreparedModel, b: &PreparedModel, call: Call) -> Promise {
        call.ask::<GapOptions>(self, [a, b], to_object)
    }

    /// All pairs of bodies of models.
    pub fn check(&self, models: NamedModels, call: Call) -> Promise {
        let engine = Rc::clone(&self.0);
        let options = call.options(convert::check_options);
        call.run(async move |monitor| {
            to_object(&engine.check(&models.named(), &options?).monitored(monitor).await?)
        })
    }

    /// The signed distances of a solid on a grid.
    #[wasm_bindgen(js_name = signedDistances)]
    pub fn signed_distances(&self, model: &PreparedModel, call: Call) -> Promise {
        let (engine, model) = (Rc::clone(&self.0), model.inner());
        let options = call.options(convert::signed_distance_options);
        call.run(async move |monitor| {
            convert::signed_distances(&engine.signed_distances(&model, &options?).monitored(monitor).await?)
        })
    }

    /// The closest points of a model to `points`, x, y, z each.
    #[wasm_bindgen(js_name = closestPoints)]
    pub fn closest_points(&self, model: &PreparedModel, points: Vec<f64>, call: Call) -> Promise {
        let (engine, model) = (Rc::clone(&self.0), model.inner());
        let options = call.options(convert::closest_point_options);
        call.run(async move |monitor| {
            convert::closest_points(
                &engine.closest_points(&model, &points, &options?).monitored(monitor).await?,
            )
        })
    }
}
