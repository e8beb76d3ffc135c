//! Surfaces from typed arrays.

use crate::model::trim::{FaceArrays, TrimCurveArrays};
use crate::model::{InstanceArrays, ModelArrays, SurfaceArrays};
use wasm_bindgen::prelude::*;

/// Number of values of a control point: x, y, z, w.
const POINT_LENGTH: usize = 4;

/// Number of values of a control point of a trimming curve: u, v, w.
const CURVE_POINT_LENGTH: usize = 3;

/// The faces of a model, not yet validated.
#[wasm_bindgen]
#[derive(Default)]
pub struct Surfaces(ModelArrays);

#[wasm_bindgen]
impl Surfaces {
    #[wasm_bindgen(constructor)]
    pub fn new(name: Option<String>, unit: Option<f64>) -> Self {
        Self(ModelArrays { name, unit, ..ModelArrays::default() })
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
        let surface = SurfaceArrays {
            degree: [degree_u, degree_v],
            knots: [knots_u, knots_v],
            counts: [count_u, count_v],
            control_points: control_points.chunks_exact(POINT_LENGTH).map(point).collect(),
        };
        self.0.faces.push(FaceArrays::new(surface, None));
    }

    /// States what else is known of the surface pushed last.
    pub fn describe(
        &mut self,
        reversed: bool,
        face_name: Option<String>,
        kind: Option<String>,
        gap: f64,
        gap_measured: bool,
        color: Option<Vec<f64>>,
        shell: Option<u32>,
        solid: Option<u32>,
    ) {
        if let Some(face) = self.0.faces.last_mut() {
            (face.reversed, face.face_name, face.kind) = (reversed, face_name, kind);
            (face.gap, face.gap_measured) = (gap, gap_measured);
            (face.shell, face.solid) = (shell, solid);
            // A number that is missing is NaN, which validation refuses.
            face.color =
                color.map(|color| std::array::from_fn(|at| color.get(at).copied().unwrap_or(f64::NAN)));
        }
    }

    /// Trims the surface pushed last, without loops so far.
    #[wasm_bindgen(js_name = beginTrim)]
    pub fn begin_trim(&mut self) {
        if let Some(face) = self.0.faces.last_mut() {
            face.trim = Some(Vec::new());
        }
    }

    /// Begins a loop of the trim of the surface pushed last.
    #[wasm_bindgen(js_name = beginLoop)]
    pub fn begin_loop(&mut self) {
        if let Some(trim) = self.0.faces.last_mut().and_then(|face| face.trim.as_mut()) {
            trim.push(Vec::new());
        }
    }

    /// Appends a curve to the loop begun last; `control_points` is u, v, w of each point,
    /// and values after the last whole point are ignored.
    #[wasm_bindgen(js_name = pushCurve)]
    pub fn push_curve(
        &mut self,
        degree: usize,
        knots: Vec<f64>,
        control_points: &[f64],
        gap: f64,
        edge: Option<u32>,
    ) {
        let trim = self.0.faces.last_mut().and_then(|face| face.trim.as_mut());
        if let Some(curves) = trim.and_then(|trim| trim.last_mut()) {
            let point = |point: &[f64]| [point[0], point[1], point[2]];
            let control_points = control_points.chunks_exact(CURVE_POINT_LENGTH).map(point).collect();
            curves.push(TrimCurveArrays { degree, knots, control_points, gap, edge });
        }
    }

    /// Appends a placement of surfaces by a row-major 3x4 matrix; numbers that are missing
    /// are NaN, which validation refuses.
    #[wasm_bindgen(js_name = pushInstance)]
    pub fn push_instance(
        &mut self,
        surfaces: &[u32],
        transform: &[f64],
        name: Option<String>,
        solid: Option<u32>,
    ) {
        self.0.instances.push(InstanceArrays {
            surfaces: surfaces.iter().map(|&surface| surface as usize).collect(),
            transform: std::array::from_fn(|index| transform.get(index).copied().unwrap_or(f64::NAN)),
            name,
            solid,
        });
    }
}

impl Surfaces {
    pub(super) fn into_inner(self) -> ModelArrays {
        self.0
    }
}
