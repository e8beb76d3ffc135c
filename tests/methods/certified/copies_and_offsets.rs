//! Copies that are moved, edited or given by other parameters, degrees and pieces
//! take few cells; surfaces that only nearly coincide are distinguished.

use crate::support::cpu::measure;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{DistanceOptions, DistanceResult};
use nurbs_hausdorff::shapes::operations::{elevate_degree, transformed};
use nurbs_hausdorff::shapes::shape;
use nurbs_hausdorff::{Axis, CertifiedOptions, Method, Model, NurbsSurface, RigidTransform, SurfaceArrays};

/// Cells that are few: halving down to cells of the tolerance takes some
/// hundred thousand.
const FEW: usize = 4000;

/// Rounding of a search relative to the diagonal.
const ROUNDING: f64 = 1e-12;

fn compared(a: &Model, b: &Model, transform: RigidTransform, tolerance: f64) -> DistanceResult {
    measure(
        a,
        b,
        &DistanceOptions {
            method: Method::Certified(CertifiedOptions { max_seconds: Some(30.0), ..Default::default() }),
            relative_tolerance: Some(tolerance),
            transform,
            ..DistanceOptions::default()
        },
    )
}

fn is_a_copy(name: &str, a: &Model, b: &Model, transform: RigidTransform) {
    for tolerance in [1e-6, 1e-10] {
        let result = compared(a, b, transform, tolerance);
        let cells = result.certified().unwrap().cells;
        println!("{name}: [{:e}, {:e}], {cells} cells", result.lower, result.upper);
        assert!(result.converged && result.lower == 0.0, "{name}: {result:?}");
        assert!(result.upper <= (tolerance + ROUNDING) * result.diagonal, "{name}: {}", result.upper);
        assert!(cells < FEW, "{name}: {cells} cells");
    }
}

/// With the axes taken in the order `axes`, each backwards or not.
fn by_other_parameters(surface: &NurbsSurface, axes: [Axis; 2], backwards: [bool; 2]) -> Model {
    let counts = axes.map(|axis| surface.counts()[axis]);
    let knots = [0, 1].map(|axis| {
        let knots = surface.knots(axes[axis]);
        let ends = knots[0] + knots[knots.len() - 1];
        if backwards[axis] { knots.iter().rev().map(|knot| ends - knot).collect() } else { knots.to_vec() }
    });
    let mut control_points = Vec::new();
    for row in 0..counts[0] {
        for column in 0..counts[1] {
            let place = [row, column];
            let turned = [0, 1].map(|k| if backwards[k] { counts[k] - 1 - place[k] } else { place[k] });
            let [i, j] = if axes == Axis::BOTH { turned } else { [turned[1], turned[0]] };
            control_points.push(surface.control_points()[i * surface.counts()[1] + j]);
        }
    }
    let degree = axes.map(|axis| surface.degree()[axis]);
    Model::from_arrays(None, vec![SurfaceArrays { degree, knots, counts, control_points }]).unwrap()
}

#[test]
fn copies_by_other_parameters_and_degrees() {
    for name in ["wavy-sheet", "glass", "bottle"] {
        let model = shape(name).unwrap();
        let surface = &model.surfaces()[0];
        is_a_copy(name, &model, &model, RigidTransform::IDENTITY);
        for (axes, backwards) in [
            (Axis::BOTH, [true, false]),
            (Axis::BOTH, [true, true]),
            ([Axis::V, Axis::U], [false, false]),
            ([Axis::V, Axis::U], [false, true]),
        ] {
            let other = by_other_parameters(surface, axes, backwards);
            let name = format!("{name} {axes:?} {backwards:?}");
            is_a_copy(&name, &other, &model, RigidTransform::IDENTITY);
        }
        let elevated = Model::new(None, vec![elevate_degree(surface, Axis::V).unwrap()]).unwrap();
        is_a_copy(&format!("{name} elevated"), &elevated, &model, RigidTransform::IDENTITY);
        is_a_copy(&format!("{name} to its elevated"), &model, &elevated, RigidTransform::IDENTITY);
    }
}

#[test]
fn a_copy_put_back_into_place() {
    let model = shape("wavy-sheet").unwrap();
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.8);
    let there = RigidTransform::new(turn, DVec3::new(3.0, -1.0, 2.0)).unwrap();
    let moved = transformed(&model, &there).unwrap();
    is_a_copy("a sheet put into place", &model, &moved, there);
}

/// Every point of a moved copy is at most as far from the model as it was
/// moved, and so far where the normal is along the way.
#[test]
fn a_moved_copy_takes_few_cells() {
    for (name, most) in [("wavy-sheet", 1500), ("torus", 1500)] {
        let model = shape(name).unwrap();
        for way in [DVec3::new(0.0, 0.0, 0.3), DVec3::new(1e-3, 0.0, 2e-3), DVec3::new(0.0, 1e-7, 0.0)] {
            let transform = RigidTransform::translation(way).unwrap();
            let result = compared(&model, &model, transform, 1e-6);
            let cells = result.certified().unwrap().cells;
            println!("{name} moved by {way}: [{:e}, {:e}], {cells} cells", result.lower, result.upper);
            assert!(result.converged && result.lower <= way.length() + ROUNDING);
            assert!(result.upper <= way.length() + 1e-6 * result.diagonal);
            assert!(cells < most, "{name}: {cells} cells");
            if name == "torus" {
                // Its normals point along every way.
                assert!(way.length() <= result.upper);
            }
        }
    }
}

/// One control point of many, moved: nobody else's patches need be searched.
#[test]
fn an_edited_copy_takes_few_cells() {
    let model = shape("wavy-sheet").unwrap();
    let mut arrays = model.surfaces()[0].clone().into_arrays();
    let middle = arrays.control_points.len() / 2;
    arrays.control_points[middle][2] += 0.1;
    let edited = Model::from_arrays(None, vec![arrays]).unwrap();
    for (a, b) in [(&model, &edited), (&edited, &model)] {
        let result = compared(a, b, RigidTransform::IDENTITY, 1e-6);
        let cells = result.certified().unwrap().cells;
        println!("an edited sheet: [{:e}, {:e}], {cells} cells", result.lower, result.upper);
        // A bump is lower than its control point is raised.
        assert!(result.converged && result.lower > 0.0 && result.lower < 0.1 && cells < FEW, "{cells}");
    }
}

/// A flat bicubic patch with one control point raised lies `δ B_1(s) B_1(t)`
/// above its plane, at most `δ (4/9)²`.
#[test]
fn a_small_bump_is_no_copy() {
    let sheet = |raised: f64| {
        let knots = || vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let mut control_points = Vec::new();
        for k in 0..16 {
            let z = if k == 5 { raised } else { 0.0 };
            control_points.push([f64::from(k / 4) / 3.0, f64::from(k % 4) / 3.0, z, 1.0]);
        }
        let arrays =
            SurfaceArrays { degree: [3, 3], knots: [knots(), knots()], counts: [4, 4], control_points };
        Model::from_arrays(None, vec![arrays]).unwrap()
    };
    for raised in [1e-3, 1e-6, 1e-9] {
        let truth = raised * (4.0_f64 / 9.0).powi(2);
        for tolerance in [1e-6, 1e-10, 1e-12] {
            let DistanceResult { lower, upper, converged, .. } =
                compared(&sheet(raised), &sheet(0.0), RigidTransform::IDENTITY, tolerance);
            assert!(converged, "{raised} {tolerance}");
            assert!(lower <= truth * (1.0 + ROUNDING) && truth <= upper, "{truth} not in [{lower}, {upper}]");
        }
    }
}
