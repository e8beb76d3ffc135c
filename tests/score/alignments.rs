//! Candidates laid on the truth, with what was done stated.

use super::{SIZE, are, cuboid, deeper, holds, models, score, truth, with_thresholds};
use nurbs_hausdorff::{DQuat, DVec3, RigidTransform, ScoreAlignment, ScoreOptions};

/// A box elsewhere and 2.5 times as large is the truth once middles and longest sides agree.
#[test]
fn boxes_are_scaled_and_shifted() {
    let factor = 2.5;
    let large = models::prepared(&cuboid([7.0, -3.0, 1.0], SIZE.map(|size| factor * size)));
    let options = ScoreOptions { align: ScoreAlignment::Box, ..with_thresholds(&[0.1]) };
    let found = score(&large, &truth(), &options);
    assert!((found.placement.scale - 1.0 / factor).abs() < 1e-9, "{:?}", found.placement);
    assert!(found.placement.fit.is_none());
    are(&found, [0.0; 3], [0.0; 3]);
    holds(found.candidate.volume.unwrap(), 24.0, 1e-6);
    holds(found.centroid_distance.unwrap(), 0.0, 1e-8);
    let as_it_is = score(&large, &truth(), &with_thresholds(&[0.1]));
    assert!(as_it_is.hausdorff.unwrap().distance.lower > 3.0);
    assert_eq!((as_it_is.placement.scale, as_it_is.placement.transform), (1.0, RigidTransform::IDENTITY));
}

/// Meshes and exact models are scaled alike.
#[test]
fn meshes_are_scaled() {
    let (corners, triangles) = models::cuboid(DVec3::ZERO, 4.0 * DVec3::from_array(SIZE));
    let options = ScoreOptions { align: ScoreAlignment::Box, ..with_thresholds(&[0.1]) };
    let found = score(&models::mesh(&corners, &triangles), &truth(), &options);
    assert!((found.placement.scale - 0.25).abs() < 1e-9);
    are(&found, [0.0; 3], [0.0; 3]);
}

/// A box turned and moved is laid back, in one of the four ways in which a box of three lengths lies on itself.
#[test]
fn the_best_fit_is_stated_with_the_other_poses() {
    let turn = RigidTransform::new(DQuat::from_rotation_z(0.7), DVec3::new(5.0, 1.0, -2.0)).unwrap();
    let moved = nurbs_hausdorff::shapes::operations::transformed(&cuboid([0.0; 3], SIZE), &turn).unwrap();
    let options = ScoreOptions {
        align: ScoreAlignment::BestFit,
        relative_tolerance: Some(1e-3),
        ..with_thresholds(&[0.1])
    };
    let found = score(&models::prepared(&moved), &truth(), &options);
    let fit = found.placement.fit.as_ref().unwrap();
    assert!(fit.converged && fit.ambiguous.len() == 3 && fit.tried > 600, "{fit:?}");
    assert_eq!(found.placement.transform, fit.transform);
    // A fit is good, not exact: the score is that of the pose that it states.
    assert!(found.converged && found.hausdorff.unwrap().distance.upper < found.tolerance);
    for difference in found.extent_differences {
        assert!(difference.lower < 1e-4 && difference.upper < 1e-3, "{difference:?}");
    }
    // Where it lies in its file its extents are others: that of x is 2 cos + 3 sin of the angle.
    let as_it_is = score(&models::prepared(&moved), &truth(), &with_thresholds(&[0.1]));
    let x = 2.0 * 0.7_f64.cos() + 3.0 * 0.7_f64.sin();
    holds(as_it_is.candidate.extents[0], x, 1e-8);
    let back = ScoreOptions { transform: turn.inverse(), ..with_thresholds(&[0.1]) };
    let found = score(&models::prepared(&moved), &truth(), &back);
    are(&found, [0.0; 3], [0.0; 3]);
    for (extent, expected) in found.candidate.extents.into_iter().zip(SIZE) {
        holds(extent, expected, 1e-8);
    }
    holds(found.centroid_distance.unwrap(), 0.0, 1e-8);
}

/// A deeper box by its box is scaled down, so that it is narrower than the truth: no alignment is neutral.
#[test]
fn alignments_change_the_score() {
    let deep = models::prepared(&cuboid([0.0; 3], [2.0, 3.0, 4.5]));
    let (there, back) = deeper(0.5);
    are(&score(&deep, &truth(), &with_thresholds(&[0.1])), there, back);
    let options = ScoreOptions { align: ScoreAlignment::Box, ..with_thresholds(&[0.1]) };
    let found = score(&deep, &truth(), &options);
    holds(found.volume.unwrap().ratio, (8.0_f64 / 9.0).powi(2), 1e-6);
    // The corners are the farthest: 1/9 and 1.5/9 apart.
    holds(found.hausdorff.unwrap().distance, 1.0_f64.hypot(1.5) / 9.0, found.tolerance * 1.01);
}
