//! Poses that differ from found ones by what is nearly a symmetry of A: a cube with a small notch, a disc with a pin.

use super::moments::Principal;
use super::poses::Candidate;
use super::samples::Samples;
use crate::model::RigidTransform;
use glam::{DQuat, DVec3};
use std::f64::consts::TAU;

/// The number of turns about each principal axis: at a distance r from it they are r / 19 apart, about what a fit from there
/// closes.
const TURNS: usize = 120;

/// The number of poses that are turned: those on both sides of a flat part.
const MOST_TURNED: usize = 2;

/// Returns poses that fit nearly as well as those found, the best of which is the first: after the motion from it to each
/// other one, and after turns about A's principal axes. O(found²).
pub(crate) fn near_symmetries(found: &[Candidate], samples: &Samples) -> Vec<RigidTransform> {
    let Some(best) = found.first() else { return Vec::new() };
    let back = best.motion.inverse();
    let between: Vec<RigidTransform> = found.iter().map(|one| after(&back, &one.motion)).collect();
    let axes = Principal::of(samples).axes;
    let turn = |axis: DVec3, step: usize| {
        let rotation = DQuat::from_axis_angle(axes * axis, TAU * step as f64 / TURNS as f64);
        RigidTransform::about(rotation, samples.center, samples.center)
    };
    let turns: Vec<RigidTransform> =
        DVec3::AXES.into_iter().flat_map(|axis| (1..TURNS).map(move |step| turn(axis, step))).collect();
    let moved = |one: &Candidate, motions: &[RigidTransform]| -> Vec<RigidTransform> {
        motions.iter().map(|motion| after(&one.motion, motion)).collect()
    };
    let among = found.iter().flat_map(|one| moved(one, &between));
    among.chain(found.iter().take(MOST_TURNED).flat_map(|one| moved(one, &turns))).collect()
}

/// Returns the motion that is the second one followed by the first.
fn after(second: &RigidTransform, first: &RigidTransform) -> RigidTransform {
    let rotation = (second.rotation() * first.rotation()).normalize();
    RigidTransform::about(rotation, DVec3::ZERO, second.apply(first.offset()))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Of a quarter turn the other three, and the turns by 3° about each axis of points at unlike distances.
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
