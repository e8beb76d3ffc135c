//! Surfaces from typed arrays.

use crate::model::SurfaceArrays;
use wasm_bindgen::prelude::*;

/// Number of values of a control point: x, y, z, w.
const POINT_LENGTH: usize = 4;

/// The surfaces of a model, not yet validated.
#[wasm_bindgen]
#[derive(Default)]
pub struct Surfaces(Vec<SurfaceArrays>);

#[wasm_bindgen]
impl Surfaces {
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Appends a surface; `control_points` is x, y, z, w of each point, v fastest,
    /// and values after the last whole point are ignored.
    pub fn push(
        &mut self,
        degree_u: usize,
        degree_v: usize,
        knots_u: Vec<f64>,
        knots_v: Vec<f64>,
        count_u: usize,
        count_v: usize,
        control_points: &[f64],
    ) {
        let point = |point: &[f64]| [point[0], point[1], point[2], point[3]];
        self.0.push(SurfaceArrays {
            degree: [degree_u, degree_v],
            knots: [knots_u, knots_v],
            counts: [count_u, count_v],
            control_points: control_points.chunks_exact(POINT_LENGTH).map(point).collect(),
        });
    }
}

impl Surfaces {
    pub(super) fn into_inner(self) -> Vec<SurfaceArrays> {
        self.0
    }
}
