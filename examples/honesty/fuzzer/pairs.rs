//! Random pairs of models of every awkward kind.

use super::offsets::{Offset, offset};
use super::partners::{both_sides, cut, moved, near, place, refined, transposed};
use super::surfaces::{direction, magnitude, surface, weights};
use fastrand::Rng;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::{Model, RigidTransform, SurfaceArrays};

/// Budgets of cells a direction, so that a pair takes milliseconds.
const BUDGETS: [usize; 5] = [1, 2000, 8000, 8000, 16000];

/// What is measured.
pub(crate) struct Pair {
    pub(crate) kind: &'static str,
    pub(crate) a: Model,
    pub(crate) b: Model,
    pub(crate) transform: RigidTransform,
    /// The directed distances, if they are known.
    pub(crate) truth: Option<[f64; 2]>,
    /// Relative to the diagonal.
    pub(crate) tolerance: f64,
    pub(crate) most_cells: usize,
    pub(crate) symmetric: bool,
    /// Relative to the diagonal.
    pub(crate) limit: Option<f64>,
}

/// The pair of a seed, always the same.
pub(crate) fn pair(seed: u64) -> Pair {
    let rng = &mut Rng::with_seed(seed);
    let (kind, mut a, mut b, mut truth) = models(rng);
    if rng.u8(0..4) == 0 {
        let (scale, far) = (magnitude(rng, -3.0, 3.0), direction(rng) * magnitude(rng, 0.0, 6.0));
        for model in [&mut a, &mut b] {
            place(model, scale, far.to_array());
        }
        truth = truth.map(|both| both.map(|distance| distance * scale));
    }
    let turns = truth.is_none() && rng.bool();
    let rotation =
        if turns { DQuat::from_axis_angle(direction(rng), rng.f64() * 0.2) } else { DQuat::IDENTITY };
    // About A's own corner, so that far models stay near each other.
    let corner = DVec3::from_slice(&a[0].control_points[0][..3]);
    let translation = corner - rotation * corner;
    Pair {
        kind,
        transform: RigidTransform::new(rotation, translation).unwrap(),
        a: Model::from_arrays(None, a).unwrap(),
        b: Model::from_arrays(None, b).unwrap(),
        truth,
        tolerance: magnitude(rng, -6.0, -2.0),
        most_cells: BUDGETS[rng.usize(0..BUDGETS.len())],
        symmetric: rng.u8(0..4) == 0,
        limit: (rng.u8(0..8) == 0).then(|| magnitude(rng, -5.0, 0.0)),
    }
}

type Models = (&'static str, Vec<SurfaceArrays>, Vec<SurfaceArrays>, Option<[f64; 2]>);

fn models(rng: &mut Rng) -> Models {
    let weights = weights(rng);
    let several = |rng: &mut Rng| -> Vec<SurfaceArrays> {
        (0..rng.usize(1..=4)).map(|_| surface(rng, weights)).collect()
    };
    let a = several(rng);
    let (kind, b) = match rng.u8(0..12) {
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
        _ => ("unrelated", several(rng)),
    };
    (kind, a, b, None)
}
