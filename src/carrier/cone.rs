//! Cones that patches lie on.

use super::curvature::Curvature;
use crate::bezier::Jet;
use glam::DVec3;

/// The parameters at which centres of curvature are taken for the axis, in pairs.
const PLACES: [[[f64; 2]; 2]; 2] = [[[0.25, 0.25], [0.75, 0.75]], [[0.25, 0.75], [0.75, 0.25]]];

/// One nappe of a cone about an axis through its apex.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cone {
    /// Away from the apex, of length 1.
    pub(super) axis: DVec3,
    /// The cosine and the sine of the angle between the axis and the nappe, with squares of sum 1.
    pub(super) cos: f64,
    pub(super) sin: f64,
}

impl Cone {
    /// Returns the apex and the cone through a patch that has a straight line along `along` and the larger curvature
    /// of `middle` across it, with the axis through centres of curvature elsewhere; `None` for cylinders. `jet` returns
    /// the patch's derivatives. Whether all of the patch lies near it is for the caller to look at.
    pub(super) fn of(
        jet: impl Fn([f64; 2]) -> Jet,
        middle: &Curvature,
        point: DVec3,
        along: DVec3,
    ) -> Option<(DVec3, Self)> {
        let center = |at: [f64; 2]| {
            let jet = jet(at);
            Curvature::of(&jet).map(|found| found.center(jet.point))
        };
        let lines = PLACES.map(|[one, other]| Some(center(other)? - center(one)?));
        let longer = lines.into_iter().flatten().max_by(|a, b| a.length().total_cmp(&b.length()))?;
        let axis = longer.try_normalize()?;
        // Toward the patch from the axis, and the height along it.
        let outward = point - middle.center(point);
        let outward = outward - axis.dot(outward) * axis;
        let radius = outward.length();
        let outward = outward.try_normalize()?;
        let along = if along.dot(outward) < 0.0 { -along } else { along };
        let (sin, cos) = (along.dot(outward), along.dot(axis));
        let length = sin.hypot(cos);
        let apex = point - radius / sin * along;
        let axis = if cos < 0.0 { -axis } else { axis };
        let cone = Self { axis, cos: cos.abs() / length, sin: sin / length };
        (apex.is_finite() && sin > 0.0 && cos != 0.0).then_some((apex, cone))
    }

    /// Returns an upper bound on how much larger the height of a point above `other`, whose apex is `between` before
    /// this one's, is than above this one, for points up to `reach` from this one's apex: lemma C6 of
    /// docs/clearance.md.
    pub(super) fn shift(&self, other: &Self, between: DVec3, reach: f64) -> f64 {
        let angle = (other.cos - self.cos).hypot(other.sin - self.sin);
        let across = between.cross(other.axis).length() + reach * self.axis.cross(other.axis).length();
        let along = reach * (self.axis - other.axis).length() - between.dot(other.axis);
        other.cos * across + other.sin * along + reach * angle
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    const REACH: f64 = 2.0;

    fn cone(angle: f64, tilt: f64) -> Cone {
        Cone { axis: DVec3::new(tilt.sin(), 0.0, tilt.cos()), cos: angle.cos(), sin: angle.sin() }
    }

    /// The height of a point above a cone with its apex at the origin.
    fn height(cone: &Cone, point: DVec3) -> f64 {
        let up = cone.axis.dot(point);
        cone.cos * (point - up * cone.axis).length() - cone.sin * up
    }

    /// Lemma C6 (b), attained by a point for another angle; for another axis no point in reach is beyond it: the one on
    /// the axis is by the way across, and one across the axis by the way along, each nearly all of the bound where the
    /// cosine or the sine is the larger one.
    #[test]
    fn no_height_above_another_cone_is_larger_by_more_than_the_shift() {
        let (one, other) = (cone(0.5, 0.0), cone(0.375, 0.0));
        let [cos, sin] = [other.cos - one.cos, other.sin - one.sin];
        let point = REACH / cos.hypot(sin) * DVec3::new(cos, 0.0, -sin);
        let more = height(&other, point) - height(&one, point);
        let shift = one.shift(&other, DVec3::ZERO, REACH);
        assert!(more <= shift + 1e-15 && shift < more + 1e-12, "{more} {shift}");
        for (angle, point) in [(0.25, REACH * DVec3::Z), (1.25, -REACH * DVec3::X)] {
            let (one, other) = (cone(angle, 0.0), cone(angle, 1e-3));
            let more = height(&other, point) - height(&one, point);
            let shift = one.shift(&other, DVec3::ZERO, REACH);
            assert!(more <= shift && shift < 1.5 * more, "{angle}: {more} {shift}");
        }
    }
}
