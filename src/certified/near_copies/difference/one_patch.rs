//! The difference of a cell and one patch of B.

use super::aligned_map::AlignedMap;
use super::net::{EXTENSION_GROWTH, Net};
use crate::certified::audit::Lemma;
use crate::certified::cell_context::{CellContext, UpperBound};
use glam::Vec4Swizzles;

/// The bound from the nearest known foot. O(p^4 q^4).
pub(in crate::certified) struct PolynomialDifference;

impl UpperBound for PolynomialDifference {
    fn lemma(&self) -> Lemma {
        Lemma::PolynomialDifference
    }

    /// `None` where the map does not run along B's parameter lines, or a corner
    /// of the cell shows that the bound exceeds the threshold.
    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64> {
        let foot = context.foot();
        if foot.distance_squared > threshold * threshold {
            return None;
        }
        let map = AlignedMap::new(context)?;
        if map.is_beyond(context, threshold) {
            return None;
        }
        let (pair, jet) = (context.pair, &context.jet);
        let target = pair.b.patch(foot.patch);
        let [s, t] = map.image(foot.parameters);
        let controls = target.restricted(s, t);
        let controls = map.orientation.oriented(&controls, target.degree);
        // Swapping the axes is its own inverse.
        let degree = map.orientation.by_axes_of_b(target.degree);
        let growth = if map.is_inside(foot.parameters) { 1.0 } else { EXTENSION_GROWTH };
        let y = Net::new(degree, controls, jet.point - target.center, growth);
        let [s, t] = context.cell.ranges();
        let mut controls = context.patch.restricted(s, t);
        for control in &mut controls {
            *control = pair.transform.rotate(control.xyz()).extend(control.w);
        }
        let center = pair.transform.apply(context.patch.center);
        let x = Net::new(context.patch.degree, controls, jet.point - center, 1.0);
        x.max_difference(&y, threshold)
    }
}
