//! Bodies that have the same shape in the same place.

use super::options::Limits;
use crate::bvh::Aabb;
use crate::engine::{CertifiedOptions, DistanceOptions, Engine, Method, PreparedModel};
use crate::error::Result;

/// The factor by which boxes of bodies within a tolerance may differ more than the bodies: control points of another
/// parametrization lie elsewhere, but those of copies do not. A copy cut otherwise may be missed.
const BOX_PART: f64 = 0.05;

/// Returns whether bodies in these boxes may have the same shape in the same place.
pub(super) fn are_alike(a: &Aabb, b: &Aabb, tolerance: f64) -> bool {
    let apart = (a.min - b.min).abs().max((a.max - b.max).abs()).max_element();
    apart <= tolerance + BOX_PART * a.diagonal()
}

impl Engine {
    /// Returns whether the Hausdorff distance of two bodies is certainly at most a tolerance.
    pub(super) async fn is_duplicate(&self, [a, b]: [&PreparedModel; 2], limits: &Limits) -> Result<bool> {
        let budgets = CertifiedOptions { max_seconds: limits.seconds(), ..CertifiedOptions::default() };
        let options = DistanceOptions {
            limit: Some(limits.tolerance),
            symmetric: true,
            method: Method::Certified(budgets),
            ..DistanceOptions::default()
        };
        Ok(self.distance(a, b, &options).await?.upper <= limits.tolerance)
    }
}
