//! Pairs with known distances: spheres, tori and cylinders.

use super::surfaces::{direction, magnitude};
use fastrand::Rng;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::shapes::operations::transformed;
use nurbs_hausdorff::shapes::{lateral, sphere, torus};
use nurbs_hausdorff::{Model, RigidTransform, SurfaceArrays};
use std::f64::consts::TAU;

/// A and B with the directed distances from A to B and from B to A.
pub(crate) struct Offset {
    pub(crate) a: Vec<SurfaceArrays>,
    pub(crate) b: Vec<SurfaceArrays>,
    pub(crate) truth: [f64; 2],
}

pub(crate) fn offset(rng: &mut Rng) -> Offset {
    let radius = magnitude(rng, -1.0, 1.0);
    let other = match rng.u8(0..3) {
        0 => radius,
        1 => radius * (1.0 + magnitude(rng, -7.0, -1.0)),
        _ => magnitude(rng, -1.0, 1.0),
    };
    let about_axis = DQuat::from_rotation_z(rng.f64() * TAU);
    let parallel = |[a, b]: [Model; 2]| Offset {
        a: arrays(&a, about_axis, DVec3::ZERO),
        b: arrays(&b, DQuat::IDENTITY, DVec3::ZERO),
        truth: [(radius - other).abs(); 2],
    };
    match rng.u8(0..4) {
        0 => {
            let major = radius.max(other) * (1.1 + rng.f64());
            parallel([radius, other].map(|minor| torus(major, minor).unwrap()))
        }
        1 => parallel([radius, other].map(|radius| {
            let side = lateral([radius, radius], [0.0, 1.0]).unwrap();
            Model::new(None, vec![side]).unwrap()
        })),
        _ => {
            let shift = if rng.bool() { 0.0 } else { magnitude(rng, -4.0, 1.0) };
            // The distances from one centre to points of the other sphere fill an
            // interval, and the largest distance is attained at one of its ends.
            let farthest =
                |from: f64, to: f64| (shift + from - to).abs().max(((shift - from).abs() - to).abs());
            let turned = |rng: &mut Rng, radius: f64, center: DVec3| {
                let turn = DQuat::from_axis_angle(direction(rng), rng.f64() * TAU);
                arrays(&sphere(DVec3::ZERO, radius).unwrap(), turn, center)
            };
            let center = direction(rng) * shift;
            Offset {
                a: turned(rng, radius, center),
                b: turned(rng, other, DVec3::ZERO),
                truth: [farthest(radius, other), farthest(other, radius)],
            }
        }
    }
}

pub(crate) fn arrays(model: &Model, turn: DQuat, shift: DVec3) -> Vec<SurfaceArrays> {
    let model = transformed(model, &RigidTransform::new(turn, shift).unwrap()).unwrap();
    model.surfaces().iter().map(|surface| surface.clone().into_arrays()).collect()
}
