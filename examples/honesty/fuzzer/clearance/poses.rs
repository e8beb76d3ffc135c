//! Random poses of two models.

use super::super::pairs::{BUDGETS, pair};
use super::super::surfaces::{direction, magnitude};
use super::subjects::{Subject, Subjects};
use fastrand::Rng;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::Engine;
use nurbs_hausdorff::{ClearanceOptions, RigidTransform};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The distances between the models' centres, as parts of half the sum of their diagonals.
const REACH: [f64; 2] = [0.0, 1.2];

/// The tolerance, relative to the diagonal, and the budget of the search for the place at which models
/// are made to touch. Whatever it finds, the pose is valid.
const NEAR: f64 = 1e-9;
const CELLS_OF_NEAREST: usize = 20_000;

/// Two models with the options of their clearance.
pub(super) struct Posed {
    pub(super) a: Arc<Subject>,
    pub(super) b: Arc<Subject>,
    pub(super) options: ClearanceOptions,
}

impl Posed {
    pub(super) fn name(&self) -> String {
        format!("{} and {}", self.a.name, self.b.name)
    }

    fn new(rng: &mut Rng, a: Arc<Subject>, b: Arc<Subject>, transform: RigidTransform) -> Self {
        let diagonal = a.prepared.bounding_box().diagonal().max(b.prepared.bounding_box().diagonal());
        let limit = match rng.u8(0..8) {
            0 => Some(0.0),
            1 | 2 => Some(magnitude(rng, -4.0, 0.0) * diagonal),
            _ => None,
        };
        let options = ClearanceOptions {
            relative_tolerance: Some(magnitude(rng, -9.0, -2.0)),
            max_cells: Some(BUDGETS[rng.usize(0..BUDGETS.len())]),
            limit,
            transform,
            ..ClearanceOptions::default()
        };
        Self { a, b, options }
    }
}

/// Returns a pair of the ordinary families of models, A moved off B in half the cases.
pub(super) fn random(seed: u64, rng: &mut Rng) -> Option<Posed> {
    let drawn = pair(seed);
    let [a, b] =
        [("A", drawn.a), ("B", drawn.b)].map(|(name, model)| Subject::new(name, model).map(Arc::new));
    let (a, b) = (a?, b?);
    let size = a.prepared.bounding_box().diagonal() + b.prepared.bounding_box().diagonal();
    let away = if rng.bool() { direction(rng) * (size * magnitude(rng, -3.0, 0.0)) } else { DVec3::ZERO };
    let transform = RigidTransform::new(drawn.transform.rotation(), drawn.transform.offset() + away).ok()?;
    Some(Posed::new(rng, a, b, transform))
}

/// Returns a pose like this one at which the models touch but for rounding, or come as near as a small
/// part of A's diagonal, or cross by as much: A is moved by its distance from B.
fn touching(rng: &mut Rng, [a, b]: [&Subject; 2], transform: &RigidTransform) -> Option<RigidTransform> {
    let options = ClearanceOptions {
        transform: *transform,
        relative_tolerance: Some(NEAR),
        max_cells: Some(CELLS_OF_NEAREST),
        ..ClearanceOptions::default()
    };
    let witness = Engine::cpu().clearance(&a.prepared, &b.prepared, &options).wait().ok()?.witness;
    let between = DVec3::from_array(witness.b.point) - DVec3::from_array(witness.a.point);
    let beyond = match rng.u8(0..3) {
        0 => 0.0,
        1 => magnitude(rng, -13.0, -2.0),
        _ => -magnitude(rng, -13.0, -2.0),
    };
    let move_on = beyond * a.prepared.bounding_box().diagonal() * between.normalize_or_zero();
    RigidTransform::new(transform.rotation(), transform.offset() + between + move_on).ok()
}

/// Returns two of the subjects, A turned about its centre and moved to a place near B.
pub(super) fn of_subjects(rng: &mut Rng, Subjects(subjects): &Subjects) -> Option<Posed> {
    let [a, b] = [0, 1].map(|_| subjects[rng.usize(0..subjects.len())].clone());
    // Poses without a turn, along an axis, let faces lie parallel and in one plane.
    let is_aligned = rng.u8(0..4) == 0;
    let turn =
        if is_aligned { DQuat::IDENTITY } else { DQuat::from_axis_angle(direction(rng), TAU * rng.f64()) };
    let along = if is_aligned { DVec3::AXES[rng.usize(0..3)] } else { direction(rng) };
    let (of_a, of_b) = (a.prepared.bounding_box(), b.prepared.bounding_box());
    let reach = REACH[0] + (REACH[1] - REACH[0]) * rng.f64();
    let place = of_b.center() + along * (reach * 0.5 * (of_a.diagonal() + of_b.diagonal()));
    let transform = RigidTransform::new(turn, place - turn * of_a.center()).ok()?;
    let transform = if rng.u8(0..4) == 0 { touching(rng, [&a, &b], &transform)? } else { transform };
    Some(Posed::new(rng, a, b, transform))
}
