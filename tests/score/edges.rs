//! Parts of feature edges with counterparts, by formulas and by dense sampling.

use super::{SIZE, cuboid, holds, models, score, truth};
use crate::plate::Plate;
use nurbs_hausdorff::shapes::{cone, cylinder, sphere, torus};
use nurbs_hausdorff::{
    AtThreshold, DQuat, DVec3, Facets, Interval, Model, NurbsSurface, PointCloud, PreparedModel,
    RigidTransform, Score, ScoreOptions, SurfaceArrays,
};
use nurbs_hausdorff_cad::from_step;
use std::f64::consts::PI;

/// The permitted width, with that of rounding.
const WIDTH: f64 = 1.1e-3;

/// Options with few parts of areas, which are not looked at here; of edges they are many.
fn options(threshold: f64) -> ScoreOptions {
    ScoreOptions { thresholds: vec![threshold], max_cells: 4000, ..ScoreOptions::default() }
}

fn shifted(by: DVec3) -> RigidTransform {
    RigidTransform::translation(by).unwrap()
}

/// Checks both parts, F1 and both lengths.
fn are(found: &Score, [precision, recall]: [f64; 2], lengths: [f64; 2]) {
    let edges = found.thresholds[0].edges.unwrap();
    holds(edges.edge_precision, precision, WIDTH);
    holds(edges.edge_recall, recall, WIDTH);
    let f1 = if precision * recall > 0.0 { 2.0 * precision * recall / (precision + recall) } else { 0.0 };
    holds(edges.edge_f1, f1, 2.0 * WIDTH);
    let length = found.edge_length.unwrap();
    // None are at most a millionth of the diagonal.
    holds(length.candidate, lengths[0], WIDTH * lengths[0] + 1e-5);
    holds(length.truth, lengths[1], WIDTH * lengths[1] + 1e-5);
}

/// A box as exact faces and as triangles, whose diagonals are no features.
fn both_kinds(size: [f64; 3]) -> [PreparedModel; 2] {
    let (corners, triangles) = models::cuboid(DVec3::ZERO, DVec3::from_array(size));
    [models::prepared(&cuboid([0.0; 3], size)), models::mesh(&corners, &triangles)]
}

/// The sum of the lengths of the edges of a box.
fn edges_of([x, y, z]: [f64; 3]) -> f64 {
    4.0 * (x + y + z)
}

#[test]
fn the_edges_of_the_truth_itself_are_all_there() {
    for candidate in &both_kinds(SIZE) {
        for truth in &both_kinds(SIZE) {
            are(&score(candidate, truth, &options(0.01)), [1.0; 2], [edges_of(SIZE); 2]);
        }
    }
}

/// Deeper by h: the edges of the new end are beyond the threshold, and t of each side's; back, those of the old end are.
#[test]
fn a_deeper_box_has_the_edges_of_the_formula() {
    let (h, t) = (0.5, 0.2);
    let all = edges_of([2.0, 3.0, 4.0 + h]);
    for deep in &both_kinds([2.0, 3.0, 4.0 + h]) {
        for truth in &both_kinds(SIZE) {
            let found = score(deep, truth, &options(t));
            // The old end's edges are near those of the sides within t of their corners, on both sides of each.
            let recall = 1.0 - (10.0 - 8.0 * t) / edges_of(SIZE);
            are(&found, [1.0 - (10.0 + 4.0 * (h - t)) / all, recall], [all, edges_of(SIZE)]);
        }
    }
}

/// Moved by d along x, edges along x stay near but for what is beyond an end; the others are d from their own.
#[test]
fn moved_boxes_have_their_edges_along_the_motion() {
    let d = 0.3;
    for t in [0.1, 0.29, 0.31] {
        let options = ScoreOptions { transform: shifted(DVec3::X * d), ..options(t) };
        let found = score(&truth(), &truth(), &options);
        // Edges along x but what is beyond t of an end, and of the four others at the end within the other box t of
        // either end, where edges along x are near.
        let near = if t < d { 4.0 * (2.0 - d + t) + 8.0 * t } else { edges_of(SIZE) };
        are(&found, [near / edges_of(SIZE); 2], [edges_of(SIZE); 2]);
    }
}

/// A ball has no feature edges, and a cube twelve: nothing of either has a counterpart. Of none and none all has.
#[test]
fn a_ball_has_no_feature_edges() {
    let ball = models::prepared(&sphere(DVec3::ZERO, 1.0).unwrap());
    let ring = models::prepared(&torus(2.0, 0.5).unwrap());
    let cube = models::prepared(&cuboid([-1.0; 3], [2.0; 3]));
    are(&score(&ball, &cube, &options(0.1)), [0.0; 2], [0.0, 24.0]);
    are(&score(&cube, &ball, &options(0.1)), [0.0; 2], [24.0, 0.0]);
    are(&score(&ball, &ring, &options(0.1)), [1.0; 2], [0.0; 2]);
}

/// The rims of a cylinder, and the base of a cone, whose apex is a point; as exact surfaces.
#[test]
fn rims_are_feature_edges_and_seams_are_none() {
    let solid = models::prepared(&cylinder(0.8, 1.6).unwrap());
    let rims = 4.0 * PI * 0.8;
    are(&score(&solid, &solid, &options(0.01)), [1.0; 2], [rims; 2]);
    let pointed = models::prepared(&cone(0.8, 1.6).unwrap());
    let found = score(&pointed, &solid, &options(0.01));
    are(&found, [1.0, 0.5], [rims / 2.0, rims]);
    // A cone and its base turn by 180° less the angle between: atan 2 here.
    let turn = 180.0 - 2.0_f64.atan().to_degrees();
    for (feature_angle, length) in [(turn - 0.1, rims / 2.0), (turn + 0.1, 0.0)] {
        let options = ScoreOptions { feature_angle, ..options(0.01) };
        are(&score(&pointed, &pointed, &options), [1.0; 2], [length; 2]);
    }
}

/// A box turns by 90° at its edges; a sheet ends at its own, whatever the angle.
#[test]
fn the_angle_decides_and_free_edges_count_always() {
    for (feature_angle, length) in [(89.9, edges_of(SIZE)), (90.1, 0.0)] {
        for kind in &both_kinds(SIZE) {
            let options = ScoreOptions { feature_angle, ..options(0.01) };
            are(&score(kind, kind, &options), [1.0; 2], [length; 2]);
        }
    }
    let corner = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let flat = [corner(0.0, 0.0, 0.0), corner(2.0, 0.0, 0.0), corner(2.0, 1.0, 0.0), corner(0.0, 1.0, 0.0)];
    for flipped in [false, true] {
        // Folded at x = 2 by 40°, the second side either way round.
        let (sin, cos) = 40.0_f64.to_radians().sin_cos();
        let far = |y: f64| corner(2.0 + cos, y, sin);
        let side = [flat[1], far(0.0), far(1.0), flat[2]];
        let side = if flipped { [side[3], side[2], side[1], side[0]] } else { side };
        let folded = models::prepared(&models::of_quads(&[flat, side]));
        for (feature_angle, length) in [(39.9, 9.0), (40.1, 8.0), (139.9, 8.0)] {
            let options = ScoreOptions { feature_angle, ..options(0.01) };
            are(&score(&folded, &folded, &options), [1.0; 2], [length; 2]);
        }
    }
}

/// Along an edge of a box a chamfer of legs c: the old edge is c from the two new ones, at which it turns by 45°.
#[test]
fn a_chamfer_has_two_edges_for_one() {
    let c = 0.2;
    let [x, y, z] = SIZE;
    let profile = [[0.0, 0.0], [x, 0.0], [x, y - c], [x - c, y], [0.0, y]];
    let at = |[x, y]: [f64; 2], z: f64| DVec3::new(x, y, z);
    let sides = (0..5).map(|k| {
        let [a, b] = [profile[k], profile[(k + 1) % 5]];
        [at(a, 0.0), at(b, 0.0), at(b, z), at(a, z)]
    });
    let mut quads: Vec<models::Quad> = sides.collect();
    for z in [0.0, z] {
        let p = profile.map(|corner| at(corner, z));
        let middle = at([0.0, y - c], z);
        let two = [[p[0], p[1], p[2], middle], [middle, p[2], p[3], p[4]]];
        quads.extend(two.map(|[a, b, c, d]| if z > 0.0 { [a, b, c, d] } else { [d, c, b, a] }));
    }
    let chamfered = models::prepared(&models::of_quads(&quads));
    let slant = c * 2.0_f64.sqrt();
    // Four ends are shorter by c, two are slants, and there is one edge more along z.
    let length = edges_of(SIZE) + z - 4.0 * c + 2.0 * slant;
    let near = c / 2.0_f64.sqrt();
    // The old edge is c from each new one, and its ends are c / √2 from the slants' middles.
    let reach = |t: f64| (t * t - near * near).max(0.0).sqrt();
    for t in [0.08, 0.15] {
        let found = score(&chamfered, &truth(), &options(t));
        // New edges along z are c from the old one; t of each is near the ends' edges. Slants are near where an end's
        // edge is: within t √2 from either end.
        let slants = 2.0 * slant.min(2.0 * t * 2.0_f64.sqrt());
        let far_along = 2.0 * (z - 2.0 * t) + (2.0 * slant - slants);
        let old = z - 2.0 * reach(t);
        // Of the ends' edges c was cut off at either side, whose point at s from the old corner is (c − s) / √2 from the
        // slant.
        let cut = (c - t * 2.0_f64.sqrt()).max(0.0);
        let edges = found.thresholds[0].edges.unwrap();
        holds(edges.edge_precision, 1.0 - far_along / length, WIDTH);
        holds(edges.edge_recall, 1.0 - (old + 4.0 * cut) / edges_of(SIZE), WIDTH);
        holds(found.edge_length.unwrap().candidate, length, WIDTH * length);
    }
}

/// The rims of a bore of radius r that moved by d less than the threshold have counterparts; moved far, they have none
/// but where the circles cross.
#[test]
fn the_rims_of_a_bore_that_moved_follow_it() {
    let plate = |x: f64| {
        let plate = Plate { size: [80.0, 50.0, 8.0], bores: [("bore", x)], radius: 9.0 };
        PreparedModel::new(&from_step(plate.step().as_bytes()).unwrap().0).unwrap()
    };
    let (r, t) = (9.0_f64, 0.5);
    let all = edges_of([80.0, 50.0, 8.0]) + 2.0 * 2.0 * PI * r;
    let still = plate(40.0);
    are(&score(&plate(40.4), &still, &options(t)), [1.0; 2], [all; 2]);
    // A point of a circle at the angle φ is √(r² + d² + 2 r d cos φ) from the other middle, r ± t within the threshold.
    let d = 2.0;
    let cos = |distance: f64| (distance * distance - r * r - d * d) / (2.0 * r * d);
    let near = cos(r - t).acos() - cos(r + t).acos();
    let part = 1.0 - 2.0 * (2.0 * PI - 2.0 * near) * r / all;
    are(&score(&plate(42.0), &still, &options(t)), [part; 2], [all; 2]);
}

/// The plane faces are cut between the bores, along lines that touch all of them: the pieces have no normals there, and cuts
/// are no edges.
#[test]
fn cuts_of_a_face_are_no_edges() {
    let plate =
        Plate { size: [100.0, 50.0, 8.0], bores: [("a", 20.0), ("b", 50.0), ("c", 80.0)], radius: 9.0 };
    let plate = PreparedModel::new(&from_step(plate.step().as_bytes()).unwrap().0).unwrap();
    let all = edges_of([100.0, 50.0, 8.0]) + 6.0 * 2.0 * PI * 9.0;
    let found = score(&plate, &plate, &options(0.5));
    are(&found, [1.0; 2], [all; 2]);
}

/// The two ends of a closed face meet at a seam, which is a feature edge if they form an angle, and is not if they are
/// smooth there.
#[test]
fn seams_are_edges_where_they_are_sharp() {
    let height = 2.0;
    for (inner, sharp) in [([[3.0, 3.0], [-3.0, 3.0]], true), ([[3.0, 0.0], [-3.0, 0.0]], false)] {
        // A loop from the origin to itself; the tangents at its ends are those to the inner control points. The smooth one
        // has a point at its top between.
        let loop_of: Vec<[f64; 2]> = if sharp {
            vec![[0.0, 0.0], inner[0], inner[1], [0.0, 0.0]]
        } else {
            vec![[0.0, 0.0], inner[0], [0.0, 4.0], inner[1], [0.0, 0.0]]
        };
        let degree = loop_of.len() - 1;
        let surface = SurfaceArrays {
            degree: [degree, 1],
            knots: [[vec![0.0; degree + 1], vec![1.0; degree + 1]].concat(), vec![0.0, 0.0, 1.0, 1.0]],
            counts: [degree + 1, 2],
            control_points: loop_of
                .iter()
                .flat_map(|&[x, y]| [0.0, height].map(|z| [x, y, z, 1.0]))
                .collect(),
        };
        let tube = models::prepared(&Model::new(None, vec![NurbsSurface::new(0, surface).unwrap()]).unwrap());
        // The length of the loop, by small chords.
        let point = |t: f64| {
            let mut points: Vec<DVec3> = loop_of.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect();
            while points.len() > 1 {
                points = points.windows(2).map(|two| two[0].lerp(two[1], t)).collect();
            }
            points[0]
        };
        let chord = |k: u32| point(f64::from(k) / 4096.0).distance(point(f64::from(k + 1) / 4096.0));
        let rim: f64 = (0..4096).map(chord).sum();
        let all = 2.0 * rim + if sharp { height } else { 0.0 };
        are(&score(&tube, &tube, &options(0.01)), [1.0; 2], [all; 2]);
    }
}

#[test]
fn clouds_have_no_edges() {
    let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    let cloud = PreparedModel::of_facets(&Facets::Cloud(PointCloud::new(points).unwrap()), None).unwrap();
    let found = score(&cloud, &truth(), &options(0.1));
    assert!(found.thresholds[0].edges.is_none() && found.edge_length.is_none());
}

/// Points of the edges of a shape at even steps, with the lengths that they stand for.
fn samples(segments: &[[DVec3; 2]], circles: &[(f64, f64)], transform: &RigidTransform) -> Vec<(DVec3, f64)> {
    const STEPS: usize = 400;
    let at = |k: usize| (k as f64 + 0.5) / STEPS as f64;
    let mut found = Vec::new();
    for [a, b] in segments {
        found.extend((0..STEPS).map(|k| (a.lerp(*b, at(k)), a.distance(*b) / STEPS as f64)));
    }
    for &(radius, z) in circles {
        let point = |k: usize| {
            let (sin, cos) = (2.0 * PI * at(k)).sin_cos();
            DVec3::new(radius * cos, radius * sin, z)
        };
        found.extend((0..STEPS).map(|k| (point(k), 2.0 * PI * radius / STEPS as f64)));
    }
    found.into_iter().map(|(point, length)| (transform.apply(point), length)).collect()
}

fn part(from: &[(DVec3, f64)], to: &[(DVec3, f64)], threshold: f64) -> f64 {
    let is_near = |of: &&(DVec3, f64)| {
        to.iter().any(|(point, _)| of.0.distance_squared(*point) <= threshold * threshold)
    };
    let total: f64 = from.iter().map(|(_, length)| length).sum();
    from.iter().filter(is_near).map(|(_, length)| length).sum::<f64>() / total
}

/// A model with the straight edges and the rims, by radius and height, that it has.
type Known<'a> = (Model, &'a [[DVec3; 2]], &'a [(f64, f64)]);

/// The intervals against samples of the edges of boxes, cylinders and cones in random poses.
#[test]
fn intervals_hold_what_dense_samples_of_edges_find() {
    let (min, max) = (DVec3::new(-0.6, -0.7, -0.8), DVec3::new(0.6, 0.7, 0.8));
    let corner =
        |k: usize| DVec3::new([min.x, max.x][k & 1], [min.y, max.y][k >> 1 & 1], [min.z, max.z][k >> 2]);
    let of_box: Vec<[DVec3; 2]> = (0..8)
        .flat_map(|k| [1, 2, 4].into_iter().filter(move |bit| k & bit == 0).map(move |bit| [k, k | bit]))
        .map(|ends| ends.map(corner))
        .collect();
    let shapes: [Known<'_>; 3] = [
        (models::box_of_faces(min, max), &of_box, &[]),
        (cylinder(0.8, 1.6).unwrap(), &[], &[(0.8, -0.8), (0.8, 0.8)]),
        (cone(0.9, 1.5).unwrap(), &[], &[(0.9, -0.75)]),
    ];
    let random = &mut fastrand::Rng::with_seed(43);
    let mut partial = 0;
    for round in 0..6 {
        let [(one, lines, rims), (other, other_lines, other_rims)] =
            [&shapes[round % 3], &shapes[random.usize(0..3)]];
        let mut signed = || 2.0 * random.f64() - 1.0;
        let (axis, turn) = (DVec3::new(signed(), signed(), signed()), 180.0 * signed());
        let shift = DVec3::new(signed(), signed(), signed()) * 0.2;
        let rotation = DQuat::from_axis_angle(axis.normalize(), turn.to_radians());
        let transform = RigidTransform::new(rotation, shift).unwrap();
        let threshold = 0.2 + 0.2 * random.f64();
        let options = ScoreOptions { transform, ..options(threshold) };
        let at: AtThreshold = score(&models::prepared(one), &models::prepared(other), &options).thresholds[0];
        let found = at.edges.unwrap();
        let a = samples(lines, rims, &transform);
        let b = samples(other_lines, other_rims, &RigidTransform::IDENTITY);
        for (interval, from, to) in [(found.edge_precision, &a, &b), (found.edge_recall, &b, &a)] {
            let [least, most] = [-0.01, 0.01].map(|more| part(from, to, threshold + more));
            let Interval { lower, upper } = interval;
            assert!(lower <= most + 1e-3 && least - 1e-3 <= upper, "{round} {interval:?} {least} {most}");
            assert!(interval.width() <= WIDTH, "{round} {interval:?}");
            partial += usize::from(lower > 0.05 && upper < 0.95);
        }
    }
    assert!(partial >= 4, "{partial}");
}
