//! Evenly spread rotations, and the distinct ones of many poses.

use super::Samples;
use crate::model::RigidTransform;
use crate::sorting::sort_by_number;
use glam::DQuat;
use std::f64::consts::{SQRT_2, TAU};

/// The second ratio of the super-Fibonacci spiral, the positive root of x⁴ = x + 4.
const PSI: f64 = 1.533_751_168_755_204_3;

/// The mean movement of A's points between poses below which they count as one, in gyrations: a
/// fiftieth of the part's size.
const ONE_POSE: f64 = 0.05;

/// A pose with the root mean square of its residuals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Candidate {
    pub(crate) motion: RigidTransform,
    pub(crate) rms: f64,
}

/// Returns rotation `index` of `count` that are spread evenly over all, by the super-Fibonacci spiral
/// (M. Alexa, *Super-Fibonacci spirals: fast, low-discrepancy sampling of SO(3)*, CVPR 2022).
pub(super) fn spiral(index: usize, count: usize) -> DQuat {
    let along = index as f64 + 0.5;
    let share = along / count as f64;
    let (alpha, beta) = (TAU * along / SQRT_2, TAU * along / PSI);
    let (r, rest) = (share.sqrt(), (1.0 - share).sqrt());
    DQuat::from_xyzw(r * alpha.sin(), r * alpha.cos(), rest * beta.sin(), rest * beta.cos()).normalize()
}

/// Returns the root mean square of the movement of the samples from one pose to the other, up to
/// their shape: that of points spread evenly about their centre.
fn movement(samples: &Samples, one: &RigidTransform, other: &RigidTransform) -> f64 {
    let shift = one.apply(samples.center).distance(other.apply(samples.center));
    let cosine = one.rotation().dot(other.rotation()).abs().min(1.0);
    // A point at distance r from the axis moves by 2 r sin(angle / 2); r² is 2/3 of the square on average.
    let turned = 2.0 * (1.0 - cosine * cosine).sqrt() * samples.gyration * (2.0_f64 / 3.0).sqrt();
    shift.hypot(turned)
}

/// Returns the candidates in the order of their residuals, each pose once, at most `most`.
/// O(candidates most).
pub(crate) fn distinct(mut candidates: Vec<Candidate>, samples: &Samples, most: usize) -> Vec<Candidate> {
    sort_by_number(&mut candidates, |candidate| candidate.rms);
    let mut kept: Vec<Candidate> = Vec::new();
    for candidate in candidates {
        if kept.len() == most {
            break;
        }
        let is_known = |one: &Candidate| {
            movement(samples, &one.motion, &candidate.motion) <= ONE_POSE * samples.gyration
        };
        if !kept.iter().any(is_known) {
            kept.push(candidate);
        }
    }
    kept
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use glam::DVec3;

    /// Every rotation is within 30° of one of 600: checked at 2,000 others.
    #[test]
    fn rotations_are_spread_over_all() {
        let all: Vec<DQuat> = (0..600).map(|index| spiral(index, 600)).collect();
        for index in 0..2000 {
            let other = spiral(index, 2000);
            let nearest = all.iter().map(|one| one.dot(other).abs()).fold(0.0, f64::max);
            let angle = 2.0 * nearest.min(1.0).acos();
            assert!(angle.to_degrees() < 30.0, "{}", angle.to_degrees());
        }
    }

    #[test]
    fn a_pose_is_listed_once() {
        let samples = Samples::new(vec![DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y], vec![1.0; 4]);
        let at = |x: f64, rms| {
            let motion = RigidTransform::translation(DVec3::X * x).unwrap_or_default();
            Candidate { motion, rms }
        };
        let kept = distinct(vec![at(0.01, 3.0), at(0.0, 2.0), at(1.0, 1.0)], &samples, 8);
        assert_eq!(kept.iter().map(|one| one.rms).collect::<Vec<_>>(), [1.0, 2.0]);
        assert_eq!(distinct(vec![at(0.0, 2.0), at(1.0, 1.0)], &samples, 1).len(), 1);
    }
}
