//! Signed distances on grids, point by point.

use super::super::clearance::triangles_of;
use super::super::surfaces::magnitude;
use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::internals::engine::{Engine, PreparedModel};
use nurbs_hausdorff::{
    ClosestPointOptions, GridOptions, Model, Precision, SignedDistanceOptions, SignedDistances,
};

/// The signs that are compared: rays through triangles take longer than all the rest.
const MAX_SIGNS: usize = 150;

/// Returns in words which values of a random grid are not those of certified closest points, or have the wrong sign,
/// and the number of points without a side.
pub(super) fn violations(rng: &mut Rng, prepared: &PreparedModel, model: &Model) -> (Vec<String>, usize) {
    let engine = Engine::cpu();
    let size = model.bounding_box().diagonal();
    let resolution = rng.u32(3..20);
    let options = SignedDistanceOptions {
        grid: GridOptions { resolution: Some(resolution), ..GridOptions::default() },
        band: rng.bool().then(|| magnitude(rng, -2.0, -0.3) * size),
        relative_tolerance: Some(magnitude(rng, -9.0, -3.0)),
        precision: if rng.bool() { Precision::Float32 } else { Precision::Float64 },
        ..SignedDistanceOptions::default()
    };
    let distances = match engine.signed_distances(prepared, &options).wait() {
        Ok(distances) => distances,
        Err(error) => return (vec![format!("the grid is refused by {}", error.code())], 0),
    };
    let SignedDistances { grid, values, bound, band, undecided, .. } = &distances;
    let [nx, ny, nz] = grid.counts;
    let origin = DVec3::from_array(grid.origin);
    let at = |k: usize| [k % nx, k / nx % ny, k / nx / ny].map(|index| index as f64);
    let points: Vec<DVec3> =
        (0..nx * ny * nz).map(|k| origin + grid.spacing * DVec3::from_array(at(k))).collect();
    let flat: Vec<f64> = points.iter().flat_map(|point| point.to_array()).collect();
    let Ok(closest) = engine.closest_points(prepared, &flat, &ClosestPointOptions::default()).wait() else {
        return (vec!["the points are refused".to_owned()], 0);
    };
    let triangles = triangles_of(model);
    let center = model.bounding_box().center();
    let step = points.len().div_ceil(MAX_SIGNS).max(1);
    let mut found = Vec::new();
    for (index, ((value, distance), error)) in
        values.iter().zip(&closest.distances).zip(&closest.bounds).enumerate()
    {
        let is_measured = value.abs() < *band;
        let (low, high) = (distance - error - bound, distance + error + bound);
        if value.abs() > high || (is_measured && value.abs() < low) || value.is_nan() {
            found.push(format!(
                "point {index} of a grid has {value} ± {bound} in a band of {band}, the closest point is {distance} ± {error} away"
            ));
        }
        if index % step == 0 && undecided.binary_search(&index).is_err() {
            let by_rays = triangles.contain(points[index] - center);
            if by_rays.is_some_and(|inside| inside != (*value < 0.0)) {
                found.push(format!(
                    "point {index} of a grid has {value}, by rays through triangles {by_rays:?}"
                ));
            }
        }
    }
    (found, undecided.len())
}
