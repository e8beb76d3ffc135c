//! A criterion from curvature: how far the parameter lines turn.

use super::{SAMPLES, sample_parameter};
use crate::bezier::Patch;
use glam::DVec3;

/// How far the s- and t-lines turn, in radians, if either by more than `tolerance`.
///
/// A curve of curvature at most k and length L turns by at most k L; both are
/// taken at samples. One number a direction says directly which cut helps,
/// where the normal span has to compare all normals.
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

/// Curvature of a curve with these derivatives; 0 where it stands still.
fn line_curvature(first: DVec3, second: DVec3) -> f64 {
    let speed = first.length();
    if speed > 0.0 { first.cross(second).length() / (speed * speed * speed) } else { 0.0 }
}
