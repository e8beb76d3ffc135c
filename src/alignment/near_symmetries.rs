//! Candidate poses by near symmetries of A, such as the rotations of a cube with a small notch and of a disc with a pin.

use super::moments::Principal;
use super::poses::Candidate;
use super::samples::Samples;
use crate::model::RigidTransform;
use glam::{DQuat, DVec3};
use std::f64::consts::TAU;

/// The number of rotations about each principal axis. A point at the distance r from the axis moves by r / 19 from one
/// rotation to the next, and the nearest rotation is off by half of that at most. Local fits converge from there.
const TURNS: usize = 120;

/// The number of poses that are rotated about the principal axes: a flat part has two, one on each side.
const MOST_TURNED: usize = 2;

/// Returns candidate poses by near symmetries of A, for poses that were found, the best first.
///
/// The motions between the best pose and each pose found are near symmetries of A if these poses fit nearly alike. The
/// candidates are all poses found after each of these motions, and the first poses after rotations about the principal axes
/// of A's samples. O(found²).
pub(crate) fn near_symmetries(found: &[Candidate], samples: &Samples) -> Vec<RigidTransform> {
    let Some(best) = found.first() else { return Vec::new() };
    let back = best.motion.inverse();
    let between: Vec<RigidTransform> = found.iter().map(|one| composed(&one.motion, &back)).collect();
    let axes = Principal::of(samples).axes;
    let turn = |axis: DVec3, step: usize| {
        let rotation = DQuat::from_axis_angle(axes * axis, TAU * step as f64 / TURNS as f64);
        RigidTransform::about(rotation, samples.center, samples.center)
    };
    let turns: Vec<RigidTransform> =
        DVec3::AXES.into_iter().flat_map(|axis| (1..TURNS).map(move |step| turn(axis, step))).collect();
    let moved = |one: &Candidate, motions: &[RigidTransform]| -> Vec<RigidTransform> {
        motions.iter().map(|motion| composed(motion, &one.motion)).collect()
    };
    let among = found.iter().flat_map(|one| moved(one, &between));
    among.chain(found.iter().take(MOST_TURNED).flat_map(|one| moved(one, &turns))).collect()
}

/// Returns the first motion followed by the second one.
fn composed(first: &RigidTransform, second: &RigidTransform) -> RigidTransform {
    let rotation = (second.rotation() * first.rotation()).normalize();
    RigidTransform::about(rotation, DVec3::ZERO, second.apply(first.offset()))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Two poses that differ by a quarter turn give the other two quarter turns. The points have three unequal principal
    /// moments, so that the axes are known: rotations by multiples of 3° are candidates too, and no others.
    #[test]
    fn found_turns_are_repeated() {
        let points = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().zip([3.0, 2.0, 1.0]);
        let points: Vec<DVec3> = points.flat_map(|(axis, length)| [length * axis, -length * axis]).collect();
        let samples = Samples::new(points, vec![1.0; 6]);
        let at = |degrees: f64| {
            let rotation = DQuat::from_rotation_z(degrees.to_radians());
            Candidate { motion: RigidTransform::about(rotation, DVec3::ZERO, DVec3::X), rms: degrees }
        };
        let found = near_symmetries(&[at(10.0), at(100.0)], &samples);
        let has = |degrees: f64| {
            let expected = at(degrees).motion;
            let is_it = |one: &RigidTransform| {
                one.rotation().dot(expected.rotation()).abs() > 1.0 - 1e-12
                    && one.offset().distance(expected.offset()) < 1e-12
            };
            found.iter().any(is_it)
        };
        assert!([10.0, 100.0, 190.0, 13.0, 310.0].into_iter().all(has));
        assert!(![11.0, 56.0].into_iter().any(has));
    }
}
