//! Triangles as Bézier patches, for the search that measures them to patches.

use super::{Facet, FacetTarget};
use crate::bezier::{Patch, PatchSet, PointError, center_grid};
use crate::param_box::ParamBox;
use crate::rounding::gamma;
use glam::DVec3;

/// The roundings of a control point about a patch's centre and back, relative to the largest
/// coordinate.
const CENTER_ROUNDINGS: f64 = 4.0;

/// Returns every triangle as a bilinear patch whose side s = 0 is its first corner; patches of
/// surface i have facet i in the order of the leaves. O(n).
///
/// The patch is the triangle: at (s, t) it is the point of the weights of [`weights`].
pub(super) fn patches(target: &FacetTarget) -> PatchSet {
    let grid = center_grid(target.bounding_box().diagonal());
    let mut patches = PatchSet::default();
    patches.reserve(target.len(), 4 * target.len());
    for place in 0..target.len() as u32 {
        let Facet::Triangle([a, b, c]) = target.facet(place) else { continue };
        let controls = [a, a, b, c].map(|corner| corner.extend(1.0));
        let patch = Patch {
            surface: place as usize,
            degree: [1, 1],
            domain: ParamBox::UNIT,
            center: DVec3::ZERO,
            controls: &controls,
            rational: false,
        };
        patches.push_centered(patch, grid);
    }
    patches
}

/// Returns the error of points of the patches.
pub(super) fn point_error(target: &FacetTarget) -> PointError {
    let aabb = target.bounding_box();
    let mut point_error = PointError::within(1, &aabb);
    point_error.include_deviation(gamma(CENTER_ROUNDINGS) * aabb.farthest_from_origin());
    point_error
}

/// Returns the weights of the corners of a triangle at the parameters of its patch.
pub(crate) fn weights([s, t]: [f64; 2]) -> [f64; 3] {
    [1.0 - s, s * (1.0 - t), s * t]
}
