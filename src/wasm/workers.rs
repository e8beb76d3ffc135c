//! What workers beside each other share: the compiled module, and blocks of points.

use super::call::Call;
use super::convert::{closest_point_options, closest_points, layers, signed_distance_options};
use super::engine::Engine;
use super::failure::to_object;
use super::model::PreparedModel;
use crate::engine::{
    self, BLOCK, ClosestPoints, MapPoints, Measurer, Running, layers_of_grid, measuring_order,
};
use crate::error::{Error, Result};
use crate::progress::Monitor;
use js_sys::{AsyncIterator, Float64Array, Function, IteratorNext, Promise, Reflect, Uint32Array};
use std::cell::RefCell;
use std::rc::Rc;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;

/// The bytes of a page of memory, by the specification of WebAssembly.
const PAGE_BYTES: f64 = 65_536.0;

/// The module as it was compiled, which is sent to a worker without being compiled again.
#[wasm_bindgen(js_name = compiledModule)]
pub fn compiled_module() -> JsValue {
    wasm_bindgen::module()
}

/// The bytes of the module's memory, which never shrinks.
#[wasm_bindgen(js_name = memoryBytes)]
pub fn memory_bytes() -> f64 {
    core::arch::wasm32::memory_size::<0>() as f64 * PAGE_BYTES
}

/// The order in which points, x, y, z each, are measured.
#[wasm_bindgen(js_name = measuringOrder)]
pub fn order(points: &[f64]) -> Result<Vec<u32>> {
    measuring_order(points)
}

/// The number of points, in the order in which they are measured, that may be measured apart from the others.
#[wasm_bindgen(js_name = pointsOfBlock)]
pub fn points_of_block() -> usize {
    BLOCK
}

/// The number of layers of bricks of the grid that these options of signed distances state.
#[wasm_bindgen(js_name = layersOfGrid)]
pub fn grid_layers(model: &PreparedModel, options: &JsValue) -> Result<usize> {
    layers_of_grid(&model.inner(), &signed_distance_options(options, &JsValue::UNDEFINED)?)
}

#[wasm_bindgen]
impl Engine {
    /// The signed distances of some layers of bricks of a grid, without the rounding in the bound, which is apart.
    #[wasm_bindgen(js_name = signedDistancesOfLayers)]
    pub fn signed_distances_of_layers(
        &self,
        model: &PreparedModel,
        first: usize,
        count: usize,
        call: Call,
    ) -> Promise {
        let (engine, model) = (Rc::clone(&self.0), model.inner());
        let options = call.options(signed_distance_options);
        call.run(async move |monitor| {
            let (options, range) = (options?, first..first.saturating_add(count));
            layers(&engine.signed_distances_of_layers(&model, &options, range).monitored(monitor).await?)
        })
    }

    /// The closest points of a model to a block of points, which are measured as they are given.
    #[wasm_bindgen(js_name = closestPointsOfBlock)]
    pub fn closest_points_of_block(&self, model: &PreparedModel, points: Vec<f64>, call: Call) -> Promise {
        let (engine, model) = (Rc::clone(&self.0), model.inner());
        let options = call.options(closest_point_options);
        call.run(async move |monitor| {
            let options = options?;
            let found = engine.closest_points_of_block(&model, &points, &options);
            closest_points(&found.monitored(monitor).await?)
        })
    }
}

/// A function of JavaScript that shares points out to workers. It is called with whether they are measured from A,
/// the points and the options of closest points, and returns an asynchronous iterator: of fractions of the work
/// done, and at the end, as its value, of the closest points.
pub(super) struct Workers<'a> {
    measure: Function,
    a: &'a engine::PreparedModel,
    thrown: RefCell<Option<JsValue>>,
}

impl<'a> Workers<'a> {
    pub(super) fn new(measure: Function, a: &'a engine::PreparedModel) -> Self {
        Self { measure, a, thrown: RefCell::default() }
    }

    /// Returns what measures by the function.
    pub(super) fn measurer(&self) -> impl Measurer {
        ByWorkers(self)
    }

    /// Returns what the function threw, which ended the work, or else the error.
    pub(super) fn thrown_or(&self, error: Error) -> JsValue {
        self.thrown.take().unwrap_or_else(|| error.into())
    }

    async fn measured(
        &self,
        MapPoints { other, points, options }: MapPoints<'_>,
        monitor: &mut dyn Monitor,
    ) -> std::result::Result<ClosestPoints, JsValue> {
        let is_from_a = std::ptr::eq(other, self.a);
        let (points, options) = (Float64Array::from(points), to_object(options)?);
        let called = self.measure.call3(&JsValue::UNDEFINED, &is_from_a.into(), &points, &options)?;
        let iterator: AsyncIterator = called.unchecked_into();
        loop {
            let next: IteratorNext = JsFuture::from(iterator.next()?).await?.unchecked_into();
            if next.done() {
                return found(&next.value());
            }
            monitor.progress(next.value().as_f64().unwrap_or_default());
        }
    }
}

struct ByWorkers<'a>(&'a Workers<'a>);

impl Measurer for ByWorkers<'_> {
    fn measure<'a>(
        &'a mut self,
        asked: MapPoints<'a>,
        monitor: &'a mut dyn Monitor,
    ) -> Running<'a, ClosestPoints> {
        Box::pin(async move {
            self.0.measured(asked, monitor).await.map_err(|thrown| {
                self.0.thrown.borrow_mut().get_or_insert(thrown);
                Error::Cancelled
            })
        })
    }
}

/// Closest points of their typed arrays.
fn found(arrays: &JsValue) -> std::result::Result<ClosestPoints, JsValue> {
    let get = |name: &str| Reflect::get(arrays, &name.into());
    let numbers = |name: &str| get(name).map(|array| array.unchecked_into::<Float64Array>().to_vec());
    Ok(ClosestPoints {
        distances: numbers("distances")?,
        bounds: numbers("bounds")?,
        signed: numbers("signed")?,
        feet: numbers("feet")?,
        faces: get("faces")?.unchecked_into::<Uint32Array>().to_vec(),
        parameters: numbers("parameters")?,
        signs: serde_wasm_bindgen::from_value(get("signs")?)?,
        // The workers of a pool use no GPU.
        decided_on_gpu: 0,
    })
}
