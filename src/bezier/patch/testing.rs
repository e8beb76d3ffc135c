//! Patches for tests.

use glam::DVec4;
use std::f64::consts::FRAC_1_SQRT_2;

/// The control points of a quarter of a cylinder of radius 1 and height 3 about the z axis, degree 2 from the x to the y
/// axis and degree 1 upwards, so that its normal points outwards.
pub(crate) fn quarter_of_cylinder() -> Vec<DVec4> {
    let arc = [(1.0, 0.0, 1.0), (1.0, 1.0, FRAC_1_SQRT_2), (0.0, 1.0, 1.0)];
    arc.iter().flat_map(|&(x, y, w)| [0.0, 3.0].map(|z| DVec4::new(w * x, w * y, w * z, w))).collect()
}
