//! Points that a kernel located: a foot, and bounds in float32.

use super::branch_and_bound::rounding;
use super::{Closest, Target};
use crate::rounding::lower_min;
use glam::DVec3;

/// A foot with lower bounds on the distances to its patch and to all others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Located {
    /// The index of the foot's patch.
    pub(crate) patch: u32,
    /// Its parameters (s, t) there.
    pub(crate) parameters: [f64; 2],
    /// Both this and `others` are lower bounds on the distance from the point to parts of the model that together are the
    /// whole; -∞ if nothing is known.
    pub(crate) own: f64,
    /// A lower bound on the distance from the point to all other patches; -∞ if nothing is known of them.
    pub(crate) others: f64,
}

impl Located {
    /// Returns the lower bound on the distance from the point to the model.
    fn least(&self) -> f64 {
        lower_min(lower_min(f64::INFINITY, self.own), self.others)
    }

    /// Returns whether a point of the model at this distance is nearer than the bounds permit.
    pub(crate) fn is_refuted_by(&self, distance: f64) -> bool {
        self.least() > distance
    }
}

/// Returns a foot that is as near as the whole model but for the gap, which is more than rounding. `None` if the bounds do
/// not show that, or are refuted by the foot.
pub(crate) fn closest_located(target: &Target, point: DVec3, gap: f64, located: &Located) -> Option<Closest> {
    let Located { patch, parameters, .. } = *located;
    let rounding = rounding(target, point)?;
    let foot = target.patches.patch(patch as usize).point(parameters);
    let upper = foot.distance(point);
    let least = located.least();
    // A NaN shows nothing.
    (upper - gap <= least && !located.is_refuted_by(upper)).then(|| {
        let lower = (least - rounding).max(0.0);
        Closest { patch: patch as usize, parameters, point: foot, upper, lower }
    })
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::closest::branch_and_bound::tests::two_squares;

    /// A foot whose distance exceeds neither bound by more than the gap is the result, with the smaller bound.
    #[test]
    fn bounds_on_all_decide_within_the_gap() {
        const GAP: f64 = 0.125;
        let target = two_squares();
        let point = DVec3::new(0.25, 0.0, 0.125);
        let located = |own: f64, others: f64| {
            closest_located(&target, point, GAP, &Located { patch: 0, parameters: [0.625, 0.5], own, others })
        };
        for (own, others, lower) in [(2.875, 3.125, 2.875), (2.8, 3.125, 2.8), (3.0, 2.75, 2.75)] {
            let Some(found) = located(own, others) else { unreachable!() };
            assert_eq!((found.patch, found.parameters, found.upper), (0, [0.625, 0.5], 2.875));
            assert!(found.lower < lower && lower - found.lower <= 1e-12, "{found:?}");
        }
        for (own, others) in
            [(2.7, 3.0), (3.0, 2.7), (2.9, 3.0), (f64::NAN, 3.0), (3.0, f64::NAN), (f64::NEG_INFINITY, 3.0)]
        {
            assert_eq!(located(own, others), None, "{own} {others}");
        }
    }
}
