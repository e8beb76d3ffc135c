//! Intervals of the search on small budgets contain the distance.

use super::support::bytes::Bytes;
use super::support::results::{assert_numbers, distance};
use super::support::sampling::Samples;
use super::support::surfaces::{plane, scaled, tame_arrays};
use nurbs_hausdorff::options::Audit;
use nurbs_hausdorff::{CertifiedOptions, DistanceOptions, DistanceResult, Method, Model};

/// Half the width of the plane: every sheet is over its inside.
const HALF_WIDTH: f64 = 32.0;

/// An upper bound on the rounding of the independent evaluator, relative to the scale.
const ROUNDING: f64 = 1e-9;

/// The range of the exponent of the scale.
const SCALES: usize = 61;

const STEPS: usize = 6;

pub fn check(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let cells = 1 + usize::from(bytes.byte()) * bytes.choose(&[1, 8]);
    let tolerance = bytes.choose(&[1e-3, 1e-6, 1e-1, 1e-9]);
    let exponent = if bytes.flag() { bytes.below(SCALES) as i32 - (SCALES as i32 / 2) } else { 0 };
    let limited = bytes.byte() > 200;
    let to_plane = bytes.flag();
    let rounding = ROUNDING * 2.0_f64.powi(exponent);
    let model = |arrays| Model::from_arrays(None, vec![scaled(arrays, exponent)]).ok();
    let Some(a) = model(tame_arrays(&mut bytes)) else { return };
    let b = if to_plane { plane(&mut bytes, HALF_WIDTH) } else { tame_arrays(&mut bytes) };
    let Some(b) = model(b) else { return };
    let sampled = Samples::new(&a, STEPS);
    let [least, largest] = if to_plane {
        // The distance of each point is |z|, and the largest is in the controls' hull.
        let largest = |heights: &mut dyn Iterator<Item = f64>| heights.map(f64::abs).fold(0.0, f64::max);
        let controls = a.surfaces()[0].control_points();
        [
            largest(&mut sampled.points.iter().map(|point| point[2])),
            largest(&mut controls.iter().map(|control| control[2])),
        ]
    } else {
        sampled.directed_distance(&Samples::new(&b, STEPS))
    };
    let limit = limited.then_some(bytes.unit() * largest);
    let options = DistanceOptions {
        method: Method::Certified(CertifiedOptions {
            max_cells: Some(cells),
            audit: Audit::All,
            ..Default::default()
        }),
        relative_tolerance: Some(tolerance),
        limit,
        ..DistanceOptions::default()
    };
    let result = distance(&a, &b, &options).unwrap();
    assert_numbers(&result);
    let DistanceResult { lower, upper, .. } = result;
    let context = || format!("{a:?}, {b:?}, {options:?}: [{lower}, {upper}], sampled [{least}, {largest}]");
    assert!(lower <= largest + rounding && least - rounding <= upper, "{}", context());
    if let (Some(limit), Some(within)) = (limit, result.certified().unwrap().within) {
        let possible = if within { least - rounding <= limit } else { largest + rounding >= limit };
        assert!(possible, "{}", context());
    }
}
