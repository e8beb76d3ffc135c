//! Flatness by the curvature of the parameter lines.

use super::{SAMPLES, sample_parameter};
use crate::bezier::Patch;
use glam::DVec3;

/// Returns the largest turning of the s-lines and of the t-lines, in radians, if
/// either exceeds `tolerance`.
///
/// A curve of curvature at most k and length L turns by at most k L; both are
/// taken at samples. One number per axis states directly which cut helps, where
/// the criterion of normals has to compare all pairs of them.
pub(super) fn excess(patch: &Patch<'_>, tolerance: f64) -> Option<[f64; 2]> {
    let mut turning = [0.0_f64; 2];
    for fixed in 0..SAMPLES {
        let mut curvature = [0.0_f64; 2];
        let mut length = [0.0_f64; 2];
        for moving in 0..SAMPLES {
            let (at, fixed) = (sample_parameter(moving), sample_parameter(fixed));
            let (on_s, on_t) = (patch.jet([at, fixed]), patch.jet([fixed, at]));
            for (axis, first, second) in [(0, on_s.s, on_s.ss), (1, on_t.t, on_t.tt)] {
                curvature[axis] = curvature[axis].max(line_curvature(first, second));
                length[axis] += first.length() / SAMPLES as f64;
            }
        }
        for axis in 0..2 {
            turning[axis] = turning[axis].max(curvature[axis] * length[axis]);
        }
    }
    (turning[0].max(turning[1]) > tolerance).then_some(turning)
}

/// Returns the curvature of a curve with these derivatives, 0 where the first vanishes.
fn line_curvature(first: DVec3, second: DVec3) -> f64 {
    let speed = first.length();
    if speed > 0.0 { first.cross(second).length() / (speed * speed * speed) } else { 0.0 }
}
