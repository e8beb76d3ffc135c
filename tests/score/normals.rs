//! Parts of areas with like counterparts, by formulas and by dense sampling.

use super::{AREA, SIZE, cuboid, holds, models, score, truth};
use nurbs_hausdorff::shapes::{cone, cylinder, sphere, torus};
use nurbs_hausdorff::tessellate::{TessellationOptions, tessellate};
use nurbs_hausdorff::{
    AtThreshold, DQuat, DVec3, Facets, Interval, Model, PointCloud, PreparedModel, RigidTransform,
    ScoreOptions,
};
use std::f64::consts::PI;

/// The permitted width, with what rounding of 2 P R / (P + R) and of P adds.
const WIDTH: f64 = 1.1e-3;

fn options(threshold: f64, normal_angle: f64) -> ScoreOptions {
    ScoreOptions { thresholds: vec![threshold], normal_angle, ..ScoreOptions::default() }
}

/// The motion that turns about an axis through a point.
fn turned(axis: DVec3, degrees: f64, about: DVec3) -> RigidTransform {
    let rotation = DQuat::from_axis_angle(axis.normalize(), degrees.to_radians());
    RigidTransform::new(rotation, about - rotation * about).unwrap()
}

fn at(candidate: &PreparedModel, truth: &PreparedModel, options: &ScoreOptions) -> AtThreshold {
    score(candidate, truth, options).thresholds[0]
}

/// Checks the parts of both areas and F1.
fn are(found: &AtThreshold, precision: f64, recall: f64) {
    let normals = found.normals.unwrap();
    holds(normals.normal_precision, precision, WIDTH);
    holds(normals.normal_recall, recall, WIDTH);
    let f1 = if precision * recall > 0.0 { 2.0 * precision * recall / (precision + recall) } else { 0.0 };
    holds(normals.normal_f1, f1, 2.0 * WIDTH);
    assert!(normals.normal_precision.upper <= found.precision.upper);
    assert!(normals.normal_recall.upper <= found.recall.upper);
}

/// The box of these lengths with a corner at the origin as exact faces and as triangles.
fn both_kinds(size: [f64; 3]) -> [PreparedModel; 2] {
    let (corners, triangles) = models::cuboid(DVec3::ZERO, DVec3::from_array(size));
    [models::prepared(&cuboid([0.0; 3], size)), models::mesh(&corners, &triangles)]
}

/// Of an upright sheet all points are near a stack of lids, and within the box about an oblique sheet that begins at its
/// edge. Only those are alike whose height over that is at most the threshold: t / sin 20° from the edge.
#[test]
fn oblique_faces_are_told_from_what_is_in_their_boxes() {
    let (turn, t) = (20.0_f64.to_radians(), 0.25);
    let quad = |corners: [[f64; 3]; 4]| corners.map(DVec3::from_array);
    let sheet = |[x, y]: [f64; 2]| quad([[0.0, 0.0, 0.0], [x, y, 0.0], [x, y, 4.0], [0.0, 0.0, 4.0]]);
    let lid = |z: f64| quad([[-0.5, -0.5, z], [1.5, -0.5, z], [1.5, 3.5, z], [-0.5, 3.5, z]]);
    let lids = (0..=10).map(|k| lid(0.4 * f64::from(k)));
    let quads: Vec<models::Quad> = lids.chain([sheet([3.0 * turn.sin(), 3.0 * turn.cos()])]).collect();
    let upright = models::prepared(&models::of_quads(&[sheet([0.0, 3.0])]));
    let found = at(&upright, &models::prepared(&models::of_quads(&quads)), &options(t, 30.0));
    holds(found.precision, 1.0, WIDTH);
    holds(found.normals.unwrap().normal_precision, t / turn.sin() / 3.0, WIDTH);
}

/// A sheet rises from a plane by 0.3 for each unit: a third of it is within 0.1 of the plane, and alike. Distances tell it
/// without halving along the line at 0.1 (lemma N7). An upright fin beside the sheet's end is near to a twentieth of it, and not
/// alike; without the plane's angle none is alike.
#[test]
fn distances_alone_divide_what_is_alike() {
    let quad = |corners: [[f64; 3]; 4]| corners.map(DVec3::from_array);
    let rising = |rise: f64| quad([[0.0, 0.0, 0.0], [1.0, 0.0, rise], [1.0, 1.0, rise], [0.0, 1.0, 0.0]]);
    let plane = quad([[-1.0, -1.0, 0.0], [2.0, -1.0, 0.0], [2.0, 2.0, 0.0], [-1.0, 2.0, 0.0]]);
    let fin = quad([[1.05, -1.0, 0.0], [1.05, 2.0, 0.0], [1.05, 2.0, 1.0], [1.05, -1.0, 1.0]]);
    let prepared = |quads: &[models::Quad]| models::prepared(&models::of_quads(quads));
    let sheet = prepared(&[rising(0.3)]);
    let narrow = ScoreOptions { part_tolerance: 1e-6, ..options(0.1, 30.0) };
    let found = at(&sheet, &prepared(&[plane]), &narrow);
    for part in [found.precision, found.normals.unwrap().normal_precision] {
        holds(part, 1.0 / 3.0, 1e-6);
    }
    let beside_fin = at(&sheet, &prepared(&[plane, fin]), &options(0.1, 30.0));
    holds(beside_fin.precision, 1.0 / 3.0 + 0.05, WIDTH);
    holds(beside_fin.normals.unwrap().normal_precision, 1.0 / 3.0, WIDTH);
    // From a fin that begins in the middle of the sheet, beyond the third, points are near that are near to nothing alike.
    let half_fin = quad([[0.36, 0.5, 0.0], [0.36, 2.0, 0.0], [0.36, 2.0, 1.0], [0.36, 0.5, 1.0]]);
    let crossed = at(&sheet, &prepared(&[plane, half_fin]), &options(0.1, 30.0));
    assert!(crossed.precision.lower > 1.0 / 3.0 + 0.05);
    holds(crossed.normals.unwrap().normal_precision, 1.0 / 3.0, WIDTH);
    let steeper = at(&prepared(&[rising(0.6)]), &prepared(&[plane]), &options(0.1, 30.0));
    holds(steeper.precision, 1.0 / 6.0, WIDTH);
    holds(steeper.normals.unwrap().normal_precision, 0.0, WIDTH);
}

/// Every point of a box is a like counterpart of itself, however narrow the angle and the threshold.
#[test]
fn the_truth_itself_is_alike_as_faces_and_as_triangles() {
    for candidate in &both_kinds(SIZE) {
        for truth in &both_kinds(SIZE) {
            for (threshold, angle) in [(0.1, 30.0), (0.02, 0.01), (0.1, 90.0)] {
                are(&at(candidate, truth, &options(threshold, angle)), 1.0, 1.0);
            }
        }
    }
}

/// Turned about z by δ the ends stay alike, and a side forms the angles δ and 90° − δ with the sides of the truth: all
/// is near.
#[test]
fn turned_boxes_have_the_angles_of_the_turn() {
    let middle = DVec3::new(1.0, 1.5, 2.0);
    let ends = 2.0 * SIZE[0] * SIZE[1] / AREA;
    for (degrees, angle, expected) in [
        (20.0, 20.01, 1.0),
        (40.0, 30.0, ends),
        (45.0, 44.99, ends),
        (70.0, 20.01, 1.0),
        // A side has no inside: upside down it is alike.
        (180.0, 1.0, 1.0),
    ] {
        let transform = turned(DVec3::Z, degrees, middle);
        for candidate in &both_kinds(SIZE) {
            for truth in &both_kinds(SIZE) {
                let options = ScoreOptions { transform, ..options(10.0, angle) };
                are(&at(candidate, truth, &options), expected, expected);
            }
        }
    }
}

/// The new end is beyond the threshold, and the strips of the sides are near where they are alike. The old end has
/// only the sides within its rim, at a right angle.
#[test]
fn the_rim_of_an_end_that_moved_is_near_and_not_alike() {
    let (h, t) = (0.5, 0.2);
    let precision = 1.0 - (6.0 + 10.0 * (h - t)) / (AREA + 10.0 * h);
    for deep in &both_kinds([2.0, 3.0, 4.0 + h]) {
        for truth in &both_kinds(SIZE) {
            let found = at(deep, truth, &options(t, 30.0));
            are(&found, precision, 1.0 - 6.0 / AREA);
            holds(found.recall, 1.0 - (2.0 - 2.0 * t) * (3.0 - 2.0 * t) / AREA, 2e-3);
            // Where all planes are alike the parts are those without normals.
            let right = at(deep, truth, &options(t, 90.0)).normals.unwrap();
            holds(right.normal_precision, precision, WIDTH);
            holds(right.normal_recall, 1.0 - (2.0 - 2.0 * t) * (3.0 - 2.0 * t) / AREA, WIDTH);
        }
    }
}

/// The points of a ball whose normal is within α of an axis are six caps of the height 1 − cos α. Of a side of the cube
/// the points within a distance of the cap below it are a disc: at ρ from its middle, beyond tan α, the nearest point
/// of the cap is its rim.
#[test]
fn a_ball_is_like_a_cube_in_six_caps() {
    let ball = models::prepared(&sphere(DVec3::ZERO, 1.0).unwrap());
    let cube = models::prepared(&cuboid([-1.0; 3], [2.0; 3]));
    let alpha = 30.0_f64.to_radians();
    let caps = 3.0 * (1.0 - alpha.cos());
    // Parts along the circles are halved as far as the budget goes.
    let wide = |threshold| ScoreOptions { max_cells: 10_000, ..options(threshold, 30.0) };
    let found = at(&ball, &cube, &wide(10.0)).normals.unwrap();
    holds(found.normal_precision, caps, 40.0 * WIDTH);
    holds(found.normal_recall, 1.0, 40.0 * WIDTH);
    let rho: f64 = 0.8;
    let threshold = (rho - alpha.sin()).hypot(1.0 - alpha.cos());
    let found = at(&ball, &cube, &wide(threshold)).normals.unwrap();
    holds(found.normal_precision, caps, 40.0 * WIDTH);
    holds(found.normal_recall, PI * rho * rho / 4.0, 40.0 * WIDTH);
}

/// Balls about one middle are alike within the difference of their radii, poles too.
#[test]
fn balls_about_one_middle_are_alike() {
    let [one, other] = [1.5_f64, 1.0].map(|radius| models::prepared(&sphere(DVec3::ZERO, radius).unwrap()));
    are(&at(&one, &other, &options(0.75, 30.0)), 1.0, 1.0);
    are(&at(&one, &other, &options(0.4, 30.0)), 0.0, 0.0);
}

/// A square turned about its middle line by just more or just less than the angle, either side up.
#[test]
fn sheets_have_no_side() {
    let square = |flipped: bool| {
        let [a, b, c, d] =
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
        models::prepared(&models::of_quads(&[if flipped { [d, c, b, a] } else { [a, b, c, d] }]))
    };
    for flipped in [false, true] {
        for (degrees, expected) in [(29.9, 1.0), (30.1, 0.0), (150.1, 1.0), (149.9, 0.0)] {
            let transform = turned(DVec3::X, degrees, DVec3::ZERO);
            let options = ScoreOptions { transform, ..options(3.0, 30.0) };
            are(&at(&square(flipped), &square(false), &options), expected, expected);
        }
    }
}

/// Neither answer is certain where the turn is the angle: the interval says so, and the score that it did not converge.
#[test]
fn a_turn_by_the_angle_itself_is_undecided() {
    let transform = turned(DVec3::Z, 30.0, DVec3::new(1.0, 1.5, 2.0));
    let options = ScoreOptions { transform, max_cells: 2000, ..options(10.0, 30.0) };
    let found = score(&truth(), &truth(), &options);
    let Interval { lower, upper } = found.thresholds[0].normals.unwrap().normal_precision;
    assert!(!found.converged && lower <= 12.0 / AREA && upper == 1.0, "{lower} {upper}");
}

#[test]
fn clouds_have_no_normals() {
    let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    let cloud = PreparedModel::of_facets(&Facets::Cloud(PointCloud::new(points).unwrap()), None).unwrap();
    for [one, other] in [[&cloud, &truth()], [&truth(), &cloud]] {
        assert!(at(one, other, &options(0.1, 30.0)).normals.is_none());
    }
}

/// A point of a surface with the normal there.
struct Sample {
    point: DVec3,
    normal: DVec3,
}

/// The number of points of a surface, and how many of them are compared with all of the other one.
const COUNT: usize = 20_000;
const COMPARED: usize = 1500;

/// Three standard deviations of a part of so many, and some.
const DEVIATION: f64 = 0.05;

/// Points of a display of a model, moved, drawn by area.
fn samples(model: &Model, transform: &RigidTransform, random: &mut fastrand::Rng) -> Vec<Sample> {
    let options = TessellationOptions { relative_tolerance: Some(6e-4), ..TessellationOptions::default() };
    let found = tessellate(model, &options).unwrap();
    let point = |index: u32| {
        let at = 3 * index as usize;
        let local = DVec3::from_array([0, 1, 2].map(|axis| f64::from(found.positions[at + axis])));
        transform.apply(found.origin + local)
    };
    let mut total = 0.0;
    let triangles: Vec<([DVec3; 3], f64)> = found
        .indices
        .chunks_exact(3)
        .map(|corners| {
            let corners = [corners[0], corners[1], corners[2]].map(point);
            total += (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
            (corners, total)
        })
        .collect();
    let mut sample = || {
        let place = total * random.f64();
        let ([a, b, c], _) = triangles[triangles.partition_point(|(_, upto)| *upto < place)];
        let (root, part) = (random.f64().sqrt(), random.f64());
        let point = a + (b - a) * (root * (1.0 - part)) + (c - a) * (root * part);
        Sample { point, normal: (b - a).cross(c - a).normalize() }
    };
    (0..COUNT).map(|_| sample()).collect()
}

/// The part of samples that have a like counterpart among others.
fn part(from: &[Sample], to: &[Sample], threshold: f64, degrees: f64) -> f64 {
    let least = degrees.to_radians().cos();
    let is_alike = |one: &&Sample| {
        to.iter().any(|other| {
            one.point.distance_squared(other.point) <= threshold * threshold
                && one.normal.dot(other.normal).abs() >= least
        })
    };
    from.iter().take(COMPARED).filter(is_alike).count() as f64 / COMPARED as f64
}

/// Samples are within this of every point, and their normals within this many degrees.
const SPACING: f64 = 0.06;
const TURN: f64 = 11.0;

/// The intervals against samples of generated shapes in random poses: with both limits wider the samples find at least
/// what is alike, and with both narrower at most that.
#[test]
fn intervals_hold_what_dense_samples_find() {
    let shapes = [
        cuboid([-0.6, -0.8, -1.0], [1.2, 1.6, 2.0]),
        sphere(DVec3::ZERO, 1.0).unwrap(),
        cylinder(0.8, 1.6).unwrap(),
        cone(0.9, 1.5).unwrap(),
        torus(0.9, 0.35).unwrap(),
    ];
    let prepared: Vec<PreparedModel> = shapes.iter().map(models::prepared).collect();
    let random = &mut fastrand::Rng::with_seed(41);
    let mut partial = 0;
    for round in 0..4 {
        let [one, other] = [round, random.usize(0..5)];
        let mut signed = || 2.0 * random.f64() - 1.0;
        let (axis, turn) = (DVec3::new(signed(), signed(), signed()), 180.0 * signed());
        let shift = DVec3::new(signed(), signed(), signed()) * 0.3;
        let rotation = DQuat::from_axis_angle(axis.normalize(), turn.to_radians());
        let transform = RigidTransform::new(rotation, shift).unwrap();
        let (threshold, angle) = (0.3 + 0.1 * random.f64(), 25.0 + 15.0 * random.f64());
        let options = ScoreOptions { transform, part_tolerance: 0.05, ..options(threshold, angle) };
        let found = at(&prepared[one], &prepared[other], &options).normals.unwrap();
        let a = samples(&shapes[one], &transform, random);
        let b = samples(&shapes[other], &RigidTransform::IDENTITY, random);
        for (interval, from, to) in [(found.normal_precision, &a, &b), (found.normal_recall, &b, &a)] {
            let most = part(from, to, threshold + SPACING, angle + TURN);
            let least = part(from, to, threshold - SPACING, angle - TURN);
            let Interval { lower, upper } = interval;
            let is_held = lower <= most + DEVIATION && least - DEVIATION <= upper;
            assert!(is_held, "{round} {interval:?} {least} {most}");
            assert!(interval.width() <= 0.1, "{round} {interval:?}");
            partial += usize::from(interval.lower > 0.05 && interval.upper < 0.95);
        }
    }
    assert!(partial >= 2, "{partial}");
}
