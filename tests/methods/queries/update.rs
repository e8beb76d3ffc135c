//! Models whose control points change on the same knots.

use glam::DVec3;
use nurbs_hausdorff::internals::engine::{DistanceOptions, DistanceResult, Engine, PreparedModel};
use nurbs_hausdorff::{HierarchyOptions, Method, Model, shapes};

/// The sheet with every control point moved by a wave of this phase.
fn waved(model: &Model, phase: f64) -> Vec<[f64; 4]> {
    let wave = |&[x, y, z, w]: &[f64; 4]| [x, y, z + 0.3 * (3.0 * x + 2.0 * y + phase).sin(), w];
    model.surfaces()[0].control_points().iter().map(wave).collect()
}

fn distance(a: &PreparedModel, b: &PreparedModel, options: &DistanceOptions) -> DistanceResult {
    let engine = Engine::cpu();
    engine.distance(a, b, options).wait().unwrap()
}

fn overlap(one: &DistanceResult, other: &DistanceResult) -> bool {
    one.lower <= other.upper && other.lower <= one.upper
}

#[test]
fn an_updated_model_is_measured_as_a_new_one() {
    let source = shapes::shape("wavy-sheet").unwrap();
    let fixed = PreparedModel::new(&shapes::shape("sphere").unwrap()).unwrap();
    let mut updated = PreparedModel::new(&source).unwrap();
    let mut grids = 0;
    // More frames than an update keeps cuts and trees for.
    for frame in 0..40 {
        let model = source.with_control_points(0, waved(&source, 0.2 * f64::from(frame))).unwrap();
        updated = updated.updated(&model).unwrap();
        let new = PreparedModel::new(&model).unwrap();
        let options =
            DistanceOptions { relative_tolerance: Some(1e-6), symmetric: true, ..DistanceOptions::default() };
        let (refitted, prepared) = (distance(&updated, &fixed, &options), distance(&new, &fixed, &options));
        assert!(refitted.converged && prepared.converged && overlap(&refitted, &prepared), "frame {frame}");
        assert_eq!(updated.bounding_box(), new.bounding_box());
        if frame % 8 == 0 {
            grids += 1;
            let options = DistanceOptions {
                method: Method::Hierarchy(HierarchyOptions { grid: 16, ..Default::default() }),
                ..options
            };
            let [kept, fresh] = [&updated, &new].map(|model| distance(model, &fixed, &options));
            // The same tree of the same cells.
            assert_eq!([kept.lower, kept.upper], [fresh.lower, fresh.upper], "frame {frame}");
        }
    }
    assert_eq!(grids, 5);
}

#[test]
fn large_changes_of_shape_keep_the_bounds_true() {
    // A flat sheet, cut little, that becomes a curved one far away.
    let flat = shapes::shape("wavy-sheet").unwrap();
    let points = |height: f64, shift: DVec3| {
        let point =
            |&[x, y, _, w]: &[f64; 4]| [x + shift.x, y + shift.y, height * (x * x - y * y) + shift.z, w];
        flat.surfaces()[0].control_points().iter().map(point).collect::<Vec<_>>()
    };
    let start = flat.with_control_points(0, points(0.0, DVec3::ZERO)).unwrap();
    let prepared = PreparedModel::new(&start).unwrap();
    let options = DistanceOptions::default();
    distance(&prepared, &prepared, &options);
    for (height, shift) in [(2.0, DVec3::ZERO), (5.0, DVec3::new(1e3, -1e3, 7.0)), (0.0, DVec3::Z)] {
        let model = start.with_control_points(0, points(height, shift)).unwrap();
        let refitted = distance(&prepared, &prepared.updated(&model).unwrap(), &options);
        let fresh = distance(&prepared, &PreparedModel::new(&model).unwrap(), &options);
        assert!(refitted.converged && overlap(&refitted, &fresh), "{height}: {refitted:?}");
    }
    // A plane one above another.
    let above = start.with_control_points(0, points(0.0, DVec3::Z)).unwrap();
    let result = distance(&prepared, &prepared.updated(&above).unwrap(), &options);
    assert!(result.lower <= 1.0 && 1.0 <= result.upper && result.upper < 1.0 + 1e-4);
}

#[test]
fn wrong_control_points_are_refused() {
    let model = shapes::shape("sphere").unwrap();
    let points = model.surfaces()[0].control_points().to_vec();
    let code = |surface, points| model.with_control_points(surface, points).unwrap_err().code();
    assert_eq!(code(0, points[1..].to_vec()), "RAGGED_NET");
    assert_eq!(code(9, points.clone()), "OPTION_OUT_OF_RANGE");
    let mut negative = points;
    negative[0][3] = -1.0;
    assert_eq!(code(0, negative), "WEIGHT_NOT_POSITIVE");
}
