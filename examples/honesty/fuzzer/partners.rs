//! Models B that are nearly the same as a model A.

use super::surfaces::{direction, magnitude};
use fastrand::Rng;
use nurbs_hausdorff::shapes::operations::{cut_model, elevate_degree, insert_knot};
use nurbs_hausdorff::{Axis, Model, NurbsSurface, SurfaceArrays};

/// Returns the same nets with control points moved by `size` in random directions.
pub(crate) fn near(rng: &mut Rng, a: &[SurfaceArrays], size: f64) -> Vec<SurfaceArrays> {
    let mut b = a.to_vec();
    for point in b.iter_mut().flat_map(|surface| &mut surface.control_points) {
        let shift = direction(rng) * size;
        point[0] += shift.x;
        point[1] += shift.y;
        point[2] += shift.z;
    }
    b
}

pub(crate) fn moved(rng: &mut Rng, a: &[SurfaceArrays]) -> Vec<SurfaceArrays> {
    let mut b = a.to_vec();
    let shift = direction(rng) * magnitude(rng, -3.0, 0.0);
    scale_and_shift(&mut b, 1.0, shift.to_array());
    b
}

/// Returns two translated copies of A on opposite sides, so that A lies on their
/// medial axis.
pub(crate) fn both_sides(rng: &mut Rng, a: &[SurfaceArrays]) -> Vec<SurfaceArrays> {
    let shift = direction(rng) * magnitude(rng, -3.0, 0.0);
    let [mut above, mut below] = [a.to_vec(), a.to_vec()];
    scale_and_shift(&mut above, 1.0, shift.to_array());
    scale_and_shift(&mut below, 1.0, (-shift).to_array());
    above.append(&mut below);
    above
}

/// Returns the same surfaces with one more knot and the degree raised by one where
/// possible. Invalid ones stay as they are, and their model is refused.
pub(crate) fn refined(rng: &mut Rng, a: &[SurfaceArrays]) -> Vec<SurfaceArrays> {
    a.iter()
        .map(|arrays| {
            let Ok(surface) = NurbsSurface::new(0, arrays.clone()) else { return arrays.clone() };
            let [[start, end], _] = surface.domain().intervals();
            let knot = start + (0.1 + 0.8 * rng.f64()) * (end - start);
            let refined = insert_knot(&surface, Axis::U, knot, 1).unwrap_or(surface);
            elevate_degree(&refined, Axis::V).unwrap_or(refined).into_arrays()
        })
        .collect()
}

/// Returns the same surfaces cut into pieces.
pub(crate) fn cut(rng: &mut Rng, a: &[SurfaceArrays]) -> Vec<SurfaceArrays> {
    let model = Model::from_arrays(None, a.to_vec()).unwrap();
    let fractions = [0, 1].map(|_| vec![0.1 + 0.8 * rng.f64(); rng.usize(0..=1)]);
    let pieces = cut_model(&model, [&fractions[0], &fractions[1]]).unwrap_or(model);
    pieces.surfaces().iter().map(|surface| surface.clone().into_arrays()).collect()
}

/// Returns the same surfaces with u and v exchanged and all weights scaled.
pub(crate) fn transposed(rng: &mut Rng, a: &[SurfaceArrays]) -> Vec<SurfaceArrays> {
    let scale = magnitude(rng, -3.0, 3.0);
    let transpose = |surface: &SurfaceArrays| {
        let [rows, columns] = surface.counts;
        let at = |index: usize| {
            let [x, y, z, w] = surface.control_points[index % rows * columns + index / rows];
            [x, y, z, scale * w]
        };
        let [u, v] = &surface.knots;
        SurfaceArrays {
            degree: [surface.degree[1], surface.degree[0]],
            knots: [v.clone(), u.clone()],
            counts: [columns, rows],
            control_points: (0..rows * columns).map(at).collect(),
        }
    };
    a.iter().map(transpose).collect()
}

/// Scales a model about the origin, then translates it.
pub(crate) fn scale_and_shift(model: &mut [SurfaceArrays], scale: f64, shift: [f64; 3]) {
    for point in model.iter_mut().flat_map(|surface| &mut surface.control_points) {
        for axis in 0..3 {
            point[axis] = point[axis] * scale + shift[axis];
        }
    }
}
