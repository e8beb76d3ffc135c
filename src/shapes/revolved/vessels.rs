//! A glass and a bottle: surfaces of revolution of cubic B-spline profiles.

use crate::error::Result;
use crate::model::Model;
use crate::shapes::{PlaneCurve, named, positive, revolve};

/// The degree of the profiles, which makes their curvature continuous.
const PROFILE_DEGREE: usize = 3;

/// The control points `[radius, height]` of a stemmed glass of height 1: under the
/// foot, up the stem, along the outside of the bowl to the rim, and down inside it.
const GLASS: [[f64; 2]; 19] = [
    [0.0, 0.015],
    [0.14, 0.015],
    [0.28, -0.005],
    [0.33, 0.0],
    [0.32, 0.02],
    [0.2, 0.035],
    [0.035, 0.05],
    [0.03, 0.2],
    [0.03, 0.36],
    [0.05, 0.43],
    [0.27, 0.48],
    [0.36, 0.68],
    [0.3, 0.92],
    [0.27, 1.0],
    [0.255, 1.0],
    [0.28, 0.92],
    [0.345, 0.68],
    [0.25, 0.49],
    [0.0, 0.47],
];

/// The control points `[radius, height]` of a bottle of height 1: under the punt,
/// up the body, over the shoulder and up the neck to its mouth.
const BOTTLE: [[f64; 2]; 15] = [
    [0.0, 0.06],
    [0.06, 0.06],
    [0.1, 0.0],
    [0.15, 0.0],
    [0.16, 0.01],
    [0.16, 0.1],
    [0.16, 0.3],
    [0.16, 0.48],
    [0.155, 0.6],
    [0.055, 0.67],
    [0.05, 0.78],
    [0.048, 0.9],
    [0.06, 0.95],
    [0.06, 0.99],
    [0.045, 1.0],
];

/// Returns a stemmed glass with an inner and an outer wall, its foot at z = 0.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless `height` is finite and above 0.
pub fn glass(height: f64) -> Result<Model> {
    vessel("glass", &GLASS, height)
}

/// Returns a bottle, open at its mouth, its foot at z = 0.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless `height` is finite and above 0.
pub fn bottle(height: f64) -> Result<Model> {
    vessel("bottle", &BOTTLE, height)
}

/// Returns the model that a profile of height 1, scaled to `height`, sweeps.
fn vessel(name: &str, profile: &[[f64; 2]], height: f64) -> Result<Model> {
    let height = positive("height", height)?;
    let points: Vec<[f64; 2]> = profile.iter().map(|point| point.map(|x| height * x)).collect();
    named(name, vec![revolve(&PlaneCurve::clamped(PROFILE_DEGREE, &points))?])
}
