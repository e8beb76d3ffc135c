//! The class of models.

use super::convert;
use super::surfaces::Surfaces;
use crate::engine;
use crate::error::{Error, Result};
use crate::model::Model;
use crate::shapes::{list, shape};
use crate::tessellate::tessellate_patches;
use js_sys::JsString;
use std::rc::Rc;
use wasm_bindgen::prelude::*;

/// A model ready to be measured, shared with the distances that use it.
#[wasm_bindgen]
pub struct PreparedModel(Rc<engine::PreparedModel>);

#[wasm_bindgen]
impl PreparedModel {
    #[wasm_bindgen(js_name = fromArrays)]
    pub fn from_arrays(surfaces: Surfaces) -> Result<PreparedModel> {
        Self::new(&Model::from_faces(surfaces.into_inner())?)
    }

    /// A model of interchange JSON.
    #[wasm_bindgen(js_name = fromJson)]
    pub fn from_json(text: &JsString) -> Result<PreparedModel> {
        // No text has fewer bytes than characters: a longer one is not copied into the module's memory.
        let found = u64::from(text.length());
        if found > Model::MAX_JSON_BYTES {
            return Err(Error::FileTooLarge { found, expected: Model::MAX_JSON_BYTES });
        }
        Self::new(&Model::from_json(&String::from(text))?)
    }

    /// One of [`shapes`].
    pub fn shape(name: &str) -> Result<PreparedModel> {
        Self::new(&shape(name)?)
    }

    #[wasm_bindgen(getter)]
    pub fn name(&self) -> Option<String> {
        self.0.name().map(str::to_owned)
    }

    /// Metres per unit.
    #[wasm_bindgen(getter)]
    pub fn unit(&self) -> Option<f64> {
        self.0.unit()
    }

    #[wasm_bindgen(getter)]
    pub fn gap(&self) -> f64 {
        self.0.gap()
    }

    /// The name of a face, of which there are [`Self::surface_count`].
    pub fn part(&self, face: usize) -> Option<String> {
        if face < self.0.face_count() { self.0.part(face).map(str::to_owned) } else { None }
    }

    #[wasm_bindgen(getter, js_name = surfaceCount)]
    pub fn surface_count(&self) -> usize {
        self.0.face_count()
    }

    /// The smallest x, y, z, then the largest.
    #[wasm_bindgen(getter, js_name = boundingBox)]
    pub fn bounding_box(&self) -> Vec<f64> {
        let aabb = self.0.bounding_box();
        [aabb.min.to_array(), aabb.max.to_array()].concat()
    }

    /// Undefined is the default tolerance.
    pub fn tessellate(&self, tolerance: Option<f64>) -> std::result::Result<JsValue, JsValue> {
        convert::tessellation(&tessellate_patches(self.0.bezier(), self.0.pieces(), tolerance)?)
    }
}

impl PreparedModel {
    fn new(model: &Model) -> Result<Self> {
        Ok(Self(Rc::new(engine::PreparedModel::new(model)?)))
    }

    pub(super) fn inner(&self) -> Rc<engine::PreparedModel> {
        Rc::clone(&self.0)
    }
}

/// The shapes that the crate makes, each with its name and title.
#[wasm_bindgen]
pub fn shapes() -> std::result::Result<JsValue, JsValue> {
    convert::to_object(&list().collect::<Vec<_>>())
}
