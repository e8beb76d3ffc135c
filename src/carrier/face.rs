//! The plane, sphere, cylinder, cone or torus that a face lies on.

use super::{Carrier, Kind};
use crate::bezier::{BezierModel, Patch, extract};
use crate::facts::Interval;
use crate::model::{Model, NurbsSurface};
use crate::rounding::{gamma, lower_min, unit, upper_max};
use glam::{DVec3, Vec4Swizzles};
use serde::Serialize;

/// The part of a surface's size by which it may leave its form: nets written with seven digits pass.
const ON_FORM: f64 = 1e-6;

/// The largest number of control points of a patch that is looked at: bounds take the square of it, for a torus 16 times
/// that.
const MAX_CONTROLS: usize = 100;

/// The roundings of a centre or an axis, relative to the lengths that it is computed from: distances are stated with as
/// much more on both sides, so that the radius that a source states is among them, and those of a cylinder that is written
/// twice have numbers in common.
const FORM_ROUNDINGS: f64 = 256.0;

/// The roundings of a height above a plane, relative to the surface's reach.
const HEIGHT_ROUNDINGS: f64 = 8.0;

/// The elementary surface that all points of a face lie on, up to what is stated, in the model's unit.
///
/// Points and directions are numbers, not intervals: what is certain is how far the face's points are from the form with
/// just these numbers. `radius` contains the distance of every point of the face from the centre, the axis or the circle.
/// The gap between the face and its source ([`crate::Face::gap`]) is not in it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "camelCase", rename_all_fields = "camelCase")]
#[non_exhaustive]
pub enum FaceForm {
    /// A plane.
    Plane {
        /// A point of the plane.
        point: [f64; 3],
        /// Its normal, of length 1, which may point to either side of the face.
        direction: [f64; 3],
        /// An upper bound on the distances of the face's points from the plane.
        deviation: f64,
    },
    /// A sphere.
    Sphere {
        /// Its centre.
        point: [f64; 3],
        /// An interval that contains the distances of the face's points from the centre.
        radius: Interval,
    },
    /// A circular cylinder.
    Cylinder {
        /// A point of the axis.
        point: [f64; 3],
        /// The axis' direction, of length 1, which may point either way.
        direction: [f64; 3],
        /// An interval that contains the distances of the face's points from the axis.
        radius: Interval,
    },
    /// A circular cone, one nappe of it.
    Cone {
        /// The apex.
        point: [f64; 3],
        /// The axis' direction from the apex to the face, of length 1.
        direction: [f64; 3],
        /// The angle between the axis and the lines of the cone, in degrees.
        half_angle: f64,
        /// An upper bound on the distances of the face's points from the cone.
        deviation: f64,
    },
    /// A torus.
    Torus {
        /// Its centre.
        point: [f64; 3],
        /// The direction of its axis, of length 1, which may point either way.
        direction: [f64; 3],
        /// The radius of the circle in the middle of its tube.
        major_radius: f64,
        /// An interval that contains the distances of the face's points from that circle.
        radius: Interval,
    },
}

impl FaceForm {
    /// Returns the form of a whole surface, and so of every face that is a part of it; `None` for others, as for
    /// surfaces whose patches have more than 100 control points.
    ///
    /// A form is stated if the surface leaves it by at most a millionth of its size. Lemmas C4 to C6 of
    /// docs/clearance.md bound how far it does; a plane is bounded by the control points' hull. O(p⁴ q⁴) a patch.
    #[must_use]
    pub fn of(surface: &NurbsSurface) -> Option<Self> {
        let whole = Model::new(None, vec![surface.clone()]).ok()?;
        let BezierModel { patches, point_error, .. } = extract(&whole);
        let surface =
            Surface { patches: patches.iter().map(Points::new).collect(), error: point_error.after(0) };
        surface.plane().or_else(|| surface.round())
    }
}

/// The control points of a patch and their weights.
struct Points<'a> {
    patch: Patch<'a>,
    points: Vec<DVec3>,
    weights: Vec<f64>,
}

impl<'a> Points<'a> {
    fn new(patch: Patch<'a>) -> Self {
        let points = patch.controls.iter().map(|control| patch.center + control.xyz() / control.w).collect();
        let weights = patch.controls.iter().map(|control| control.w).collect();
        Self { patch, points, weights }
    }
}

/// The patches of a surface.
struct Surface<'a> {
    patches: Vec<Points<'a>>,
    /// An upper bound on the distance of its points from those of the patches.
    error: f64,
}

impl Surface<'_> {
    fn points(&self) -> impl Iterator<Item = DVec3> {
        self.patches.iter().flat_map(|patch| patch.points.iter().copied())
    }

    /// Returns how far the surface reaches from a point, up to rounding.
    fn reach(&self, from: DVec3) -> f64 {
        self.points().map(|point| point.distance(from)).fold(0.0, upper_max)
    }

    /// Returns the plane that the surface lies on.
    fn plane(&self) -> Option<FaceForm> {
        let points: Vec<DVec3> = self.points().collect();
        let (point, normal) = plane_of(&points)?;
        let reach = self.reach(point);
        let height = points.iter().map(|&at| normal.dot(at - point).abs()).fold(0.0, upper_max);
        let deviation = height + gamma(HEIGHT_ROUNDINGS) * (reach + point.length()) + self.error;
        let is_plane = deviation <= ON_FORM * reach;
        is_plane.then(|| FaceForm::Plane {
            point: point.to_array(),
            direction: normal.to_array(),
            deviation: deviation.next_up(),
        })
    }

    /// Returns the sphere, the cylinder, the cone or the torus that the surface lies on.
    fn round(&self) -> Option<FaceForm> {
        if self.patches.iter().any(|patch| patch.points.len() > MAX_CONTROLS) {
            return None;
        }
        // The longest patch says most of the curvature.
        let size = |patch: &&Points<'_>| patch.patch.bounding_box().diagonal();
        let longest = self.patches.iter().max_by(|one, other| size(one).total_cmp(&size(other)))?;
        let jet = |at: [f64; 2]| longest.patch.jet(at);
        let carrier = Carrier::of(jet, longest.patch.degree, &longest.points, &longest.weights)?;
        let middle = 0.5 * (carrier.range[0] + carrier.range[1]);
        let mut all = carrier.range;
        for Points { patch, points, weights } in &self.patches {
            let (range, _) = carrier.kind.range(carrier.center, middle, patch.degree, points, weights)?;
            all = [lower_min(all[0], range[0]), upper_max(all[1], range[1])];
        }
        let rounding = gamma(FORM_ROUNDINGS) * (carrier.reach + carrier.center.length());
        let distances =
            Interval { lower: all[0], upper: all[1] } + Interval::about(0.0, self.error + rounding);
        let is_on = distances.width() <= ON_FORM * self.reach(longest.points[0]);
        is_on.then(|| carrier.form(distances))
    }
}

impl Carrier {
    /// Returns the form with the distances of a face's points from the centre, the axis or the circle, or their heights
    /// above the cone.
    fn form(&self, distances: Interval) -> FaceForm {
        let point = self.center.to_array();
        match self.kind {
            Kind::Point => FaceForm::Sphere { point, radius: distances },
            Kind::Line(axis) => FaceForm::Cylinder { point, direction: axis.to_array(), radius: distances },
            Kind::Circle(axis, major_radius) => {
                FaceForm::Torus { point, direction: axis.to_array(), major_radius, radius: distances }
            }
            Kind::Cone(cone) => FaceForm::Cone {
                point,
                direction: cone.axis.to_array(),
                half_angle: cone.sin.atan2(cone.cos).to_degrees(),
                deviation: upper_max(-distances.lower, distances.upper),
            },
        }
    }
}

/// Returns the plane on which points lie or nearly so, by their mean and its normal; `None` for others, and for points
/// of a line.
pub(crate) fn plane_of(points: &[DVec3]) -> Option<(DVec3, DVec3)> {
    let center = points.iter().sum::<DVec3>() / points.len() as f64;
    let arms = || points.iter().map(|&point| point - center);
    let longer = |one: DVec3, other: DVec3| if other.length() > one.length() { other } else { one };
    let longest = arms().reduce(longer)?;
    let across = arms().map(|arm| longest.cross(arm)).reduce(longer)?;
    let normal = unit(across);
    let size = longest.length();
    let is_flat = arms().all(|arm| normal.dot(arm).abs() <= ON_FORM * size);
    (is_flat && across.length() > ON_FORM * size * size).then_some((center, normal))
}

#[cfg(all(test, feature = "shapes", not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::model::RigidTransform;
    use crate::shapes::operations::transformed;
    use crate::shapes::{cone, cylinder, shape, sphere, torus};
    use glam::DQuat;
    use std::f64::consts::FRAC_1_SQRT_2;

    /// Turned and moved, so that no axis is one of the coordinates'.
    fn moved(model: &Model) -> (Model, RigidTransform) {
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.8);
        let motion = RigidTransform::new(turn, DVec3::new(-10.0, 20.0, 5.0)).unwrap();
        (transformed(model, &motion).unwrap(), motion)
    }

    fn forms(model: &Model) -> Vec<Option<FaceForm>> {
        model.surfaces().iter().map(FaceForm::of).collect()
    }

    /// The distance of a point from a line.
    fn from_line(at: DVec3, point: [f64; 3], direction: [f64; 3]) -> f64 {
        (at - DVec3::from_array(point)).cross(DVec3::from_array(direction)).length()
    }

    fn assert_radius(found: Interval, radius: f64) {
        assert!(found.contains(radius) && found.width() < 1e-10, "{found:?} for {radius}");
    }

    #[test]
    fn balls_and_tori_have_their_radii_wherever_they_are() {
        let (ball, motion) = moved(&sphere(DVec3::new(3.0, 1.0, 2.0), 2.0).unwrap());
        let center = motion.apply(DVec3::new(3.0, 1.0, 2.0));
        for found in forms(&ball) {
            let Some(FaceForm::Sphere { point: at, radius }) = found else { panic!("{found:?}") };
            assert!(DVec3::from_array(at).distance(center) < 1e-11);
            assert_radius(radius, 2.0);
        }
        let (ring, motion) = moved(&torus(2.0, 0.5).unwrap());
        for found in forms(&ring) {
            let Some(FaceForm::Torus { point, major_radius, radius, .. }) = found else {
                panic!("{found:?}")
            };
            assert!(DVec3::from_array(point).distance(motion.apply(DVec3::ZERO)) < 1e-10);
            assert!((major_radius - 2.0).abs() < 1e-10);
            assert_radius(radius, 0.5);
        }
    }

    /// The wall of a cylinder is one, and its ends are planes.
    #[test]
    fn a_cylinder_has_its_radius_and_two_planes() {
        let (part, motion) = moved(&cylinder(1.5, 3.0).unwrap());
        let (mut walls, mut ends) = (0, 0);
        for (found, surface) in forms(&part).into_iter().zip(part.surfaces()) {
            match found {
                Some(FaceForm::Cylinder { point, direction, radius }) => {
                    walls += 1;
                    assert_radius(radius, 1.5);
                    assert!(from_line(motion.apply(DVec3::Z), point, direction) < 1e-11);
                }
                Some(FaceForm::Plane { point, direction, deviation }) => {
                    ends += 1;
                    assert!(deviation < 1e-12, "{deviation}");
                    let corner = DVec3::from_slice(&surface.control_points()[0]);
                    assert!(
                        (corner - DVec3::from_array(point)).dot(DVec3::from_array(direction)).abs() < 1e-12
                    );
                }
                other => panic!("{other:?}"),
            }
        }
        assert!(walls > 0 && ends > 0, "{walls} {ends}");
    }

    #[test]
    fn a_cone_has_its_apex_and_its_angle() {
        let (part, motion) = moved(&cone(1.0, 2.0).unwrap());
        let found = forms(&part).into_iter().flatten();
        let cones: Vec<_> = found
            .filter_map(|form| match form {
                FaceForm::Cone { point, half_angle, deviation, .. } => Some((point, half_angle, deviation)),
                _ => None,
            })
            .collect();
        assert!(!cones.is_empty());
        for (apex, half_angle, deviation) in cones {
            assert!(DVec3::from_array(apex).distance(motion.apply(DVec3::Z)) < 1e-10, "{apex:?}");
            assert!(
                (half_angle - 0.5_f64.atan().to_degrees()).abs() < 1e-9 && deviation < 1e-7,
                "{half_angle}"
            );
        }
    }

    /// The distance of a point from what its radius is measured from.
    fn distance(form: &FaceForm, at: DVec3) -> (f64, Interval) {
        match *form {
            FaceForm::Sphere { point, radius } => (at.distance(DVec3::from_array(point)), radius),
            FaceForm::Cylinder { point, direction, radius } => (from_line(at, point, direction), radius),
            FaceForm::Torus { point, direction, major_radius, radius } => {
                let up = (at - DVec3::from_array(point)).dot(DVec3::from_array(direction));
                (up.hypot(from_line(at, point, direction) - major_radius), radius)
            }
            _ => unreachable!("it has a radius"),
        }
    }

    /// Of surfaces that are off their forms by a little the radius holds the distances of all points, and no others by
    /// more than half of its width.
    #[test]
    fn the_radius_holds_the_distances_of_all_points() {
        let ball = sphere(DVec3::new(3.0, 1.0, 2.0), 2.0).unwrap();
        for model in [ball, cylinder(1.5, 3.0).unwrap(), torus(2.0, 0.5).unwrap()] {
            let mut points = model.surfaces()[0].control_points().to_vec();
            // A part of the control points is 2e-8 off, a part of another patch for each coordinate.
            let count = points.len();
            for (index, point) in points.iter_mut().enumerate() {
                point[index * 3 / count] += 2e-8;
            }
            let bent = model.with_control_points(0, points).unwrap();
            let form = FaceForm::of(&bent.surfaces()[0]).unwrap();
            let whole = Model::new(None, vec![bent.surfaces()[0].clone()]).unwrap();
            let (mut least, mut largest) = (f64::INFINITY, 0.0_f64);
            for patch in extract(&whole).patches.iter() {
                for place in 0..17 * 17 {
                    let at = [place / 17, place % 17].map(|step| f64::from(step) / 16.0);
                    let (found, radius) = distance(&form, patch.point(at));
                    assert!(radius.contains(found), "{found} in {radius:?}");
                    (least, largest) = (least.min(found), largest.max(found));
                }
            }
            let (_, radius) = distance(&form, DVec3::ZERO);
            assert!(largest - least > 0.5 * radius.width(), "{least} … {largest} in {radius:?}");
        }
    }

    /// A source states radii, and the NURBS of a reader are rounded.
    #[test]
    fn the_error_of_patches_is_part_of_the_radius() {
        let whole = sphere(DVec3::ZERO, 2.0).unwrap();
        let patches = extract(&whole).patches;
        let of = |error: f64| {
            let all = Surface { patches: patches.iter().map(Points::new).collect(), error };
            match all.round() {
                Some(FaceForm::Sphere { radius, .. }) => radius,
                other => panic!("{other:?}"),
            }
        };
        let [without, with] = [0.0, 1e-7].map(of);
        for (less, more) in [(with.lower, without.lower), (without.upper, with.upper)] {
            assert!((more - less - 1e-7).abs() < 1e-15, "{with:?} {without:?}");
        }
        // The roundings of the centre: 256 of a reach of at least 2.
        assert!(without.width() > 2.0 * 256.0 * f64::EPSILON, "{without:?}");
    }

    #[test]
    fn a_tube_wider_than_its_circle_is_a_torus() {
        let net = |tube: f64| {
            let section = [(1.0, 0.0, 1.0), (1.0, 0.5, 0.8_f64.sqrt()), (0.6, 0.8, 1.0)];
            section.map(|(out, up, weight)| (1.0 + tube * out, tube * up, weight))
        };
        // An arc of the section from 0 to atan(4/3), about z through a quarter turn; its middle control point is where the
        // tangents of both ends meet, with the cosine of half of the angle.
        let mut controls = Vec::new();
        for (out, up, weight) in net(3.0) {
            for (x, y, of_turn) in [(1.0, 0.0, 1.0), (1.0, 1.0, FRAC_1_SQRT_2), (0.0, 1.0, 1.0)] {
                let weight = weight * of_turn;
                controls.push((weight * DVec3::new(out * x, out * y, up)).extend(weight));
            }
        }
        let patch = Patch::whole([2, 2], DVec3::ZERO, &controls);
        let found = Surface { patches: vec![Points::new(patch)], error: 0.0 }.round();
        let Some(FaceForm::Torus { major_radius, radius, .. }) = found else { panic!("{found:?}") };
        assert!((major_radius - 1.0).abs() < 1e-10, "{major_radius}");
        assert_radius(radius, 3.0);
    }

    #[test]
    fn free_forms_have_none() {
        for name in ["wavy-sheet", "bottle"] {
            assert!(forms(&shape(name).unwrap()).iter().all(Option::is_none), "{name}");
        }
    }

    /// Without an error of the patches the bounds are those of the control points; with one they are farther by it.
    #[test]
    fn a_plane_is_as_far_off_as_its_farthest_control_point() {
        let patch = |lift: f64| {
            let corners = [[0.0, 0.0, lift], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [2.0, 2.0, 0.0]];
            corners.map(|[x, y, z]| DVec3::new(x, y, z).extend(1.0))
        };
        let found = |lift: f64, error: f64| {
            let controls = patch(lift);
            let patch = Patch::whole([1, 1], DVec3::ZERO, &controls);
            let found = Surface { patches: vec![Points::new(patch)], error }.plane();
            found.map(|form| match form {
                FaceForm::Plane { deviation, .. } => deviation,
                _ => unreachable!("it is a plane"),
            })
        };
        let flat = found(0.0, 0.0).unwrap();
        assert!(flat < 1e-14, "{flat}");
        assert!((0.25e-6..0.2501e-6).contains(&found(0.0, 0.25e-6).unwrap()));
        let lifted = found(1e-6, 0.0).unwrap();
        assert!((0.24e-6..1e-6).contains(&lifted), "{lifted}");
        assert_eq!(found(1e-5, 0.0), None);
    }
    /// Control points in a plane give it, whichever way its net runs.
    #[test]
    fn planes_are_those_of_their_points() {
        let points = [(0.0, 0.0), (2.0, 0.0), (0.0, 2.0), (2.0, 2.0)].map(|(x, y)| DVec3::new(x, y, 5.0 - x));
        let (point, normal) = plane_of(&points).unwrap();
        assert_eq!(point, DVec3::new(1.0, 1.0, 4.0));
        assert!((normal.dot(DVec3::new(1.0, 0.0, 1.0)).abs() - 2.0_f64.sqrt()).abs() < 1e-15);
        let line = [0.0, 1.0, 2.0].map(|x| DVec3::X * x);
        assert_eq!(plane_of(&line), None);
        let bent = [points[0], points[1], points[2], points[3] + DVec3::Z];
        assert_eq!(plane_of(&bent), None);
    }
}
