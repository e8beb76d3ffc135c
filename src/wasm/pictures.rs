//! Pictures of deviations, for the command line's report: a module of its own, which knows no models.
//! Who has these measures the points that a map needs.

use super::failure::to_object;
use crate::engine::Signs;
use crate::model::RigidTransform;
use crate::pictures::{Drawn, Map, MapBuilder, Picture, Pictures, Placing, Shown, Surface, draw};
use glam::{DQuat, DVec3};
use js_sys::{Function, Uint8Array};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// A map that is being made.
#[wasm_bindgen]
pub struct PictureMap {
    builder: Option<MapBuilder>,
    map: Map,
}

#[wasm_bindgen]
impl PictureMap {
    /// Begins the map of triangles as `NurbsModel.tessellate` gives them. `rotation` and `translation` move
    /// A, `scale` is A's units in one of B's, `diagonal` the larger one of both models, and `shown` what is
    /// known of this one.
    #[wasm_bindgen(constructor)]
    pub fn new(
        positions: &[f32],
        normals: &[f32],
        indices: &[u32],
        counts: &[u32],
        origin: &[f64],
        is_mesh: bool,
        is_of_a: bool,
        rotation: &[f64],
        translation: &[f64],
        scale: f64,
        diagonal: f64,
        shown: JsValue,
    ) -> Result<PictureMap, JsValue> {
        let at = |numbers: &[f64], index: usize| numbers.get(index).copied().unwrap_or(f64::NAN);
        let vector = |numbers: &[f64]| DVec3::new(at(numbers, 0), at(numbers, 1), at(numbers, 2));
        let rotation = DQuat::from_array([0, 1, 2, 3].map(|index| at(rotation, index)));
        let transform = RigidTransform::new(rotation, vector(translation))?;
        let surface = Surface { positions, normals, indices, counts, origin: vector(origin), is_mesh };
        let shown: Shown = serde_wasm_bindgen::from_value(shown)?;
        let builder = MapBuilder::new(&surface, &shown, Placing { transform, scale, is_of_a }, diagonal);
        Ok(Self { builder: Some(builder), map: Map::default() })
    }

    /// The points to be measured next, x, y, z each, in the coordinates of the other model; none if there
    /// are no more.
    pub fn pending(&self) -> Vec<f64> {
        self.builder.as_ref().map_or_else(Vec::new, MapBuilder::pending)
    }

    /// Takes the signed deviations and the distances of these points.
    pub fn measured(&mut self, signed: &[f64], distances: &[f64]) {
        if let Some(builder) = &mut self.builder {
            builder.measured(signed, distances);
        }
    }

    /// Ends the map.
    pub fn finish(&mut self, is_solid: bool) {
        let signs = if is_solid { Signs::Solid } else { Signs::Faces };
        if let Some(builder) = self.builder.take() {
            self.map = builder.finish(signs);
        }
    }
}

/// Draws the maps of A and of B that there are; `deflate` makes a zlib stream of bytes.
#[wasm_bindgen(js_name = drawPictures)]
pub fn draw_pictures(
    a: Option<PictureMap>,
    b: Option<PictureMap>,
    diagonal: f64,
    unit: Option<f64>,
    allowed: Option<f64>,
    deflate: &Function,
) -> Result<JsValue, JsValue> {
    let compressed = |bytes: &[u8]| -> Result<Vec<u8>, JsValue> {
        let stream = deflate.call1(&JsValue::UNDEFINED, &Uint8Array::from(bytes))?;
        Ok(Uint8Array::new(&stream).to_vec())
    };
    let maps = [&a, &b].map(|map| map.as_ref().map(|map| &map.map));
    let Pictures { figures, legend } = draw(Drawn { maps, diagonal, unit, allowed }, compressed)?;
    let figures = figures
        .iter()
        .map(|figure| FigureObject {
            caption: &figure.caption,
            pictures: figure.pictures.iter().map(PictureObject::from).collect(),
        })
        .collect();
    to_object(&PicturesObject { figures, legend: &legend })
}

#[derive(Serialize)]
struct PicturesObject<'a> {
    figures: Vec<FigureObject<'a>>,
    legend: &'a str,
}

#[derive(Serialize)]
struct FigureObject<'a> {
    caption: &'a str,
    pictures: Vec<PictureObject<'a>>,
}

#[derive(Serialize)]
struct PictureObject<'a> {
    alt: &'a str,
    size: [usize; 2],
    #[serde(with = "serde_wasm_bindgen::preserve")]
    png: Uint8Array,
}

impl<'a> From<&'a Picture> for PictureObject<'a> {
    fn from(Picture { alt, size, png, .. }: &'a Picture) -> Self {
        Self { alt, size: *size, png: Uint8Array::from(png.as_slice()) }
    }
}
