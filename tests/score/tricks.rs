//! The tricks by which a candidate looks better than it is, each with what it costs.

use super::{AREA, SIZE, are, cuboid, deeper, holds, models, score, speck, together, truth, with_thresholds};
use crate::plate::Plate;
use nurbs_hausdorff::shapes::sphere;
use nurbs_hausdorff::trim::FaceArrays;
use nurbs_hausdorff::{DVec3, Model, PreparedModel, Score, ScoreOptions};
use nurbs_hausdorff_cad::from_step;
use std::f64::consts::PI;

/// A number that is 1 or 0.
fn is_valid(found: &Score, expected: f64) {
    holds(found.candidate.valid, expected, 1e-15);
}

/// The plate of the README, with its bores here.
fn plate<const BORES: usize>(bores: [f64; BORES]) -> PreparedModel {
    let plate = Plate { size: [80.0, 50.0, 8.0], bores: bores.map(|x| ("bore", x)), radius: 9.0 };
    PreparedModel::new(&from_step(plate.step().as_bytes()).unwrap().0).unwrap()
}

#[test]
fn the_truth_itself_has_the_best_score() {
    let found = score(&truth(), &truth(), &with_thresholds(&[0.05, 0.1]));
    are(&found, [0.0; 3], [0.0; 3]);
    is_valid(&found, 1.0);
    for ratio in [found.volume.unwrap().ratio, found.area.unwrap().ratio] {
        holds(ratio, 1.0, 1e-5);
    }
    holds(found.centroid_distance.unwrap(), 0.0, 1e-9);
    holds(found.iou.unwrap(), 1.0, 1e-3);
    holds(found.candidate.volume.unwrap(), 24.0, 1e-9);
    let at = found.thresholds[1];
    for part in [at.precision, at.recall, at.f1] {
        holds(part, 1.0, 1e-9);
    }
}

/// Inflated depth.
#[test]
fn a_deeper_box_has_the_distances_of_the_formula() {
    let h = 0.5;
    let deep = models::prepared(&cuboid([0.0; 3], [2.0, 3.0, 4.0 + h]));
    let t = 0.2;
    let found = score(&deep, &truth(), &with_thresholds(&[t, 2.0 * h]));
    let (there, back) = deeper(h);
    are(&found, there, back);
    let precision = 1.0 - (6.0 + 10.0 * (h - t)) / (AREA + 10.0 * h);
    let recall = 1.0 - (2.0 - 2.0 * t) * (3.0 - 2.0 * t) / AREA;
    let at = found.thresholds[0];
    holds(at.precision, precision, 2e-3);
    holds(at.recall, recall, 2e-3);
    holds(at.f1, 2.0 * precision * recall / (precision + recall), 4e-3);
    holds(found.thresholds[1].f1, 1.0, 2e-3);
    holds(found.volume.unwrap().ratio, 4.0 / (4.0 + h), 1e-9);
    holds(found.volume.unwrap().difference, 6.0 * h, 1e-8);
    // Sides lie on sides of other patches.
    holds(found.iou.unwrap(), 4.0 / (4.0 + h), 2.2e-3);
    holds(found.area.unwrap().ratio, AREA / (AREA + 10.0 * h), 1e-5);
    holds(found.centroid_distance.unwrap(), h / 2.0, 1e-8);
    for (difference, expected) in found.extent_differences.into_iter().zip([0.0, 0.0, h]) {
        holds(difference, expected, 1e-8);
    }
    is_valid(&found, 1.0);
}

#[test]
fn balls_about_one_middle_have_one_distance() {
    let [one, other] = [1.5_f64, 1.0].map(|radius| models::prepared(&sphere(DVec3::ZERO, radius).unwrap()));
    let found = score(&one, &other, &with_thresholds(&[0.25, 0.75]));
    are(&found, [0.5, 0.25, 0.5], [0.5, 0.25, 0.5]);
    holds(found.volume.unwrap().ratio, 1.5_f64.powi(-3), 1e-4);
    holds(found.iou.unwrap(), 1.5_f64.powi(-3), 2e-3);
    holds(found.area.unwrap().ratio, 1.5_f64.powi(-2), 1e-4);
    // Nothing is within the first threshold, and all within the second.
    for (at, expected) in found.thresholds.iter().zip([0.0, 1.0]) {
        for part in [at.precision, at.recall, at.f1] {
            holds(part, expected, 2e-3);
        }
    }
}

/// A floating speck outside, and the part mirrored.
#[test]
fn a_speck_outside_and_a_mirrored_part_have_the_distances_of_the_formula() {
    let (s, g) = (0.25, 0.5);
    let cube = cuboid([SIZE[0] + g, 0.5, 0.75], [s; 3]);
    let with_speck = |whole: &Model| together(&[whole, &cube]);
    let whole = cuboid([0.0; 3], SIZE);
    let candidate = with_speck(&whole);
    let found = score(&candidate, &truth(), &with_thresholds(&[0.1]));
    are(&found, speck(s, g), [0.0; 3]);
    assert_eq!((found.candidate.bodies, found.truth.bodies), (2, 1));
    let volume = 24.0 + s.powi(3);
    holds(found.volume.unwrap().ratio, 24.0 / volume, 1e-9);
    let area = AREA + 6.0 * s * s;
    holds(found.thresholds[0].precision, AREA / area, 2e-3);
    holds(found.thresholds[0].recall, 1.0, 2e-3);
    // Mirrored at the plane x = 1, which maps the box to itself: both specks are as far from the box.
    let mirror = [-1.0, 0.0, 0.0, 2.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let both = [(&whole, mirror), (&cube, mirror)];
    let mirrored = models::prepared(&models::placed_all(&both));
    let found = score(&mirrored, &candidate, &with_thresholds(&[0.1]));
    are(&found, speck(s, g), speck(s, g));
    is_valid(&found, 1.0);
    holds(found.iou.unwrap(), 24.0 / (volume + s.powi(3)), 1e-2);
    let apart = 2.0 * (SIZE[0] / 2.0 + g + s / 2.0);
    holds(found.centroid_distance.unwrap(), apart * s.powi(3) / volume, 1e-8);
    holds(found.thresholds[0].f1, AREA / area, 2e-3);
}

/// The same body twice: distances see nothing, counts do.
#[test]
fn a_body_twice_is_not_valid_and_has_half_the_ratios() {
    let whole = cuboid([0.0; 3], SIZE);
    let found = score(&together(&[&whole, &whole]), &truth(), &with_thresholds(&[0.1]));
    are(&found, [0.0; 3], [0.0; 3]);
    is_valid(&found, 0.0);
    assert_eq!((found.candidate.duplicates, found.candidate.bodies), (6, 2));
    holds(found.volume.unwrap().ratio, 0.5, 1e-9);
    holds(found.area.unwrap().ratio, 0.5, 1e-6);
    let (corners, triangles) = models::cuboid(DVec3::ZERO, DVec3::from_array(SIZE));
    let mesh = models::mesh(&corners, &[triangles.clone(), triangles].concat());
    let found = score(&mesh, &truth(), &with_thresholds(&[0.1]));
    is_valid(&found, 0.0);
    assert_eq!(found.candidate.duplicates, 12);
}

/// Both bodies have the face at x = 2 with the same surface, and one of them has it reversed.
#[test]
fn bodies_that_lie_flush_are_valid() {
    let [left, right] = [[0.0; 3], [SIZE[0], 0.0, 0.0]].map(|corner| models::faces(&cuboid(corner, SIZE)));
    let mut beside = right;
    let common = left[5].clone();
    beside[4] = FaceArrays { reversed: true, ..common };
    let both = together(&[&models::of(left), &models::of(beside)]);
    let found = score(&both, &both, &with_thresholds(&[0.1]));
    assert_eq!((found.candidate.duplicates, found.candidate.bodies), (0, 2));
    is_valid(&found, 1.0);
}

/// A pocket that is deeper than the cube is high: its floor is outside.
#[test]
fn a_body_that_meets_itself_is_not_valid() {
    for (depth, overlaps) in [(9.9, 0), (12.0, 1)] {
        let model = models::prepared(&models::of_quads(&models::cube_with_pocket(depth)));
        let found = score(&model, &model, &with_thresholds(&[0.1]));
        is_valid(&found, if overlaps > 0 { 0.0 } else { 1.0 });
        assert_eq!(found.candidate.self_overlaps, overlaps);
        assert!(found.candidate.closed && found.candidate.duplicates == 0);
    }
}

/// A shell without its end: the end's points are at their distances from its rim, 7/3 together.
#[test]
fn an_open_shell_is_not_valid_and_has_no_volume() {
    let mut faces = models::faces(&cuboid([0.0; 3], SIZE));
    let is_end = |face: &FaceArrays| face.surface.control_points.iter().all(|point| point[2] == SIZE[2]);
    faces.retain(|face| !is_end(face));
    assert_eq!(faces.len(), 5);
    let found = score(&models::prepared(&models::of(faces)), &truth(), &with_thresholds(&[0.1]));
    are(&found, [0.0; 3], [7.0 / 3.0 / AREA, mean_square_to_rim() / AREA, 1.0]);
    is_valid(&found, 0.0);
    assert!(!found.candidate.closed && found.candidate.sheets == 1);
    assert_eq!((found.candidate.volume, found.volume), (None, None));
    assert!(found.truth.volume.is_some());
}

/// The integral of r² over the end, whose part with r > t is (2 − 2t)(3 − 2t): ∫ 2t (2 − 2t)(3 − 2t) dt.
fn mean_square_to_rim() -> f64 {
    6.0 - 20.0 / 3.0 + 2.0
}

/// A face turned over.
#[test]
fn a_face_against_the_others_is_not_valid() {
    let mut faces = models::faces(&cuboid([0.0; 3], SIZE));
    let surface = &mut faces[0].surface;
    surface.control_points = [0, 2, 1, 3].map(|index| surface.control_points[index]).to_vec();
    let found = score(&models::prepared(&models::of(faces)), &truth(), &with_thresholds(&[0.1]));
    is_valid(&found, 0.0);
    assert_eq!((found.candidate.closed, found.candidate.oriented), (true, Some(false)));
    are(&found, [0.0; 3], [0.0; 3]);
}

/// A bore that is filled: there, the discs are at their distances from the rim; back, the wall at its
/// distances from the ends.
#[test]
fn a_filled_bore_has_the_distances_of_the_formula() {
    let (radius, height) = (9.0, 8.0);
    let (whole, filled) = (plate([20.0, 60.0]), plate([20.0]));
    let faces = 2.0 * 80.0 * 50.0 + 2.0 * 130.0 * height;
    let bore = |count: f64| count * (2.0 * PI * radius * height - 2.0 * PI * radius * radius);
    let wall = 2.0 * PI * radius * height;
    let discs = 2.0 * PI * radius * radius;
    let options = ScoreOptions { limit: Some(0.1), ..ScoreOptions::default() };
    let found = score(&filled, &whole, &options);
    are(
        &found,
        [radius / 3.0, radius * radius / 6.0, radius]
            .map(|of| of * discs / (faces + bore(1.0)))
            .with_last(radius),
        [height / 4.0, height * height / 12.0, 0.0]
            .map(|of| of * wall / (faces + bore(2.0)))
            .with_last(height / 2.0),
    );
    let volume = |count: f64| (80.0 * 50.0 - count * PI * radius * radius) * height;
    holds(found.volume.unwrap().ratio, volume(2.0) / volume(1.0), 1e-3);
    let changed = found.faces.unwrap();
    assert_eq!((changed.changed_of_candidate, changed.changed_of_truth), ([2, 7], [1, 8]));
    let found = score(&whole, &filled, &ScoreOptions::default());
    assert!(found.hausdorff.unwrap().forward.contains(height / 2.0));
}

trait WithLast {
    fn with_last(self, last: f64) -> Self;
}

impl WithLast for [f64; 3] {
    fn with_last(mut self, last: f64) -> Self {
        self[2] = last;
        self
    }
}

/// A bore that moved by 0.3 of a diagonal of 95: a threshold of 1 % of the diagonal does not see it, the
/// Hausdorff distance and a threshold of 0.1 do.
#[test]
fn a_bore_that_moved_is_seen() {
    let (whole, moved) = (plate([20.0, 60.0]), plate([20.0, 60.3]));
    let options =
        ScoreOptions { thresholds: vec![0.1], relative_thresholds: vec![0.01], ..with_thresholds(&[]) };
    let found = score(&moved, &whole, &options);
    let distance = found.hausdorff.unwrap().distance;
    holds(distance, 0.3, found.tolerance * 1.01);
    let [fine, coarse] = [found.thresholds[0], found.thresholds[1]];
    holds(coarse.f1, 1.0, 1e-9);
    // Of the wall, |cos| < 1/3 is within 0.1, but for the rims, which are within 0.1 of the ends.
    let wall = 2.0 * PI * 9.0 * 8.0;
    let faces = 2.0 * 80.0 * 50.0 + 2.0 * 130.0 * 8.0 + 2.0 * (wall - 2.0 * PI * 81.0);
    let within = 2.0 * (1.0_f64 / 3.0).asin() / PI;
    let most = 1.0 - (1.0 - within) * wall * (1.0 - 0.2 / 8.0) / faces;
    let least = most - 2.0 * 0.3 * 18.0 / faces - 0.2 / 8.0 * wall / faces;
    for part in [fine.precision, fine.recall] {
        assert!(part.lower < most + 1e-3 && part.upper > least - 1e-3, "{part:?} {least} {most}");
        assert!(part.upper < 1.0, "{part:?}");
    }
    assert!(found.chamfer.unwrap().lower > 0.0);
    holds(found.centroid_distance.unwrap(), moved_centroid(0.3), 0.03);
}

/// The distance of the centroids: of a bore's volume that moved, over that of the plate.
fn moved_centroid(by: f64) -> f64 {
    let bore = PI * 81.0;
    by * bore / (80.0 * 50.0 - 2.0 * bore)
}
