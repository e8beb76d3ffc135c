//! Numbers that follow the size of an edit: larger edits never score better.

use super::{cuboid, holds, models, score, speck, together, truth, with_thresholds};
use nurbs_hausdorff::{Interval, PreparedModel, Score};

/// The numbers that fall with the quality.
fn lengths(found: &Score) -> [Interval; 5] {
    let [x, y, z] = found.extent_differences;
    let extents = Interval { lower: x.lower + y.lower + z.lower, upper: x.upper + y.upper + z.upper };
    [
        found.chamfer.unwrap(),
        found.chamfer_squared.unwrap(),
        found.hausdorff.unwrap().distance,
        found.centroid_distance.unwrap(),
        extents,
    ]
}

/// The numbers that rise with it.
fn parts(found: &Score) -> [Interval; 3] {
    [found.thresholds[0].f1, found.volume.unwrap().ratio, found.area.unwrap().ratio]
}

/// Checks that each score is certainly worse than the one before.
fn fall(scores: &[Score]) {
    for pair in scores.windows(2) {
        for (before, after) in lengths(&pair[0]).into_iter().zip(lengths(&pair[1])) {
            assert_eq!(before.is_below(&after), Some(true), "{before:?} {after:?}");
        }
        for (before, after) in parts(&pair[0]).into_iter().zip(parts(&pair[1])) {
            assert_eq!(after.is_below(&before), Some(true), "{before:?} {after:?}");
        }
    }
}

fn scored(edit: impl Fn(f64) -> PreparedModel, sizes: &[f64]) -> Vec<Score> {
    sizes.iter().map(|&size| score(&edit(size), &truth(), &with_thresholds(&[0.02]))).collect()
}

#[test]
fn deeper_boxes_score_less_and_less() {
    let deep = |h: f64| models::prepared(&cuboid([0.0; 3], [2.0, 3.0, 4.0 + h]));
    fall(&scored(deep, &[0.05, 0.2, 0.8]));
}

#[test]
fn shallower_boxes_score_less_and_less() {
    let shallow = |h: f64| models::prepared(&cuboid([0.0; 3], [2.0, 3.0, 4.0 - h]));
    fall(&scored(shallow, &[0.05, 0.2, 0.8]));
}

/// Larger specks at one gap; and one speck farther and farther, whose area and volume stay.
#[test]
fn specks_score_less_and_less() {
    let whole = cuboid([0.0; 3], super::SIZE);
    let at = |s: f64, g: f64| together(&[&whole, &cuboid([2.0 + g, 0.5, 0.75], [s; 3])]);
    fall(&scored(|s| at(s, 0.5), &[0.2, 0.4, 0.8]));
    let far = scored(|g| at(0.2, g), &[0.5, 1.0, 2.0]);
    for pair in far.windows(2) {
        for (before, after) in lengths(&pair[0]).into_iter().zip(lengths(&pair[1])) {
            assert_eq!(before.is_below(&after), Some(true), "{before:?} {after:?}");
        }
        for (before, after) in parts(&pair[0]).into_iter().zip(parts(&pair[1])) {
            assert_ne!(before.is_below(&after), Some(true), "{before:?} {after:?}");
            assert_ne!(after.is_below(&before), Some(true), "{before:?} {after:?}");
        }
    }
    for (found, gap) in far.iter().zip([0.5, 1.0, 2.0]) {
        holds(found.forward.unwrap().mean, speck(0.2, gap)[0], found.tolerance);
    }
}
