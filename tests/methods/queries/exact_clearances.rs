//! Clearances and overlaps that geometry gives in closed form: boxes, cylinders, spheres and tori,
//! turned, nested, touching and crossing.

use super::clearance::{assert_clearance, clearance, pose};
use super::solids::{cube, together};
use glam::DVec3;
use nurbs_hausdorff::shapes::{cylinder, sphere, torus};
use nurbs_hausdorff::{ClearanceOptions, Model, Overlap, OverlapUnknown, RigidTransform, SurfaceArrays};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

pub(super) fn boxed(half: f64) -> Model {
    Model::from_arrays(None, cube(half)).unwrap()
}

/// The same model elsewhere.
pub(super) fn moved(model: &Model, transform: &RigidTransform) -> Model {
    let mut arrays: Vec<_> = model.surfaces().iter().map(|surface| surface.clone().into_arrays()).collect();
    for control in arrays.iter_mut().flat_map(|surface| &mut surface.control_points) {
        let [x, y, z, w] = *control;
        let point = transform.apply(DVec3::new(x, y, z));
        *control = [point.x, point.y, point.z, w];
    }
    Model::from_arrays(None, arrays).unwrap()
}

fn overlap(a: &Model, b: &Model, transform: RigidTransform) -> Option<Overlap> {
    clearance(a, b, &ClearanceOptions { transform, ..ClearanceOptions::default() }).overlap
}

#[test]
fn boxes_apart_by_faces_edges_and_corners() {
    let (one, other) = (boxed(1.0), boxed(0.5));
    let straight = |offset: [f64; 3]| pose([0.0, 0.0, 1.0], 0.0, offset);
    assert_clearance("face to face", &other, &one, straight([1.75, 0.2, -0.1]), 0.25);
    assert_clearance("edge to edge", &other, &one, straight([1.8, 1.9, 0.0]), 0.5);
    assert_clearance("corner to corner", &other, &one, straight([2.5, 2.5, 2.0]), 1.5);
    // An edge, turned by 45°, toward a face.
    let edge = pose([0.0, 0.0, 1.0], FRAC_PI_4, [2.0, 0.0, 0.0]);
    assert_clearance("edge to face", &other, &one, edge, 1.0 - 0.5_f64.sqrt());
    // The corner (1, 1, 1) / 2, turned onto the x axis, toward a face.
    let axis = DVec3::ONE.cross(DVec3::X).to_array();
    let corner = pose(axis, (1.0 / 3.0_f64.sqrt()).acos(), [-2.0, 0.0, 0.0]);
    assert_clearance("corner to face", &other, &one, corner, 1.0 - 0.75_f64.sqrt());
    // Two edges at right angles, with their bisectors on one line.
    let crossed = moved(&other, &pose([0.0, 0.0, 1.0], FRAC_PI_4, [0.0; 3]));
    let turned = moved(&crossed, &pose([1.0, 0.0, 0.0], FRAC_PI_2, [0.0; 3]));
    assert_clearance("crossed edges", &turned, &crossed, straight([2.0, 0.0, 0.0]), 2.0 - 2.0_f64.sqrt());
}

#[test]
fn boxes_nested_touching_and_crossing() {
    let (one, other) = (boxed(1.0), boxed(0.5));
    let at = |x: f64, turn: f64| pose([0.0, 0.0, 1.0], turn, [x, 0.0, 0.0]);
    assert_clearance("nested", &other, &one, at(0.2, 0.0), 0.3);
    assert_clearance("nested and turned", &other, &one, at(0.0, FRAC_PI_4), 1.0 - 0.5_f64.sqrt());
    assert_clearance("face on face", &other, &one, at(1.5, 0.0), 0.0);
    assert_clearance("edge on face", &other, &one, at(1.0 + 0.5_f64.sqrt(), FRAC_PI_4), 0.0);
    assert_clearance("crossing", &other, &one, at(1.2, 0.3), 0.0);
    assert!(matches!(overlap(&other, &one, at(0.2, 0.0)), Some(Overlap::Contained { .. })));
    assert!(matches!(overlap(&one, &other, at(0.2, 0.0)), Some(Overlap::Contained { .. })));
    assert_eq!(overlap(&other, &one, at(1.5, 0.0)), Some(Overlap::Touching));
    assert!(matches!(overlap(&other, &one, at(1.2, 0.3)), Some(Overlap::Intersecting { .. })));
    assert_eq!(overlap(&other, &one, at(1.6, 0.0)), Some(Overlap::None));
}

/// Their lateral surfaces are equally far apart along a line, or over an area.
#[test]
fn cylinders_beside_crossed_and_in_each_other() {
    let (thick, thin) = (cylinder(1.0, 6.0).unwrap(), cylinder(0.25, 4.0).unwrap());
    assert_clearance("beside", &thin, &thick, pose([0.0, 0.0, 1.0], 0.4, [2.0, 0.0, 0.5]), 0.75);
    assert_clearance("crossed", &thin, &thick, pose([0.0, 1.0, 0.0], FRAC_PI_2, [0.0, 2.0, 0.5]), 0.75);
    assert_clearance("coaxial", &thin, &thick, pose([0.0, 0.0, 1.0], 0.4, [0.0, 0.0, 0.3]), 0.7);
    let shaft = cylinder(0.9, 4.0).unwrap();
    assert_clearance("a shaft", &shaft, &thick, pose([0.0, 0.0, 1.0], 0.7, [0.0; 3]), 0.1);
    assert_clearance("off its axis", &shaft, &thick, pose([0.0, 0.0, 1.0], 0.7, [0.06, 0.0, 0.0]), 0.04);
    let bored = pose([0.3, -1.0, 0.4], 1.1, [5.0, -2.0, 1.0]);
    let [shaft, thick] = [&shaft, &thick].map(|model| moved(model, &bored));
    assert_clearance("a turned shaft", &shaft, &thick, RigidTransform::IDENTITY, 0.1);
}

#[test]
fn concentric_spheres_are_their_radii_apart() {
    let (one, other) = (sphere(DVec3::ZERO, 1.0).unwrap(), sphere(DVec3::ZERO, 0.75).unwrap());
    assert_clearance("concentric", &other, &one, pose([0.3, -1.0, 0.4], 1.1, [0.0; 3]), 0.25);
    let far = DVec3::new(3.0, -2.0, 1.0);
    let [one, other] = [1.0, 0.75].map(|radius| sphere(far, radius).unwrap());
    assert_clearance("off the origin", &other, &one, RigidTransform::IDENTITY, 0.25);
}

/// The lateral surface of a part of a cone about z whose half angle has the sine 0.6 and the cosine 0.8, of this radius
/// at z = 0.
fn lateral_of_cone(radius: f64, height: f64) -> Model {
    let mut lateral = cylinder(1.0, height).unwrap().surfaces()[0].clone().into_arrays();
    for [x, y, z, _] in &mut lateral.control_points {
        let radius = radius + 0.75 * *z;
        (*x, *y) = (*x * radius, *y * radius);
    }
    Model::from_arrays(None, vec![lateral]).unwrap()
}

/// Radii that differ by 0.225 at one height are 0.8 times that apart along the normal.
#[test]
fn coaxial_cones_of_one_angle_are_the_distance_of_their_lines_apart() {
    let (outer, inner) = (lateral_of_cone(5.0, 6.0), lateral_of_cone(4.775, 2.0));
    assert_clearance("a cone in a cone", &inner, &outer, pose([0.0, 0.0, 1.0], 0.9, [0.0; 3]), 0.18);
    // Along the axis by the way that brings them into one, but for a ninth.
    let along = pose([0.0, 0.0, 1.0], 0.9, [0.0, 0.0, -0.3 * 8.0 / 9.0]);
    assert_clearance("along the axis", &inner, &outer, along, 0.02);
    let bored = pose([0.3, -1.0, 0.4], 1.1, [5.0, -2.0, 1.0]);
    let [inner, outer] = [&inner, &outer].map(|model| moved(model, &bored));
    assert_clearance("turned cones", &inner, &outer, RigidTransform::IDENTITY, 0.18);
}

#[test]
fn tori_about_one_circle_are_their_tubes_apart() {
    let (thick, thin) = (torus(2.0, 0.5).unwrap(), torus(2.0, 0.3).unwrap());
    assert_clearance("in a torus", &thin, &thick, pose([0.0, 0.0, 1.0], 0.7, [0.0; 3]), 0.2);
    assert_clearance("off its centre", &thin, &thick, pose([0.0, 0.0, 1.0], 0.7, [0.0, 0.0, 0.05]), 0.15);
}

#[test]
fn tori_touch_and_cross() {
    let torus = torus(2.0, 0.5).unwrap();
    let beside = |x: f64| pose([0.0, 0.0, 1.0], 0.7, [x, 0.0, 0.0]);
    assert_clearance("touching", &torus, &torus, beside(5.0), 0.0);
    assert_clearance("crossing", &torus, &torus, beside(4.6), 0.0);
    assert!(matches!(overlap(&torus, &torus, beside(4.6)), Some(Overlap::Intersecting { .. })));
    // Linked rings are outside each other.
    let linked = pose([1.0, 0.0, 0.0], FRAC_PI_2, [1.5, 0.0, 0.0]);
    assert_eq!(overlap(&torus, &torus, linked), Some(Overlap::None));
}

/// OCCT#1123: of four cylinders through a body, another program finds positive distances.
#[test]
fn cylinders_through_a_body_intersect_it() {
    let body = boxed(1.0);
    let at = |x: f64, y: f64, tilt: f64| {
        moved(&cylinder(0.2, 5.0).unwrap(), &pose([0.0, 1.0, 0.0], tilt, [x, y, 0.1]))
    };
    let pins = [at(0.5, 0.5, 0.0), at(-0.5, 0.5, 0.1), at(0.5, -0.5, -0.2), at(-0.5, -0.5, 0.05)];
    let all = together(&pins.each_ref());
    for (name, pin) in ["first", "second", "third", "fourth", "all"].iter().zip(pins.iter().chain([&all])) {
        for turn in [0.0, 0.37] {
            let transform = pose([0.2, 0.1, 1.0], turn, [0.01, 0.0, 0.0]);
            let result =
                clearance(pin, &body, &ClearanceOptions { transform, ..ClearanceOptions::default() });
            assert!(result.lower == 0.0 && result.upper <= result.tolerance, "{name}: {}", result.upper);
            let Some(Overlap::Intersecting { inside_both }) = result.overlap else {
                panic!("{name}: {:?}", result.overlap)
            };
            assert!(inside_both.iter().all(|coordinate| coordinate.abs() < 1.0), "{name}: {inside_both:?}");
            let limit = Some(0.0);
            let decided =
                clearance(pin, &body, &ClearanceOptions { transform, limit, ..ClearanceOptions::default() });
            assert_eq!(decided.at_least, Some(false), "{name}");
        }
    }
}

/// Two boxes that have a face each in one surface, which jumps from one to the other: one of them
/// is far off, the other in a larger box.
#[test]
fn bodies_that_share_a_surface_each_have_a_side() {
    let far = pose([0.0, 0.0, 1.0], 0.0, [10.0, 0.0, 0.0]);
    let arrays = |model: &Model| -> Vec<_> {
        model.surfaces().iter().map(|surface| surface.clone().into_arrays()).collect()
    };
    let (near, away) = (arrays(&boxed(0.5)), arrays(&moved(&boxed(0.5), &far)));
    let jump = vec![0.0, 0.0, 1.0, 1.0, 2.0, 2.0];
    for is_near_first in [true, false] {
        let [one, two] = if is_near_first { [&near, &away] } else { [&away, &near] };
        let mut shared = one[4].clone();
        shared.knots[0] = jump.clone();
        shared.counts[0] = 4;
        shared.control_points.extend(&two[4].control_points);
        let rest = |faces: &[SurfaceArrays]| [&faces[..4], &faces[5..]].concat();
        for faces in [[vec![shared.clone()], rest(one), rest(two)], [rest(one), rest(two), vec![shared]]] {
            let both = Model::from_arrays(None, faces.concat()).unwrap();
            let found = overlap(&both, &boxed(1.0), RigidTransform::IDENTITY);
            let Some(Overlap::Contained { inside_both }) = found else { panic!("{found:?}") };
            assert!(inside_both.iter().all(|coordinate| coordinate.abs() < 0.5 - 1e-9), "{inside_both:?}");
            let apart = pose([0.0, 0.0, 1.0], 0.0, [0.0, 5.0, 0.0]);
            assert_eq!(overlap(&both, &boxed(1.0), apart), Some(Overlap::None));
        }
    }
}

/// A limit of 0 asks whether solids are apart; for those that touch it stays open.
#[test]
fn at_least_0_means_apart() {
    let (one, other) = (boxed(1.0), boxed(0.5));
    for (x, expected) in [(1.6, Some(true)), (1.5, None), (1.4, Some(false)), (0.1, Some(false))] {
        let transform = pose([0.0, 0.0, 1.0], 0.0, [x, 0.0, 0.0]);
        let options = ClearanceOptions { transform, limit: Some(0.0), ..ClearanceOptions::default() };
        assert_eq!(clearance(&other, &one, &options).at_least, expected, "{x}");
    }
}

/// Two bodies whose cracks are together as wide as the distance between them are not said to be
/// apart: the strips that close the cracks may meet.
#[test]
fn solids_nearer_than_both_their_cracks_are_not_apart() {
    let cracked = |crack: f64| {
        let mut faces = cube(1.0);
        for control in &mut faces[1].control_points {
            control[0] += crack;
        }
        Model::from_arrays(None, faces).unwrap()
    };
    let crack = 1e-5;
    let one = cracked(crack);
    let opposite = moved(&one, &pose([0.0, 0.0, 1.0], std::f64::consts::PI, [0.0; 3]));
    let apart = |distance: f64| pose([0.0, 0.0, 1.0], 0.0, [2.0 + 2.0 * crack + distance, 0.0, 0.0]);
    let options = |distance: f64| ClearanceOptions {
        transform: apart(distance),
        tolerance: Some(1e-9),
        ..ClearanceOptions::default()
    };
    let far = clearance(&opposite, &one, &options(20.0 * crack));
    assert_eq!(far.overlap, Some(Overlap::None));
    // The strips at corners are within a crack of their faces' points.
    let apart = clearance(&opposite, &one, &options(2.5 * crack));
    assert_eq!(apart.overlap, Some(Overlap::None));
    let near = clearance(&opposite, &one, &options(1.5 * crack));
    assert!(near.lower > 1.4 * crack && near.overlap.is_none(), "{near:?}");
    assert_eq!(near.overlap_unknown, Some(OverlapUnknown::Cracks));
}
