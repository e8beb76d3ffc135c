//! Random pairs of models of many difficult kinds.

use super::offsets::{Offset, offset};
use super::partners::{both_sides, cut, moved, near, refined, scale_and_shift, transposed};
use super::refits::{Refit, refit};
use super::reparametrized::reparametrized;
use super::surfaces::{direction, magnitude, surface, weights};
use fastrand::Rng;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{Backend, MethodName};
use nurbs_hausdorff::{Model, RigidTransform, SurfaceArrays};

/// The budgets of cells per direction, with which a pair takes milliseconds.
pub(crate) const BUDGETS: [usize; 5] = [1, 2000, 8000, 8000, 16000];

/// A pair with the options of its computation.
pub(crate) struct Pair {
    pub(crate) kind: &'static str,
    pub(crate) a: Model,
    pub(crate) b: Model,
    pub(crate) transform: RigidTransform,
    /// The directed distances from A to B and from B to A, if they are known.
    pub(crate) truth: Option<[f64; 2]>,
    /// The tolerance relative to the diagonal.
    pub(crate) tolerance: f64,
    pub(crate) max_cells: usize,
    pub(crate) symmetric: bool,
    /// The limit relative to the diagonal.
    pub(crate) limit: Option<f64>,
    pub(crate) method: MethodName,
    pub(crate) backend: Backend,
    /// The exponent of the power of two by which both models are scaled for the
    /// computation, and the result is scaled back.
    pub(crate) exponent: i32,
}

/// Returns the pair of a seed, deterministically.
pub(crate) fn pair(seed: u64) -> Pair {
    drawn(seed, models)
}

/// Returns the pair of a seed of surfaces in other parameters.
pub(crate) fn reparametrized_pair(seed: u64) -> Pair {
    drawn(seed, in_other_parameters)
}

fn drawn(seed: u64, models: fn(&mut Rng) -> Models) -> Pair {
    let rng = &mut Rng::with_seed(seed);
    let (kind, mut a, mut b, mut truth) = models(rng);
    if rng.u8(0..4) == 0 {
        let (scale, shift) = (magnitude(rng, -3.0, 3.0), direction(rng) * magnitude(rng, 0.0, 6.0));
        for model in [&mut a, &mut b] {
            scale_and_shift(model, scale, shift.to_array());
        }
        truth = truth.map(|both| both.map(|distance| distance * scale));
    }
    let turns = truth.is_none() && rng.bool();
    let rotation =
        if turns { DQuat::from_axis_angle(direction(rng), rng.f64() * 0.2) } else { DQuat::IDENTITY };
    // The rotation is about a corner of A, so that models far from the origin stay near each other.
    let corner = DVec3::from_slice(&a[0].control_points[0][..3]);
    let translation = corner - rotation * corner;
    Pair {
        kind,
        transform: RigidTransform::new(rotation, translation).unwrap(),
        a: Model::from_arrays(None, a).unwrap(),
        b: Model::from_arrays(None, b).unwrap(),
        truth,
        tolerance: magnitude(rng, -6.0, -2.0),
        max_cells: BUDGETS[rng.usize(0..BUDGETS.len())],
        symmetric: rng.u8(0..4) == 0,
        limit: random_limit(rng),
        method: MethodName::Certified,
        backend: Backend::Cpu,
        exponent: 0,
    }
}

/// Returns a limit for one pair in eight.
pub(crate) fn random_limit(rng: &mut Rng) -> Option<f64> {
    (rng.u8(0..8) == 0).then(|| magnitude(rng, -5.0, 0.0))
}

type Models = (&'static str, Vec<SurfaceArrays>, Vec<SurfaceArrays>, Option<[f64; 2]>);

fn models(rng: &mut Rng) -> Models {
    let weights = weights(rng);
    let several = |rng: &mut Rng| -> Vec<SurfaceArrays> {
        (0..rng.usize(1..=4)).map(|_| surface(rng, weights)).collect()
    };
    let a = several(rng);
    let (kind, b) = match rng.u8(0..16) {
        0 => ("the same", a.clone()),
        1 | 2 => {
            let size = magnitude(rng, -9.0, -1.0);
            ("near-coincident", near(rng, &a, size))
        }
        3 => ("moved", moved(rng, &a)),
        4 => ("refined", refined(rng, &a)),
        5 => ("in pieces", cut(rng, &a)),
        6 => ("transposed", transposed(rng, &a)),
        7 => ("between two", both_sides(rng, &a)),
        8 | 9 => {
            let Offset { a, b, truth } = offset(rng);
            return ("offset", a, b, Some(truth));
        }
        10 => return in_other_parameters(rng),
        11..14 => {
            let Refit { a, b } = refit(rng);
            return ("refit", a, b, None);
        }
        _ => ("unrelated", several(rng)),
    };
    (kind, a, b, None)
}

fn in_other_parameters(rng: &mut Rng) -> Models {
    let [a, b] = reparametrized(rng);
    ("in other parameters", a, b, None)
}
