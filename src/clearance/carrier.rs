//! Spheres, cylinders and tori that patches lie on.

use super::curvature::{Curvature, circle};
use super::distances::{Distances, across};
use crate::bezier::Jet;
use crate::rounding::{gamma, upper_max};
use glam::DVec3;

/// The ratio of the principal curvatures below which the smaller one counts as 0, and the part of
/// the larger one by which they may differ to count as equal. It decides which carrier is tried.
const CURVATURE_RATIO: f64 = 1e-3;

/// The width of the range of distances, relative to its upper end, up to which a carrier is kept.
const MAX_SPREAD: f64 = 1e-3;

/// The parameters at which three centres of curvature are taken for a torus.
const PLACES: [[f64; 2]; 3] = [[0.0, 0.0], [0.5, 0.5], [1.0, 1.0]];

/// The roundings of a separation, relative to the lengths that it is made of: lemma C4 of
/// docs/clearance.md.
const SEPARATION_ROUNDINGS: f64 = 64.0;

/// A point, a line or a circle from which all points of a patch are about equally far.
#[derive(Debug, Clone, Copy)]
pub(super) struct Carrier {
    /// The point, a point of the line, or the circle's centre.
    center: DVec3,
    kind: Kind,
    /// Bounds on the distances of the patch's points from the point, the line or the circle.
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
}

impl Carrier {
    /// Returns the sphere or the cylinder that has the curvature of a patch in its middle, or the torus
    /// through its centres of curvature, if all of the patch lies near it. `jet` returns the patch's
    /// derivatives. O(p² q²).
    pub(super) fn of(
        jet: impl Fn([f64; 2]) -> Jet,
        degree: [usize; 2],
        points: &[DVec3],
        weights: &[f64],
    ) -> Option<Self> {
        let middle = jet([0.5; 2]);
        let Curvature { normal, values: [less, more], directions: [along, _] } = Curvature::of(&middle)?;
        let (center, kind) = if less.abs() <= CURVATURE_RATIO * more.abs() {
            (middle.point + normal / more, Kind::Line(along))
        } else if (more - less).abs() <= CURVATURE_RATIO * more.abs() {
            (middle.point + normal / (0.5 * (less + more)), Kind::Point)
        } else {
            let [a, b, c] = PLACES.map(|at| Curvature::of(&jet(at)).map(|found| found.center(jet(at).point)));
            let (center, axis, radius) = circle([a?, b?, c?])?;
            (center, Kind::Circle(axis, radius))
        };
        let offsets: Vec<DVec3> = points.iter().map(|&point| point - center).collect();
        let reach = offsets.iter().map(|offset| offset.length()).fold(0.0, upper_max);
        let from_center = || Distances::new(degree, &offsets, weights, reach);
        let from_axis = |axis| Distances::new(degree, &across(&offsets, axis), weights, reach);
        let range = match kind {
            Kind::Point => from_center().range(),
            Kind::Line(axis) => from_axis(axis).range(),
            Kind::Circle(axis, radius) => {
                let offset = middle.point - center;
                let up = axis.dot(offset);
                let near = up.hypot((offset - up * axis).length() - radius);
                from_center().range_from_circle(&from_axis(axis), radius, near)?
            }
        };
        // A plane's range is all numbers: its center is infinitely far.
        let is_near = range[1] - range[0] < MAX_SPREAD * range[1];
        is_near.then_some(Self { center, kind, range, reach })
    }

    /// Returns a lower bound on the distance of two patches, 0 where none is known.
    ///
    /// Guarantee (lemma C3 of docs/clearance.md): the distance f from a point, a line or a circle
    /// changes by at most |x - y| between x and y, so that |x - y| is at least the least f of one patch
    /// less the largest of the other; with a carrier each, f of the second differs by at most a shift.
    pub(super) fn separation(&self, other: &Self) -> f64 {
        let [Some(of_other), Some(of_self)] = [other.shift(self), self.shift(other)] else { return 0.0 };
        let rounding =
            gamma(SEPARATION_ROUNDINGS) * (self.size() + other.size() + self.center.distance(other.center));
        let inner = self.range[0] - other.range[1] - of_other;
        let outer = other.range[0] - self.range[1] - of_self;
        // NaN bounds nothing.
        let larger = if outer > inner { outer } else { inner };
        if larger > rounding { larger - rounding } else { 0.0 }
    }

    /// Returns an upper bound on the difference of a point's distances from both carriers, for the
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

    #[test]
    fn a_plane_and_a_saddle_have_no_carrier() {
        let net = |twist: f64| {
            let at = |x: f64, y: f64| (DVec3::new(x, y, twist * x * y), 1.0);
            [at(0.0, 0.0), at(0.0, 1.0), at(1.0, 0.0), at(1.0, 1.0)]
        };
        assert!(carrier([1, 1], &net(0.0)).is_none() && carrier([1, 1], &net(0.5)).is_none());
    }
}
