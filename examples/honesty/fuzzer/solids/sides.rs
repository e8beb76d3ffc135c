//! Sides of points by second rays: through triangles, in other directions, with none of the library's code.

use super::super::clearance::triangles_of;
use fastrand::Rng;
use glam::DVec3;
use nurbs_hausdorff::internals::engine::PreparedModel;
use nurbs_hausdorff::{Model, Side};

/// The points of a solid whose sides are compared.
const POINTS: usize = 40;

/// Returns in words which side is not the one that rays through triangles give.
pub(super) fn violations(rng: &mut Rng, prepared: &PreparedModel, model: &Model) -> Vec<String> {
    let triangles = triangles_of(model);
    let center = model.bounding_box().center();
    let half = 0.55 * (model.bounding_box().max - model.bounding_box().min);
    let mut found = Vec::new();
    for _ in 0..POINTS {
        let any = DVec3::new(rng.f64(), rng.f64(), rng.f64()) * 2.0 - DVec3::ONE;
        let point = center + half * any;
        let by_rays = triangles.contain(point - center);
        let side = prepared.side(point.to_array());
        let differs = match side {
            Side::Inside => by_rays == Some(false),
            Side::Outside => by_rays == Some(true),
            _ => false,
        };
        if differs {
            found.push(format!("{point} is {side:?}, by rays through triangles {by_rays:?}"));
        }
    }
    found
}
