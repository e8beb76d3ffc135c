//! Facts of bodies of which formulas state them.

use crate::models::{box_of_faces, cuboid, faces, mesh, moved, of, placed, placed_all, prepared, stretched};
use nurbs_hausdorff::shapes::{self, shape};
use nurbs_hausdorff::{DQuat, DVec3, Facts, Interval, Model, PreparedModel, VolumeUnknown};
use std::f64::consts::PI;

/// The widths that are aimed at where weights are equal and where not, relative to the size.
const EQUAL_WEIGHTS: f64 = 1e-10;
const RATIONAL: f64 = 1e-8;

/// What the weights of arcs, rounded to float64, make of a quantity at most, relative to it.
const OF_WEIGHTS: f64 = 1e-14;

fn assert_holds(found: Interval, expected: f64, size: f64, width: f64, what: &str) {
    let off = OF_WEIGHTS * size;
    assert!(
        found.lower - off <= expected && expected <= found.upper + off,
        "{what}: {found:?} without {expected}"
    );
    assert!(found.width() <= width * size, "{what}: {found:?} is {} wide", found.width());
}

/// What a body is to have, at density 1.
struct Expected {
    volume: f64,
    centroid: [f64; 3],
    /// About the centroid: xx, yy, zz.
    inertia: [f64; 3],
    extents: [f64; 3],
}

fn assert_facts(found: &Facts, expected: &Expected, width: f64) {
    let size = expected.extents.into_iter().fold(0.0, f64::max);
    assert_holds(found.volume.unwrap(), expected.volume, expected.volume, width, "volume");
    let (centroid, inertia) = (found.centroid.unwrap(), found.inertia.unwrap());
    for axis in 0..3 {
        assert_holds(centroid[axis], expected.centroid[axis], size, width, "centroid");
        assert_holds(found.extents[axis], expected.extents[axis], size, 1e-9, "extent");
        for (other, found) in inertia[axis].into_iter().enumerate() {
            let entry = if axis == other { expected.inertia[axis] } else { 0.0 };
            assert_holds(found, entry, expected.volume * size * size, width, "inertia");
        }
    }
    let mut moments = expected.inertia;
    moments.sort_by(f64::total_cmp);
    for (found, moment) in found.principal_moments.unwrap().iter().zip(moments) {
        assert_holds(*found, moment, expected.volume * size * size, 4.0 * width, "moment");
    }
}

fn assert_body(model: &PreparedModel, expected: &Expected, width: f64) {
    assert_eq!(model.bodies().len(), 1);
    assert_facts(model.facts(), expected, width);
    assert_facts(model.body_facts().next().unwrap(), expected, width);
}

fn cuboid_facts(min: DVec3, max: DVec3) -> Expected {
    let [a, b, c] = (max - min).to_array();
    let volume = a * b * c;
    let inertia = [b * b + c * c, a * a + c * c, a * a + b * b].map(|sum| volume / 12.0 * sum);
    Expected { volume, centroid: (0.5 * (min + max)).to_array(), inertia, extents: [a, b, c] }
}

fn ball_facts(radius: f64) -> Expected {
    let volume = 4.0 / 3.0 * PI * radius.powi(3);
    Expected {
        volume,
        centroid: [0.0; 3],
        inertia: [0.4 * volume * radius * radius; 3],
        extents: [2.0 * radius; 3],
    }
}

#[test]
fn a_box_of_faces_and_of_triangles() {
    let (min, max) = (DVec3::new(-1.0, 2.0, 0.5), DVec3::new(3.0, 5.0, 2.5));
    let expected = cuboid_facts(min, max);
    assert_body(&prepared(&box_of_faces(min, max)), &expected, EQUAL_WEIGHTS);
    let (vertices, triangles) = cuboid(min, max);
    assert_body(&mesh(&vertices, &triangles), &expected, EQUAL_WEIGHTS);
    let of_triangles = mesh(&vertices, &triangles);
    assert_holds(of_triangles.facts().area.unwrap(), 52.0, 52.0, EQUAL_WEIGHTS, "area");
}

#[test]
fn a_ball_and_an_ellipsoid() {
    let ball = shape("sphere").unwrap();
    assert_body(&prepared(&ball), &ball_facts(2.0), RATIONAL);
    let [a, b, c] = [2.0, 3.0, 0.5];
    let ellipsoid = placed(&ball, stretched([1.0, 1.5, 0.25]));
    let volume = 4.0 / 3.0 * PI * a * b * c;
    let inertia = [b * b + c * c, a * a + c * c, a * a + b * b].map(|sum| volume / 5.0 * sum);
    let expected = Expected { volume, centroid: [0.0; 3], inertia, extents: [2.0 * a, 2.0 * b, 2.0 * c] };
    assert_body(&prepared(&ellipsoid), &expected, RATIONAL);
}

#[test]
fn a_torus_a_cylinder_and_a_cone() {
    let (large, small) = (2.0, 0.8);
    let volume = 2.0 * PI * PI * large * small * small;
    let across = volume * (0.5 * large * large + 0.625 * small * small);
    let inertia = [across, across, volume * (large * large + 0.75 * small * small)];
    let extents = [2.0 * (large + small), 2.0 * (large + small), 2.0 * small];
    let torus = Expected { volume, centroid: [0.0; 3], inertia, extents };
    assert_body(&prepared(&shapes::torus(large, small).unwrap()), &torus, RATIONAL);
    let (radius, height) = (1.5, 4.0);
    let volume = PI * radius * radius * height;
    let across = volume * (3.0 * radius * radius + height * height) / 12.0;
    let inertia = [across, across, 0.5 * volume * radius * radius];
    let extents = [2.0 * radius, 2.0 * radius, height];
    let cylinder = Expected { volume, centroid: [0.0; 3], inertia, extents };
    assert_body(&prepared(&shapes::cylinder(radius, height).unwrap()), &cylinder, RATIONAL);
    let volume = volume / 3.0;
    let across = volume * (0.15 * radius * radius + 0.0375 * height * height);
    let inertia = [across, across, 0.3 * volume * radius * radius];
    let cone = Expected { volume, centroid: [0.0, 0.0, -0.25 * height], inertia, extents };
    assert_body(&prepared(&shapes::cone(radius, height).unwrap()), &cone, RATIONAL);
}

/// Two revolved bodies, of which the control points of one are far from it: a torus of ±5.
#[test]
fn extents_are_those_of_the_body_and_not_of_its_control_points() {
    let torus = prepared(&shapes::torus(4.0, 1.0).unwrap());
    let turned = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -1.0).normalize(), 0.7);
    assert_holds(torus.facts().extents[0], 10.0, 10.0, 1e-9, "extent");
    let model = shapes::torus(4.0, 1.0).unwrap();
    let turned_model = prepared(&placed(&model, turned_matrix(turned)));
    // The torus is the circle of radius 4 about the axis n with a ball of radius 1: 2 (4 √(1 − n_x²) + 1).
    let axis = turned * DVec3::Z;
    for k in 0..3 {
        let expected = 2.0 * (4.0 * (1.0 - axis[k] * axis[k]).sqrt() + 1.0);
        assert_holds(turned_model.facts().extents[k], expected, 10.0, 1e-9, "extent");
    }
    let along_axes = turned_model.facts().principal_extents.unwrap();
    assert_holds(along_axes[2], 2.0, 10.0, 1e-7, "extent along the axis");
    let found = DVec3::from_array(turned_model.facts().principal_axes.unwrap()[2]);
    assert!(found.dot(axis).abs() > 1.0 - 1e-12);
    let angles = turned_model.facts().principal_angles.unwrap();
    assert!(angles[2] < 1e-7 && angles[0] > 1.57, "{angles:?}");
}

fn turned_matrix(rotation: DQuat) -> [f64; 12] {
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| rotation * axis);
    [x.x, y.x, z.x, 0.0, x.y, y.y, z.y, 0.0, x.z, y.z, z.z, 0.0]
}

/// A ball of radius 2 with a void of radius 1.5, and a ball of radius 1 in it.
#[test]
fn a_hollow_ball_with_a_ball_in_it_is_two_bodies() {
    let unit = placed(&shape("sphere").unwrap(), stretched([0.5; 3]));
    let scaled = |factor: f64| stretched([factor; 3]);
    let model = prepared(&placed_all(&[(&unit, scaled(1.5)), (&unit, scaled(1.0)), (&unit, scaled(2.0))]));
    let bodies = model.bodies();
    assert_eq!(bodies.iter().map(|body| body.faces.clone()).collect::<Vec<_>>(), [vec![1], vec![0, 2]]);
    assert_eq!(bodies.iter().map(|body| body.voids).collect::<Vec<_>>(), [0, 1]);
    let facts: Vec<&Facts> = model.body_facts().collect();
    assert_facts(facts[0], &ball_facts(1.0), RATIONAL);
    let [outer, void] = [2.0, 1.5].map(ball_facts);
    let volume = outer.volume - void.volume;
    let hollow = Expected { volume, inertia: [outer.inertia[0] - void.inertia[0]; 3], ..outer };
    assert_facts(facts[1], &hollow, RATIONAL);
    let volume = 4.0 / 3.0 * PI * (8.0 - 3.375 + 1.0);
    assert_holds(model.facts().volume.unwrap(), volume, volume, RATIONAL, "volume");
}

/// Moved, mirrored, small, large and far away.
#[test]
fn facts_hold_wherever_a_body_is() {
    let cone = shapes::cone(1.5, 4.0).unwrap();
    let volume = 3.0 * PI;
    for scale in [1e-6, 1.0, 1e6] {
        for mirror in [1.0, -1.0] {
            let scaled = placed(&cone, stretched([scale * mirror, scale, scale]));
            let found = prepared(&scaled);
            let expected = volume * scale.powi(3);
            assert_holds(found.facts().volume.unwrap(), expected, expected, RATIONAL, "volume");
            let centroid = found.facts().centroid.unwrap();
            assert_holds(centroid[2], -scale, 4.0 * scale, RATIONAL, "centroid");
        }
    }
    // A coordinate of 3e4 is off by 4e-12 in float64.
    let far = prepared(&placed(&cone, moved([1e4, -2e4, 3e4])));
    let facts = far.facts();
    assert_holds(facts.volume.unwrap(), volume, volume, RATIONAL, "volume");
    for (found, expected) in facts.centroid.unwrap().iter().zip([1e4, -2e4, 3e4 - 1.0]) {
        assert!(found.contains(expected) && found.width() < 1e-7, "{found:?} without {expected}");
    }
}

/// Faces of all signs of orientation have one volume.
#[test]
fn faces_that_are_turned_over_have_the_same_volume() {
    let cylinder = shapes::cylinder(1.5, 4.0).unwrap();
    let volume = 9.0 * PI;
    for turned in 0..8 {
        let mut faces = faces(&cylinder);
        for (index, face) in faces.iter_mut().enumerate() {
            if turned & (1 << index) == 0 {
                continue;
            }
            // The other order of u turns the surface over.
            let [rows, columns] = face.surface.counts;
            let points = &face.surface.control_points;
            face.surface.control_points =
                (0..rows).rev().flat_map(|row| points[row * columns..][..columns].to_vec()).collect();
            let knots = &face.surface.knots[0];
            let sum = knots[0] + knots[knots.len() - 1];
            face.surface.knots[0] = knots.iter().rev().map(|knot| sum - knot).collect();
        }
        let found = prepared(&of(faces));
        assert_holds(found.facts().volume.unwrap(), volume, volume, RATIONAL, "volume");
    }
}

#[test]
fn what_has_no_volume_says_why() {
    let why = |model: &Model| prepared(model).facts().volume_unknown;
    let mut open = faces(&shapes::cylinder(1.5, 4.0).unwrap());
    assert_eq!(why(&of(open.clone())), None);
    open.pop();
    assert_eq!(why(&of(open)), Some(VolumeUnknown::Open));
}
