//! Biquadratic patches.

use super::surfaces::{Surfaces, clamped};
use crate::flatness::Flatness;
use crate::model::SurfaceArrays;
use glam::{DVec3, DVec4};

/// A biquadratic patch with these control points and weights, v fastest.
pub(in crate::certified) fn patch(controls: [DVec4; 9]) -> Surfaces {
    let arrays = SurfaceArrays {
        degree: [2, 2],
        counts: [3, 3],
        knots: [clamped(2, &[]), clamped(2, &[])],
        control_points: controls.iter().map(DVec4::to_array).collect(),
    };
    Surfaces::new(vec![arrays], Flatness::None)
}

/// The biquadratic patch through the points of a function at 0, ½ and 1.
pub(in crate::certified) fn through(of: impl Fn(f64, f64) -> DVec3) -> [DVec4; 9] {
    let at = |i: usize, j: usize| of(0.5 * i as f64, 0.5 * j as f64);
    // Interpolation along an axis: the middle control is twice the middle point less the mean of the ends.
    let row = |i: usize| [at(i, 0), 2.0 * at(i, 1) - 0.5 * (at(i, 0) + at(i, 2)), at(i, 2)];
    let rows = [row(0), row(1), row(2)];
    let mut controls = [DVec4::W; 9];
    for j in 0..3 {
        let middle = 2.0 * rows[1][j] - 0.5 * (rows[0][j] + rows[2][j]);
        for (i, point) in [rows[0][j], middle, rows[2][j]].into_iter().enumerate() {
            controls[3 * i + j] = point.extend(1.0);
        }
    }
    controls
}

/// A patch over [¼, ¾]² or nearly, in parameters at 45° to x and y, of this height.
pub(in crate::certified) fn oblique(height: impl Fn(f64, f64) -> f64) -> [DVec4; 9] {
    through(|s, t| {
        let [x, y] = [0.25 + 0.25 * (s + t), 0.5 + 0.25 * (s - t)];
        DVec3::new(x, y, height(x, y))
    })
}
