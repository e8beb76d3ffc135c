//! Surfaces of revolution and spheres are searched along one profile or in
//! closed form, and only where that is right.

use crate::support::cpu::measure;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::bezier::extract;
use nurbs_hausdorff::internals::closest::{Target, closest};
use nurbs_hausdorff::internals::engine::DistanceOptions;
use nurbs_hausdorff::shapes::operations::{part, transformed};
use nurbs_hausdorff::shapes::{lateral, shape, sphere, torus};
use nurbs_hausdorff::{CertifiedOptions, Method, Model, RigidTransform};

/// Cells that are few: those of a profile. Those of a surface are more than ten
/// thousand in these tests.
const FEW: usize = 1500;
/// Rounding of a search relative to the diagonal.
const ROUNDING: f64 = 1e-12;

/// Whether the truth is in the interval, and how many cells that took.
fn cells(name: &str, a: &Model, b: &Model, truth: f64, tolerance: f64) -> usize {
    let result = measure(
        a,
        b,
        &DistanceOptions {
            method: Method::Certified(CertifiedOptions { max_seconds: Some(60.0), ..Default::default() }),
            relative_tolerance: Some(tolerance),
            ..DistanceOptions::default()
        },
    );
    let cells = result.certified().unwrap().cells;
    println!("{name}: [{:e}, {:e}], {cells} cells", result.lower, result.upper);
    let rounding = ROUNDING * result.diagonal;
    assert!(result.converged, "{name}");
    assert!(result.lower <= truth + rounding && truth <= result.upper + rounding, "{name}: {truth}");
    assert!(result.upper - result.lower <= tolerance * result.diagonal + 2.0 * rounding, "{name}");
    cells
}

fn turn() -> RigidTransform {
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.7).normalize(), 1.1);
    RigidTransform::new(turn, DVec3::ZERO).unwrap()
}

fn moved(model: &Model, by: [f64; 3]) -> Model {
    transformed(model, &RigidTransform::translation(DVec3::from_array(by)).unwrap()).unwrap()
}

/// The first half of its parameters along one axis.
fn half(model: &Model, axis: usize) -> Model {
    let fractions = if axis == 0 { [[0.0, 0.5], [0.0, 1.0]] } else { [[0.0, 1.0], [0.0, 0.5]] };
    Model::new(None, vec![part(&model.surfaces()[0], fractions.into()).unwrap()]).unwrap()
}

#[test]
fn spheres_however_turned() {
    let one = sphere(DVec3::ZERO, 1.0).unwrap();
    for radius in [0.5, 1.0, 1.1] {
        let other = transformed(&sphere(DVec3::ZERO, radius).unwrap(), &turn()).unwrap();
        for tolerance in [1e-6, 1e-10] {
            assert!(cells("concentric", &other, &one, (1.0 - radius).abs(), tolerance) < FEW);
        }
        // The farthest point lies on the line through the centres.
        let beside = moved(&other, [0.3, -0.4, 0.0]);
        cells(
            "beside each other",
            &beside,
            &one,
            (radius + 0.5 - 1.0_f64).max(1.0 - (radius - 0.5_f64).abs()),
            1e-6,
        );
    }
}

#[test]
fn about_one_axis() {
    let [thin, fat] = [1.0, 1.3].map(|tube| torus(4.0, tube).unwrap());
    let about_z = RigidTransform::new(DQuat::from_rotation_z(0.3), DVec3::ZERO).unwrap();
    let turned = transformed(&fat, &about_z).unwrap();
    assert!(cells("tori", &turned, &thin, 0.3, 1e-6) < FEW);
    // On top of each other: the lower one's lowest circle.
    assert!(cells("tori above", &moved(&turned, [0.0, 0.0, 0.5]), &thin, 0.8, 1e-6) < FEW);
    // Elsewhere also, along any axis.
    let away = |model: &Model| transformed(&moved(model, [3.0, -7.0, 11.0]), &turn()).unwrap();
    assert!(cells("tori turned", &away(&turned), &away(&thin), 0.3, 1e-6) < FEW);
    // A sphere is one about every axis through its centre.
    let ball = transformed(&sphere(DVec3::ZERO, 1.0).unwrap(), &turn()).unwrap();
    assert!(cells("torus to sphere", &fat, &ball, 4.3, 1e-6) < FEW);
}

#[test]
fn not_about_one_axis() {
    let ring = torus(4.0, 1.0).unwrap();
    for by in [1e-2, 1e-4, 1e-7, 1e-9] {
        // Where the normal points along the way moved, no point of B is nearer.
        cells("beside its axis", &moved(&ring, [by, 0.0, 0.0]), &ring, by, 1e-6);
    }
}

#[test]
fn parts_that_do_not_go_round() {
    let whole = Model::new(None, vec![lateral([1.0, 1.0], [0.0, 2.0]).unwrap()]).unwrap();
    // Of the missing half, the middle is as far from both edges.
    cells("half a cylinder", &whole, &half(&whole, 0), 2.0_f64.sqrt(), 1e-6);
    cells("the other way", &half(&whole, 0), &whole, 0.0, 1e-6);
    let ball = sphere(DVec3::ZERO, 1.0).unwrap();
    for axis in [0, 1] {
        let half = half(&ball, axis);
        // The missing half's pole is as far from all of the edge.
        for other in [&ball, &transformed(&ball, &turn()).unwrap()] {
            cells("half a sphere", other, &half, 2.0_f64.sqrt(), 1e-6);
            cells("on half a sphere", &half, other, 0.0, 1e-6);
        }
    }
}

/// Of three quarters, the missing one's middle is as far from both edges:
/// cos 45° along the circle and 1 - sin 45° beside it.
#[test]
fn three_quarters_that_do_not_go_round() {
    let missing = (2.0 - 2.0_f64.sqrt()).sqrt();
    let three_quarters = |model: &Model| {
        let part = part(&model.surfaces()[0], [[0.0, 0.75], [0.0, 1.0]].into()).unwrap();
        Model::new(None, vec![part]).unwrap()
    };
    let whole = Model::new(None, vec![lateral([1.0, 1.0], [0.0, 2.0]).unwrap()]).unwrap();
    cells("a cylinder", &whole, &three_quarters(&whole), missing, 1e-6);
    let ball = sphere(DVec3::ZERO, 1.0).unwrap();
    cells("a sphere", &ball, &three_quarters(&ball), missing, 1e-6);
    cells("a sphere turned", &transformed(&ball, &turn()).unwrap(), &three_quarters(&ball), missing, 1e-6);
}

/// A sample's distance, certified from below, is at most the upper bound.
fn largest_sample(a: &Model, b: &Model) -> f64 {
    let (a, b) = (extract(a), Target::new(extract(b).patches));
    let mut largest = 0.0_f64;
    for patch in a.patches.iter() {
        for sample in 0..49 {
            let point = patch.point([f64::from(sample / 7) / 6.0, f64::from(sample % 7) / 6.0]);
            largest = largest.max(closest(&b, point, 1e-12).unwrap().lower);
        }
    }
    largest
}

/// One control point moved by a little moves the surface by at most as much.
#[test]
fn a_dent_is_seen() {
    for (name, point) in [("sphere", 13), ("torus", 40), ("bottle", 30)] {
        let model = shape(name).unwrap();
        for depth in [1e-2, 1e-5, 1e-7, 1e-9] {
            let mut arrays = model.surfaces()[0].clone().into_arrays();
            let dent = depth * model.bounding_box().diagonal();
            arrays.control_points[point][0] += dent;
            let dented = Model::from_arrays(None, vec![arrays]).unwrap();
            for (a, b) in [(&dented, &model), (&model, &dented)] {
                let found = largest_sample(a, b);
                for tolerance in [1e-6, 1e-8] {
                    let options = DistanceOptions {
                        method: Method::Certified(CertifiedOptions {
                            max_cells: Some(20_000),
                            ..Default::default()
                        }),
                        relative_tolerance: Some(tolerance),
                        ..DistanceOptions::default()
                    };
                    let result = measure(a, b, &options);
                    println!("{name} {depth:e}: [{:e}, {:e}], {found:e}", result.lower, result.upper);
                    let rounding = ROUNDING * result.diagonal;
                    assert!(result.lower <= dent + rounding, "{name} {depth}");
                    assert!(found <= result.upper, "{name} {depth}");
                    if tolerance < depth {
                        assert!(found > 0.01 * dent, "{name} {depth}: a dent that no sample sees");
                    }
                }
            }
        }
    }
}
