//! Volumes of two bodies of which curved faces lie on each other or nearly so, in patches that are divided in different
//! ways.

use crate::models::{circle, moved, placed, placed_all, prepared, stretched};
use crate::overlap::{assert_holds, ball, ball_volume, bored_plate, moved_by, overlap};
use nurbs_hausdorff::{DQuat, DVec3, Model, OverlapResult, RigidTransform, SurfaceArrays, shapes};
use std::f64::consts::PI;

fn along_z(distance: f64) -> RigidTransform {
    RigidTransform::translation(DVec3::new(0.0, 0.0, distance)).unwrap()
}

fn turned(axis: DVec3, angle: f64) -> RigidTransform {
    RigidTransform::new(DQuat::from_axis_angle(axis, angle), DVec3::ZERO).unwrap()
}

/// Asserts that no more pieces were compared: about one and a half times as many as are today.
fn assert_few(found: &OverlapResult, most: usize) {
    assert!(found.cells <= most, "{} pieces, not {most}", found.cells);
}

#[test]
fn a_cylinder_slides_along_its_axis() {
    let cylinder = prepared(&shapes::cylinder(1.0, 2.0).unwrap());
    for distance in [0.3, 0.01, -1.75] {
        let found = moved_by(&cylinder, &cylinder, along_z(distance), 1e-3);
        let common = PI * (2.0 - distance.abs());
        assert_holds(&found, [2.0 * PI, 2.0 * PI, common], 1e-3);
        assert_few(&found, 2000);
    }
}

#[test]
fn a_bore_slides_along_its_axis() {
    let plate = prepared(&bored_plate([0.25, 0.0], 0.5));
    let area = 4.0 - 0.25 * PI;
    for distance in [0.25, 0.01] {
        let found = moved_by(&plate, &plate, along_z(distance), 1e-3);
        assert_holds(&found, [area, area, area * (1.0 - distance)], 1e-3);
        assert_few(&found, 10_000);
    }
}

#[test]
fn a_cylinder_turns_about_its_axis() {
    let cylinder = prepared(&shapes::cylinder(1.0, 2.0).unwrap());
    for angle in [0.0087, 0.5] {
        let found = moved_by(&cylinder, &cylinder, turned(DVec3::Z, angle), 1e-3);
        assert_holds(&found, [2.0 * PI; 3], 1e-3);
        assert_few(&found, 9000);
    }
}

#[test]
fn a_ball_turns_about_its_middle() {
    let model = prepared(&ball(1.0, [0.0; 3]));
    let axis = DVec3::new(0.6, 0.0, 0.8);
    for angle in [0.01, 1.1] {
        let found = moved_by(&model, &model, turned(axis, angle), 1e-3);
        assert_holds(&found, [ball_volume(1.0); 3], 1e-3);
        assert_few(&found, 17_000);
    }
}

/// A ball of radius 1 whose lower half is turned against the upper one, so that strips lie between both.
fn halves_turned_by(angle: f64) -> Model {
    let half = |up: f64| {
        let arc = [[1.0, 0.0, 1.0], [1.0, up, 0.5_f64.sqrt()], [0.0, up, 1.0]];
        let point = |[radius, height, weight]: [f64; 3], [x, y, _, w]: [f64; 4]| {
            [radius * x, radius * y, height, weight * w]
        };
        let rows = arc.map(|row| circle(1.0, 0.0).into_iter().map(|on| point(row, on)).collect::<Vec<_>>());
        let knots = vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0];
        let surface = SurfaceArrays {
            degree: [2, 2],
            knots: [vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], knots],
            counts: [3, 9],
            control_points: rows.concat(),
        };
        Model::from_arrays(None, vec![surface]).unwrap()
    };
    let (sine, cosine) = angle.sin_cos();
    let turn = [cosine, -sine, 0.0, 0.0, sine, cosine, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    placed_all(&[(&half(1.0), moved([0.0; 3])), (&half(-1.0), turn)])
}

/// Strips lie on the sphere, too, though the hulls of their control points do not.
#[test]
fn strips_that_lie_on_a_sphere_are_told_apart() {
    let [a, b] = [0.3, 0.7].map(|angle| prepared(&halves_turned_by(angle)));
    for angle in [0.4, 1.3] {
        let found = moved_by(&a, &b, turned(DVec3::X, angle), 1e-3);
        assert_holds(&found, [ball_volume(1.0); 3], 1e-3);
        assert_few(&found, 3000);
    }
}

/// An ellipsoid is a quadric, too.
#[test]
fn an_ellipsoid_turns_about_its_axis() {
    let stretch = stretched([0.5, 0.5, 1.0]);
    let model = prepared(&placed(&shapes::shape("sphere").unwrap(), stretch));
    let volume = ball_volume(1.0) * 2.0;
    let found = moved_by(&model, &model, turned(DVec3::Z, 0.3), 1e-3);
    assert_holds(&found, [volume; 3], 1e-3);
    assert_few(&found, 15_000);
}

#[test]
fn concentric_cylinders_are_told_apart() {
    let outer = prepared(&shapes::cylinder(1.001, 2.0).unwrap());
    let volume = |radius: f64, height: f64| PI * radius * radius * height;
    // Where an end is flush, or the inner one's side leaves the outer one, rims cross.
    for (height, most) in [(1.5, 550), (2.0, 6500), (2.5, 12_000)] {
        let inner = prepared(&placed(&shapes::cylinder(1.0, height).unwrap(), moved([0.0; 3])));
        let found = overlap(&inner, &outer, 1e-4);
        let common = volume(1.0, if height < 2.0 { height } else { 2.0 });
        assert_holds(&found, [volume(1.0, height), volume(1.001, 2.0), common], 1e-4);
        assert_few(&found, most);
    }
}

/// No quadric has more of a torus than a curve on it: carriers of pieces are near it to the third order.
#[test]
fn a_torus_turns_about_its_axis() {
    let torus = prepared(&shapes::torus(2.0, 0.5).unwrap());
    let volume = PI * PI;
    let found = moved_by(&torus, &torus, turned(DVec3::Z, 0.2), 1e-2);
    assert_holds(&found, [volume; 3], 1e-2);
    assert_few(&found, 70_000);
}
