//! Closed shapes under random maps.

use super::super::surfaces::magnitude;
use fastrand::Rng;
use glam::{DMat3, DVec3};
use nurbs_hausdorff::Model;
use nurbs_hausdorff::internals::engine::PreparedModel;
use nurbs_hausdorff::shapes::{list, shape};

/// Shapes with more control points take too long.
const MAX_CONTROL_POINTS: usize = 400;

/// The determinant below which a map flattens too much for the second ways.
const MIN_DETERMINANT: f64 = 0.05;

/// The largest share that a projective map changes weights by.
const MAX_TURN: f64 = 0.45;

/// The closed shapes of the catalogue.
pub(crate) struct Shapes(Vec<(&'static str, Model)>);

impl Shapes {
    pub(crate) fn new() -> Self {
        let of = |name| {
            let model = shape(name).ok().filter(|model| !model.is_trimmed())?;
            let points: usize = model.surfaces().iter().map(|surface| surface.control_points().len()).sum();
            let is_closed = || PreparedModel::new(&model).is_ok_and(|prepared| prepared.solid().closed);
            (points <= MAX_CONTROL_POINTS && is_closed()).then_some((name, model))
        };
        Self(list().filter_map(|info| of(info.name)).collect())
    }

    /// Draws a shape, mapped: a projective map changes the weights, and a size or a place far from the origin the
    /// rounding.
    pub(crate) fn draw(&self, rng: &mut Rng) -> Option<(&'static str, Model)> {
        let (name, model) = &self.0[rng.usize(0..self.0.len())];
        Some((*name, mapped(rng, model)?))
    }
}

/// Returns a model under a random map that is one to one on it.
pub(super) fn mapped(rng: &mut Rng, model: &Model) -> Option<Model> {
    let size = model.bounding_box().diagonal();
    let center = model.bounding_box().center();
    let scale = if rng.bool() { 1.0 } else { magnitude(rng, -3.0, 3.0) };
    let linear = loop {
        let entries: [f64; 9] = std::array::from_fn(|k| f64::from(k % 4 == 0) + 1.2 * (rng.f64() - 0.5));
        let linear = DMat3::from_cols_array(&entries);
        if linear.determinant().abs() > MIN_DETERMINANT {
            break linear * scale;
        }
    };
    let far = if rng.u8(0..4) == 0 { magnitude(rng, 0.0, 4.0) * size * scale } else { 0.0 };
    let turn = if rng.bool() { MAX_TURN * rng.f64() * 2.0 / size } else { 0.0 };
    let any = |rng: &mut Rng| DVec3::new(rng.f64() - 0.5, rng.f64() - 0.5, rng.f64() - 0.5);
    let (toward, offset) = (any(rng).normalize_or_zero() * turn, any(rng) * far);
    let mut arrays: Vec<_> = model.surfaces().iter().map(|surface| surface.clone().into_arrays()).collect();
    for point in arrays.iter_mut().flat_map(|surface| &mut surface.control_points) {
        let [x, y, z, weight] = *point;
        let from = DVec3::new(x, y, z) - center;
        let by = 1.0 + toward.dot(from);
        let [x, y, z] = (linear * from / by + offset).to_array();
        *point = [x, y, z, weight * by];
    }
    Model::from_arrays(None, arrays).ok()
}
