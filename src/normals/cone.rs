//! Cones about normals, and the angles between them.

use crate::area::{is_to_side, normal_cone};
use crate::bezier::Patch;
use crate::facets::{Facet, FacetTarget};
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use crate::rounding::{UNIT_ROUNDOFF, gamma, upper_max};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// The roundings of an angle between two normals in radians: of their lengths, a motion, a cross product, a
/// quotient, an arc tangent and its argument from degrees (lemma N2 of docs/score.md).
const ANGLE_ROUNDING: f64 = 128.0 * UNIT_ROUNDOFF;

/// The roundings of the normal of a triangle, relative to the product of two edges.
const TRIANGLE_ROUNDINGS: f64 = 8.0;

/// The sine of the largest angle by which the normal of a plane may be off for the plane to be known.
const MAX_SINE: f64 = 0.5;

/// At most this times the sine is the angle, for sines up to [`MAX_SINE`]: the arc sine of ½ is 0.5236.
const ANGLE_PER_SINE: f64 = 1.05;

/// The roundings of control points for each degree and besides: those of extraction, halving and restriction (lemmas
/// R3, R4 and R6 of docs/rounding.md).
const CONTROL_ROUNDINGS: [f64; 2] = [32.0, 64.0];

/// Lines through the origin: all that form at most an angle with an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NormalCone {
    /// Of length 1.
    axis: DVec3,
    /// In radians.
    angle: f64,
}

impl NormalCone {
    /// Returns a cone about the normals of a part of a patch; `None` where there may be none. O(degree³).
    pub(crate) fn of_part(patch: &Patch<'_>, part: ParamBox) -> Option<Self> {
        let (axis, tangent) = normal_cone(patch, part)?;
        Some(Self { axis, angle: tangent.atan() + ANGLE_ROUNDING })
    }

    /// Returns the cone about the normal of the plane that a patch lies in, or about the normals of a part of a curved one;
    /// `None` where there may be none. O(degree³).
    pub(crate) fn of_patch(patch: &Patch<'_>, part: ParamBox) -> Option<Self> {
        Self::of_plane(patch).or_else(|| Self::of_part(patch, part))
    }

    /// Returns the cone about the normal of the plane that a patch lies in, up to the rounding of its control points;
    /// `None` where it lies in none, or in several. O(p q).
    pub(crate) fn of_plane(patch: &Patch<'_>) -> Option<Self> {
        let (axis, sine, start) = Self::plane(patch)?;
        let error = control_error(patch);
        let off = patch.local_points().map(|point| (point - start).dot(axis).abs()).fold(0.0, upper_max);
        (off <= error && sine <= MAX_SINE)
            .then_some(Self { axis, angle: ANGLE_PER_SINE * sine + ANGLE_ROUNDING })
    }

    /// Returns the unit normal of the plane of three control points that are far from each other, an upper bound on the sine
    /// by which their errors turn it, and the first of them, about the patch's centre.
    fn plane(patch: &Patch<'_>) -> Option<(DVec3, f64, DVec3)> {
        let points: Vec<DVec3> = patch.local_points().collect();
        let &start = points.first()?;
        let farthest = |length: &dyn Fn(DVec3) -> f64| {
            let longest = |one: DVec3, other: DVec3| if length(other) > length(one) { other } else { one };
            points.iter().copied().fold(start, longest)
        };
        let along = farthest(&|point| point.distance_squared(start)) - start;
        let direction = along.try_normalize()?;
        let across = |point: DVec3| (point - start).reject_from_normalized(direction);
        let side = across(farthest(&|point| across(point).length_squared()));
        let axis = direction.cross(side.try_normalize()?).try_normalize()?;
        // Three points that are off by the error turn their plane by at most this about either edge.
        let error = control_error(patch);
        Some((axis, 4.0 * error / side.length() + 4.0 * error / along.length(), start))
    }

    /// Returns the cone about the normal of a triangle whose corners are off by at most `error`; `None` for one whose
    /// plane is not known.
    pub(crate) fn of_triangle([a, b, c]: [DVec3; 3], error: f64) -> Option<Self> {
        let (one, other) = (b - a, c - a);
        let normal = one.cross(other);
        let axis = normal.try_normalize()?;
        let [x, y] = [one.length(), other.length()];
        let off = gamma(TRIANGLE_ROUNDINGS) * x * y + 2.0 * error * (x + y) + 4.0 * error * error;
        let sine = off / normal.length();
        (sine <= MAX_SINE).then_some(Self { axis, angle: ANGLE_PER_SINE * sine + ANGLE_ROUNDING })
    }

    /// As [`Self::of_triangle`], of the facet at a place, whose corners are off by at most `error`; `None` of a point.
    pub(crate) fn of_facet(facets: &FacetTarget, place: u32, error: f64) -> Option<Self> {
        match facets.facet(place) {
            Facet::Triangle(corners) => Self::of_triangle(corners, error),
            Facet::Point(_) => None,
        }
    }

    /// Returns the cone of the moved part.
    pub(crate) fn moved(&self, transform: &RigidTransform) -> Self {
        Self { axis: transform.rotate(self.axis), angle: self.angle + ANGLE_ROUNDING }
    }

    /// Returns bounds on the angle, in radians, between every line of this cone and every one of the other one.
    ///
    /// Angles between lines are a metric, at most a right angle, so that they differ from that of the axes by at most both
    /// cones' angles.
    pub(crate) fn angles(&self, other: &Self) -> [f64; 2] {
        let between = self.axis.cross(other.axis).length().atan2(self.axis.dot(other.axis).abs());
        let spread = self.angle + other.angle + ANGLE_ROUNDING;
        [between - spread, if between + spread > FRAC_PI_2 { FRAC_PI_2 } else { between + spread }]
    }
}

/// Returns an upper bound on the errors of a patch's control points by reading and dividing them.
fn control_error(patch: &Patch<'_>) -> f64 {
    let radius = patch.local_points().map(DVec3::length).fold(0.0, upper_max);
    let [each, more] = CONTROL_ROUNDINGS;
    let degrees = (patch.degree[0] + patch.degree[1]) as f64;
    gamma(each * degrees + more) * (radius + patch.center.length())
}

/// Angles between normals with their sides.
impl NormalCone {
    /// As [`Self::of_plane`], to the side of the patch's normals: a plane patch has them to one side, that of their mean.
    pub(crate) fn of_sided_plane(patch: &Patch<'_>) -> Option<Self> {
        let plane = Self::of_plane(patch)?;
        let axis = if is_to_side(patch, plane.axis)? { plane.axis } else { -plane.axis };
        Some(Self { axis, ..plane })
    }

    /// Returns bounds on the angle, in radians from 0 to π, between every normal of this cone and every one of the other
    /// one, which is turned over if it is to the other side.
    pub(crate) fn turns(&self, other: &Self, is_turned: bool) -> [f64; 2] {
        let axis = if is_turned { -other.axis } else { other.axis };
        let between = self.axis.cross(axis).length().atan2(self.axis.dot(axis));
        let spread = self.angle + other.angle + ANGLE_ROUNDING;
        [between - spread, between + spread]
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::quarter_of_cylinder;
    use glam::DVec4;

    fn triangle(turn: f64) -> NormalCone {
        let (sin, cos) = turn.sin_cos();
        NormalCone::of_triangle([DVec3::ZERO, DVec3::X, DVec3::new(0.0, cos, sin)], 0.0).unwrap()
    }

    /// Triangles about the x axis, turned by known angles; the sides do not matter.
    #[test]
    fn angles_of_triangles_are_those_of_their_turns() {
        for degrees in [0.0_f64, 0.001, 29.0, 30.0, 89.0, 90.0, 91.0, 150.0, 180.0, 270.0] {
            let [low, high] = triangle(0.0).angles(&triangle(degrees.to_radians()));
            let folded = (degrees % 180.0).min(180.0 - degrees % 180.0).to_radians();
            assert!(low <= folded && folded <= high && high - low < 1e-12, "{degrees}: [{low}, {high}]");
        }
    }

    /// Lemma N2, attained: lines of cones about axes at 0.5 form angles from 0.5 less both half-angles to 0.5 and both;
    /// with a side and turned over those to π.
    #[test]
    fn angles_between_cones_are_those_of_their_extreme_lines() {
        let cone =
            |turn: f64, angle: f64| NormalCone { axis: DVec3::new(turn.sin(), 0.0, turn.cos()), angle };
        let (one, other) = (cone(0.0, 0.125), cone(0.5, 0.25));
        let about = |[low, high]: [f64; 2], [least, most]: [f64; 2]| {
            assert!(low <= least && least < low + 1e-12, "{low} {least}");
            assert!(most <= high && high < most + 1e-12, "{high} {most}");
        };
        let pi = std::f64::consts::PI;
        about(one.angles(&other), [0.125, 0.875]);
        about(other.angles(&one), [0.125, 0.875]);
        about(one.turns(&other, false), [0.125, 0.875]);
        about(one.turns(&other, true), [pi - 0.875, pi - 0.125]);
    }

    /// Over a turn of a cylinder by 2 β the lines are within β of the middle one, and none is a bound nearer than the
    /// farthest.
    #[test]
    fn cones_hold_the_normals_of_parts_and_narrow_with_them() {
        let controls = quarter_of_cylinder();
        let patch = Patch::whole([2, 1], DVec3::ZERO, &controls);
        let mut last = f64::INFINITY;
        for halvings in 0..6_i32 {
            let width = 0.5_f64.powi(halvings);
            let part = ParamBox::new([0.25, 0.25 + 0.5 * width], [0.0, 1.0]);
            let cone = NormalCone::of_part(&patch, part).unwrap();
            let mut largest = 0.0_f64;
            for step in 0..=20 {
                let at = [part.at([f64::from(step) / 20.0, 0.5])[0], 0.3];
                let jet = patch.jet(at);
                let normal = jet.s.cross(jet.t);
                let angle = normal.cross(cone.axis).length().atan2(normal.dot(cone.axis));
                assert!(angle <= cone.angle + 1e-14, "{angle} {}", cone.angle);
                largest = largest.max(angle);
            }
            assert!(
                cone.angle <= 2.0 * largest + 1e-12 && cone.angle < 0.75 * last,
                "{largest} {}",
                cone.angle
            );
            last = cone.angle;
        }
    }

    #[test]
    fn planes_are_known_up_to_rounding_and_curved_patches_are_none() {
        // A triangle as a patch with a collapsed edge: it has no normal there.
        let corners = [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.1], [0.0, 2.0, 1.2]];
        let controls = corners.map(|[x, y, z]| DVec4::new(x, y, z, 1.0));
        let patch = Patch::whole([1, 1], DVec3::ZERO, &controls);
        assert!(NormalCone::of_part(&patch, ParamBox::UNIT).is_none());
        let plane = NormalCone::of_plane(&patch).unwrap();
        let [a, _, b, c] = corners.map(DVec3::from_array);
        let [_, high] = plane.angles(&NormalCone::of_triangle([a, b, c], 0.0).unwrap());
        assert!(high < 1e-12, "{high}");
        let lifted = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 1e-9]];
        let controls = lifted.map(|[x, y, z]| DVec4::new(x, y, z, 1.0));
        assert!(NormalCone::of_plane(&Patch::whole([1, 1], DVec3::ZERO, &controls)).is_none());
        // A part of a line, and a point, lie in many planes.
        for y in [0.0, 1e-18] {
            let thin = [[0.0, 0.0, 0.0], [0.0, y, 0.0], [1.0, 0.0, 0.0], [1.0, y, 0.0]];
            let controls = thin.map(|[x, y, z]| DVec4::new(x, y, z, 1.0));
            assert!(NormalCone::of_plane(&Patch::whole([1, 1], DVec3::ZERO, &controls)).is_none());
        }
    }

    /// Corners that are off may turn a thin triangle: its cone is wide, or there is none.
    #[test]
    fn errors_of_corners_turn_the_planes_of_thin_triangles() {
        let thin = |height: f64| [DVec3::ZERO, DVec3::X, DVec3::new(0.5, height, 0.0)];
        let [exact, raised] =
            [0.0, 1e-3].map(|z| thin(0.1).map(|corner| corner + DVec3::Z * z * corner.y * 10.0));
        let turn = NormalCone::of_triangle(exact, 0.0)
            .unwrap()
            .angles(&NormalCone::of_triangle(raised, 0.0).unwrap())[0];
        let known = NormalCone::of_triangle(exact, 1e-3).unwrap();
        assert!(turn > 0.009 && known.angle >= turn, "{turn} {}", known.angle);
        assert!(NormalCone::of_triangle(thin(1e-3), 1e-3).is_none());
        assert!(NormalCone::of_triangle(thin(0.0), 0.0).is_none());
    }
}
