//! Volumes of sets of two bodies of which formulas state them.

use crate::models::{box_of_faces, cuboid, mesh, moved, placed, placed_all, prepared, stretched};
use nurbs_hausdorff::shapes::{self, shape};
use nurbs_hausdorff::{
    DQuat, DVec3, Engine, Model, OverlapOptions, OverlapResult, PreparedModel, RigidTransform, SurfaceArrays,
    VolumesUnknown,
};
use std::f64::consts::PI;

/// What the weights of arcs, rounded to float64, make of a volume at most, relative to it.
const OF_WEIGHTS: f64 = 1e-13;

pub(crate) fn overlap(a: &PreparedModel, b: &PreparedModel, tolerance: f64) -> OverlapResult {
    let options = OverlapOptions { tolerance: Some(tolerance), ..OverlapOptions::default() };
    Engine::cpu().overlap(a, b, &options).wait().unwrap()
}

pub(crate) fn moved_by(
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
pub(crate) fn assert_holds(found: &OverlapResult, volumes: [f64; 3], tolerance: f64) {
    let width = assert_sound(found, volumes);
    assert!(found.converged && width <= tolerance, "{width} wide: {found:?}");
}

pub(crate) fn ball(radius: f64, center: [f64; 3]) -> Model {
    let unit = placed(&shape("sphere").unwrap(), stretched([0.5 * radius; 3]));
    placed(&unit, moved(center))
}

pub(crate) fn ball_volume(radius: f64) -> f64 {
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

/// The origin of the cones is far from both bodies, so that their volumes cancel to few digits. The boxes decide.
#[test]
fn bodies_that_are_far_apart_have_nothing_in_common() {
    let near = prepared(&box_of_faces(DVec3::ZERO, DVec3::ONE));
    for x in [1.5, 1e3, 1e6] {
        let far = prepared(&box_of_faces(DVec3::new(x, 0.0, 0.0), DVec3::new(x + 1.0, 1.0, 1.0)));
        let common = overlap(&near, &far, 1e-3).volumes.unwrap().intersection;
        assert_eq!((common.lower, common.upper), (0.0, 0.0), "{x}");
    }
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
    assert_holds(&overlap(&unit, &beside, 1e-6), [1.0, 0.5 * 1.375, 0.0], 1e-6);
    // Within each other, on parts of three faces.
    let within = solid([0.0; 3], [0.5, 0.75, 0.25]);
    assert_holds(&overlap(&unit, &within, 1e-6), [1.0, 0.09375, 0.09375], 1e-6);
    // Crossing, with two planes in common.
    let across = solid([0.25, -0.5, 0.0], [0.75, 0.5, 1.0]);
    assert_holds(&overlap(&unit, &across, 1e-6), [1.0, 0.5, 0.25], 1e-6);
    // A body and its triangles.
    let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
    let found = overlap(&unit, &mesh(&vertices, &triangles), 1e-6);
    assert_holds(&found, [1.0; 3], 1e-6);
    assert!(found.ratio.unwrap().lower > 1.0 - 1e-5 && found.ratio.unwrap().upper == 1.0);
}

/// The plate from (−1, −1, 0) to (1, 1, 1) with a bore about an axis along z, in ruled faces.
pub(crate) fn bored_plate(center: [f64; 2], radius: f64) -> Model {
    let weight = 0.5_f64.sqrt();
    let row = |points: [[f64; 2]; 3], height: f64| {
        let weights = [1.0, weight, 1.0];
        points.into_iter().zip(weights).map(|([x, y], w)| [x, y, height, w]).collect::<Vec<_>>()
    };
    let ruled = |from: Vec<[f64; 4]>, to: Vec<[f64; 4]>| SurfaceArrays {
        degree: [1, 2],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]],
        counts: [2, 3],
        control_points: from.into_iter().chain(to).collect(),
    };
    let corners = [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
    let faces = corners.windows(2).flat_map(|ends| {
        let middle = [0, 1].map(|axis| 0.5 * (ends[0][axis] + ends[1][axis]));
        let side = [ends[0], middle, ends[1]];
        let on_circle = |direction: [f64; 2], reach: f64| {
            [0, 1].map(|axis| center[axis] + radius * reach * direction[axis])
        };
        // The tangents at 45 degrees to either side meet √2 away.
        let arc = [on_circle(ends[0], weight), on_circle(middle, 1.0 / weight), on_circle(ends[1], weight)];
        [
            ruled(row(arc, 1.0), row(side, 1.0)),
            ruled(row(side, 1.0), row(side, 0.0)),
            ruled(row(side, 0.0), row(arc, 0.0)),
            ruled(row(arc, 0.0), row(arc, 1.0)),
        ]
    });
    Model::from_arrays(None, faces.collect()).unwrap()
}

/// A plate with a bore, whose two revisions have the bore at different places and of different sizes.
#[test]
fn plates_that_lie_on_each_other_differ_by_their_bores() {
    let plate = |center: [f64; 2], radius: f64| prepared(&bored_plate(center, radius));
    let volume = |radius: f64| 4.0 - PI * radius * radius;
    let one = plate([0.0; 2], 0.25);
    // Within the other's bore, and beside it.
    let smaller = plate([0.0; 2], 0.125);
    let common = volume(0.25);
    assert_holds(&overlap(&one, &smaller, 1e-4), [volume(0.25), volume(0.125), common], 1e-4);
    let beside = plate([0.5, 0.25], 0.125);
    let common = volume(0.25) - PI * 0.125 * 0.125;
    assert_holds(&overlap(&one, &beside, 1e-4), [volume(0.25), volume(0.125), common], 1e-4);
    // Bores that cross.
    let across = plate([0.25, 0.0], 0.25);
    // Circles of radius r that are r apart have the area r² (2π/3 − √3/2) in common.
    let of_both = 0.0625 * (2.0 * PI / 3.0 - 0.5 * 3.0_f64.sqrt());
    let common = 4.0 - (2.0 * PI * 0.0625 - of_both);
    assert_holds(&overlap(&one, &across, 1e-4), [volume(0.25), volume(0.25), common], 1e-4);
}

/// Four times as many pieces leave a tenth of the width: boundaries that cross are planes but for a second order.
#[test]
fn the_width_falls_as_the_square_of_the_number_of_pieces() {
    let (a, b) = (prepared(&ball(1.0, [0.0; 3])), prepared(&ball(1.0, [0.7, 0.1, 0.3])));
    let distance = DVec3::new(0.7, 0.1, 0.3).length();
    let expected = [ball_volume(1.0), ball_volume(1.0), lens([1.0; 2], distance)];
    let widths = [1000, 4000, 16_000].map(|max_cells| {
        let options =
            OverlapOptions { tolerance: Some(1e-9), max_cells: Some(max_cells), ..OverlapOptions::default() };
        assert_sound(&Engine::cpu().overlap(&a, &b, &options).wait().unwrap(), expected)
    });
    assert!(widths.is_sorted_by(|a, b| *a > 10.0 * b), "{widths:?}");
}

/// Curved faces on each other that are divided in different ways: no piece is decided until they are moved apart.
#[test]
fn curved_faces_on_each_other_are_told_apart() {
    let long = prepared(&shapes::cylinder(1.0, 4.0).unwrap());
    let short = prepared(&shapes::cylinder(1.0, 2.0).unwrap());
    assert_holds(&overlap(&long, &short, 1e-2), [4.0 * PI, 2.0 * PI, 2.0 * PI], 1e-2);
}
