//! The start of an iteration on a patch.

use crate::bezier::Patch;
use glam::{DVec3, Vec4Swizzles};

/// Returns the parameters (i/p, j/q) of the control point nearest to `target`,
/// the start of the 2012 paper's projection. O(p q).
#[must_use]
pub fn nearest_control(patch: &Patch<'_>, target: DVec3) -> [f64; 2] {
    let local = target - patch.center;
    let mut nearest = (f64::INFINITY, 0);
    for (index, control) in patch.controls.iter().enumerate() {
        let residual = control.xyz() - control.w * local;
        let distance_squared = residual.length_squared() / (control.w * control.w);
        if distance_squared < nearest.0 {
            nearest = (distance_squared, index);
        }
    }
    let columns = patch.degree[1] + 1;
    let (i, j) = (nearest.1 / columns, nearest.1 % columns);
    [i as f64 / patch.degree[0] as f64, j as f64 / patch.degree[1] as f64]
}
