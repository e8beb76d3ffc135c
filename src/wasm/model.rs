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
pub struct PreparedModel {
    /// The model itself, for updates.
    source: Model,
    prepared: Rc<engine::PreparedModel>,
}

#[wasm_bindgen]
impl PreparedModel {
    #[wasm_bindgen(js_name = fromArrays)]
    pub fn from_arrays(surfaces: Surfaces) -> Result<PreparedModel> {
        Ok(Self::new(Model::from_arrays(None, surfaces.into_inner())?))
    }

    /// A model of interchange JSON.
    #[wasm_bindgen(js_name = fromJson)]
    pub fn from_json(text: &JsString) -> Result<PreparedModel> {
        // No text has fewer bytes than characters: a longer one is not copied into the module's memory.
        let found = u64::from(text.length());
        if found > Model::MAX_JSON_BYTES {
            return Err(Error::FileTooLarge { found, expected: Model::MAX_JSON_BYTES });
        }
        Ok(Self::new(Model::from_json(&String::from(text))?))
    }

    /// One of [`shapes`].
    pub fn shape(name: &str) -> Result<PreparedModel> {
        Ok(Self::new(shape(name)?))
    }

    #[wasm_bindgen(getter)]
    pub fn name(&self) -> Option<String> {
        self.prepared.name().map(str::to_owned)
    }

    #[wasm_bindgen(getter, js_name = surfaceCount)]
    pub fn surface_count(&self) -> usize {
        self.prepared.bezier().grids.len()
    }

    /// The smallest x, y, z, then the largest.
    #[wasm_bindgen(getter, js_name = boundingBox)]
    pub fn bounding_box(&self) -> Vec<f64> {
        let aabb = self.prepared.bounding_box();
        [aabb.min.to_array(), aabb.max.to_array()].concat()
    }

    /// Replaces the control points of a surface, x, y, z, w each; distances that are
    /// being computed keep the old ones.
    pub fn update(&mut self, surface: usize, control_points: Vec<f64>) -> Result<()> {
        let (points, _) = control_points.as_chunks();
        self.source = self.source.with_control_points(surface, points.to_vec())?;
        self.prepared = Rc::new(self.prepared.updated(&self.source));
        Ok(())
    }

    /// Undefined is the default tolerance.
    pub fn tessellate(&self, tolerance: Option<f64>) -> std::result::Result<JsValue, JsValue> {
        convert::tessellation(&tessellate_patches(self.prepared.bezier(), tolerance)?)
    }
}

impl PreparedModel {
    fn new(source: Model) -> Self {
        Self { prepared: Rc::new(engine::PreparedModel::new(&source)), source }
    }

    pub(super) fn inner(&self) -> Rc<engine::PreparedModel> {
        Rc::clone(&self.prepared)
    }
}

/// The shapes that the crate makes, each with its name and title.
#[wasm_bindgen]
pub fn shapes() -> std::result::Result<JsValue, JsValue> {
    convert::to_object(&list().collect::<Vec<_>>())
}
