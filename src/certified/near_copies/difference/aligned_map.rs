//! Maps of a cell along the parameter lines of B.

use super::super::orientation::Orientation;
use crate::axis::Axis;
use crate::certified::cell_context::CellContext;
use crate::certified::reparametrization::Reparametrization;
use glam::DVec2;

/// How far, relative to its length along the parameter lines, a map may run
/// across them or be clamped at the edge of the patch.
const MAX_SKEW: f64 = 1e-6;

/// A map of the cell along B's parameter lines.
pub(super) struct AlignedMap {
    /// The derivatives by σ and τ along the lines.
    p: DVec2,
    q: DVec2,
    pub(super) orientation: Orientation,
    /// Their sizes and signs by A's axes.
    along: [f64; 2],
}

impl AlignedMap {
    /// The feet's linearization if it is one. An axis along which A's patch is
    /// constant may be mapped to a point.
    pub(super) fn new(context: &CellContext<'_>) -> Option<Self> {
        let (foot, a, [h, k]) = (context.foot(), &context.jet, context.cell.half);
        let jet = context.pair.b.patch(foot.patch).jet(foot.parameters);
        let tangents = [h * a.s, k * a.t];
        let map = Reparametrization::linearized(&jet, jet.point - a.point, tangents, [false; 2])?;
        let clamped = map.clamped_to(context.pair.b.room(foot.patch), foot.parameters);
        let clamping = (map.extent() - clamped.extent()).abs().max_element();
        let Reparametrization { p, q } = clamped;
        let orientation = Orientation::new(&clamped);
        let (along, across) = (orientation.along(&clamped), orientation.across(&clamped));
        let is_constant = Axis::BOTH.map(|axis| context.patch.is_constant(axis));
        let mut least = f64::INFINITY;
        for axis in 0..2 {
            if !is_constant[axis] {
                least = least.min(along[axis].abs());
            }
        }
        let skew = across.abs().max_element().max(clamping);
        (skew <= MAX_SKEW * least && least > 0.0).then_some(Self { p, q, orientation, along })
    }

    /// Whether a corner of the cell is farther than the threshold from its image.
    pub(super) fn is_beyond(&self, context: &CellContext<'_>, threshold: f64) -> bool {
        let foot = context.foot();
        let target = context.pair.b.patch(foot.patch);
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        corners.into_iter().any(|corner| {
            let from = context.pair.point_of_a(context.cell.patch, context.cell.at(corner));
            let image = DVec2::from_array(foot.parameters) + corner[0] * self.p + corner[1] * self.q;
            from.distance_squared(target.point(image.to_array())) > threshold * threshold
        })
    }

    /// The image of the cell, by B's axes.
    pub(super) fn image(&self, foot: [f64; 2]) -> [[f64; 2]; 2] {
        let extent = self.orientation.by_axes_of_b(self.along);
        [0, 1].map(|axis| [foot[axis] - extent[axis].abs(), foot[axis] + extent[axis].abs()])
    }

    /// Whether the image lies in B's patch, not only in its extension.
    pub(super) fn is_inside(&self, foot: [f64; 2]) -> bool {
        self.image(foot).as_flattened().iter().all(|parameter| (0.0..=1.0).contains(parameter))
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// An image that leaves the patch on any side has the errors of an extrapolation (lemma R6).
    #[test]
    fn an_image_beyond_an_edge_is_not_inside() {
        for swapped in [false, true] {
            let orientation = Orientation::new(&if swapped {
                Reparametrization { p: -DVec2::Y, q: DVec2::X }
            } else {
                Reparametrization { p: -DVec2::X, q: DVec2::Y }
            });
            let extent = if swapped { [0.125, -0.25] } else { [-0.25, 0.125] };
            let map = AlignedMap { p: DVec2::ZERO, q: DVec2::ZERO, orientation, along: extent };
            assert_eq!(map.image([0.5, 0.5]), [[0.25, 0.75], [0.375, 0.625]]);
            assert!(map.is_inside([0.5, 0.5]) && map.is_inside([0.25, 0.875]));
            for foot in [[0.2, 0.5], [0.8, 0.5], [0.5, 0.1], [0.5, 0.9]] {
                assert!(!map.is_inside(foot), "{foot:?}");
            }
        }
    }
}
