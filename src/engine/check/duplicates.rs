//! Bodies that have the same shape in the same place.

use crate::bvh::Aabb;
use crate::engine::{DistanceOptions, Engine, PreparedModel};
use crate::error::Result;

/// The factor by which boxes of bodies within a tolerance may differ more than the bodies: control points of another
/// parametrization lie elsewhere, but those of copies do not. A copy cut otherwise may be missed.
const BOX_PART: f64 = 0.05;

/// Returns the pairs whose boxes are about the same.
pub(super) fn candidates(near: &[[usize; 2]], boxes: &[Aabb], tolerance: f64) -> Vec<[usize; 2]> {
    let is_alike = |&&[a, b]: &&[usize; 2]| {
        let [a, b] = [&boxes[a], &boxes[b]];
        let apart = (a.min - b.min).abs().max((a.max - b.max).abs()).max_element();
        apart <= tolerance + BOX_PART * a.diagonal()
    };
    near.iter().filter(is_alike).copied().collect()
}

impl Engine {
    /// Returns whether the Hausdorff distance of two bodies is certainly at most a tolerance.
    pub(super) async fn is_duplicate(&self, [a, b]: [&PreparedModel; 2], tolerance: f64) -> Result<bool> {
        let options =
            DistanceOptions { limit: Some(tolerance), symmetric: true, ..DistanceOptions::default() };
        Ok(self.distance(a, b, &options).await?.upper <= tolerance)
    }
}
