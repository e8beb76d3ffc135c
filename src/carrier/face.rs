//! The plane, sphere, cylinder, cone or torus that a face lies on.

use super::{Carrier, Kind, MAX_CONTROLS};
use crate::bezier::{BezierModel, Patch, extract};
use crate::interval::Interval;
use crate::model::{Model, NurbsSurface};
use crate::rounding::{gamma, lower_min, unit, upper_max};
use glam::{DVec3, Vec4Swizzles};
use serde::Serialize;

/// The part of a surface's size by which it may leave its form: nets written with seven digits pass.
const ON_FORM: f64 = 1e-6;

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
    /// A circular cone.
    Cone {
        /// The apex.
        point: [f64; 3],
        /// The axis' direction from the apex to the face, of length 1.
        direction: [f64; 3],
        /// The angle between the axis and the lines of the cone, in degrees.
        half_angle: f64,
        /// An upper bound on the distances of the face's points from the cone, both nappes of it: behind the apex, points
        /// are near the other one.
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
    /// tori whose tube is wider than their circle, and surfaces whose patches have more than 100 control points.
    ///
    /// A form is stated if the surface leaves it by at most a millionth of its size. Lemmas C4 to C6 of
    /// docs/clearance.md bound how far it does; a plane is bounded by the control points' hull. The corners and the middle
    /// of each patch are evaluated, and a form that does not hold one of them is not stated. O(p⁴ q⁴) a patch.
    #[must_use]
    pub fn of(surface: &NurbsSurface) -> Option<Self> {
        let whole = Model::new(None, vec![surface.clone()]).ok()?;
        let BezierModel { patches, point_error, .. } = extract(&whole);
        let surface =
            Surface { patches: patches.iter().map(Points::new).collect(), error: point_error.after(0) };
        let form = surface.plane().or_else(|| surface.round())?;
        surface.samples().all(|point| form.holds(point)).then_some(form)
    }

    /// Returns whether the distance of a point is among those that are stated; false for NaN.
    fn holds(&self, at: DVec3) -> bool {
        let from = |point: &[f64; 3]| at - DVec3::from_array(*point);
        let parts = |point: &[f64; 3], direction: &[f64; 3]| {
            let axis = DVec3::from_array(*direction);
            [from(point).dot(axis), from(point).cross(axis).length()]
        };
        match self {
            Self::Plane { point, direction, deviation } => parts(point, direction)[0].abs() <= *deviation,
            Self::Sphere { point, radius } => radius.contains(from(point).length()),
            Self::Cylinder { point, direction, radius } => radius.contains(parts(point, direction)[1]),
            Self::Cone { point, direction, half_angle, deviation } => {
                let ([up, out], (sin, cos)) = (parts(point, direction), half_angle.to_radians().sin_cos());
                (cos * out - sin * up).abs() <= *deviation
            }
            Self::Torus { point, direction, major_radius, radius } => {
                let [up, out] = parts(point, direction);
                radius.contains(up.hypot(out - major_radius))
            }
        }
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

    /// Returns the corners and the middle of each patch, by its formula.
    fn samples(&self) -> impl Iterator<Item = DVec3> {
        let places = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [0.5, 0.5]];
        self.patches.iter().flat_map(move |of| places.map(|at| of.patch.point(at)))
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
        let rounding = gamma(FORM_ROUNDINGS) * (self.reach(carrier.center) + carrier.center.length());
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
mod tests;
