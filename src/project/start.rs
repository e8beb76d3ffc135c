//! Where an iteration on a patch starts, and whether it is worth starting.

use crate::bezier::Patch;
use glam::{DVec3, Vec4Swizzles};

/// The parameters (i/p, j/q) of the control point nearest to `target` (the
/// 2012 paper, section 4). O(p q).
#[must_use]
pub fn nearest_control(patch: &Patch<'_>, target: DVec3) -> [f64; 2] {
    let local = target - patch.center;
    let mut nearest = (f64::INFINITY, 0);
    for (index, control) in patch.controls.iter().enumerate() {
        let way = control.xyz() - control.w * local;
        let distance_squared = way.length_squared() / (control.w * control.w);
        if distance_squared < nearest.0 {
            nearest = (distance_squared, index);
        }
    }
    let columns = patch.degree[1] + 1;
    let (i, j) = (nearest.1 / columns, nearest.1 % columns);
    [i as f64 / patch.degree[0] as f64, j as f64 / patch.degree[1] as f64]
}

/// Whether all control points, and so the patch, lie beyond a plane at this
/// distance from the target, square to the way to the control point at (s, t).
///
/// True of any direction of the way but none, so only the products' rounding
/// counts: in the distance, below 32 units of 2^-53 of the largest coordinate. O(p q).
pub(crate) fn is_beyond(patch: &Patch<'_>, target: DVec3, [s, t]: [f64; 2], distance_squared: f64) -> bool {
    let local = target - patch.center;
    let columns = patch.degree[1] + 1;
    let index =
        (s * patch.degree[0] as f64 + 0.5) as usize * columns + (t * patch.degree[1] as f64 + 0.5) as usize;
    let control = patch.controls[index];
    let way = control.xyz() - control.w * local;
    let far = (way.length_squared() * distance_squared).sqrt();
    far > 0.0
        && patch.controls.iter().all(|control| way.dot(control.xyz() - control.w * local) >= control.w * far)
}
