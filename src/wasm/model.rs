//! The class of models.

use super::surfaces::Surfaces;
use super::tessellation::Tessellation;
use crate::distance;
use crate::error::Result;
use crate::model::Model;
use crate::shapes;
use crate::tessellate::tessellate;
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

    /// One of [`shape_names`].
    pub fn shape(name: &str) -> Result<PreparedModel> {
        Ok(Self::new(&shapes::shape(name)?))
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
    pub fn tessellate(&self, tolerance: Option<f64>) -> Result<Tessellation> {
        Ok(tessellate(self.0.bezier(), tolerance)?.into())
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

/// Names and titles of the shapes, by turns.
#[wasm_bindgen(js_name = shapeNames)]
pub fn shape_names() -> Vec<String> {
    shapes::list().flat_map(|info| [info.name, info.title].map(str::to_owned)).collect()
}
