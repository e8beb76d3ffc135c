//! Maps of deviations.

use super::call::Call;
use super::convert::query;
use super::engine::Engine;
use super::failure::to_object;
use super::model::PreparedModel;
use super::workers::Workers;
use crate::engine::{DeviationMap, DeviationMapOptions, DeviationMaps, Here, Signs};
use js_sys::{Float32Array, Float64Array, Function, Promise, Uint32Array};
use serde::Serialize;
use std::rc::Rc;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Engine {
    /// The maps of the models that the options name. `on_coarse` is called with the maps before their triangles are
    /// split; what it throws is ignored. `measure`, if it is given, measures their points, as [`Workers`] states.
    #[wasm_bindgen(js_name = deviationMaps)]
    pub fn deviation_maps(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        on_coarse: Option<Function>,
        measure: Option<Function>,
        call: Call,
    ) -> Promise {
        let (engine, a, b) = (Rc::clone(&self.0), a.inner(), b.inner());
        let options = call.options(query::<DeviationMapOptions>);
        call.run(async move |monitor| {
            let tell = |coarse: DeviationMaps| {
                if let (Some(on_coarse), Ok(maps)) = (&on_coarse, maps(&coarse)) {
                    // The caller's listener keeps what it throws.
                    let _ = on_coarse.call1(&JsValue::UNDEFINED, &maps);
                }
            };
            let options = options?;
            let Some(measure) = measure else {
                return maps(
                    &engine.deviation_maps_by(&a, &b, &options, Here, tell).monitored(monitor).await?,
                );
            };
            let workers = Workers::new(measure, &a);
            let found =
                engine.deviation_maps_by(&a, &b, &options, workers.measurer(), tell).monitored(monitor).await;
            maps(&found.map_err(|error| workers.thrown_or(error))?)
        })
    }
}

#[derive(Serialize)]
struct Maps {
    diagonal: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    a: Option<MapArrays>,
    #[serde(skip_serializing_if = "Option::is_none")]
    b: Option<MapArrays>,
}

#[derive(Serialize)]
struct MapArrays {
    #[serde(with = "serde_wasm_bindgen::preserve")]
    positions: Float32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    normals: Float32Array,
    origin: [f64; 3],
    #[serde(with = "serde_wasm_bindgen::preserve")]
    indices: Uint32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    faces: Uint32Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    points: Float64Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    slacks: Float64Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    distances: Float64Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    signed: Float64Array,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    feet: Float64Array,
    signs: Signs,
}

impl From<&DeviationMap> for MapArrays {
    fn from(map: &DeviationMap) -> Self {
        Self {
            positions: map.positions.as_slice().into(),
            normals: map.normals.as_slice().into(),
            origin: map.origin.to_array(),
            indices: map.indices.as_slice().into(),
            faces: map.faces.as_slice().into(),
            points: map.points.as_slice().into(),
            slacks: map.slacks.as_slice().into(),
            distances: map.distances.as_slice().into(),
            signed: map.signed.as_slice().into(),
            feet: map.feet.as_slice().into(),
            signs: map.signs,
        }
    }
}

/// Maps as typed arrays.
///
/// # Errors
/// As [`to_object`].
fn maps(maps: &DeviationMaps) -> Result<JsValue, JsValue> {
    let [a, b] = [&maps.a, &maps.b].map(|map| map.as_ref().map(MapArrays::from));
    to_object(&Maps { diagonal: maps.diagonal, a, b })
}
