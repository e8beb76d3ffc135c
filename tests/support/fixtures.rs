//! Small models and transforms that several tests share.

use glam::{DQuat, DVec3};
use nurbs_hausdorff::{HierarchyOptions, Method, MethodName, Model, RigidTransform, SurfaceArrays};

/// A translation by finite amounts.
pub fn translation(x: f64, y: f64, z: f64) -> RigidTransform {
    RigidTransform::translation(DVec3::new(x, y, z)).unwrap()
}

/// A rotation about a skew axis with a small translation.
pub fn turned() -> RigidTransform {
    let rotation = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.8);
    RigidTransform::new(rotation, DVec3::new(0.3, -0.2, 0.1)).unwrap()
}

/// The unit square whose lower corner is (`x`, 0), at this height.
pub fn square(x: f64, height: f64) -> SurfaceArrays {
    let corner = |i: f64, j: f64| [x + i, j, height, 1.0];
    SurfaceArrays {
        degree: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        counts: [2, 2],
        control_points: vec![corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 0.0), corner(1.0, 1.0)],
    }
}

/// A bicubic sheet over the unit square whose inner control point (1, 1) has this
/// weight: a large one makes the bounds of its derivatives useless on large cells.
pub fn peaked_sheet(weight: f64) -> Model {
    let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let point = |index: usize| {
        let [x, y] = [index / 4, index % 4].map(|k| k as f64 / 3.0);
        [x, y, 0.3 * (5.0 * x).sin() * (4.0 * y).cos(), if index == 5 { weight } else { 1.0 }]
    };
    let control_points = (0..16).map(point).collect();
    model(vec![SurfaceArrays {
        degree: [3, 3],
        knots: [knots.clone(), knots],
        counts: [4, 4],
        control_points,
    }])
}

/// A model of surfaces that are known to be valid.
pub fn model(surfaces: Vec<SurfaceArrays>) -> Model {
    Model::from_arrays(None, surfaces).unwrap()
}

/// Returns a method with its defaults but for the cells of method `hierarchy`.
pub fn with_grid(method: MethodName, grid: usize) -> Method {
    match method {
        MethodName::Hierarchy => Method::Hierarchy(HierarchyOptions { grid, ..Default::default() }),
        other => other.into(),
    }
}
