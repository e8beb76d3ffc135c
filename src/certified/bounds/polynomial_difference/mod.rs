//! The bound by the difference of two patches as a rational function: cells
//! that keep their distance to B under a change of parameters, as on copies and
//! offsets with other knots, degrees or pieces.
//!
//! Where the feet's linearization runs along B's parameter lines, `B∘φ` has the
//! control net of B restricted to the image of the cell, as A has that of the
//! cell. With `A = X/w` and `B∘φ = Y/v`,
//!
//! `|A - B∘φ|² = |X v - Y w|² / (w v)²`,
//!
//! a quotient of Bernstein polynomials of twice the degrees' sums. It is at most
//! the largest quotient of coefficients, as those of the denominator are
//! positive. Up to rounding that is exact where the distance is the same
//! everywhere: zero where A and B are the same polynomials or rational functions.

mod across_knots;
mod aligned_map;
mod block;
mod knot_line_map;
mod net;
mod piece;
mod sliding;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod sliding_attained;
mod spline;
mod strip;

pub(in crate::certified) use block::block;
pub(super) use sliding::pseudo_inverse;

use super::{CellContext, UpperBound};
use aligned_map::AlignedMap;
use glam::Vec4Swizzles;
use net::Net;

/// Sum of the absolute coefficients of a restriction that goes beyond the patch
/// in its extension, at most (lemma R6).
const EXTENSION_GROWTH: f64 = 46.0;

/// The bound from the nearest known foot. O(p^4 q^4).
pub(super) struct PolynomialDifference;

impl UpperBound for PolynomialDifference {
    /// `None` where the map does not run along B's parameter lines, or a corner
    /// of the cell shows that the bound exceeds the threshold.
    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64> {
        let foot = context.foot();
        if foot.distance_squared > threshold * threshold {
            return None;
        }
        let Some(map) = AlignedMap::new(context) else {
            return across_knots::upper_bound(context, threshold);
        };
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
