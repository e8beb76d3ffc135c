//! Spheres, cylinders, cones and tori that patches and faces lie on, with bounds on how far they leave them.
//!
//! docs/clearance.md has the lemmas. Nothing here knows of files or processors.

mod cone;
mod curvature;
mod distances;
mod face;

use self::cone::Cone;
use self::curvature::{Curvature, circle};
use self::distances::{Distances, across, along, lowest};
use crate::bezier::Jet;
use crate::rounding::{gamma, upper_max};
use glam::DVec3;

pub use face::FaceForm;
pub(crate) use face::plane_of;

/// The ratio of the principal curvatures below which the smaller one counts as 0, and the part of
/// the larger one by which they may differ to count as equal. It decides which carrier is tried.
const CURVATURE_RATIO: f64 = 1e-3;

/// The width of the range of distances, relative to its upper end, up to which a carrier is kept.
const MAX_SPREAD: f64 = 1e-3;

/// The largest number of control points of a patch whose carrier is looked for, which takes the square of it, for a
/// torus 16 times that.
pub(crate) const MAX_CONTROLS: usize = 100;

/// The parameters at which three centres of curvature are taken for a torus.
const PLACES: [[f64; 2]; 3] = [[0.0, 0.0], [0.5, 0.5], [1.0, 1.0]];

/// The roundings of a separation, relative to the lengths that it is made of: lemma C4 of
/// docs/clearance.md.
const SEPARATION_ROUNDINGS: f64 = 64.0;

/// A point, a line or a circle from which all points of a patch are about equally far, or a cone above which they have
/// about the height 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Carrier {
    /// The point, a point of the line, the circle's centre, or the apex.
    center: DVec3,
    kind: Kind,
    /// Bounds on the distances of the patch's points from the point, the line or the circle, or on their heights above
    /// the cone.
    range: [f64; 2],
    /// An upper bound on their distances from `center`.
    reach: f64,
}

#[derive(Debug, Clone, Copy)]
enum Kind {
    Point,
    /// Along a direction of length 1.
    Line(DVec3),
    /// About an axis of length 1, of this radius.
    Circle(DVec3, f64),
    Cone(Cone),
}

impl Kind {
    /// Returns bounds on the distances of a patch's points from the point, the line or the circle about `center`, or on
    /// their heights above the cone, with an upper bound on their distances from `center`; `None` where none are known.
    /// `near` is about the distance from a circle.
    fn range(
        self,
        center: DVec3,
        near: f64,
        degree: [usize; 2],
        points: &[DVec3],
        weights: &[f64],
    ) -> Option<([f64; 2], f64)> {
        let offsets: Vec<DVec3> = points.iter().map(|&point| point - center).collect();
        let reach = offsets.iter().map(|offset| offset.length()).fold(0.0, upper_max);
        let of = |offsets: &[DVec3]| Distances::new(degree, offsets, weights, reach);
        let from_axis = |axis| of(&across(&offsets, axis));
        let range = match self {
            Self::Point => of(&offsets).range(),
            Self::Line(axis) => from_axis(axis).range(),
            Self::Circle(axis, radius) => of(&offsets).range_from_circle(&from_axis(axis), radius, near)?,
            Self::Cone(Cone { axis, cos, sin }) => {
                let heights = along(&offsets, axis);
                from_axis(axis).range_from_cone(&of(&heights), lowest(&heights), [cos, sin])
            }
        };
        Some((range, reach))
    }
}

impl Carrier {
    /// Returns the sphere or the cylinder that has the curvature of a patch in its middle, or the torus
    /// or the cone through its centres of curvature, if all of the patch lies near it. `jet` returns the patch's
    /// derivatives. O(p² q²).
    pub(crate) fn of(
        jet: impl Fn([f64; 2]) -> Jet,
        degree: [usize; 2],
        points: &[DVec3],
        weights: &[f64],
    ) -> Option<Self> {
        let middle = jet([0.5; 2]);
        let curvature = Curvature::of(&middle)?;
        let Curvature { normal, values: [less, more], directions: [along, _] } = curvature;
        let near =
            |center: DVec3, kind: Kind| Self::near(center, kind, middle.point, degree, points, weights);
        if less.abs() <= CURVATURE_RATIO * more.abs() {
            let cylinder = near(middle.point + normal / more, Kind::Line(along));
            return cylinder.or_else(|| {
                let (apex, cone) = Cone::of(jet, &curvature, middle.point, along)?;
                near(apex, Kind::Cone(cone))
            });
        }
        if (more - less).abs() <= CURVATURE_RATIO * more.abs() {
            return near(middle.point + normal / (0.5 * (less + more)), Kind::Point);
        }
        let [a, b, c] = PLACES.map(|at| Curvature::of(&jet(at)).map(|found| found.center(jet(at).point)));
        let (center, axis, radius) = circle([a?, b?, c?])?;
        near(center, Kind::Circle(axis, radius))
    }

    /// Returns the carrier if all of a patch, with this point in its middle, lies near it.
    fn near(
        center: DVec3,
        kind: Kind,
        middle: DVec3,
        degree: [usize; 2],
        points: &[DVec3],
        weights: &[f64],
    ) -> Option<Self> {
        let near = match kind {
            Kind::Circle(axis, radius) => {
                let offset = middle - center;
                let up = axis.dot(offset);
                up.hypot((offset - up * axis).length() - radius)
            }
            _ => 0.0,
        };
        let (range, reach) = kind.range(center, near, degree, points, weights)?;
        let size = match kind {
            Kind::Cone(_) => reach,
            _ => range[1],
        };
        // A plane's range is all numbers: its center is infinitely far.
        let is_near = range[1] - range[0] < MAX_SPREAD * size;
        is_near.then_some(Self { center, kind, range, reach })
    }

    /// Returns a lower bound on the distance of two patches, 0 where none is known.
    ///
    /// Guarantee (lemmas C3 and C6 of docs/clearance.md): the distance f from a point, a line or a circle, or the height
    /// above a cone, changes by at most |x - y| between x and y, so that |x - y| is at least the least f of one patch
    /// less the largest of the other; with a carrier each, f of the second is larger by at most a shift.
    pub(crate) fn separation(&self, other: &Self) -> f64 {
        let [Some(of_other), Some(of_self)] = [other.shift(self), self.shift(other)] else { return 0.0 };
        let rounding =
            gamma(SEPARATION_ROUNDINGS) * (self.size() + other.size() + self.center.distance(other.center));
        let inner = self.range[0] - other.range[1] - of_other;
        let outer = other.range[0] - self.range[1] - of_self;
        // NaN bounds nothing.
        let larger = if outer > inner { outer } else { inner };
        if larger > rounding { larger - rounding } else { 0.0 }
    }

    /// Returns an upper bound on a point's distance from the other carrier less that from this one, for the
    /// points of this patch; `None` for carriers of two kinds.
    fn shift(&self, other: &Self) -> Option<f64> {
        let between = self.center - other.center;
        match (self.kind, other.kind) {
            (Kind::Point, Kind::Point) => Some(between.length()),
            (Kind::Line(one), Kind::Line(two)) => {
                Some(between.cross(two).length() + self.reach * one.cross(two).length())
            }
            (Kind::Circle(one, radius), Kind::Circle(two, other_radius)) => {
                let tilt = if one.dot(two) < 0.0 { one + two } else { one - two };
                Some(between.length() + (radius - other_radius).abs() + radius * tilt.length())
            }
            (Kind::Cone(one), Kind::Cone(two)) => Some(one.shift(&two, between, self.reach)),
            _ => None,
        }
    }

    /// Returns a bound on the lengths that a separation is computed from.
    fn size(&self) -> f64 {
        match self.kind {
            Kind::Circle(_, radius) => self.reach + radius,
            _ => self.reach,
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::bezier::Patch;
    use crate::rounding::UNIT_ROUNDOFF;
    use glam::{DQuat, DVec4};
    use std::f64::consts::FRAC_1_SQRT_2;

    /// A quarter of a circle about z, from x to y: points with weights.
    fn quarter(radius: f64) -> [(DVec3, f64); 3] {
        [
            (radius * DVec3::X, 1.0),
            (radius * DVec3::new(1.0, 1.0, 0.0), FRAC_1_SQRT_2),
            (radius * DVec3::Y, 1.0),
        ]
    }

    fn carrier(degree: [usize; 2], net: &[(DVec3, f64)]) -> Option<Carrier> {
        let points: Vec<DVec3> = net.iter().map(|&(point, _)| point).collect();
        let controls: Vec<DVec4> = net.iter().map(|&(point, w)| (w * point).extend(w)).collect();
        let weights: Vec<f64> = net.iter().map(|&(_, w)| w).collect();
        let patch = Patch::whole(degree, DVec3::ZERO, &controls);
        Carrier::of(|at| patch.jet(at), degree, &points, &weights)
    }

    /// A quarter of a cylinder of height 2 about z, moved.
    fn cylinder(radius: f64, place: impl Fn(DVec3) -> DVec3) -> Carrier {
        let at =
            |height: f64| quarter(radius).map(|(point, weight)| (place(point + height * DVec3::Z), weight));
        let net: Vec<(DVec3, f64)> = [at(-1.0), at(1.0)].concat();
        carrier([1, 2], &net).unwrap_or_else(|| unreachable!("it lies on a cylinder"))
    }

    /// An eighth of a sphere, moved.
    fn sphere(radius: f64, place: impl Fn(DVec3) -> DVec3) -> Carrier {
        // The meridian from the equator to the pole, turned about z.
        let meridian = [(1.0, 0.0, 1.0), (1.0, 1.0, FRAC_1_SQRT_2), (0.0, 1.0, 1.0)];
        let net: Vec<(DVec3, f64)> = meridian
            .iter()
            .flat_map(|&(out, up, of_meridian)| {
                quarter(radius).map(|(point, weight)| {
                    (place(out * point + up * radius * DVec3::Z), weight * of_meridian)
                })
            })
            .collect();
        carrier([2, 2], &net).unwrap_or_else(|| unreachable!("it lies on a sphere"))
    }

    /// A quarter of a ring of radius 3 about z, the upper outer quarter of its tube, moved.
    fn torus(tube: f64, place: impl Fn(DVec3) -> DVec3) -> Carrier {
        ring(3.0, tube, place)
    }

    fn ring(radius: f64, tube: f64, place: impl Fn(DVec3) -> DVec3) -> Carrier {
        let section = [(1.0, 0.0, 1.0), (1.0, 1.0, FRAC_1_SQRT_2), (0.0, 1.0, 1.0)];
        let net: Vec<(DVec3, f64)> = section
            .iter()
            .flat_map(|&(out, up, of_section)| {
                quarter(radius + tube * out)
                    .map(|(point, weight)| (place(point + tube * up * DVec3::Z), weight * of_section))
            })
            .collect();
        carrier([2, 2], &net).unwrap_or_else(|| unreachable!("it lies on a torus"))
    }

    fn turned(point: DVec3) -> DVec3 {
        DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), 0.9) * point
            + DVec3::new(3.0, 4.0, -1.0)
    }

    /// The rounding that a bound allows for, and at most twenty times as much.
    fn assert_attained(bound: f64, truth: f64) {
        assert!(bound <= truth && truth - bound < 2e-11, "{bound} for {truth}");
    }

    #[test]
    fn coaxial_cylinders_are_the_difference_of_their_radii_apart() {
        let (inner, outer) = (cylinder(1.5, turned), cylinder(2.0, turned));
        assert_attained(inner.separation(&outer), 0.5);
        assert_attained(outer.separation(&inner), 0.5);
        // Moved along its axis it is as far, and across it, outwards, nearer by as much.
        let along = cylinder(1.5, |point| turned(point + 0.3 * DVec3::Z));
        assert_attained(along.separation(&outer), 0.5);
        let across = cylinder(1.5, |point| turned(point + 0.1 * DVec3::new(1.0, 1.0, 0.0).normalize()));
        assert_attained(across.separation(&outer), 0.4);
        assert_attained(outer.separation(&across), 0.4);
    }

    #[test]
    fn concentric_spheres_are_the_difference_of_their_radii_apart() {
        let (inner, outer) = (sphere(1.5, turned), sphere(2.0, turned));
        assert_attained(inner.separation(&outer), 0.5);
        assert_attained(outer.separation(&inner), 0.5);
        let across = sphere(1.5, |point| turned(point + 0.1 * DVec3::ONE.normalize()));
        assert_attained(across.separation(&outer), 0.4);
        assert_attained(outer.separation(&across), 0.4);
        assert_eq!(cylinder(1.5, turned).separation(&outer), 0.0, "of another kind");
    }

    /// The allowance of lemma C4: 64 roundings of both reaches, with the radii of circles, and of the
    /// distance of both centres.
    #[test]
    fn a_separation_is_less_by_its_rounding() {
        let carrier = |kind: Kind, x: f64, [low, high]: [f64; 2], reach: f64| Carrier {
            center: x * DVec3::X,
            kind,
            range: [low, high],
            reach,
        };
        let axis = DVec3::X;
        for (kind, lengths) in [
            (Kind::Point, 8.0 + 3.0 + 1.0),
            (Kind::Circle(axis, 16.0), 8.0 + 3.0 + 1.0 + 32.0),
            (Kind::Line(axis), 8.0 + 3.0 + 1.0),
        ] {
            let [outer, inner] = [carrier(kind, 0.0, [7.5, 8.0], 8.0), carrier(kind, 1.0, [1.0, 2.0], 3.0)];
            // A line that is moved along itself is the same line.
            let shift = if matches!(kind, Kind::Line(_)) { 0.0 } else { 1.0 };
            let rounding = 64.0 * UNIT_ROUNDOFF * lengths;
            for found in [outer.separation(&inner), inner.separation(&outer)] {
                let less = 7.5 - 2.0 - shift - found;
                assert!(rounding <= less && less <= 1.1 * rounding, "{less:e} for {rounding:e}");
            }
        }
    }

    /// Tilted in the plane of its middle, a cylinder of radius 1.5 comes nearer to that of 2 by
    /// the sine times its half height, from the middle of its end.
    #[test]
    fn tilted_axes_lessen_the_bound() {
        let middle = DVec3::new(1.0, 1.0, 0.0).normalize();
        for angle in [1e-3_f64, -1e-3] {
            let tilt = DQuat::from_axis_angle(middle.cross(DVec3::Z).normalize(), angle);
            let tilted = cylinder(1.5, |point| turned(tilt * point));
            let outer = cylinder(2.0, turned);
            let truth = 2.0 - 1.5 * angle.cos() - angle.sin().abs();
            for bound in [tilted.separation(&outer), outer.separation(&tilted)] {
                assert!(bound <= truth && bound > truth - 2e-3, "{bound} for {truth}");
            }
        }
    }

    #[test]
    fn tori_about_one_circle_are_the_difference_of_their_tubes_apart() {
        let (inner, outer) = (torus(0.5, turned), torus(0.75, turned));
        assert_attained(inner.separation(&outer), 0.25);
        assert_attained(outer.separation(&inner), 0.25);
        let up = torus(0.5, |point| turned(point + 0.1 * DVec3::Z));
        assert_attained(up.separation(&outer), 0.15);
        // A wider ring is nearer to the outer one outside of it by the difference of both radii.
        let wide = ring(3.1, 0.5, turned);
        assert_attained(wide.separation(&outer), 0.15);
        assert_attained(outer.separation(&wide), 0.15);
        assert_eq!(sphere(0.5, turned).separation(&outer), 0.0, "of another kind");
        // A tilt by an angle lifts the circle by at most its radius times the angle.
        let tilt = DQuat::from_axis_angle(DVec3::new(1.0, -1.0, 0.0).normalize(), -1e-3);
        let tilted = torus(0.5, |point| turned(tilt * point));
        // The upper end of the section in the middle plane, 3 from the axis, rises by 3 sines.
        let truth = 0.25 - 3.0 * 1e-3;
        for bound in [tilted.separation(&outer), outer.separation(&tilted)] {
            assert!(bound <= truth + 1e-5 && bound > truth - 1e-3, "{bound} for {truth}");
        }
    }

    /// A quarter of a nappe about z with its apex at 0, between two heights, moved.
    fn cone(tangent: f64, heights: [f64; 2], place: impl Fn(DVec3) -> DVec3) -> Carrier {
        let at = |height: f64| {
            quarter(tangent * height).map(|(point, weight)| (place(point + height * DVec3::Z), weight))
        };
        let net: Vec<(DVec3, f64)> = heights.map(at).concat();
        carrier([1, 2], &net).unwrap_or_else(|| unreachable!("it lies on a cone"))
    }

    /// The lines of coaxial cones of a half angle with the sine 0.6 are 0.6 times the way along the axis apart.
    #[test]
    fn coaxial_cones_are_the_distance_of_their_lines_apart() {
        let outer = cone(0.75, [1.0, 3.0], turned);
        let up = |way: f64| cone(0.75, [0.5, 2.0], move |point| turned(point + way * DVec3::Z));
        for way in [0.25, -0.25] {
            assert_attained(up(way).separation(&outer), 0.15);
            assert_attained(outer.separation(&up(way)), 0.15);
        }
        // Moved across the axis, outwards from its middle and back, it is nearer by the cosine times the way.
        let across = |point: DVec3| turned(point - 0.3 * DVec3::Z + 0.1 * DVec3::new(0.6, 0.8, 0.0));
        let moved = cone(0.75, [0.5, 2.0], across);
        let truth = 0.6 * 0.3 - 0.8 * 0.1;
        for bound in [moved.separation(&outer), outer.separation(&moved)] {
            assert!(bound <= truth + 1e-12 && bound > truth - 1e-9, "{bound} for {truth}");
        }
        assert_eq!(cylinder(1.5, turned).separation(&outer), 0.0, "of another kind");
    }

    /// The apex itself has no normal and no divisor; heights above its cone are bounded by a root.
    #[test]
    fn cones_with_their_apex_are_as_far_apart_but_for_the_root_of_rounding() {
        let whole = |way: f64| cone(0.75, [0.0, 2.0], move |point| turned(point + way * DVec3::Z));
        let found = whole(0.25).separation(&whole(0.0));
        assert!(found <= 0.15 && 0.15 - found < 1e-6, "{found}");
    }

    /// A cone that is opened by an angle, of two cones with one apex, comes nearer by that angle at its end, and one
    /// that is tilted by it too.
    #[test]
    fn other_angles_and_tilts_lessen_the_bound() {
        let outer = cone(0.75, [1.0, 3.0], turned);
        let below = |point: DVec3| turned(point - 0.5 * DVec3::Z);
        let least = |truth: f64, bound: f64, slack: f64| {
            assert!(bound <= truth + 1e-12 && bound > truth - slack, "{bound} for {truth}");
        };
        // At heights h from 1 to 2 its radius is 0.76 h, 0.3 + 0.008 h above the other cone.
        let opened = cone(0.76, [1.0, 2.0], below);
        least(0.308, opened.separation(&outer), 0.05);
        least(0.308, outer.separation(&opened), 0.05);
        let tilt = DQuat::from_axis_angle(DVec3::new(1.0, -1.0, 0.0).normalize(), 1e-3);
        let tilted = cone(0.75, [0.5, 2.0], |point| below(tilt * point));
        // The line in the middle plane, 2.5 long, turns inwards.
        let truth = 0.3 - 2.5 * 1e-3_f64.sin();
        for bound in [tilted.separation(&outer), outer.separation(&tilted)] {
            least(truth, bound, 5e-3);
        }
    }

    #[test]
    fn a_plane_and_a_saddle_have_no_carrier() {
        let net = |twist: f64| {
            let at = |x: f64, y: f64| (DVec3::new(x, y, twist * x * y), 1.0);
            [at(0.0, 0.0), at(0.0, 1.0), at(1.0, 0.0), at(1.0, 1.0)]
        };
        assert!(carrier([1, 1], &net(0.0)).is_none() && carrier([1, 1], &net(0.5)).is_none());
    }
}
