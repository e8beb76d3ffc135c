//! Volumes of sets of two bodies of which formulas state them.

use crate::models::{box_of_faces, cuboid, mesh, moved, placed, placed_all, prepared, stretched};
use nurbs_hausdorff::shapes::{self, shape};
use nurbs_hausdorff::{
    DQuat, DVec3, Engine, Model, OverlapOptions, OverlapResult, PreparedModel, RigidTransform, VolumesUnknown,
};
use std::f64::consts::PI;

/// What the weights of arcs, rounded to float64, make of a volume at most, relative to it.
const OF_WEIGHTS: f64 = 1e-13;

fn overlap(a: &PreparedModel, b: &PreparedModel, tolerance: f64) -> OverlapResult {
    let options = OverlapOptions { tolerance: Some(tolerance), ..OverlapOptions::default() };
    Engine::cpu().overlap(a, b, &options).wait().unwrap()
}

fn moved_by(
    a: &PreparedModel,
    b: &PreparedModel,
    transform: RigidTransform,
    tolerance: f64,
) -> OverlapResult {
    let options = OverlapOptions { transform, tolerance: Some(tolerance), ..OverlapOptions::default() };
    Engine::cpu().overlap(a, b, &options).wait().unwrap()
}

/// Asserts that the intervals contain the volumes of A, B and their intersection, and returns the width of the latter,
/// relative to the union.
fn assert_sound(found: &OverlapResult, [a, b, common]: [f64; 3]) -> f64 {
    let volumes = found.volumes.unwrap();
    let union = a + b - common;
    let expected = [
        (volumes.intersection, common),
        (volumes.union, union),
        (volumes.only_a, a - common),
        (volumes.only_b, b - common),
    ];
    for (found, expected) in expected {
        let off = OF_WEIGHTS * union;
        assert!(
            found.lower - off <= expected && expected <= found.upper + off,
            "{found:?} without {expected}"
        );
    }
    let ratio = found.ratio.unwrap();
    let off = OF_WEIGHTS;
    assert!(ratio.lower - off <= common / union && common / union <= ratio.upper + off, "{ratio:?}");
    volumes.intersection.width() / union
}

/// As [`assert_sound`], and that the width is the one asked for.
fn assert_holds(found: &OverlapResult, volumes: [f64; 3], tolerance: f64) {
    let width = assert_sound(found, volumes);
    assert!(found.converged && width <= tolerance, "{width} wide: {found:?}");
}

fn ball(radius: f64, center: [f64; 3]) -> Model {
    let unit = placed(&shape("sphere").unwrap(), stretched([0.5 * radius; 3]));
    placed(&unit, moved(center))
}

fn ball_volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3)
}

/// The lens of two balls whose centres are d apart.
fn lens([r, s]: [f64; 2], d: f64) -> f64 {
    let reach = r + s - d;
    PI * reach * reach * (d * d + 2.0 * d * (r + s) - 3.0 * (r - s) * (r - s)) / (12.0 * d)
}

#[test]
fn two_balls_have_a_lens_in_common() {
    for (radii, distance) in [([1.0, 1.0], 0.7), ([2.0, 1.5], 2.5), ([1.0, 3.0], 3.9)] {
        let a = prepared(&ball(radii[0], [0.0; 3]));
        let along = distance * DVec3::new(2.0, -1.0, 2.0) / 3.0;
        let b = prepared(&ball(radii[1], along.to_array()));
        let expected = [ball_volume(radii[0]), ball_volume(radii[1]), lens(radii, distance)];
        assert_holds(&overlap(&a, &b, 1e-3), expected, 1e-3);
        // The same by a motion of A, turned.
        let turn = DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 1.1);
        let still = prepared(&ball(radii[1], [0.0; 3]));
        let found = moved_by(&a, &still, RigidTransform::new(turn, -along).unwrap(), 1e-2);
        assert_holds(&found, expected, 1e-2);
    }
}

#[test]
fn bodies_within_and_beside_each_other_take_no_width() {
    let (small, large) = (prepared(&ball(1.0, [0.5, 0.0, 0.0])), prepared(&ball(2.0, [0.0; 3])));
    let [inner, outer] = [1.0, 2.0].map(ball_volume);
    assert_holds(&overlap(&small, &large, 1e-7), [inner, outer, inner], 1e-7);
    assert_holds(&overlap(&large, &small, 1e-7), [outer, inner, inner], 1e-7);
    let far = prepared(&ball(1.0, [3.5, 0.0, 0.0]));
    let found = overlap(&large, &far, 1e-7);
    assert_holds(&found, [outer, inner, 0.0], 1e-7);
    assert_eq!(found.volumes.unwrap().intersection.lower, 0.0);
}

#[test]
fn a_body_and_itself_have_the_ratio_1() {
    for model in
        [ball(1.5, [1.0, 2.0, 3.0]), shapes::cylinder(1.0, 3.0).unwrap(), shapes::torus(2.0, 0.5).unwrap()]
    {
        let (a, b) = (prepared(&model), prepared(&model));
        let volume = a.facts().volume.unwrap().middle();
        let found = overlap(&a, &b, 1e-3);
        assert!(assert_sound(&found, [volume; 3]) < 1e-8);
        assert!(found.ratio.unwrap().lower > 1.0 - 1e-7 && found.ratio.unwrap().upper == 1.0, "{found:?}");
        assert!(found.volumes.unwrap().only_a.upper < 1e-7 * volume);
    }
}

#[test]
fn boxes_of_faces_and_of_triangles_cross() {
    let (one, other) =
        ([DVec3::ZERO, DVec3::new(2.0, 3.0, 1.0)], [DVec3::new(1.25, 0.5, -0.5), DVec3::new(4.0, 2.0, 0.75)]);
    let expected = [6.0, 2.75 * 1.5 * 1.25, 0.75 * 1.5 * 0.75];
    let faces = [one, other].map(|[min, max]| prepared(&box_of_faces(min, max)));
    let triangles = [one, other].map(|[min, max]| {
        let (vertices, triangles) = cuboid(min, max);
        mesh(&vertices, &triangles)
    });
    assert_holds(&overlap(&faces[0], &faces[1], 1e-3), expected, 1e-3);
    assert_holds(&overlap(&triangles[0], &faces[1], 1e-3), expected, 1e-3);
    assert_holds(&overlap(&triangles[0], &triangles[1], 1e-3), expected, 1e-3);
}

/// Two cylinders of one radius across each other, and a ball about a cylinder's end.
#[test]
fn cylinders_cross_in_a_solid_of_steinmetz() {
    let (radius, height) = (1.0, 6.0);
    let cylinder = prepared(&shapes::cylinder(radius, height).unwrap());
    let turn = DQuat::from_axis_angle(DVec3::X, 0.5 * PI);
    let volume = PI * radius * radius * height;
    let found = moved_by(&cylinder, &cylinder, RigidTransform::new(turn, DVec3::ZERO).unwrap(), 1e-2);
    assert_holds(&found, [volume, volume, 16.0 / 3.0], 1e-2);
    // Half of a ball that lies about the middle of an end.
    let ball = prepared(&ball(0.5, [0.0, 0.0, 0.5 * height]));
    let whole = ball_volume(0.5);
    assert_holds(&overlap(&cylinder, &ball, 1e-3), [volume, whole, 0.5 * whole], 1e-3);
}

/// A hollow ball, whose void the second one fills in part.
#[test]
fn a_void_is_no_part_of_its_body() {
    let hollow = prepared(&placed_all(&[
        (&ball(2.0, [0.0; 3]), moved([0.0; 3])),
        (&ball(1.0, [0.0; 3]), moved([0.0; 3])),
    ]));
    assert_eq!(hollow.bodies().len(), 1);
    let own = ball_volume(2.0) - ball_volume(1.0);
    let within = prepared(&ball(0.5, [0.25, 0.0, 0.0]));
    assert_holds(&overlap(&hollow, &within, 1e-6), [own, ball_volume(0.5), 0.0], 1e-6);
    let across = prepared(&ball(0.75, [1.5, 0.0, 0.0]));
    let common = lens([2.0, 0.75], 1.5) - lens([1.0, 0.75], 1.5);
    assert_holds(&overlap(&hollow, &across, 1e-3), [own, ball_volume(0.75), common], 1e-3);
}

/// Bodies of one model that are apart count together.
#[test]
fn a_model_of_two_bodies_overlaps_a_third_one() {
    let two = prepared(&placed_all(&[
        (&ball(1.0, [-1.5, 0.0, 0.0]), moved([0.0; 3])),
        (&ball(1.0, [1.5, 0.0, 0.0]), moved([0.0; 3])),
    ]));
    let third = prepared(&ball(1.0, [0.0; 3]));
    let expected = [2.0 * ball_volume(1.0), ball_volume(1.0), 2.0 * lens([1.0; 2], 1.5)];
    assert_holds(&overlap(&two, &third, 1e-3), expected, 1e-3);
}

#[test]
fn the_common_volume_falls_as_bodies_part() {
    let a = prepared(&ball(1.0, [0.0; 3]));
    let mut last = f64::INFINITY;
    for step in 0..7 {
        let shift = DVec3::new(0.2 + 0.25 * f64::from(step), 0.05, -0.1);
        let found = moved_by(&a, &a, RigidTransform::translation(shift).unwrap(), 1e-2);
        let common = found.volumes.unwrap().intersection;
        assert!(common.upper < last, "{step}: {common:?} after {last}");
        last = common.lower;
    }
}

#[test]
fn what_has_no_volume_is_said() {
    let ball = prepared(&ball(1.0, [0.0; 3]));
    let sheet = prepared(&shape("saddle").unwrap_or_else(|_| shapes::figure5_plane().unwrap()));
    let why = |a: &PreparedModel, b: &PreparedModel| overlap(a, b, 1e-3).volumes_unknown;
    assert_eq!(why(&sheet, &ball), Some(VolumesUnknown::AOpen));
    assert_eq!(why(&ball, &sheet), Some(VolumesUnknown::BOpen));
    assert_eq!(why(&sheet, &sheet), Some(VolumesUnknown::BothOpen));
    let both = prepared(&placed_all(&[
        (&shape("sphere").unwrap(), moved([0.0; 3])),
        (&shape("sphere").unwrap(), moved([1.0, 0.0, 0.0])),
    ]));
    assert_eq!(why(&both, &ball), Some(VolumesUnknown::ABodies));
    assert_eq!(why(&ball, &both), Some(VolumesUnknown::BBodies));
    assert_eq!(why(&ball, &ball), None);
}

#[test]
fn budgets_and_options() {
    let (a, b) = (prepared(&ball(1.0, [0.0; 3])), prepared(&ball(1.0, [0.7, 0.1, 0.0])));
    let expected = [ball_volume(1.0), ball_volume(1.0), lens([1.0; 2], 0.5_f64.sqrt())];
    let widths = [10, 1000, 10_000].map(|max_cells| {
        let options =
            OverlapOptions { tolerance: Some(1e-6), max_cells: Some(max_cells), ..OverlapOptions::default() };
        let found = Engine::cpu().overlap(&a, &b, &options).wait().unwrap();
        assert!(!found.converged && found.stop == nurbs_hausdorff::result::Stop::Cells, "{found:?}");
        assert_sound(&found, expected)
    });
    assert!(widths.is_sorted_by(|a, b| a > b), "{widths:?}");
    for tolerance in [0.0, -1.0, f64::NAN] {
        let options = OverlapOptions { tolerance: Some(tolerance), ..OverlapOptions::default() };
        let refused = Engine::cpu().overlap(&a, &b, &options).wait();
        assert_eq!(refused.map_err(|error| error.code()).err(), Some("OPTION_OUT_OF_RANGE"));
    }
}

/// Bodies that lie on each other in plane faces that are divided in different ways.
#[test]
fn faces_that_are_flush_are_decided() {
    let solid = |min: [f64; 3], max: [f64; 3]| {
        prepared(&box_of_faces(DVec3::from_array(min), DVec3::from_array(max)))
    };
    let unit = solid([0.0; 3], [1.0; 3]);
    // Beside each other, on a part of a face.
    let beside = solid([1.0, 0.25, 0.125], [2.0, 0.75, 1.5]);
    assert_holds(&overlap(&unit, &beside, 5e-3), [1.0, 0.5 * 1.375, 0.0], 5e-3);
    // Within each other, on parts of three faces.
    let within = solid([0.0; 3], [0.5, 0.75, 0.25]);
    assert_holds(&overlap(&unit, &within, 2e-2), [1.0, 0.09375, 0.09375], 2e-2);
    // Crossing, with two planes in common.
    let across = solid([0.25, -0.5, 0.0], [0.75, 0.5, 1.0]);
    assert_holds(&overlap(&unit, &across, 2e-2), [1.0, 0.5, 0.25], 2e-2);
    // A body and its triangles.
    let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
    let found = overlap(&unit, &mesh(&vertices, &triangles), 5e-2);
    assert_holds(&found, [1.0; 3], 5e-2);
    assert!(found.ratio.unwrap().lower > 0.9 && found.ratio.unwrap().upper == 1.0);
}

/// Curved faces on each other that are divided in different ways: the interval is wide, and the search ends.
#[test]
fn curved_faces_on_each_other_end_the_search() {
    let long = prepared(&shapes::cylinder(1.0, 4.0).unwrap());
    let short = prepared(&shapes::cylinder(1.0, 2.0).unwrap());
    let found = overlap(&long, &short, 1e-3);
    assert_sound(&found, [4.0 * PI, 2.0 * PI, 2.0 * PI]);
    assert!(found.cells < 100_000, "{}", found.cells);
}
