//! The class of models.

use super::object::object;
use super::surfaces::Surfaces;
use super::tessellation::plain;
use crate::distance;
use crate::error::Result;
use crate::model::Model;
use crate::shapes::{ShapeInfo, list, shape};
use crate::tessellate::tessellate_patches;
use js_sys::Array;
use std::rc::Rc;
use wasm_bindgen::prelude::*;

/// A model ready to be measured, shared with the distances in work on it.
#[wasm_bindgen]
pub struct PreparedModel(Rc<distance::PreparedModel>);

#[wasm_bindgen]
impl PreparedModel {
    #[wasm_bindgen(js_name = fromArrays)]
    pub fn from_arrays(name: Option<String>, surfaces: Surfaces) -> Result<PreparedModel> {
        Ok(Self::new(&Model::from_arrays(name, surfaces.into_inner())?))
    }

    /// One of [`shapes`].
    pub fn shape(name: &str) -> Result<PreparedModel> {
        Ok(Self::new(&shape(name)?))
    }

    #[wasm_bindgen(getter)]
    pub fn name(&self) -> Option<String> {
        self.0.name().map(str::to_owned)
    }

    #[wasm_bindgen(getter, js_name = surfaceCount)]
    pub fn surface_count(&self) -> usize {
        self.0.bezier().grids.len()
    }

    /// The least x, y, z, then the greatest.
    #[wasm_bindgen(getter, js_name = boundingBox)]
    pub fn bounding_box(&self) -> Vec<f64> {
        let aabb = self.0.bounding_box();
        [aabb.min.to_array(), aabb.max.to_array()].concat()
    }

    /// Undefined is the default tolerance.
    pub fn tessellate(&self, tolerance: Option<f64>) -> Result<JsValue> {
        Ok(plain(&tessellate_patches(self.0.bezier(), tolerance)?))
    }
}

impl PreparedModel {
    fn new(model: &Model) -> Self {
        Self(Rc::new(distance::PreparedModel::new(model)))
    }

    pub(super) fn inner(&self) -> Rc<distance::PreparedModel> {
        Rc::clone(&self.0)
    }
}

/// The shapes there are, each with its name and title.
#[wasm_bindgen]
pub fn shapes() -> Array {
    let all = Array::new();
    for ShapeInfo { name, title } in list() {
        all.push(&object(&[("name", name.into()), ("title", title.into())]));
    }
    all
}
