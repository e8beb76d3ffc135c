//! Forms of surfaces whose radii and axes are known.

use super::*;
use crate::model::RigidTransform;
use crate::shapes::operations::transformed;
use crate::shapes::{cone, cylinder, shape, sphere, torus};
use glam::DQuat;

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
        let Some(FaceForm::Torus { point, major_radius, radius, .. }) = found else { panic!("{found:?}") };
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
                assert!((corner - DVec3::from_array(point)).dot(DVec3::from_array(direction)).abs() < 1e-12);
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
        assert!((half_angle - 0.5_f64.atan().to_degrees()).abs() < 1e-9 && deviation < 1e-6, "{half_angle}");
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

/// The audit of a form that is said to be a little smaller than it is.
#[test]
fn points_beyond_what_is_stated_are_not_held() {
    let at = [0.0; 3];
    let direction = [0.0, 0.0, 1.0];
    let radius = Interval { lower: 2.0, upper: 2.5 };
    let beyond = |form: FaceForm, inside: DVec3, outside: DVec3| {
        assert!(form.holds(inside) && !form.holds(outside) && !form.holds(DVec3::NAN), "{form:?}");
    };
    beyond(FaceForm::Sphere { point: at, radius }, 2.25 * DVec3::Y, 1.9 * DVec3::Y);
    beyond(FaceForm::Cylinder { point: at, direction, radius }, DVec3::new(2.25, 0.0, 9.0), 2.6 * DVec3::X);
    let ring = FaceForm::Torus { point: at, direction, major_radius: 5.0, radius };
    beyond(ring, DVec3::new(5.0, 0.0, 2.25), DVec3::new(5.0, 0.0, 2.6));
    beyond(FaceForm::Plane { point: at, direction, deviation: 0.1 }, 9.0 * DVec3::X, 0.2 * DVec3::Z);
    let cone = FaceForm::Cone { point: at, direction, half_angle: 45.0, deviation: 0.1 };
    beyond(cone, DVec3::new(1.0, 0.0, 1.1), DVec3::new(1.0, 0.0, 1.2));
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
